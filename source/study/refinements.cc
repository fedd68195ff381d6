// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/refinements.h"
#include <taut/output/table_file.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    constexpr int most_coarser = 3;

    /// Steps of a contact with a damper are coarser by this power of two at most: twice as long
    /// there are eight of them and more, and changes with the step follow its powers.
    constexpr int most_coarser_in_contacts = 1;

    bool ends(const std::string &path, const std::string &tail)
    {
      return path.size() >= tail.size() &&
             path.compare(path.size() - tail.size(), tail.size(), tail) == 0;
    }

    /// How often the size of a group can be doubled.
    int coarser(const Refinement::Group &group)
    {
      if (group.kind == Refinement::Kind::size)
        return most_coarser;
      const int value = static_cast<int>(group.value);
      if (group.kind == Refinement::Kind::halvings)
        return std::min(value, most_coarser);
      int n = 0;
      while (n < most_coarser && value % (2 << n) == 0)
        ++n;
      return n;
    }

    void add(Refinement &refinement, const Refinement::Kind kind, const std::string &path,
             const std::string &text)
    {
      const double value = std::stod(text);
      for (Refinement::Group &group : refinement.groups)
        if (group.kind == kind && group.value == value)
        {
          group.entries.push_back(path);
          return;
        }
      const std::size_t n = refinement.groups.size() + 1;
      refinement.groups.push_back(
          {n > 1 ? "mesh " + std::to_string(n) : "mesh", kind, value, {path}});
    }

    /// Whether contacts of the scene have dampers, which take steps of their own length.
    bool has_damped_contacts(const std::map<std::string, std::string> &scene)
    {
      const std::string tail = "/Damping";
      for (const auto &[path, damping] : scene)
      {
        if (!ends(path, tail) || damping.empty() || !(std::stod(damping) > 0.))
          continue;
        const std::string owner = path.substr(0, path.size() - tail.size());
        const auto type = scene.find(owner + "/Type");
        const bool is_link = owner.rfind("Network/Link ", 0) == 0 && type != scene.end() &&
                             (type->second == "stop" || type->second == "dropper");
        if (is_link || ends(owner, "Droppers"))
          return true;
      }
      return false;
    }
  } // namespace

  std::string Refinement::Group::halved(const int n) const
  {
    if (kind == Kind::size)
      return csv_number(std::ldexp(value, -n));
    return std::to_string(std::lround(kind == Kind::count ? std::ldexp(value, n) : value + n));
  }

  std::vector<std::string> Refinement::values(const int level) const
  {
    std::vector<std::string> list;
    for (const Group &group : groups)
      list.push_back(group.halved(level - n_coarser));
    return list;
  }

  std::vector<Refinement> find_refinements(const std::map<std::string, std::string> &scene)
  {
    Refinement step{{}, most_coarser};
    const auto add_step = [&](const std::string &name, const std::string &entry, const int finer)
    {
      const double size = std::ldexp(std::stod(scene.at(entry)), -finer);
      step.groups.push_back({name, Refinement::Kind::size, size, {entry}});
    };
    add_step("step", "Time/Step", 0);
    if (has_damped_contacts(scene))
      add_step("step in damped contacts", "Time/Step in damped contacts",
               most_coarser - most_coarser_in_contacts);
    Refinement mesh{{}, most_coarser};
    for (const auto &[path, text] : scene)
      if (ends(path, "/Element size"))
        add(mesh, Refinement::Kind::size, path, text);
      else if (ends(path, "/Elements"))
        add(mesh, Refinement::Kind::count, path, text);
      else if (ends(path, "/Mesh/Refinements"))
        add(mesh, Refinement::Kind::halvings, path, text);
    if (mesh.groups.empty())
      return {step};
    for (const Refinement::Group &group : mesh.groups)
      mesh.n_coarser = std::min(mesh.n_coarser, coarser(group));
    return {step, mesh};
  }
} // namespace taut
