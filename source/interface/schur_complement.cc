// SPDX-License-Identifier: LGPL-2.1-or-later
#include "interface/assembled_schur_complement.h"
#include "interface/matrix_free_schur_complement.h"

#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>

#include <stdexcept>

namespace taut
{
  namespace
  {
    /// Numbers beside F for each DoF up to which F is assembled, some three times those of factors:
    /// 512 bytes, where a run of a line takes 0.55 kB in all (doc/decomposition.md).
    constexpr double most_stored_numbers = 64.;

    /// Numbers beside F, in all, up to which F is assembled for an equilibrium whatever they are
    /// for each DoF, where columns are short: 32 MB. Conjugate gradients take three to five times
    /// longer on the cable of prm/cable_on_floor with 200 and 400 bars.
    constexpr double few_numbers = 4e6;

    /// Number of columns that estimate the length of all. A choice: each costs a solution of its
    /// bodies.
    constexpr std::size_t n_sampled_columns = 16;

    /// Numbers beside an assembled F, and the number of DoFs, on all ranks.
    std::vector<double> stored_numbers(const FactoredStructure &solvers,
                                       const Constraints &constraints)
    {
      WindowedVector column;
      double sum = 0.;
      const std::size_t n_fixed = constraints.fixed_rows().size(),
                        n = std::min(n_sampled_columns, n_fixed);
      for (std::size_t s = 0; s < n; ++s)
        for (const auto &[k, form, of] : constraints[s * n_fixed / n].terms)
        {
          solvers[k].column(form, column);
          sum += column.value.size();
        }
      // Without a coarse problem, statics stores responses of all constraints to rigid body modes.
      std::size_t n_null_space = 0;
      for (const FactoredStructure::RigidBodyModes &modes : solvers.rigid_body_modes())
        n_null_space += modes.vectors.size();
      std::vector<double> totals = {(n > 0 ? sum / n : 0.) * constraints.size() +
                                        static_cast<double>(n_null_space) * constraints.size(),
                                    static_cast<double>(solvers.structure().n_dofs())};
      solvers.structure().communicator().sum(totals);
      return totals;
    }

    /// True if columns are long, and F and its factor fit in the memory of an assembled F.
    bool suits_half_columns(const Structure &structure, const Constraints &constraints)
    {
      double n_dofs = structure.n_dofs();
      structure.communicator().sum(&n_dofs, 1);
      const auto n = static_cast<double>(constraints.n_of_all());
      return have_long_columns(structure) && 2. * n * n <= most_stored_numbers * n_dofs;
    }

    /// Whether a body of any rank has conditions inside, such as a rigid body, which the
    /// preconditioners of the matrix-free form do not know.
    bool has_conditions_inside(const Structure &structure)
    {
      bool result = false;
      for (std::size_t k = 0; k < structure.size(); ++k)
        result = result || dynamic_cast<const ConstrainedBody *>(&structure[k]);
      return structure.communicator().any(result);
    }

    /// The form that suits the constraints and the decay of their columns, known after
    /// factorisation.
    class AutomaticSchurComplement : public SchurComplement
    {
    public:
      AutomaticSchurComplement(const InterfaceParameters &parameters,
                               const FactoredStructure &solvers, const Constraints &constraints)
          : parameters(parameters), solvers(solvers), constraints(constraints)
      {
      }
      void setup(const std::vector<double> &S) override
      {
        const std::string form = choice();
        if (!chosen || parameters.form != form || form == "matrix-free")
        {
          if (chosen)
            earlier += chosen->statistics();
          parameters.form = form;
          chosen = make_schur_complement(parameters, solvers, constraints);
        }
        chosen->setup(S);
      }
      void set_compliance(const std::vector<double> &S) override { chosen->set_compliance(S); }
      void update_moving() override { chosen->update_moving(); }
      void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                  std::vector<double> &terms_size) const override
      {
        chosen->contact_free_predictor(P, d, terms_size);
      }
      ComplementarityOperator &matrix() override { return chosen->matrix(); }
      std::string description() const override { return chosen->description(); }
      InterfaceStatistics statistics() const override
      {
        InterfaceStatistics result = earlier;
        return result += chosen->statistics();
      }

    private:
      std::string choice() const
      {
        if (constraints.shared())
          return "matrix-free";
        if (constraints.size() <= most_dense_rows ||
            suits_half_columns(solvers.structure(), constraints))
          return "assembled dense";
        if (!solvers.is_generalised_inverse() && solvers.has_rigid_body_modes())
          return "assembled sparse";
        const std::vector<double> stored = stored_numbers(solvers, constraints);
        return stored[0] <= most_stored_numbers * stored[1] ||
                       has_conditions_inside(solvers.structure())
                   ? "assembled sparse"
               : solvers.is_generalised_inverse() && stored[0] <= few_numbers &&
                       !have_long_columns(solvers.structure())
                   ? "assembled dense"
                   : "matrix-free";
      }

      InterfaceParameters parameters;
      const FactoredStructure &solvers;
      const Constraints &constraints;
      std::unique_ptr<SchurComplement> chosen;
      InterfaceStatistics earlier; ///< of earlier forms
    };
  } // namespace

  bool suits_distributed_rows(const InterfaceParameters &parameters, const Structure &structure,
                              const Constraints &constraints, const bool is_at_rest)
  {
    const Communicator &processes = structure.communicator();
    const bool has_rows = constraints.n_of_all() > constraints.varying_rows().size();
    if (processes.size() == 1 || !has_rows)
      return false;
    if (parameters.form == "matrix-free")
      return true;
    if (parameters.form != "automatic" || !is_at_rest ||
        constraints.n_of_all() <= most_dense_rows || suits_half_columns(structure, constraints) ||
        has_conditions_inside(structure) || !have_long_columns(structure))
      return false;
    // A long column has a number for each DoF of the bodies of its row.
    std::vector<double> sums = {0., static_cast<double>(structure.n_dofs())};
    for (std::size_t i = 0; i < constraints.size(); ++i)
      for (const Term &term : constraints[i].terms)
        sums[0] += structure[term.substructure].n_dofs();
    processes.sum(sums);
    return sums[0] > most_stored_numbers * sums[1];
  }

  InterfaceStatistics &InterfaceStatistics::operator+=(const InterfaceStatistics &other)
  {
    n_systems += other.n_systems;
    n_iterations += other.n_iterations;
    n_applications += other.n_applications;
    n_local_solves += other.n_local_solves;
    return *this;
  }

  std::unique_ptr<SchurComplement> make_schur_complement(const InterfaceParameters &parameters,
                                                         const FactoredStructure &solvers,
                                                         const Constraints &constraints)
  {
    if (constraints.shared() && parameters.form != "automatic" && parameters.form != "matrix-free")
      throw std::invalid_argument("F of distributed constraints is not assembled");
    if (parameters.form == "automatic")
      return std::make_unique<AutomaticSchurComplement>(parameters, solvers, constraints);
    if (parameters.form == "assembled dense")
      return std::make_unique<DenseSchurComplement>(solvers, constraints);
    if (parameters.form == "assembled sparse")
      return std::make_unique<SparseSchurComplement>(solvers, constraints);
    if (parameters.form == "matrix-free")
      return std::make_unique<MatrixFreeSchurComplement>(parameters, solvers, constraints);
    throw UserError(
        "unknown form of the interface operator '" + parameters.form +
        "'; known are: automatic, assembled dense, assembled sparse, matrix-free. Correct the "
        "name");
  }
} // namespace taut
