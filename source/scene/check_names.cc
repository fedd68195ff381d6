// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/check_parts.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace taut
{
  namespace
  {
    template <typename Item>
    void check_kind(const std::vector<Item> &items, const std::string &kind)
    {
      std::set<std::string> names;
      for (const Item &item : items)
        if (item.name.empty() || !names.insert(item.name).second)
          fail(item, "", "two ", kind, " are called '", item.name,
               "'; names are unique and not empty");
    }

    /// A link names its ends by a name alone.
    void check_body_names(const Scene &scene)
    {
      for (const CustomBody &body : scene.bodies)
      {
        const auto is_same = [&](const auto &item) { return item.name == body.name; };
        if (body.name == "ground" || std::any_of(scene.wires.begin(), scene.wires.end(), is_same) ||
            std::any_of(scene.masses.begin(), scene.masses.end(), is_same))
          fail(body, "", "the name '", body.name,
               "' is taken by a wire, a mass or the ground; take another");
      }
    }

    /// The column name that numpy's genfromtxt(names=True) makes of a name in the head of a table.
    std::string name_in_tables(const std::string &name)
    {
      const std::string dropped = "~!@#$%^&*()-=+\\|]}[{';:/?.>,<\"";
      std::string result;
      for (const char c : name)
        if (dropped.find(c) == std::string::npos)
          result += c == ' ' ? '_' : c;
      return result;
    }

    /// Two names must not become one column name in the head of a table.
    class TableNames
    {
    public:
      explicit TableNames(std::string kind) : kind(std::move(kind)) {}

      template <typename Item>
      void add(const Item &item, const std::string &name)
      {
        const auto [known, is_new] = names.emplace(name_in_tables(name), name);
        if (!is_new)
          fail(item, "", "two ", kind, " are called '", known->second, "' and '", name,
               "', which is one name for programs that read the tables and drop what is neither "
               "letter nor digit; rename one");
      }

    private:
      std::string kind;
      std::map<std::string, std::string> names; ///< as written, by their column names
    };

    void check_names_in_tables(const Scene &scene)
    {
      TableNames links("links"), probes("probes"), supports("supports");
      for (const Link &link : scene.links)
        links.add(link, link.name);
      for (const Probe &probe : scene.probes)
        probes.add(probe, probe.name);
      for (const Support &support : scene.supports)
        for (std::size_t k = 0; k < support.positions.size(); ++k)
          supports.add(support,
                       support.name +
                           (support.positions.size() > 1 ? " " + std::to_string(k + 1) : ""));
    }
  } // namespace

  void check_names(const Scene &scene)
  {
    check_kind(scene.wires, "wires");
    check_kind(scene.bodies, "bodies");
    check_body_names(scene);
    check_kind(scene.masses, "masses");
    check_kind(scene.links, "links");
    check_names_in_tables(scene);
  }
} // namespace taut
