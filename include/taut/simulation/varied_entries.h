// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_varied_entries_h
#define taut_varied_entries_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Entries of a scene that take successive values together, in the sections of a study or sweep.
  struct VariedEntries
  {
    std::string entries, values; ///< as written

    void declare(dealii::ParameterHandler &prm);

    /// Paths of the entries, each in @p scene, all entries by path, and not in @p taken; adds them
    /// to @p taken. Throws EntryError on an entry of section @p title.
    std::vector<std::string> paths(const std::string &title,
                                   const std::map<std::string, std::string> &scene,
                                   std::set<std::string> &taken) const;

    /// The values, with all values of ranges "first:step:last", at most @p most of one range.
    /// Throws EntryError on an entry of section @p title for no value or an empty one.
    std::vector<std::string> value_list(const std::string &title, std::size_t most) const;
  };
} // namespace taut

#endif
