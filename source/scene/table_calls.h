// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_table_calls_h
#define taut_table_calls_h

#include "scene/tabulated_function.h"

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A formula with functions table_0(s), table_1(t), ... in the place of its calls
  /// 'table(FILE.csv, column, s, cubic)'.
  struct TableCalls
  {
    /// A formula without tables stays as it is. @p variables are what the formula may depend on;
    /// the word for one of them may be left out if there is one only. Throws EntryError on @p
    /// entry.
    TableCalls(const std::string &formula, const std::vector<std::string> &variables,
               const std::string &entry);

    std::string formula;
    std::vector<std::shared_ptr<const TabulatedFunction>> tables;
    std::string alone; ///< variable of a formula that is one table and nothing else; or empty
  };
} // namespace taut

#endif
