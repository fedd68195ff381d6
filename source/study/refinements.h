// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_refinements_h
#define taut_refinements_h

#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// What a search refines: the time step, or all elements of a scene together.
  struct Refinement
  {
    /// How a value changes when its size is halved: it is halved, doubled or has one added.
    enum class Kind
    {
      size,
      count,
      halvings
    };

    /// Entries that have the same value.
    struct Group
    {
      std::string name;
      Kind kind;
      double value; ///< at the level of the file
      std::vector<std::string> entries;

      /// The value with its size halved @p n times; negative: doubled.
      std::string halved(int n) const;
    };
    std::vector<Group> groups;
    int n_coarser; ///< halvings from the coarsest values, level 0, to those of the file

    /// The value of each group at a level.
    std::vector<std::string> values(int level) const;
  };

  /// The time step, and the mesh if the scene has elements. @p scene is all entries by path. The
  /// coarsest values are eight times those of the file, or as coarse as whole numbers allow. Steps
  /// in contacts with dampers are twice those of the file at the coarsest.
  std::vector<Refinement> find_refinements(const std::map<std::string, std::string> &scene);
} // namespace taut

#endif
