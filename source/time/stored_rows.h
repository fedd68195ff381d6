// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stored_rows_h
#define taut_stored_rows_h

#include <taut/interface/constraints.h>
#include <taut/time/state.h>
#include <taut/time/step_report.h>

#include <vector>

namespace taut
{
  /// What the rows of the constraints have in a checkpoint: with all rows of distributed
  /// constraints, so that any number of ranks resumes.
  class StoredRows
  {
  public:
    struct Vectors
    {
      RowStates &states;
      StepReport &report;
      std::vector<double> &gaps, &terms;
    };

    /// The arguments are kept by reference.
    StoredRows(const Constraints &constraints, Vectors vectors)
        : constraints(constraints), of(vectors)
    {
    }

    /// Puts the vectors of all rows in the place of those of this rank; and back. Called by all
    /// ranks together.
    void gather() const;
    void pick() const;

  private:
    std::vector<std::vector<double>> numbers() const;
    void set(const std::vector<std::vector<double>> &numbers) const;

    const Constraints &constraints;
    const Vectors of;
  };
} // namespace taut

#endif
