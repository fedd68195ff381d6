// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_response_columns_h
#define taut_response_columns_h

#include <taut/interface/constraints.h>
#include <taut/substructure/factored_structure.h>

#include <functional>
#include <vector>

namespace taut
{
  /// The columns A_k^-1 B_k of the constraints, without the tails where they have decayed: what
  /// both assembled forms of F are made of.
  class ResponseColumns
  {
  public:
    /// The arguments are kept by reference.
    ResponseColumns(const FactoredStructure &solvers, const Constraints &constraints);

    /// After a change of A_k: the columns of the fixed constraints anew. Without it compute() is
    /// for moving constraints only.
    void setup();

    /// Column of constraint i anew.
    void compute(std::size_t i);

    /// The share of the substructures here in F_ij, without compliance.
    double entry(std::size_t i, std::size_t j) const;

    /// Calls @p visit(j) for every fixed constraint j <= i that the column of constraint i reaches,
    /// and maybe more than once.
    void visit_reached(std::size_t i, const std::function<void(std::size_t)> &visit) const;

    /// The share of the substructures here in d = B^T A^-1 P.
    void contact_free_predictor(const BodyVectors &P, std::vector<double> &d,
                                std::vector<double> &terms_size) const;

  private:
    /// A_k^-1 B_k of one constraint, for the substructures that it touches.
    struct Column
    {
      std::vector<std::size_t> substructure;
      std::vector<WindowedVector> part;
    };

    /// The DoFs first..last of a substructure that a fixed constraint acts on.
    struct Reach
    {
      unsigned int first, last;
      std::size_t constraint;
    };

    const FactoredStructure &solvers;
    const Constraints &constraints;
    std::vector<Column> columns;
    std::vector<std::vector<Reach>> reach; ///< of each substructure, by first DoF
    std::vector<unsigned int> widest;      ///< last - first of each substructure's reaches
    bool by_columns =
        false; ///< contact_free_predictor() from the stored columns is cheaper than a solve
    mutable BodyVectors work;
  };
} // namespace taut

#endif
