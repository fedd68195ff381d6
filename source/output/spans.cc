// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "scene/travel.h"
#include "scene/wave_speed.h"
#include <taut/output/spans.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut
{
  bool is_dropper_between_wires(const Link &link)
  {
    return link.kind == LinkKind::dropper && link.through.empty() &&
           link.from.kind == Attachment::Kind::wire && link.to.kind == Attachment::Kind::wire;
  }

  namespace
  {
    constexpr double rounding_of_masts = 1e-6; ///< of their places [m]
    constexpr unsigned int n_places = 4;       ///< in an element

    /// Places of the transverse supports of a wire, on it [m].
    std::vector<double> supports_of(const Scene &scene, const std::size_t wire)
    {
      std::vector<double> places;
      for (const Support &support : scene.supports)
        if (support.wire == wire && support.motion == WireMotion::transverse)
          places.insert(places.end(), support.positions.begin(), support.positions.end());
      return places;
    }

    /// @p droppers: links that hold the wire.
    std::vector<double> masts_of(const Scene &scene, const std::size_t wire,
                                 const std::vector<std::size_t> &droppers)
    {
      std::set<std::size_t> above;
      for (const std::size_t l : droppers)
        above.insert(scene.links[l].from.index);
      std::vector<double> places;
      if (above.empty())
        places = supports_of(scene, wire);
      const Wire &own = scene.wires[wire];
      for (const std::size_t other : above)
        for (const double s : supports_of(scene, other))
        {
          const Coordinates way = add_scaled(scene.wires[other].at(s), -1., own.a);
          const double place = dot(way, own.tangent());
          if (place > -rounding_of_masts && place < own.length() + rounding_of_masts)
            places.push_back(std::clamp(place, 0., own.length()));
        }
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end(),
                               [](const double a, const double b)
                               { return b - a < rounding_of_masts; }),
                   places.end());
      return places;
    }

    bool is_in(const Span &span, const double place)
    {
      return place >= span.from - rounding_of_masts && place < span.to - rounding_of_masts;
    }

    /// The span of a place, or their number.
    std::size_t span_at(const std::vector<Span> &spans, const double place)
    {
      const auto behind =
          std::upper_bound(spans.begin(), spans.end(), place + rounding_of_masts,
                           [](const double s, const Span &span) { return s < span.from; });
      return behind != spans.begin() && is_in(*(behind - 1), place) ? behind - spans.begin() - 1
                                                                    : spans.size();
    }
  } // namespace

  std::vector<SpannedWire> spanned_wires(const Scene &scene)
  {
    std::set<std::size_t> wires;
    for (const Link &link : scene.links)
    {
      if (is_dropper_between_wires(link))
        wires.insert({link.from.index, link.to.index});
      else if (link.moving() && link.to.kind == Attachment::Kind::wire)
        wires.insert(link.to.index);
    }
    std::vector<std::vector<std::size_t>> droppers(scene.wires.size()); // at their lower ends
    for (std::size_t l = 0; l < scene.links.size(); ++l)
      if (is_dropper_between_wires(scene.links[l]))
        droppers[scene.links[l].to.index].push_back(l);
    std::vector<SpannedWire> result;
    for (const std::size_t wire : wires)
    {
      SpannedWire found{wire, scene.wires[wire].name, {}};
      const std::vector<double> masts = masts_of(scene, wire, droppers[wire]);
      for (std::size_t i = 1; i < masts.size(); ++i)
        found.spans.push_back({to_text(found.name, " span ", i), masts[i - 1], masts[i]});
      for (const std::size_t l : droppers[wire])
        if (const std::size_t i = span_at(found.spans, scene.links[l].to.position);
            i < found.spans.size())
          found.spans[i].droppers.push_back(l);
      if (!found.spans.empty())
        result.push_back(std::move(found));
    }
    return result;
  }

  void find_sags(const Scene &scene, const SceneBodies &bodies, const BodyVectors &U,
                 std::vector<SpannedWire> &wires)
  {
    for (SpannedWire &spanned : wires)
    {
      const double up = scene.wires[spanned.wire].normal().y < 0. ? -1. : 1.;
      const std::vector<double> nodes = grid(scene, spanned.wire);
      for (Span &span : spanned.spans)
      {
        std::vector<double> places = {span.from, span.to};
        const auto begin = std::upper_bound(nodes.begin() + 1, nodes.end(), span.from);
        for (std::size_t i = begin - nodes.begin(); i < nodes.size() && nodes[i - 1] < span.to; ++i)
          for (unsigned int k = 0; k < n_places; ++k)
            if (const double s = nodes[i - 1] + (nodes[i] - nodes[i - 1]) * k / n_places;
                s > span.from && s < span.to)
              places.push_back(s);
        std::vector<double> heights;
        for (const double s : places)
        {
          std::vector<Term> terms;
          bodies.motion(spanned.wire, s, WireMotion::transverse, terms);
          heights.push_back(up * evaluate(terms, U));
        }
        bodies.communicator().sum(heights);
        span.sag = 0.;
        for (std::size_t i = 2; i < places.size(); ++i)
        {
          const double part = (places[i] - span.from) / (span.to - span.from);
          const double chord = heights[0] + part * (heights[1] - heights[0]);
          span.sag = std::max(span.sag, chord - heights[i]);
        }
      }
    }
  }

  SpanForce SpanForce::of(const Span &span, const ContactRecord &record,
                          const StatisticsParameters &parameters)
  {
    std::vector<double> force, mean_force;
    for (std::size_t i = 0; i < record.force.size(); ++i)
      if (is_in(span, record.position[i]) && parameters.is_in_window(record.position[i]))
      {
        force.push_back(record.force[i]);
        mean_force.push_back(record.mean_force[i]);
      }
    SpanForce result = {Moments::of(force), force.size()};
    // Peaks of impulses depend on the step, so that peaks are those of mean forces.
    result.moments.maximum = Moments::of(mean_force).maximum;
    return result;
  }

  namespace
  {
    /// Resistance of a wire to waves, sqrt(T m) [N s/m].
    double impedance(const Wire &wire)
    {
      return std::sqrt(wire.tension * wire.mass_per_length);
    }
  } // namespace

  std::vector<LineConstants> line_constants(const Scene &scene)
  {
    std::vector<LineConstants> result;
    for (const Link &link : scene.links)
    {
      if (!link.moving() || link.to.kind != Attachment::Kind::wire)
        continue;
      const Wire &wire = scene.wires[link.to.index];
      if (!(wire.tension > 0. && wire.mass_per_length > 0.))
        continue;
      LineConstants found{link.name, wire.name};
      found.speed = std::fabs(link.speed);
      if (link.travel)
        found.speed = std::max(std::fabs(link.travel->speed(0.)), link.travel->range().fastest);
      const double c = found.wave_speed = wave_speed(wire);
      found.doppler = std::max(0., (c - found.speed) / (c + found.speed));
      const auto holds = [&](const Link &dropper)
      { return is_dropper_between_wires(dropper) && dropper.to.index == link.to.index; };
      const auto dropper = std::find_if(scene.links.begin(), scene.links.end(), holds);
      if (dropper != scene.links.end())
      {
        const double above = impedance(scene.wires[dropper->from.index]);
        found.reflection = above / (above + impedance(wire));
        found.amplification = found.doppler > 0. ? found.reflection / found.doppler : 0.;
      }
      result.push_back(found);
    }
    return result;
  }
} // namespace taut
