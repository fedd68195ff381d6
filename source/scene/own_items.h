// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_own_items_h
#define taut_own_items_h

#include "scene/catenary_items.h"
#include "scene/line_geometry.h"

#include <map>
#include <string>

namespace taut
{
  /// What a tension length has other than the line: its kind, wires, arms and droppers. An entry
  /// that is empty is that of the line.
  class OwnItems
  {
  public:
    /// Declares the entries in the section of the tension length.
    void declare(dealii::ParameterHandler &prm);

    /// The items of the line with the own ones. Throws EntryError for an entry that is no number,
    /// or a negative one; @p section is the path of the section.
    LineItems with(const LineItems &of_line, const std::string &section) const;

  private:
    std::string kind;
    std::map<std::string, std::string> texts; ///< by section and entry
  };

  /// The section of a tension length.
  class TensionLengthItem : public LineGeometry
  {
  public:
    void declare(dealii::ParameterHandler &prm)
    {
      LineGeometry::declare(prm);
      own.declare(prm);
    }
    OwnItems own;
  };
} // namespace taut

#endif
