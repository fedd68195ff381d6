// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_levels_h
#define taut_extremes_levels_h

#include "pairwise.h"

namespace extremes
{
  struct Dimension
  {
    std::string name;
    std::vector<double> levels;
  };

  /// One constraint of a cover: levels by the name of the dimension.
  class Levels
  {
  public:
    Levels(const std::vector<Dimension> &dimensions, const std::vector<std::size_t> &constraint)
        : dimensions(dimensions), constraint(constraint)
    {
    }
    double operator[](const std::string &name) const
    {
      for (std::size_t d = 0; d < dimensions.size(); ++d)
        if (dimensions[d].name == name)
          return dimensions[d].levels[constraint[d]];
      throw std::logic_error("no dimension " + name);
    }
    std::string name() const
    {
      std::ostringstream out;
      for (std::size_t d = 0; d < dimensions.size(); ++d)
        out << (d > 0 ? ", " : "") << dimensions[d].name << ' '
            << dimensions[d].levels[constraint[d]];
      return out.str();
    }

  private:
    const std::vector<Dimension> &dimensions;
    const std::vector<std::size_t> &constraint;
  };

  /// Calls @p visit with the levels of each constraint of a pairwise cover.
  template <typename Visit>
  void cover(const std::vector<Dimension> &dimensions, const unsigned int seed, const Visit &visit)
  {
    std::vector<std::size_t> sizes;
    for (const Dimension &d : dimensions)
      sizes.push_back(d.levels.size());
    for (const std::vector<std::size_t> &constraint : pairwise(sizes, seed))
      visit(Levels(dimensions, constraint));
  }
} // namespace extremes

#endif
