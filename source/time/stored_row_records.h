// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stored_row_records_h
#define taut_stored_row_records_h

#include <taut/base/archive.h>
#include <taut/interface/constraints.h>

#include <cstddef>
#include <map>
#include <vector>

namespace taut
{
  /// Stores what @p records have of each row but cuts, of all rows on any number of ranks. Called
  /// by all ranks together.
  template <typename Record>
  void store_of_rows(OutputArchive &archive, const Constraints &constraints,
                     const std::vector<Record> &records)
  {
    if (!constraints.shared())
    {
      for (const std::size_t i : constraints.rows_but_cuts())
        archive << records[i];
      return;
    }
    std::map<std::size_t, Record> own, all;
    for (const std::size_t i : constraints.rows_but_cuts())
      if (constraints.is_own(i))
        own[constraints.number(i)] = records[i];
    for (const std::string &text :
         constraints.communicator().gather(archived([&](OutputArchive &rank) { rank << own; })))
    {
      unarchive(text, [&](InputArchive &rank) { rank >> own; });
      all.insert(own.begin(), own.end());
    }
    for (const auto &[number, record] : all)
      archive << record;
  }

  /// Loads the records of the rows of this rank.
  template <typename Record>
  void store_of_rows(InputArchive &archive, const Constraints &constraints,
                     std::vector<Record> &records)
  {
    Record of_others;
    for (std::size_t number = constraints.n_cuts_of_all(); number < constraints.n_of_all();
         ++number)
    {
      const std::size_t i = constraints.index(number);
      archive >> (i < records.size() ? records[i] : of_others);
    }
  }
} // namespace taut

#endif
