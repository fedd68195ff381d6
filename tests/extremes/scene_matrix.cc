// SPDX-License-Identifier: LGPL-2.1-or-later
// The dimensions of the matrix of extremes and the scenes that they span; see scene_matrix.h.
#include "scene_matrix.h"

#include "levels.h"

namespace extremes
{
  namespace
  {
    using taut::Attachment;
    using Kind = taut::Attachment::Kind;

    const Dimension steps = {"step", {1e-9, 1e-6, 1e-3, 1., 1e3, 1e6}},
                    schemes = {"scheme", {0, 1, 2, 3}},
                    // The fourth accelerates such bodies by the rounding of their elastic forces.
        schemes_of_floating_bodies = {"scheme", {0, 1, 2}}, starts = {"start", {0, 1, 2}},
                    states = {"state", {0, 1, 2, 3}}, // open, closed, grazing, by turns
        solvers = {"solver", {0, 1, 2, 3, 4}};
    const char *const scheme_names[] = {"backward Euler", "BDF2", "generalised-alpha",
                                        "Moreau-Jean"};

    taut::Link link(const std::string &name, const taut::LinkKind kind, const Attachment &from,
                    const Attachment &to, const double compliance, const double gap)
    {
      taut::Link l;
      l.name = name;
      l.kind = kind;
      l.from = from;
      l.to = to;
      if (compliance > 0.)
        l.stiffness = 1. / compliance;
      l.gap = gap;
      return l;
    }

    taut::Spring spring(const std::size_t from, const std::size_t to, const double k)
    {
      taut::Spring s;
      s.name = "spring";
      s.from = from;
      s.to = to;
      s.stiffness = k;
      return s;
    }

    taut::Load load(const Attachment &on, const double magnitude)
    {
      taut::Load l;
      l.name = "load";
      l.target = on;
      l.magnitude = taut::Expression(magnitude);
      return l;
    }

    taut::Mass mass(const std::string &name, const double m)
    {
      taut::Mass result;
      result.name = name;
      result.mass = m;
      result.weight = false;
      return result;
    }

    taut::Wire wire(const double length, const double element_size, const double tension)
    {
      taut::Wire result;
      result.name = "wire";
      result.mass_per_length = 1.;
      result.weight = false;
      result.b = {length, 0.};
      result.element_size = element_size;
      result.tension = tension;
      return result;
    }

    taut::Support ends(const double length)
    {
      taut::Support result;
      result.name = "ends";
      result.positions = {0., length};
      return result;
    }

    const auto on_wire = [](const double s) { return Attachment{Kind::wire, 0, s}; };
    const auto on_mass = [](const std::size_t i) { return Attachment{Kind::mass, i, 0.}; };

    void set_common(Case &c, const Levels &level)
    {
      c.step = level["step"];
      c.scheme = scheme_names[static_cast<int>(level["scheme"])];
      const int solver = static_cast<int>(level["solver"]);
      if (solver == 1)
        c.local_solver = "sparse direct";
      if (solver == 2)
        c.interface_operator = "matrix-free";
      if (solver == 3)
        c.complementarity = "energy-ordered";
      if (solver == 4)
        c.interface_operator = "assembled sparse";
    }

    template <typename Make>
    std::vector<Case> cover(const std::string &family, const std::vector<Dimension> &dimensions,
                            const unsigned int seed, const Make &make)
    {
      std::vector<Case> cases;
      extremes::cover(dimensions, seed,
                      [&](const Levels &level)
                      {
                        Case c;
                        c.family = family;
                        c.name = level.name();
                        c.scene.gravity = {0., 0.};
                        make(c, level);
                        cases.push_back(std::move(c));
                      });
      return cases;
    }

    /// Gap of a stop under a point that a load moves down by u: open by u, pressed, or touching.
    double gap_in_state(const int state, const std::size_t i, const double u)
    {
      const int own = state == 3 ? static_cast<int>(i % 3) : state;
      return own == 0 ? 2. * u : own == 1 ? .5 * u : u;
    }

    // Ground, spring, mass 1, spring, mass 2 under a load; stops below, above and between them.
    const std::vector<Dimension> dimensions_of_masses = {
        steps,
        {"stiffness ratio", {1., 1e6, 1e12, 1e-6, 1e-12}},
        {"mass ratio", {1., 1e12, 1e-12, 0.}},
        {"compliance", {0., 1e-12, 1e-6, 1e-3, 1.}},
        {"gap", {0., 1e-9, 1., 1e6}},
        {"load", {0., 1e-12, 1., 1e12}},
        states,
        {"copies", {1, 2}},
        schemes,
        starts,
        solvers};

