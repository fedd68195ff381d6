// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_written_items_h
#define taut_written_items_h

#include "scene/network_entries.h"
#include <taut/base/coordinates.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace taut
{
  /// With the digits from which it is read back to the last bit.
  std::string written_number(double value);
  std::string written_numbers(const std::vector<double> &values);

  /// "x, y" in the plane, else "x, y, z".
  std::string written_coordinates(const Coordinates &p);

  /// Entries of one list of items of section Network, each in a section of its own. What is usual
  /// is left out.
  class WrittenItems
  {
  public:
    WrittenItems(std::vector<WrittenEntry> &all, std::string list, std::string section);

    /// Begins the section of an item. A name that another item has gets a number. Throws UserError
    /// for a name that no parameter file can say.
    void begin(const std::string &given);

    void set(const std::string &entry, const std::string &value);
    void set_text(const std::string &usual, const std::string &entry, const std::string &value);
    void set_number(double usual, const std::string &entry, double value);
    void set_flag(bool usual, const std::string &entry, bool value);

    /// Direction of a displacement or force, or axis of a rotation or moment. Without @p is_usual
    /// also y and the axis z are written.
    void set_direction(bool rotational, const Coordinates &direction, bool is_usual);

  private:
    std::vector<WrittenEntry> &all;
    std::size_t place_of_names;
    std::string section, name;
    std::set<std::string> names;
  };
} // namespace taut

#endif
