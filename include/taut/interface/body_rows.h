// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_rows_h
#define taut_body_rows_h

#include <taut/interface/contact_rows.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// The rows by the substructures of this rank that they act on: B_k^T of each.
  class BodyRows
  {
  public:
    /// A row of B_k^T; all terms of the row on this substructure in one form.
    struct Entry
    {
      std::size_t row;
      bool moving;
      SparseVector form;
    };

    /// The arguments are kept by reference.
    BodyRows(const Structure &structure, const ContactRows &rows);

    /// After ContactRows::update(): the moving rows anew.
    void update();

    std::size_t size() const { return entries.size(); }
    const std::vector<Entry> &operator[](std::size_t k) const { return entries[k]; }

  private:
    void add(std::size_t row);

    const ContactRows &rows;
    std::vector<std::vector<Entry>> entries; ///< the moving rows of each are its last ones
  };
} // namespace taut

#endif