    void make_masses(Case &c, const Levels &level)
    {
      using taut::LinkKind;
      set_common(c, level);
      const double k1 = 1024., k2 = k1 * level["stiffness ratio"], P = level["load"],
                   S = level["compliance"], G = level["gap"];
      const double u = P / k1 + P / k2;
      // Beside what their impulses do to the light one the velocities are lost from 1e12 on.
      double heavier = level["mass ratio"];
      if (c.scheme == "Moreau-Jean" && heavier > 0.)
        heavier = std::clamp(heavier, 1e-9, 1e9);
      c.scene.masses = {mass("1", 1.), mass("2", heavier)};
      c.scene.springs = {spring(taut::ground, 0, k1), spring(0, 1, k2)};
      c.scene.loads = {load(on_mass(1), -P)};
      const int state = static_cast<int>(level["state"]);
      for (int copy = 0; copy < static_cast<int>(level["copies"]); ++copy)
      {
        const std::string n = std::to_string(copy);
        c.scene.links.push_back(
            link("below" + n, LinkKind::stop, {}, on_mass(1), S, gap_in_state(state, 1, u)));
        c.scene.links.push_back(link("above" + n, LinkKind::dropper, {}, on_mass(0), S, G));
        c.scene.links.push_back(link("between" + n, LinkKind::stop, on_mass(1), on_mass(0), S,
                                     gap_in_state(state, 2, G)));
      }
      c.scene.start = static_cast<taut::Start>(static_cast<int>(level["start"]));
      // Far from equilibrium, both alike, so that rigid constraints start open.
      for (taut::Mass &m : c.scene.masses)
      {
        m.displacement[1] = G;
        m.velocity[1] = 1.;
      }
    }
    const std::vector<Dimension> dimensions_of_wires = {
        steps,
        {"kind", {0, 1, 2, 3, 4}}, // bar, string of degree 1 and 2, beam, tensioned beam
        {"grid", {0, 1, 2}},       // one element, six, 1e-4 to 1e3 m
        {"compliance", {0., 1e-9, 1.}},
        {"gap", {0., 1e-3, 1e6}},
        {"load", {1e-12, 1., 1e12}},
        states,
        {"parts", {1, 2, 5}},
        {"hold", {0, 1, 2}}, // both ends, elastic, one end
        {"copies", {1, 2}},
        schemes,
        starts,
        solvers};

