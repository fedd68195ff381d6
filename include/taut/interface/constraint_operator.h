// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraint_operator_h
#define taut_constraint_operator_h

#include <taut/interface/constraints.h>
#include <taut/interface/row_map.h>

#include <Epetra_MultiVector.h>
#include <Epetra_Operator.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace taut
{
  /// The constraints on each substructure of this rank: the rows of B_k^T.
  class BodyConstraints
  {
  public:
    /// Row of B_k^T with all terms of a constraint on one substructure.
    struct Entry
    {
      std::size_t constraint;
      bool varies; ///< slides or turns
      LinearForm form;
    };

    /// @p constraints are kept by reference.
    BodyConstraints(const Structure &structure, Lasting<Constraints> constraints);

    /// After Constraints::update() or turn(): updates the sliding and turning constraints.
    void update();

    std::size_t size() const { return entries.size(); }

    const Constraints &all() const { return constraints; }

    /// Numbers of the constraints with a term on a body of this rank, ascending.
    std::vector<std::size_t> rows() const;

    /// Constraints on body k of this rank.
    const std::vector<Entry> &operator[](std::size_t k) const { return entries[k]; }

  private:
    void add(std::size_t constraint);

    const Constraints &constraints;
    std::vector<std::vector<Entry>> entries; ///< sliding and turning constraints last
  };

  /// A symmetric operator on vectors over constraints for Belos: each rank has the values of the
  /// rows that it owns.
  class ConstraintOperator : public Epetra_Operator
  {
  public:
    explicit ConstraintOperator(std::shared_ptr<const RowMap> rows) : own_rows(std::move(rows)) {}

    const RowMap &rows() const { return *own_rows; }
    const std::shared_ptr<const RowMap> &shared_rows() const { return own_rows; }

    /// Y = A X for each column of the multivectors over the constraints. Called by all ranks
    /// together.
    int Apply(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
    {
      for (int v = 0; v < X.NumVectors(); ++v)
      {
        ++products;
        in.assign(X[v], X[v] + X.MyLength());
        multiply(in, out);
        std::copy(out.begin(), out.end(), Y[v]);
      }
      return 0;
    }

    /// Calls Apply(): Belos uses this name for a preconditioner.
    int ApplyInverse(const Epetra_MultiVector &X, Epetra_MultiVector &Y) const override
    {
      return Apply(X, Y);
    }

    /// Number of products so far.
    int n_products() const { return products; }

    int SetUseTranspose(bool) override { return 0; } // symmetric
    double NormInf() const override { return -1.; }
    const char *Label() const override { return "constraints"; }
    bool UseTranspose() const override { return false; }
    bool HasNormInf() const override { return false; }
    const Epetra_Comm &Comm() const override { return own_rows->map().Comm(); }
    const Epetra_Map &OperatorDomainMap() const override { return own_rows->map(); }
    const Epetra_Map &OperatorRangeMap() const override { return own_rows->map(); }

  protected:
    std::shared_ptr<const RowMap> own_rows;

  private:
    /// y = A x
    virtual void multiply(const std::vector<double> &x, std::vector<double> &y) const = 0;

    mutable std::vector<double> in, out;
    mutable int products = 0;
  };
} // namespace taut

#endif
