// SPDX-License-Identifier: LGPL-2.1-or-later
#include "substructure/line_fields.h"
#include "base/memory.h"
#include "base/write_file.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <sstream>

namespace taut
{
  void write_lines(const std::string &path, const std::vector<std::vector<LinePoint>> &lines,
                   const std::vector<LineField> &further)
  {
    std::vector<std::string> names(3, "displacement");
    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false; // the same bytes from run to run
    flags.physical_units["displacement"] = "m";
    for (const auto &[name, units] : further)
    {
      names.push_back(name);
      flags.physical_units[name] = units;
    }
    std::vector<dealii::DataOutBase::Patch<1, 3>> patches(lines.size());
    for (unsigned int e = 0; e < patches.size(); ++e)
    {
      const unsigned int last = lines[e].size() - 1;
      dealii::DataOutBase::Patch<1, 3> &patch = patches[e];
      patch.patch_index = e;
      patch.reference_cell = dealii::ReferenceCells::Line;
      patch.n_subdivisions = last;
      patch.points_are_available = true;
      patch.data.reinit(names.size() + 3, last + 1);
      for (unsigned int k = 0; k <= last; ++k)
      {
        const auto &[place, u, values] = lines[e][k];
        std::vector<double> row = {u.x, u.y, u.z};
        row.insert(row.end(), values.begin(), values.end());
        row.insert(row.end(), {place.x, place.y, place.z});
        for (unsigned int c = 0; c < row.size(); ++c)
          patch.data(c, k) = static_cast<float>(row[c]);
        if (k == 0 || k == last)
          patch.vertices[k / last] = dealii::Point<3>(place.x, place.y, place.z);
      }
    }
    std::ostringstream file;
    dealii::DataOutBase::write_vtu(
        patches, names,
        {{0, 2, "displacement", dealii::DataComponentInterpretation::component_is_part_of_vector}},
        flags, file);
    write_file(path, whole_text(file));
  }
} // namespace taut
