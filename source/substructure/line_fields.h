// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_line_fields_h
#define taut_line_fields_h

#include <taut/base/coordinates.h>

#include <string>
#include <vector>

namespace taut
{
  /// A point of a line in a picture for ParaView.
  struct LinePoint
  {
    Coordinates place, displacement; ///< place without the displacement [m]
    std::vector<double> values;      ///< of further fields, in the order of their names
  };

  /// A further field.
  struct LineField
  {
    std::string name, units;
  };

  /// Writes lines, each of two points or more, with `displacement` and @p further fields as a
  /// .vtu file, the same bytes from run to run. Throws UserError if the file cannot be written.
  void write_lines(const std::string &path, const std::vector<std::vector<LinePoint>> &lines,
                   const std::vector<LineField> &further);
} // namespace taut

#endif
