// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_response_columns_h
#define taut_response_columns_h

#include <taut/interface/constraints.h>
#include <taut/substructure/factored_structure.h>

#include <algorithm>
#include <vector>

namespace taut
{
  /// The columns A_k^-1 B_k of the constraints without decayed tails, for the assembled forms of F.
  class ResponseColumns
  {
  public:
    /// The arguments are kept by reference.
    ResponseColumns(const FactoredStructure &solvers, const Constraints &constraints);

    /// After a change of A_k: computes the columns of the fixed constraints. Without setup(),
    /// compute() is for sliding and turning constraints only.
    void setup();

    /// Computes the column of constraint i.
    void compute(std::size_t i);

    /// Part of this rank in F_ij, without compliance.
    double entry(std::size_t i, std::size_t j) const;

    /// Calls @p visit(j), perhaps repeatedly, for each fixed constraint j <= i that the column of
    /// constraint i reaches.
    template <typename Visit>
    void visit_reached(std::size_t i, const Visit &visit) const;

    /// Part of this rank in d = B^T A^-1 P.
    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const;

  private:
    /// A_k^-1 B_k of one constraint for each of its substructures.
    struct Column
    {
      std::vector<std::size_t> substructure;
      std::vector<WindowedVector> part;
    };

    /// First and last DoF of a fixed constraint on a substructure.
    struct Reach
    {
      unsigned int first, last;
      std::size_t constraint;
    };

    const FactoredStructure &solvers;
    const Constraints &constraints;
    std::vector<Column> columns;
    std::vector<std::vector<Reach>> reach; ///< for each substructure, by first DoF
    std::vector<unsigned int> widest;      ///< largest last - first of each substructure
    bool by_columns =
        false; ///< contact_free_predictor() from the stored columns is cheaper than a solve
    mutable BodyVectors work;
  };

  template <typename Visit>
  void ResponseColumns::visit_reached(const std::size_t i, const Visit &visit) const
  {
    const Column &c = columns[i];
    for (std::size_t p = 0; p < c.substructure.size(); ++p)
    {
      const std::size_t k = c.substructure[p];
      const unsigned int begin = c.part[p].first,
                         end = begin + static_cast<unsigned int>(c.part[p].value.size());
      auto at = std::lower_bound(reach[k].begin(), reach[k].end(), begin,
                                 [&](const Reach &r, const unsigned int dof)
                                 { return r.first + widest[k] < dof; });
      for (; at != reach[k].end() && at->first < end; ++at)
        if (at->last >= begin && at->constraint <= i)
          visit(at->constraint);
    }
  }
} // namespace taut

#endif
