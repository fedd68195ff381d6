// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/rest_figures.h"
#include "base/text.h"
#include "base/write_file.h"
#include "output/json_values.h"
#include <taut/base/version.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    using json = nlohmann::ordered_json;

    /// Links in the log, those with the largest forces first.
    constexpr std::size_t most_links = 8;

    json vector_of(const Coordinates &x, const std::string &unit)
    {
      return {{"value", {x.x + 0., x.y + 0., x.z + 0.}}, {"unit", unit}};
    }
  } // namespace

  void RestFigures::record(const StepView &step)
  {
    links.clear();
    for (std::size_t l = 0; l < scene.links.size(); ++l)
      links.push_back(
          {scene.links[l].name, step.links.force[l], step.links.gap[l], scene.links[l].rotational});
    const std::vector<Structure::Body> &all = step.structure.all_bodies();
    std::vector<double> of_bodies(all.size(), 0.);
    for (std::size_t k = 0; k < step.structure.size(); ++k)
    {
      const Substructure &body = step.structure[k];
      std::vector<unsigned int> multipliers;
      if (dynamic_cast<const ConstrainedBody *>(&body))
        multipliers = body.dofs_without_mass();
      const std::vector<double> U = taut::displacement(step.reference, step.state, k);
      double &largest = of_bodies[step.structure.number(k)];
      for (unsigned int i = 0; i < U.size(); ++i)
        if (body.kind(i) == 0 && !std::binary_search(multipliers.begin(), multipliers.end(), i))
          largest = std::max(largest, std::fabs(U[i]));
    }
    step.structure.communicator().sum(of_bodies);
    const auto found = std::max_element(of_bodies.begin(), of_bodies.end());
    displacement = found == of_bodies.end() ? 0. : *found;
    moved = displacement > 0. ? all[found - of_bodies.begin()].name : "";
  }

  void RestFigures::report(std::ostream &log, const bool failed) const
  {
    if (failed)
      return;
    const std::vector<SurfaceForce> contacts =
        tables ? tables->last() : std::vector<SurfaceForce>();
    for (std::size_t c = 0; c < contacts.size(); ++c)
    {
      const SurfaceForce &sum = contacts[c];
      log << "At rest: contact '" << scene.contacts[c].name << "' "
          << to_text(std::setprecision(4), norm(sum.force)) << " N on ";
      const bool is_line = sum.is_line;
      log << to_text(std::setprecision(4), sum.area) << (is_line ? " m" : " m^2") << ", at most "
          << to_text(std::setprecision(4), sum.largest) << (is_line ? " N/m" : " Pa") << "; "
          << sum.n_closed << " of " << sum.n_nodes << " nodes are closed\n";
    }
    if (!links.empty())
    {
      std::vector<LinkAtRest> sorted = links;
      std::stable_sort(sorted.begin(), sorted.end(),
                       [](const LinkAtRest &a, const LinkAtRest &b)
                       { return std::fabs(a.force) > std::fabs(b.force); });
      log << "At rest: forces of links";
      for (std::size_t k = 0; k < std::min(sorted.size(), most_links); ++k)
        log << (k == 0 ? " '" : ", '") << sorted[k].name << "' "
            << to_text(std::setprecision(4), sorted[k].force + 0.)
            << (sorted[k].rotational ? " N m" : " N");
      if (sorted.size() > most_links)
        log << " and " << sorted.size() - most_links << " smaller ones";
      log << '\n';
    }
    if (displacement > 0.)
      log << "At rest: largest displacement along an axis "
          << to_text(std::setprecision(4), displacement) << " m, of '" << moved << "'\n";
  }

  void RestFigures::write(const std::string &path, const RunDescription &run,
                          const std::vector<NamedQuantity> &others) const
  {
    json root = {{"schema", statistics_schema}, {"scene", run.scene},
                 {"generator", run.generator},  {"version", version()},
                 {"end", json_time(0.)},        {"partial", false}};
    root["largest_displacement"] = json_quantity(displacement, "m");
    root["largest_displacement"]["of"] = moved;
    for (const char *const section : {"contacts", "links"})
      root[section] = json::object();
    const std::vector<SurfaceForce> contacts =
        tables ? tables->last() : std::vector<SurfaceForce>();
    for (std::size_t c = 0; c < contacts.size(); ++c)
    {
      const SurfaceForce &sum = contacts[c];
      root["contacts"][scene.contacts[c].name] = {
          {"force", vector_of(sum.force, "N")},
          {"point", vector_of(sum.point, "m")},
          {sum.is_line ? "length" : "area", json_quantity(sum.area, sum.is_line ? "m" : "m^2")},
          {sum.is_line ? "largest_force_per_length" : "largest_pressure",
           json_quantity(sum.largest, sum.is_line ? "N/m" : "Pa")},
          {"least_gap", json_quantity(sum.gap, "m")},
          {"closed", json_quantity(static_cast<double>(sum.n_closed), "1")},
          {"nodes", json_quantity(static_cast<double>(sum.n_nodes), "1")}};
    }
    for (const LinkAtRest &link : links)
      root["links"][link.name] = {
          {"force", json_quantity(link.force, link.rotational ? "N m" : "N")},
          {"gap", json_quantity(link.gap, link.rotational ? "rad" : "m")}};
    add_observers(others, root);
    add_warnings(run.warnings, root);
    write_file(path, root.dump(2) + '\n');
  }
} // namespace taut
