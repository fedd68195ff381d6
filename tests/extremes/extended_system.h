// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_system_h
#define taut_extremes_extended_system_h

#include "extended_laws.h"

namespace extremes
{
  /// A U = P + B N with the conditions of the links of a scene, dense; see extended_answer().
  class ExtendedSystem
  {
  public:
    /// The arguments are kept by reference.
    ExtendedSystem(const taut::Scene &scene, const ExtendedModel &model, bool as_double);

    /// For this A from now on; of a static problem with springs. Throws std::runtime_error.
    void factor(const Matrix &full, bool is_static);

    /// N, D and U at time t with the forms @p B, under forces @p P. The condition of each
    /// constraint is on D + N / stiffness + @p past, or its law if it has one in @p laws. N as
    /// given says which constraints may be closed. Throws std::runtime_error if there is no answer.
    void solve(const Vector &P, const Number &t, const std::vector<Form> &B, const Vector &past,
               const std::vector<std::optional<ConservingLaw>> &laws, Vector &N, Vector &D,
               Vector &U);

    /// Of the constraints with their bodies held; empty before A is known.
    const Vector &flexibility() const { return flexibilities; }

    /// B_i^T A^-1 B_i of the last answer.
    const Vector &motion_of_force() const { return motions_of_forces; }

  private:
    Vector free_part(const Form &form) const;
    void check_answer(const Vector &rhs, const std::vector<Form> &B, const Vector &N,
                      const Vector &U) const;

    const taut::Scene &scene;
    const ExtendedModel &model;
    const bool as_double;
    std::vector<std::size_t> free_dofs;
    Matrix A_full;        ///< of all DoFs, without springs
    Vector spring;        ///< of the free DoFs
    Vector flexibilities; ///< what `shared_by` counts in
    Vector motions_of_forces;
    Cholesky factor_of_A;
  };
} // namespace extremes

#endif