    void make_wires(Case &c, const Levels &level)
    {
      set_common(c, level);
      c.n_parts = static_cast<unsigned int>(level["parts"]);
      const int kind = static_cast<int>(level["kind"]), grid = static_cast<int>(level["grid"]);
      if (grid == 0)
        c.n_parts = 1; // one element cannot be shared
      const std::vector<double> graded = {1e-4, 1.1e-3, 1e-2, .1, 1.};
      const double length = grid == 2 ? 1001. : grid == 1 ? 6. : 1.;
      taut::Wire w = wire(length, grid == 1 ? 1. : 1e3, kind == 3 ? 0. : 1e4);
      w.has_axial = kind == 0;
      w.axial_stiffness = 1e4;
      w.bending_stiffness = 1e3;
      w.degree = kind == 2 ? 2 : 1;
      w.transverse = kind == 0   ? taut::TransverseKind::none
                     : kind >= 3 ? taut::TransverseKind::beam
                                 : taut::TransverseKind::string;
      const taut::Coordinates along =
          kind == 0 ? taut::Coordinates{1., 0.} : taut::Coordinates{0., 1.};

      taut::Support support = ends(length);
      const int hold = static_cast<int>(level["hold"]);
      if (hold == 2)
        support.positions = {0.};
      support.fixed = hold != 1;
      support.stiffness = 1e3;
      support.motion = kind == 0 ? taut::WireMotion::axial : taut::WireMotion::transverse;
      c.scene.supports.push_back(support);
      if (hold == 2 && kind == 3)
      {
        support.name = "slope";
        support.motion = taut::WireMotion::slope;
        c.scene.supports.push_back(support);
      }

      // The load at one third or in a short element, stops around it.
      const double at = grid == 2 ? graded[3] : grid == 1 ? 2. : 1.;
      taut::Load P = load(on_wire(at), -level["load"]);
      P.direction = along;
      c.scene.loads = {P};
      const std::vector<double> places = grid == 2   ? graded
                                         : grid == 1 ? std::vector<double>{1., 2., 4., 5.}
                                                     : std::vector<double>{1.};
      const double u = level["load"] / 1e4 * std::min(at, 1.);
      const int state = static_cast<int>(level["state"]);
      for (std::size_t i = 0; i < places.size(); ++i)
        for (int copy = 0; copy < static_cast<int>(level["copies"]); ++copy)
        {
          taut::Link l = link("stop" + std::to_string(i) + "_" + std::to_string(copy),
                              taut::LinkKind::stop, {}, on_wire(places[i]), level["compliance"],
                              i % 2 == 1 ? gap_in_state(state, i, u) : level["gap"]);
          l.direction = along;
          c.scene.links.push_back(l);
        }
      c.scene.start = static_cast<taut::Start>(static_cast<int>(level["start"]));
      for (taut::InitialMotion *m : {&w.axial_start, &w.transverse_start})
      {
        m->displacement = taut::Expression(hold == 1 ? 10. : 0.);
        m->velocity = taut::Expression(-1.);
      }
      c.scene.wires = {w};
    }
    // A mass on a spring presses a string or beam from below while it moves along.
    const std::vector<Dimension> dimensions_of_sliding = {
        steps,
        {"speed over wave speed", {0., 1e-6, .5, 1., 1.5, 3.}},
        {"kind", {1, 2, 4}},
        {"elements", {1, 12}},
        {"compliance", {0., 1e-6, 1.}},
        {"gap", {0., 1e-3, 1e6}},
        {"load", {1e-12, 1e2, 1e12}},
        {"contact mass", {0., 1e-6, 1., 1e6}},
        {"parts", {1, 3}},
        {"start", {0, 1}},
        schemes,
        solvers};

    void make_sliding(Case &c, const Levels &level)
    {
      set_common(c, level);
      c.n_steps = 5;
      if (level["elements"] > 1.)
        c.n_parts = static_cast<unsigned int>(level["parts"]);
      const int kind = static_cast<int>(level["kind"]);
      constexpr double wave_speed = 128., T = wave_speed * wave_speed;
      const double v = wave_speed * level["speed over wave speed"];
      const double length = 10. + 1.25 * v * c.step * c.n_steps;
      taut::Wire w = wire(length, length / level["elements"], T);
      w.bending_stiffness = 100.;
      w.degree = kind == 2 ? 2 : 1;
      w.transverse = kind == 4 ? taut::TransverseKind::beam : taut::TransverseKind::string;
      c.scene.wires = {w};
      c.scene.supports = {ends(length)};
      c.scene.masses = {mass("head", level["contact mass"])};
      c.scene.springs = {spring(taut::ground, 0, 100.)};
      c.scene.loads = {load(on_mass(0), level["load"])};
      taut::Link l = link("contact", taut::LinkKind::sliding_contact, on_mass(0),
                          on_wire(.1 * length), level["compliance"], level["gap"]);
      l.speed = v;
      l.faster_than_waves = true;
      c.scene.links = {l};
      c.scene.start = static_cast<taut::Start>(static_cast<int>(level["start"]));
    }
    // A free beam, string or rigid bar on stops, or one that hangs on droppers, at rest.
    const std::vector<Dimension> dimensions_of_resting = {
        steps,
        {"body", {1, 3, 5}}, // string, beam, mass that turns
        {"constraints", {2, 3, 7}},
        {"load", {1e-12, 1., 1e12}},
        {"at", {.25, .5, .75}},
        {"bending stiffness", {1e-6, 1., 1e6}},
        {"compliance", {0., 1e-6, 1.}},
        {"gap", {0., 1e-3, 1e6}},
        {"copies", {1, 2}},
        {"droppers", {0, 1}},
        {"parts", {1, 3}},
        schemes_of_floating_bodies,
        solvers};

