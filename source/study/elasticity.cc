// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/elasticity.h"
#include "base/data_files.h"
#include "base/interruption.h"
#include "base/text.h"
#include "base/write_file.h"
#include "model/form_finding.h"
#include "model/scene_constraints.h"
#include "model/shared_parts.h"
#include "output/json_values.h"
#include <taut/base/exceptions.h>
#include <taut/time/static_equilibrium.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <set>

namespace taut
{
  namespace
  {
    constexpr const char *table_file = "elasticity.csv", *summary_file = "elasticity.json",
                         *entries_file = "elasticity.prm";

    /// A scene at rest, whose wires other scenes share.
    struct AtRest
    {
      AtRest(const Scene &scene, const SolverParameters &solver, SharedParts &shared)
          : bodies(scene, whole(scene), Communicator(), &shared),
            constraints(scene_constraints(scene, bodies)),
            state(static_equilibrium(bodies, constraints, solver, 0.))
      {
      }

      double height(const std::size_t wire, const double s) const
      {
        std::vector<Term> terms;
        bodies.motion({Attachment::Kind::wire, wire, s}, false, {0., 1.}, 1., terms);
        return evaluate(terms, state.displacement);
      }

      const SceneBodies bodies;
      const Constraints constraints;
      const StaticState state;
    };

    /// The joint that a link is which stays closed under a force @p N.
    Link closed(Link link, const double N)
    {
      if (link.kind == LinkKind::dropper)
        link.direction = add_scaled({}, -1., link.direction);
      link.kind = LinkKind::joint;
      if (!link.law)
        return link;
      const double small = 1e-6 * N,
                   flexibility =
                       (link.elongation(N + small) - link.elongation(N - small)) / (2. * small);
      link.gap += link.elongation(N) - N * flexibility;
      link.stiffness = 1. / flexibility;
      link.law = nullptr;
      return link;
    }

    /// The scene whose links stay as they are at rest.
    Scene linear_at_rest(Scene scene, const AtRest &rest)
    {
      std::vector<Link> links;
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        const double N = rest.state.multiplier[rest.constraints.index_of_link(i)];
        if (!link.unilateral())
          links.push_back(link);
        else if (link.turns)
          throw EntryError(link.origin,
                           "link '" + link.name +
                               "' turns, and has no linear elasticity; set Elasticity/Slackening");
        else if (N > 0.)
          links.push_back(closed(link, N));
      }
      scene.links = std::move(links);
      return scene;
    }

    /// Wires that move across and that no other wire hangs from.
    std::set<std::size_t> lowest_wires(const Scene &scene)
    {
      std::set<std::size_t> result;
      for (std::size_t w = 0; w < scene.wires.size(); ++w)
        if (scene.wires[w].has(WireMotion::transverse))
          result.insert(w);
      for (const Link &link : scene.links)
        if (link.from.kind == Attachment::Kind::wire && link.to.kind == Attachment::Kind::wire)
        {
          const Wire &from = scene.wires[link.from.index], &to = scene.wires[link.to.index];
          result.erase(from.a.y > to.a.y ? link.from.index : link.to.index);
        }
      return result;
    }

