// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/model_limits.h"
#include "base/instruction_set.h"
#include "base/text.h"
#include "scene/travel.h"
#include "scene/wave_speed.h"
#include <taut/base/archive.h>
#include <taut/cable/cable.h>
#include <taut/mechanism/rigid_body.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace taut
{
  namespace
  {
    constexpr double largest_slope = .1; ///< [rad]
    constexpr double largest_turn = 1.;  ///< of a rigid body from its start to rest [rad]
    constexpr double tiny = std::numeric_limits<double>::min();
    constexpr double least_samples = 10.; ///< in a period of the filter frequency
    constexpr std::size_t most_slopes = 2000, most_distances = 300; ///< along a wire

    /// At most so many of the positions, including the last one.
    std::vector<double> thinned(const std::vector<double> &positions, const std::size_t most)
    {
      const std::size_t stride = (positions.size() + most - 1) / most;
      std::vector<double> result;
      for (std::size_t i = 0; i + 1 < positions.size(); i += stride)
        result.push_back(positions[i]);
      result.push_back(positions.back());
      return result;
    }

    /// True if a link pushes two wires apart and so limits their distance.
    bool are_in_contact(const Scene &scene, const std::size_t a, const std::size_t b)
    {
      const auto is_on = [](const Attachment &end, const std::size_t wire)
      { return end.kind == Attachment::Kind::wire && end.index == wire; };
      return std::any_of(scene.links.begin(), scene.links.end(),
                         [&](const Link &link)
                         {
                           return link.kind != LinkKind::dropper &&
                                  ((is_on(link.from, a) && is_on(link.to, b)) ||
                                   (is_on(link.from, b) && is_on(link.to, a)));
                         });
    }
  } // namespace

  ModelLimits::ModelLimits(const Scene &scene, const SceneBodies &structure,
                           const double filter_frequency, const double step, const long interval)
      : interval(std::max(1L, interval)), solids(scene, structure)
  {
    add_slopes(scene, structure);
    add_cables(scene, structure);
    add_distances(scene, structure);
    compare_speeds(scene);
    compare_filter(scene, filter_frequency, step);
  }

  void ModelLimits::add_slopes(const Scene &scene, const SceneBodies &structure)
  {
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const Wire &wire = scene.wires[w];
      if (wire.transverse == TransverseKind::none)
        continue;
      Line line{
          "wire '" + wire.name + "'", "", forms.size(), 0, thinned(grid(scene, w), most_slopes), {},
          wire.has_lateral ? 2u : 1u, {}};
      line.n = line.positions.size();
      for (unsigned int d = 0; d < line.n_directions; ++d)
        for (const double s : line.positions)
        {
          std::vector<Term> terms;
          structure.motion({Attachment::Kind::wire, w, s}, false,
                           d == 0 ? wire.normal() : wire.binormal(), 1., terms);
          forms.add(terms);
        }
      lines.push_back(std::move(line));
    }
  }

  void ModelLimits::add_cables(const Scene &scene, const SceneBodies &structure)
  {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    {
      if (scene.bodies[i].type_name != "cable")
        continue;
      const std::size_t k = structure.indices_of_body(i)[0];
      // Length, number of elements, and whether it is linearised at the start, on all ranks.
      double known[] = {0., 0., 0.};
      if (k != Structure::elsewhere && structure[k].is_linear())
      {
        const auto &cable = dynamic_cast<const Cable &>(structure[k]);
        known[0] = cable.elements().length();
        known[1] = cable.elements().n_elements();
        known[2] = cable.is_linearised() ? 1. : 0.;
      }
      structure.communicator().sum(known, 3);
      if (known[1] == 0.)
        continue;
      std::vector<double> nodes;
      for (unsigned int e = 0; e <= known[1]; ++e)
        nodes.push_back(known[0] * e / known[1]);
      Line line;
      line.name = "linearised cable '" + scene.bodies[i].name + "'";
      line.first = forms.size();
      line.positions = thinned(nodes, most_slopes);
      line.n_directions = 3;
      line.turns_from_reference = known[2] > 0.;
      line.n = line.positions.size();
      std::vector<Coordinates> places;
      const auto at = [&](const double s)
      {
        Attachment point{Attachment::Kind::body, i};
        point.place = {s};
        return point;
      };
      for (const double s : line.positions)
        places.push_back(structure.position(scene, at(s)));
      for (std::size_t j = 0; j + 1 < line.n; ++j)
        line.chords.push_back(places[j + 1] - places[j]);
      for (const Coordinates &axis :
           {Coordinates{1.}, Coordinates{0., 1.}, Coordinates{0., 0., 1.}})
        for (const double s : line.positions)
        {
          std::vector<Term> terms;
          structure.motion(at(s), false, axis, 1., terms);
          forms.add(terms);
        }
      lines.push_back(std::move(line));
    }
  }

  /// Slope between a sample and the next one [rad].
  double ModelLimits::slope_after(const Line &line, const double *const u,
                                  const std::size_t sample) const
  {
    double change[3] = {0., 0., 0.};
    for (unsigned int d = 0; d < line.n_directions; ++d)
      change[d] = u[d * line.n + sample + 1] - u[d * line.n + sample];
    Coordinates across = {change[0], change[1], change[2]};
    if (line.chords.empty())
      return norm(across) / (line.positions[sample + 1] - line.positions[sample]);
    const Coordinates &chord = line.chords[sample];
    across = add_scaled(across, -dot(across, chord) / dot(chord, chord), chord);
    return norm(across) / norm(chord);
  }

  void ModelLimits::add_distances(const Scene &scene, const SceneBodies &structure)
  {
    constexpr double least_part_along_x = .5;
    for (std::size_t a = 0; a < scene.wires.size(); ++a)
      for (std::size_t b = 0; b < scene.wires.size(); ++b)
      {
        const Wire &lower = scene.wires[a], &upper = scene.wires[b];
        const double slope_a = lower.tangent().x, slope_b = upper.tangent().x;
        if (a == b || std::fabs(slope_a) < least_part_along_x ||
            std::fabs(slope_b) < least_part_along_x || are_in_contact(scene, a, b))
          continue;
        Line line{"wire '" + lower.name + "'",
                  "wire '" + upper.name + "'",
                  forms.size(),
                  0,
                  {},
                  {},
                  1,
                  {}};
        for (const double s : thinned(grid(scene, a), most_distances))
        {
          const double s_above = (lower.at(s).x - upper.a.x) / slope_b;
          // Wires beside each other may pass.
          if (s_above < 0. || s_above > upper.length() || upper.at(s_above).z != lower.at(s).z)
            continue;
          line.positions.push_back(s);
          line.distances.push_back(upper.at(s_above).y - lower.at(s).y);
        }
        // Wires that meet or cross are joined there, or should be.
        if (line.positions.empty() ||
            *std::min_element(line.distances.begin(), line.distances.end()) <= 0.)
          continue;
        for (const double s : line.positions)
        {
          const double s_above = (lower.at(s).x - upper.a.x) / slope_b;
          std::vector<Term> terms;
          structure.motion({Attachment::Kind::wire, a, s}, false, {0., 1.}, 1., terms);
          structure.motion({Attachment::Kind::wire, b, s_above}, false, {0., 1.}, -1., terms);
          forms.add(terms);
        }
        line.n = line.positions.size();
        lines.push_back(std::move(line));
      }
  }

  void ModelLimits::compare_speeds(const Scene &scene)
  {
    const auto compare = [&](const std::string &name, const Attachment &on, const double speed)
    {
      if (on.kind != Attachment::Kind::wire)
        return;
      const Wire &wire = scene.wires[on.index];
      const double waves = wave_speed(wire), v = std::fabs(speed);
      if (!(wire.tension > 0.) || v <= waves)
        return;
      const std::string what = to_text(
          std::setprecision(4), name, " moves at ", v, " m/s, faster than the waves of wire '",
          wire.name, "', ", waves,
          " m/s: what is ahead of it does not know of it. Slow it down, or tighten the wire");
      if (constant.empty() || v / waves > constant.back().value / constant.back().limit)
        constant = {{"speed", what, v, waves, "m/s", 0.}};
    };
    for (const Link &link : scene.links)
      if (link.moving())
        compare("sliding contact '" + link.name + "'", link.to,
                link.travel ? link.travel->range().fastest : link.speed);
    for (const Load &load : scene.loads)
      if (load.kind == Load::Kind::moving)
        compare("load '" + load.name + "'", load.target,
                load.travel ? load.travel->range().fastest : load.speed);
  }

  void ModelLimits::compare_filter(const Scene &scene, const double frequency, const double step)
  {
    const bool is_used = std::any_of(scene.links.begin(), scene.links.end(),
                                     [](const Link &link) { return link.moving(); });
    constexpr double rounding = 1e-9;
    const double n = 1. / (frequency * step);
    if (!is_used || !(frequency > 0.) || !(step > 0.) || n >= least_samples * (1. - rounding))
      return;
    const double pi = std::acos(-1.);
    constant.push_back(
        {"filter",
         to_text(std::setprecision(4), "a period of Statistics/Filter frequency = ", frequency,
                 " Hz has ", n, " steps, fewer than ", least_samples, ": peaks may be missed by ",
                 n > 2. ? 100. * (1. - std::cos(pi / n)) : 100.,
                 " % of their height. Take a Time/Step of at most ",
                 1. / (least_samples * frequency), " s, or a lower frequency"),
         n, least_samples, "1", 0.});
  }

  /// Takes directions at the reference for cables that are linearised there.
  void ModelLimits::take_chords_at_reference(const Communicator &processes)
  {
    std::vector<double> all = at_reference;
    processes.sum(all);
    for (Line &line : lines)
    {
      if (!line.turns_from_reference)
        continue;
      const double *const u = all.data() + line.first;
      const auto change = [&](const std::size_t d, const std::size_t j)
      { return u[d * line.n + j + 1] - u[d * line.n + j]; };
      for (std::size_t j = 0; j < line.chords.size(); ++j)
        line.chords[j] = add_scaled(line.chords[j], 1., {change(0, j), change(1, j), change(2, j)});
      std::fill_n(at_reference.begin() + line.first, line.n_directions * line.n, 0.);
    }
  }

  /// Compares the equilibrium at the start with the place that is given: by which angle the
  /// vertical of each rigid body turns, or the body, if there is no gravity.
  void ModelLimits::record_turned_bodies(const StepView &step)
  {
    for (std::size_t i = 0; i < step.scene.bodies.size(); ++i)
    {
      double angle = 0.;
      for (const std::size_t k : step.structure.indices_of_body(i))
        if (k != Structure::elsewhere)
          if (const auto *const body = dynamic_cast<const RigidBody *>(&step.structure[k]))
          {
            std::vector<double> U = step.reference.displacement[k];
            for (std::size_t j = 0; j < U.size(); ++j)
              U[j] += step.state.U[k][j];
            const Coordinates turn = body->rotation(U), down = step.scene.gravity;
            const double about_vertical = dot(turn, down) / std::max(norm(turn) * norm(down), tiny);
            angle = std::acos(std::clamp(1. - (1. - std::cos(norm(turn))) *
                                                  (1. - about_vertical * about_vertical),
                                         -1., 1.));
          }
      angle = step.structure.communicator().max(angle);
      if (angle / largest_turn > turned.excess)
        turned = {angle / largest_turn, angle, largest_turn, 0., step.state.time, i};
    }
    if (turned.excess > 1.)
      turned_body = step.scene.bodies[turned.line].name;
  }

  void ModelLimits::record(const StepView &step)
  {
    if (n_calls == 0)
      record_turned_bodies(step);
    if (n_calls++ % interval != 0)
      return;
    solids.record(step);
    if (lines.empty())
      return;
    if (at_reference.empty())
    {
      at_reference.assign(forms.size(), 0.);
      forms.evaluate(step.reference.displacement, at_reference.data());
      take_chords_at_reference(step.structure.communicator());
    }
    values = at_reference;
    forms.evaluate(step.state.U, values.data());
    step.structure.communicator().sum(values);
    const auto keep = [&](Extreme &extreme, const double value, const double limit,
                          const double position, const std::size_t line)
    {
      if (value / limit > extreme.excess)
        extreme = {value / limit, value, limit, position, step.state.time, line};
    };
    for (std::size_t l = 0; l < lines.size(); ++l)
    {
      const Line &line = lines[l];
      const double *const u = values.data() + line.first;
      if (!may_exceed(line, u))
        continue;
      for (std::size_t i = 0; i < line.n; ++i)
        if (!line.distances.empty())
          keep(distance, u[i], line.distances[i], line.positions[i], l);
        else if (i + 1 < line.n)
          keep(slope, slope_after(line, u, i), largest_slope,
               .5 * (line.positions[i] + line.positions[i + 1]), l);
    }
  }

  /// False if a line certainly has no new extreme: a quick look at the lines of most scenes.
  bool ModelLimits::may_exceed(const Line &line, const double *const u) const
  {
    if (line.n_directions > 1 || !line.chords.empty())
      return true;
    double largest = 0.;
    vectorised(
        [&]
        {
          const double *const s = line.positions.data(), *const d = line.distances.data();
          const std::size_t n = line.n;
          double found = 0.;
          if (line.distances.empty())
#pragma omp simd reduction(max : found)
            for (std::size_t i = 1; i < n; ++i)
              found = std::max(found, std::fabs(u[i] - u[i - 1]) / (s[i] - s[i - 1]));
          else
#pragma omp simd reduction(max : found)
            for (std::size_t i = 0; i < n; ++i)
              found = std::max(found, u[i] / d[i]);
          largest = found;
        });
    return line.distances.empty() ? largest / largest_slope > slope.excess
                                  : largest > distance.excess;
  }

  template <typename Archive>
  void ModelLimits::store(Archive &archive)
  {
    archive &n_calls;
    archive &turned_body;
    for (Extreme *extreme : {&slope, &distance, &turned})
      archive & extreme->excess & extreme->value & extreme->limit & extreme->position &
          extreme->time & extreme->line;
    solids.store(archive);
  }

  void ModelLimits::save(OutputArchive &archive)
  {
    store(archive);
  }

  void ModelLimits::resume(InputArchive &archive, const StepView &)
  {
    store(archive);
  }

  std::vector<Warning> ModelLimits::warnings() const
  {
    std::vector<Warning> result = constant;
    if (slope.excess > 1.)
    {
      const Line &line = lines[slope.line];
      const bool is_wire = line.chords.empty();
      result.push_back(
          {"slope",
           to_text(std::setprecision(4), line.name, is_wire ? " has a slope of " : " turns by ",
                   slope.value, " rad at ", slope.position, " m, t = ", slope.time,
                   " s: the equations are those of small ", is_wire ? "slopes" : "turns",
                   ", up to ", slope.limit, " rad. Check loads and tension",
                   is_wire ? "" : ", or take Geometry = nonlinear"),
           slope.value, slope.limit, "rad", slope.time});
    }
    if (distance.excess > 1.)
      result.push_back(
          {"distance",
           to_text(std::setprecision(4), lines[distance.line].name, " comes ", distance.value,
                   " m nearer to ", lines[distance.line].other, ", which is ", distance.limit,
                   " m above it, at ", distance.position, " m, t = ", distance.time,
                   " s: it passes through it, for no contact between them is part of "
                   "the model. Check loads and the distance"),
           distance.value, distance.limit, "m", distance.time});
    if (turned.excess > 1.)
      result.push_back(
          {"equilibrium",
           to_text(std::setprecision(4), "the equilibrium at the start tilts '", turned_body,
                   "' by ", turned.value,
                   " rad from its place in the scene, which may not be the one that is meant. "
                   "Check supports, stops and the centre of mass, or give the body "
                   "near its equilibrium"),
           turned.value, turned.limit, "rad", turned.time});
    const std::vector<Warning> of_solids = solids.warnings();
    result.insert(result.end(), of_solids.begin(), of_solids.end());
    return result;
  }

  void ModelLimits::report(std::ostream &log, bool) const
  {
    solids.print_left_out(log);
    for (const Warning &warning : warnings())
      log << "Warning: " << warning.message << '\n';
  }
} // namespace taut