    void make_resting(Case &c, const Levels &level)
    {
      set_common(c, level);
      c.n_steps = 2;
      const int body = static_cast<int>(level["body"]);
      const bool hangs = level["droppers"] == 1.;
      const auto n = static_cast<int>(level["constraints"]);
      constexpr double length = 16.;
      const double at = level["at"] * length;
      if (body == 5)
      {
        taut::Mass m = mass("bar", 1.);
        m.inertia = 20.;
        m.moves[2] = true;
        c.scene.masses = {m};
        c.scene.loads = {load(on_mass(0), -level["load"])};
        taut::Load turn = load(on_mass(0), -level["load"] * (at - .5 * length));
        turn.rotational = true;
        turn.direction = {0., 0., 1.};
        c.scene.loads.push_back(turn);
      }
      else
      {
        taut::Wire w = wire(length, 2., body == 1 ? 1e3 : 0.);
        w.bending_stiffness = level["bending stiffness"];
        w.degree = 1;
        w.transverse = body == 1 ? taut::TransverseKind::string : taut::TransverseKind::beam;
        c.scene.wires = {w};
        c.scene.loads = {load(on_wire(at), -level["load"])};
        c.n_parts = static_cast<unsigned int>(level["parts"]);
      }
      for (int i = 0; i < n; ++i)
        for (int copy = 0; copy < static_cast<int>(level["copies"]); ++copy)
        {
          const double x = length * i / (n - 1);
          // A mass that turns has no points away from it: a joint to a massless node would be a
          // body more; its constraints hold deflection and, as angular stops, rotation.
          taut::Link l = link("constraint" + std::to_string(i) + "_" + std::to_string(copy),
                              hangs ? taut::LinkKind::dropper : taut::LinkKind::stop, {},
                              body == 5 ? on_mass(0) : on_wire(x), level["compliance"],
                              i % 2 == 1 ? level["gap"] : 0.);
          if (hangs)
            l.direction = {0., -1.};
          if (body == 5 && i > 0)
          {
            l.rotational = true;
            l.direction = {0., 0., 1.};
            l.kind = i % 2 == 1 ? taut::LinkKind::stop : taut::LinkKind::dropper;
            l.gap = i == 1 ? 0. : level["gap"] * 1e-3 * i;
          }
          c.scene.links.push_back(l);
        }
    }
  } // namespace

  std::vector<Case> masses(const unsigned int seed)
  {
    return cover("masses", dimensions_of_masses, seed, make_masses);
  }

  std::vector<Case> wires(const unsigned int seed)
  {
    return cover("wires", dimensions_of_wires, seed, make_wires);
  }

  std::vector<Case> sliding(const unsigned int seed)
  {
    return cover("sliding", dimensions_of_sliding, seed, make_sliding);
  }

  std::vector<Case> resting(const unsigned int seed)
  {
    return cover("resting", dimensions_of_resting, seed, make_resting);
  }

  std::vector<Case> impossible()
  {
    using taut::LinkKind;
    std::vector<Case> cases;
    const auto add = [&](const std::string &name, const taut::Start start,
                         const std::vector<std::pair<LinkKind, double>> &kinds_and_gaps)
    {
      Case c;
      c.family = "impossible";
      c.name = name;
      c.scene.gravity = {0., 0.};
      c.scene.start = start;
      c.scene.masses = {mass("1", 1.)};
      c.scene.springs = {spring(taut::ground, 0, 1e3)};
      c.scene.loads = {load(on_mass(0), -1.)};
      for (const auto &[kind, gap] : kinds_and_gaps)
        c.scene.links.push_back(
            link(c.scene.links.empty() ? "a" : "b", kind, {}, on_mass(0), 0., gap));
      cases.push_back(c);
      return &cases.back().scene;
    };
    const auto rest = taut::Start::equilibrium, motion = taut::Start::undeformed;
    add("two joints with two gaps", rest, {{LinkKind::joint, 0.}, {LinkKind::joint, 1e-6}});
    add("squeezed between two stops", rest, {{LinkKind::stop, -1.}, {LinkKind::dropper, -1.}});
    add("a joint against a stop", rest, {{LinkKind::joint, 1.}, {LinkKind::stop, 0.}});
    add("two joints with two gaps, in motion", motion,
        {{LinkKind::joint, 0.}, {LinkKind::joint, 1e-6}});
    taut::Scene *s = add("a load pulls off the only stop", rest, {{LinkKind::stop, 0.}});
    s->springs.clear();
    s->loads = {load(on_mass(0), 1.)};
    s = add("a massless mass that nothing holds", motion, {});
    s->springs.clear();
    s->masses[0].mass = 0.;
    return cases;
  }
} // namespace extremes