    std::vector<double> places_between(const double first, const double last, const double spacing)
    {
      const int n = std::max(1, static_cast<int>(std::lround((last - first) / spacing)));
      std::vector<double> places;
      for (int i = 0; i <= n; ++i)
        places.push_back(first + (last - first) * i / n);
      return places;
    }
  } // namespace

  double ElasticityOfWire::largest() const
  {
    return *std::max_element(elasticity.begin(), elasticity.end());
  }

  double ElasticityOfWire::smallest() const
  {
    return *std::min_element(elasticity.begin(), elasticity.end());
  }

  double ElasticityOfWire::nonuniformity() const
  {
    return (largest() - smallest()) / (largest() + smallest());
  }

  Elasticity::Elasticity(const std::string &file, const std::vector<std::string> &overrides,
                         const bool overwrite, std::ostream &log)
      : overwrite(overwrite), log(log)
  {
    parameters.read(file, overrides, Communicator());
  }

  const std::vector<ElasticityOfWire> &Elasticity::run()
  {
    for (const char *const name : {table_file, summary_file, entries_file})
      if (const std::string path = parameters.output.folder + "/" + name;
          !overwrite && std::filesystem::exists(path))
        throw UserError("'" + path +
                        "' is there already; give --overwrite, or another Output/Folder");
    try
    {
      measure();
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters.explain(e));
    }
    write();
    report();
    return wires;
  }

  void Elasticity::measure()
  {
    const ElasticityParameters &asked = parameters.elasticity;
    const Scene all = parameters.scene();
    std::set<std::size_t> under;
    for (const Link &link : all.links)
      if (link.moving() && link.to.kind == Attachment::Kind::wire)
        under.insert(link.to.index);
    if (under.empty())
      under = lowest_wires(all);
    if (under.empty())
      throw UserError(
          "--elasticity measures the wires that sliding contacts slide on, or those that "
          "hang lowest, and the scene has no wire that moves across");
    SharedParts shared;
    shared.begin();
    Scene scene =
        find_lengths(without_sliding_contacts(all), parameters.solver, Communicator(), &shared);
    if (!asked.slackening)
      scene = linear_at_rest(scene, AtRest(scene, parameters.solver, shared));
    const AtRest rest(scene, parameters.solver, shared);
    Load load;
    load.kind = Load::Kind::moving; // a moving load is no node of the grid
    load.name = "force of --elasticity";
    load.magnitude = Expression(asked.force);
    scene.loads.push_back(load);
    for (const std::size_t w : under)
    {
      const Wire &wire = scene.wires[w];
      const double along = wire.tangent().x;
      double first = std::min(wire.a.x, wire.b.x), last = std::max(wire.a.x, wire.b.x);
      if (asked.range.size() == 2)
      {
        first = std::max(first, asked.range[0]);
        last = std::min(last, asked.range[1]);
      }
      if (!(last > first) || std::fabs(along) < .5)
        continue;
      wires.push_back({wire.name, places_between(first, last, asked.spacing), {}});
      for (const double x : wires.back().x)
      {
        const double s = std::clamp((x - wire.a.x) / along, 0., wire.length());
        scene.loads.back().target = {Attachment::Kind::wire, w, s};
        const AtRest loaded(scene, parameters.solver, shared);
        wires.back().elasticity.push_back((loaded.height(w, s) - rest.height(w, s)) / asked.force);
        if (stop_asked)
          if (const int signal = stop_asked())
            throw Interrupted(signal, "--elasticity ended by " + signal_name(signal));
      }
    }
    if (wires.empty())
      throw EntryError("Elasticity/Range", "no contact wire is there");
  }

  void Elasticity::write() const
  {
    std::ostringstream table;
    table << "wire,x [m],elasticity [m/N]\n" << std::setprecision(10);
    nlohmann::ordered_json summary;
    summary["schema"] = statistics_schema;
    summary["force"] = json_quantity(parameters.elasticity.force, "N");
    summary["slackening"] = parameters.elasticity.slackening;
    summary["wires"] = nlohmann::ordered_json::object();
    for (const ElasticityOfWire &wire : wires)
    {
      for (std::size_t i = 0; i < wire.x.size(); ++i)
        table << wire.wire << ',' << wire.x[i] << ',' << wire.elasticity[i] << '\n';
      summary["wires"][wire.wire] = {{"largest_elasticity", json_quantity(wire.largest(), "m/N")},
                                     {"smallest_elasticity", json_quantity(wire.smallest(), "m/N")},
                                     {"nonuniformity", json_quantity(wire.nonuniformity(), "1")}};
    }
    std::filesystem::create_directories(parameters.output.folder);
    std::ostringstream entries;
    parameters.print(entries);
    copy_data_files(data_files(), parameters.output.folder);
    write_file(parameters.output.folder + "/" + entries_file, entries.str());
    write_file(parameters.output.folder + "/" + table_file, table.str());
    write_file(parameters.output.folder + "/" + summary_file, summary.dump(2) + '\n');
  }

  void Elasticity::report() const
  {
    log << "Elasticity: static uplift over a force of " << parameters.elasticity.force << " N, "
        << (parameters.elasticity.slackening ? "with slackening" : "linear")
        << "; u = (e_max - e_min) / (e_max + e_min), EN 50119\n";
    const auto at = [](const ElasticityOfWire &wire, const auto found)
    { return wire.x[found - wire.elasticity.begin()]; };
    for (const ElasticityOfWire &wire : wires)
    {
      const auto [least, most] =
          std::minmax_element(wire.elasticity.begin(), wire.elasticity.end());
      log << to_text(std::setprecision(4), "  ", wire.wire, ": e_max ", 1e3 * *most, " mm/N at ",
                     at(wire, most), " m, e_min ", 1e3 * *least, " mm/N at ", at(wire, least),
                     " m, u ", 100. * wire.nonuniformity(), " %\n");
    }
    log << "Results in " << parameters.output.folder << '\n';
  }
} // namespace taut
