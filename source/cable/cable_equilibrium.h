// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cable_equilibrium_h
#define taut_cable_equilibrium_h

#include "base/newton_search.h"
#include <taut/cable/cable_elements.h>
#include <taut/substructure/local_solver.h>

#include <memory>
#include <vector>

namespace taut
{
  /// The equilibrium of one cable under dead loads, see find_shape(). Where a tangent is not
  /// definite, a part of the mass makes it so.
  class CableEquilibrium : private DescentProblem
  {
  public:
    /// @p held: DoFs; @p load [N, N m] is kept by reference.
    CableEquilibrium(const CableElements &cable, const std::vector<unsigned int> &held,
                     const std::vector<double> &load);

    /// Finds the equilibrium of @p cable, which may be softer than the first one, from @p q on.
    /// Returns false, with q unchanged, if there is no stable equilibrium within reach.
    bool find(const CableElements &cable, std::vector<double> &q);

    /// The same to a thousandth of the load, as a start for the next cable.
    bool find_roughly(const CableElements &cable, std::vector<double> &q);

    unsigned int iterations() const { return n_iterations; }
    double residual() const { return last_residual; } ///< [N]

    /// True if the last call ended in an equilibrium, stable or not.
    bool is_balanced() const { return balanced; }

  private:
    bool find(const CableElements &cable, NewtonConvergence::Limits limits, std::vector<double> &q);
    void begin() override;
    double solve() override;
    void go_on() override;
    bool accept() override;
    Descent descent() override;
    double shorten_to(double s) override;

    void move(double s);
    double find_residual(const std::vector<double> &at);
    double energy(const std::vector<double> &at) const;
    bool factor(bool definite, double mu);
    bool factor_shifted(bool definite);
    void set_unstable_direction();

    std::vector<unsigned int> held;
    const std::vector<double> &load;
    std::unique_ptr<LocalSolver> solver;
    std::unique_ptr<SymmetricMatrix> M; ///< of 1 kg/m
    const CableElements *cable = nullptr;
    std::vector<double> start, q, best, solution, r, direction;
    double scale = 0.;   ///< of forces [N]
    double reached = 0.; ///< part of the scale that counts as rest
    int n_unstable = 0;  ///< guesses in turn that balance and are not stable
    unsigned int n_iterations = 0;
    double last_residual = 0., least = 0.; ///< of the last guess, and of @ref best [N]
    bool balanced = false;
  };
} // namespace taut

#endif
