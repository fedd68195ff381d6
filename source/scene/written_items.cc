// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/written_items.h"

#include "base/text.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>
#include <taut/scene/named_items.h>

#include <cmath>
#include <utility>

namespace taut
{
  namespace
  {
    /// Whether the signs of zeros agree, too.
    bool is_same(const double a, const double b)
    {
      return a == b && std::signbit(a) == std::signbit(b);
    }

    bool is_same(const Coordinates &a, const Coordinates &b)
    {
      return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
    }

    /// A vector from which the reader makes this unit vector: to divide by a length rounds, so that
    /// not each is one that the vector itself gives.
    Coordinates vector_of(const Coordinates &direction)
    {
      constexpr int most = 4096;
      for (int k = 0; k < most; ++k)
      {
        const double factor = 1. + k / 1024.;
        const Coordinates longer = {factor * direction.x, factor * direction.y,
                                    factor * direction.z};
        if (is_same(unit(longer, ""), direction))
          return longer;
      }
      return direction;
    }
  } // namespace

  std::string written_number(const double value)
  {
    return to_text(std::setprecision(17), value);
  }

  std::string written_numbers(const std::vector<double> &values)
  {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + written_number(value);
    return text;
  }

  std::string written_coordinates(const Coordinates &p)
  {
    return p.z == 0. && !std::signbit(p.z) ? written_numbers({p.x, p.y})
                                           : written_numbers({p.x, p.y, p.z});
  }

  WrittenItems::WrittenItems(std::vector<WrittenEntry> &all, std::string list, std::string section)
      : all(all), section(std::move(section))
  {
    all.push_back({{"Network", std::move(list)}, ""});
    place_of_names = all.size() - 1;
  }

  void WrittenItems::begin(const std::string &given)
  {
    std::string own = given;
    for (int k = 2; !names.insert(own).second; ++k)
      own = given + " " + std::to_string(k);
    check_item_names({own}, "");
    if (own.find(',') != std::string::npos || trim(own) != own)
      throw UserError("'" + own +
                      "' cannot be a name in a parameter file: lists of names have "
                      "commas between them; give it another name");
    std::string &list = all[place_of_names].value;
    list += (list.empty() ? "" : ", ") + own;
    name = own;
  }

  void WrittenItems::set(const std::string &entry, const std::string &value)
  {
    all.push_back({{"Network", section + " " + name, entry}, value});
  }

  void WrittenItems::set_text(const std::string &usual, const std::string &entry,
                              const std::string &value)
  {
    if (value != usual)
      set(entry, value);
  }

  void WrittenItems::set_number(const double usual, const std::string &entry, const double value)
  {
    if (!is_same(value, usual))
      set(entry, written_number(value));
  }

  void WrittenItems::set_flag(const bool usual, const std::string &entry, const bool value)
  {
    if (value != usual)
      set(entry, value ? "true" : "false");
  }

  void WrittenItems::set_direction(const bool rotational, const Coordinates &direction,
                                   const bool is_usual)
  {
    set_flag(false, "Rotational", rotational);
    if (!is_usual ||
        !is_same(direction, rotational ? Coordinates{0., 0., 1.} : Coordinates{0., 1.}))
      set(rotational ? "Axis" : "Direction", written_coordinates(vector_of(direction)));
  }
} // namespace taut
