// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/rest_limits.h"
#include "base/text.h"
#include "output/linear_forms.h"
#include <taut/output/spans.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>

namespace taut
{
  namespace
  {
    constexpr double largest_slope = .2, largest_sag = .1; ///< [rad], over the span

    struct Worst
    {
      double value = 0., limit = 0., position = 0.;
      std::string wire;

      void keep(const double found, const double of, const double at, const std::string &name)
      {
        if (found > of && found * limit >= value * of)
          *this = {found, of, at, name};
      }
    };

    /// Displacements across a wire at its nodes, in one direction [m].
    std::vector<double> displacements(const SceneBodies &structure, const BodyVectors &start,
                                      const std::size_t wire, const std::vector<double> &nodes,
                                      const Coordinates &axis)
    {
      LinearForms forms;
      for (const double s : nodes)
      {
        std::vector<Term> terms;
        structure.motion({Attachment::Kind::wire, wire, s}, false, axis, 1., terms);
        forms.add(terms);
      }
      std::vector<double> u(forms.size(), 0.);
      forms.evaluate(start, u.data());
      structure.communicator().sum(u);
      return u;
    }

    /// Positions at which supports hold a wire across it, sorted.
    std::vector<double> held_places(const Scene &scene, const std::size_t wire)
    {
      std::vector<double> places;
      for (const Support &support : scene.supports)
        if (support.wire == wire && component_of(support.motion) == WireMotion::transverse &&
            !is_slope(support.motion))
          places.insert(places.end(), support.positions.begin(), support.positions.end());
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      return places;
    }

    void find_sag(const std::string &name, const std::vector<double> &places,
                  const std::vector<double> &nodes, const std::vector<double> &u, Worst &worst)
    {
      const auto node_at = [&](const double s)
      {
        const auto found = std::lower_bound(nodes.begin(), nodes.end(), s * (1. - 1e-12));
        return std::min<std::size_t>(found - nodes.begin(), nodes.size() - 1);
      };
      for (std::size_t k = 1; k < places.size(); ++k)
      {
        const std::size_t first = node_at(places[k - 1]), last = node_at(places[k]);
        const double span = nodes[last] - nodes[first];
        for (std::size_t i = first + 1; i < last; ++i)
        {
          const double part = (nodes[i] - nodes[first]) / span;
          worst.keep(std::fabs(u[i] - (1. - part) * u[first] - part * u[last]), largest_sag * span,
                     nodes[i], name);
        }
      }
    }
  } // namespace

  std::vector<std::string> warnings_at_rest(const Scene &scene, const SceneBodies &structure,
                                            const BodyVectors &start)
  {
    Worst slope, sag;
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const Wire &wire = scene.wires[w];
      if (wire.transverse == TransverseKind::none)
        continue;
      const std::vector<double> nodes = grid(scene, w);
      const std::vector<double> u = displacements(structure, start, w, nodes, wire.normal());
      for (std::size_t i = 1; i < nodes.size(); ++i)
        slope.keep(std::fabs(u[i] - u[i - 1]) / (nodes[i] - nodes[i - 1]), largest_slope,
                   .5 * (nodes[i] + nodes[i - 1]), wire.name);
      find_sag(wire.name, held_places(scene, w), nodes, u, sag);
    }
    const std::string remedy =
        ". Check tension [N] and mass per length [kg/m], or take a cable (a Body of Type = cable)";
    std::vector<std::string> result;
    if (slope.value > 0.)
      result.push_back(to_text(std::setprecision(4), "wire '", slope.wire, "' has a slope of ",
                               slope.value, " at the start, at ", slope.position,
                               " m: the equations are those of small slopes, and more than ",
                               slope.limit, " bends the results", remedy));
    if (sag.value > 0.)
      result.push_back(to_text(std::setprecision(4), "wire '", sag.wire, "' hangs ", sag.value,
                               " m below the line between two supports at the start, at ",
                               sag.position, " m, more than a tenth of their distance of ",
                               sag.limit / largest_sag,
                               " m: the equations take its length for the distance", remedy));
    return result;
  }

  std::vector<std::string> warnings_of_slack_droppers(const Scene &scene,
                                                      const std::vector<double> &forces,
                                                      const std::vector<double> &gaps)
  {
    std::vector<std::string> result;
    std::set<std::size_t> said; // links
    std::vector<std::vector<std::size_t>> of_wires(scene.wires.size());
    for (std::size_t i = 0; i < scene.links.size(); ++i)
      if (const Link &link = scene.links[i]; is_dropper_between_wires(link))
        for (const std::size_t w : std::set<std::size_t>{link.from.index, link.to.index})
          of_wires[w].push_back(i);
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const std::vector<std::size_t> &droppers = of_wires[w];
      if (droppers.empty() || said.count(droppers[0]) > 0 ||
          std::any_of(droppers.begin(), droppers.end(),
                      [&](const std::size_t i) { return forces[i] != 0.; }))
        continue;
      said.insert(droppers.begin(), droppers.end());
      const std::size_t nearest = *std::min_element(droppers.begin(), droppers.end(),
                                                    [&](const std::size_t a, const std::size_t b)
                                                    { return gaps[a] < gaps[b]; });
      const Link &link = scene.links[nearest];
      const bool is_one = droppers.size() == 1;
      result.push_back(to_text(
          std::setprecision(4),
          is_one ? "the only dropper" : to_text("all ", droppers.size(), " droppers"), " of wire '",
          scene.wires[w].name, is_one ? "' is" : "' are", " slack at the start, '", link.name,
          is_one ? "'" : "' by the least", ", ", gaps[nearest], " m",
          link.unstressed_length > 0. ? to_text(" at its length of ", link.unstressed_length, " m")
                                      : "",
          ": no force goes from wire to wire. Check their lengths [m], the heights of the wires "
          "[m] and their tensions [N]"));
    }
    return result;
  }
} // namespace taut
