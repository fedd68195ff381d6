// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_network_entries_h
#define taut_network_entries_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// An entry to write into a parameter file.
  struct WrittenEntry
  {
    std::vector<std::string> path; ///< sections, then the name of the entry
    std::string value;

    bool operator==(const WrittenEntry &other) const
    {
      return path == other.path && value == other.value;
    }
  };

  /**
   * Entries of the section `Network` from which the generator `network` makes the wires, supports,
   * masses, springs, links, loads and probes of a scene again, in their order and to the last bit.
   * Entries with their default values are left out. Point masses, springs and loads that share a
   * name get a number. Throws UserError for what no entry says: a law of a
   * program, and names with characters that names of items do not have.
   */
  std::vector<WrittenEntry> network_entries(const Scene &scene);
} // namespace taut

#endif
