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
  /// Entries of a scene that take values together, one after the other: what a study and a sweep
  /// have in common in the sections of their parameters.
  struct VariedEntries
  {
    std::string entries, values; ///< as written

    void declare(dealii::ParameterHandler &prm);

    /**
     * The paths of the entries, each one of @p scene, all entries by path, and not among the @p
     * taken ones, to which they are added. Throws EntryError on an entry of section @p title.
     */
    std::vector<std::string> paths(const std::string &title,
                                   const std::map<std::string, std::string> &scene,
                                   std::set<std::string> &taken) const;

    /// The values, ranges "first:step:last" with all of theirs; at most @p most of one range.
    /// Throws EntryError on an entry of section @p title if there is none, or an empty one.
    std::vector<std::string> value_list(const std::string &title, std::size_t most) const;
  };
} // namespace taut

#endif
