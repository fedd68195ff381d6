// SPDX-License-Identifier: LGPL-2.1-or-later
#include "assembled_schur_complement.h"
#include "matrix_free_schur_complement.h"

#include <taut/base/exceptions.h>

namespace taut
{
  namespace
  {
    /// Rows up to which a dense F is as fast as a sparse one.
    constexpr std::size_t most_dense_rows = 150;

    /// Numbers stored beside F for each DoF up to which F is assembled, some three times those of
    /// the factors.
    constexpr double most_stored_numbers = 64.;

    /// Columns that are computed to guess the length of all.
    constexpr std::size_t n_samples = 16;

    /// Numbers that an assembled F would store beside F, over the number of DoFs, on all ranks.
    double stored_numbers_per_dof(const FactoredStructure &solvers, const ContactRows &rows)
    {
      WindowedVector column;
      double sum = 0.;
      const std::size_t n = std::min(n_samples, rows.n_fixed());
      for (std::size_t s = 0; s < n; ++s)
        for (const auto &[k, form] : rows[s * rows.n_fixed() / n].terms)
        {
          solvers[k].column(form, column);
          sum += column.value.size();
        }
      // Without a coarse problem statics stores the response of all rows to each free motion.
      std::size_t n_kernel = 0;
      for (std::size_t k = 0; solvers.is_generalised_inverse() && k < solvers.structure().size();
           ++k)
        n_kernel += solvers.structure()[k].kernel().vectors.size();
      std::vector<double> totals = {(n > 0 ? sum / n : 0.) * rows.size() +
                                        static_cast<double>(n_kernel) * rows.size(),
                                    static_cast<double>(solvers.structure().n_dofs())};
      solvers.structure().communicator().sum(totals);
      return totals[0] / std::max(1., totals[1]);
    }

    /// The form that suits the rows and the decay of their columns, known only once A_k is
    /// factored.
    class AutomaticSchurComplement : public SchurComplement
    {
    public:
      AutomaticSchurComplement(const InterfaceParameters &parameters,
                               const FactoredStructure &solvers, const ContactRows &rows)
          : parameters(parameters), solvers(solvers), rows(rows)
      {
      }
      void setup(const std::vector<double> &S) override
      {
        parameters.form = choice();
        chosen = make_schur_complement(parameters, solvers, rows);
        chosen->setup(S);
      }
      void update_moving() override { chosen->update_moving(); }
      void free_motion(const BlockVector &P, std::vector<double> &d,
                       std::vector<double> &terms_size) const override
      {
        chosen->free_motion(P, d, terms_size);
      }
      ComplementarityOperator &matrix() override { return chosen->matrix(); }
      std::string description() const override { return chosen->description(); }
      InterfaceStatistics statistics() const override { return chosen->statistics(); }

    private:
      std::string choice() const
      {
        if (rows.size() <= most_dense_rows)
          return "assembled dense";
        if (solvers.has_free_motions())
          return "assembled sparse";
        return stored_numbers_per_dof(solvers, rows) <= most_stored_numbers ? "assembled sparse"
                                                                            : "matrix-free";
      }

      InterfaceParameters parameters;
      const FactoredStructure &solvers;
      const ContactRows &rows;
      std::unique_ptr<SchurComplement> chosen;
    };
  } // namespace

  std::unique_ptr<SchurComplement> make_schur_complement(const InterfaceParameters &parameters,
                                                         const FactoredStructure &solvers,
                                                         const ContactRows &rows)
  {
    if (parameters.form == "automatic")
      return std::make_unique<AutomaticSchurComplement>(parameters, solvers, rows);
    if (parameters.form == "assembled dense")
      return std::make_unique<DenseSchurComplement>(solvers, rows);
    if (parameters.form == "assembled sparse")
      return std::make_unique<SparseSchurComplement>(solvers, rows);
    if (parameters.form == "matrix-free")
      return std::make_unique<MatrixFreeSchurComplement>(parameters, solvers, rows);
    throw UserError("unknown form of the interface operator '" + parameters.form +
                    "'; known are: automatic, assembled dense, assembled sparse, matrix-free. "
                    "Correct the name");
  }
} // namespace taut
