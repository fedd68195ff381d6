// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scenes.h"

#include "scene_text.h"

#include <cmath>

namespace hunt
{
  namespace
  {
    /// Decades of the step below its largest, three tenths of the time scale; wires cost more.
    constexpr double step_decades = 4., step_decades_of_wires = 3.3, largest_step = .3;

    /// Decades of the stiffness of a link about that of its surroundings: ten.
    constexpr double softest = -2., stiffest = 8.;

    /// Mass, time and length of a scene, from which its numbers are drawn.
    struct Scales
    {
      double m, t, l;
      double k() const { return m / (t * t); }
      double v() const { return l / t; }
      double g() const { return l / (t * t); }
      double f() const { return m * g(); }
    };

    Scales draw_scales(Random &random)
    {
      return {short_number(random.decades(-2, 2)), short_number(random.decades(-2, 1)),
              short_number(random.decades(-3, 1))};
    }

    /// A scene that grows.
    struct Draft
    {
      Random &random;
      Scales scales;
      SceneText text = {};
      HuntScene scene = {};

      std::string draw(const double unit, const double a, const double b)
      {
        return number(short_number(unit * random.uniform(a, b)));
      }
      std::string draw_decades(const double unit, const double a, const double b)
      {
        return number(short_number(unit * random.decades(a, b)));
      }

      void set_time(const double decades, const double least, const double most)
      {
        scene.step = short_number(scales.t * largest_step * random.decades(-decades, 0));
        const double duration = scales.t * random.uniform(least, most);
        const double n = std::max(8., std::round(duration / scene.step));
        text.set("subsection Time", "Step", number(scene.step));
        text.set("subsection Time", "End", number(n * scene.step));
      }

      HuntScene finish()
      {
        text.set("subsection Output", "Field interval", "0");
        scene.text = text.text();
        return scene;
      }
    };

    /// Masses one above the other, the first at the bottom, on springs between them; it falls.
    void add_chain(Draft &draft, const int n, const bool held)
    {
      const Scales &s = draft.scales;
      for (int i = 0; i < n; ++i)
      {
        const std::string name = "m" + std::to_string(i);
        const double speed = i == 0 ? -draft.random.uniform(.5, 2.) : draft.random.uniform(-2., 1.);
        draft.text.add("Mass", name,
                       {{"Position", "0, " + number(10. * i * s.l)},
                        {"Motions", "y"},
                        {"Mass", draft.draw_decades(s.m, -.5, .5)},
                        {"Initial velocity", "0, " + number(short_number(speed * s.v())) + ", 0"}});
        if (i == 0 && !held)
          continue;
        Entries spring = {{"From", i == 0 ? "ground" : "m" + std::to_string(i - 1)},
                          {"To", name},
                          {"Stiffness", draft.draw_decades(s.k(), -1, 1.3)}};
        if (draft.random.chance(.4))
          spring.emplace_back("Damping", draft.draw_decades(s.m / s.t, -2, 0));
        draft.text.add("Spring", "s" + std::to_string(i), spring);
      }
      draft.text.set("", "Start", "given");
      const bool falls = draft.random.chance(.5);
      draft.text.set("", "Gravity", falls ? "0, -" + draft.draw(s.g(), .2, 2.) : "0, 0");
    }

    void add_load(Draft &draft, const std::string &on, const double force)
    {
      const double frequency = short_number(draft.random.uniform(.5, 8.) / draft.scales.t);
      const bool varies = draft.random.chance(.5);
      if (varies)
        draft.scene.frequency = frequency;
      draft.text.add("Load", "push",
                     {{"On", on},
                      {"Direction", "0, 1"},
                      {"Magnitude", draft.draw(force, -1., 1.) +
                                        (varies ? "*sin(" + number(frequency) + "*t)" : "")}});
    }

    /// A stop under a point, or a dropper that holds it from falling.
    void add_stop(Draft &draft, const std::string &name, const std::string &on,
                  const Entries &spring, const bool is_stop = true)
    {
      Entries entries = {{"Type", is_stop ? "stop" : "dropper"},
                         {"From", "ground"},
                         {"To", on},
                         {"Direction", is_stop ? "0, 1" : "0, -1"},
                         {"Gap", draft.draw(draft.scales.l, .05, 1.)}};
      entries.insert(entries.end(), spring.begin(), spring.end());
      draft.text.add("Link", name, entries);
      draft.scene.reach = 20. * draft.scales.l;
    }

    Entries elastic(Draft &draft)
    {
      return {{"Stiffness", draft.draw_decades(draft.scales.k(), softest, stiffest)}};
    }

    HuntScene smooth_masses(Draft draft)
    {
      const int n = draft.random.integer(1, 4);
      add_chain(draft, n, true);
      add_load(draft, "m0", draft.scales.f());
      if (n > 1 && draft.random.chance(.5))
      {
        Entries joint = {{"Type", "joint"}, {"From", "m0"}, {"To", "m" + std::to_string(n - 1)},
                         {"Direction", "0, 1"}};
        // A rigid joint needs ends that move alike at the start.
        joint.emplace_back("Stiffness", draft.draw_decades(draft.scales.k(), -2, 4));
        draft.text.add("Link", "tie", joint);
      }
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene elastic_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", elastic(draft));
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene rigid_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", {}, draft.random.chance(.7));
      if (draft.random.chance(.5))
      {
        draft.scene.restitution = short_number(draft.random.uniform(.1, 1.));
        draft.text.set("subsection Time\nsubsection Moreau-Jean", "Restitution",
                       number(draft.scene.restitution));
      }
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene damped_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 2), draft.random.chance(.5));
      const double k = short_number(draft.scales.k() * draft.random.decades(softest, stiffest)),
                   critical = 2. * std::sqrt(k * draft.scales.m);
      add_stop(draft, "floor", "m0",
               {{"Stiffness", number(k)}, {"Damping", draft.draw_decades(critical, -2, .5)}});
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene several_links(Draft draft)
    {
      const int n = draft.random.integer(2, 3);
      add_chain(draft, n, draft.random.chance(.5));
      const int n_links = draft.random.integer(2, 4);
      for (int i = 0; i < n_links; ++i)
      {
        const bool rigid = draft.random.chance(.3);
        add_stop(draft, "stop" + std::to_string(i),
                 "m" + std::to_string(draft.random.integer(0, n - 1)),
                 rigid ? Entries{} : elastic(draft), draft.random.chance(.7));
      }
      if (draft.random.chance(.5))
        draft.text.add("Link", "between",
                       {{"Type", "stop"},
                        {"From", "m0"},
                        {"To", "m1"},
                        {"Direction", "0, 1"},
                        {"Stiffness", elastic(draft).front().second},
                        {"Gap", draft.draw(draft.scales.l, .05, 1.)}});
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene law(Draft draft)
    {
      const Scales &s = draft.scales;
      add_chain(draft, draft.random.integer(1, 2), draft.random.chance(.5));
      const double k = s.k() * draft.random.decades(-1, 6), u = s.l / std::sqrt(k / s.k());
      if (draft.random.chance(.5))
      {
        const double f1 = .3 * k * u, f2 = f1 + .7 * u * k * draft.random.decades(-1, 1.5);
        add_stop(draft, "floor", "m0",
                 {{"Law", "table"},
                  {"Law points", number(short_number(.3 * u)) + ": " + number(short_number(f1)) +
                                     ", " + number(short_number(u)) + ": " +
                                     number(short_number(f2))}});
      }
      else
        add_stop(draft, "floor", "m0",
                 {{"Law", "formula"},
                  {"Law formula", number(short_number(k)) + "*d + " +
                                      number(short_number(k / (u * u))) + "*d^3"},
                  {"Law range", number(short_number(10. * u))}});
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    HuntScene adaptive(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", draft.random.chance(.3) ? Entries{} : elastic(draft));
      draft.set_time(step_decades - 1., 1.5, 4.);
      draft.text.set("subsection Time", "Step control", "adaptive");
      draft.scene.step *= 16.; // the longest, with the default of four doublings
      return draft.finish();
    }

    /// A wire of few elements along x; waves cross it in about the time scale.
    double add_wire(Draft &draft, const std::string &kind, const bool moves = true)
    {
      const Scales &s = draft.scales;
      const double length = short_number(100. * s.l), mu = short_number(s.m / length),
                   tension = short_number(mu * length * length / (s.t * s.t));
      const int n = draft.random.integer(4, 8);
      Entries wire = {{"From", "0, 0"},
                      {"To", number(length) + ", 0"},
                      {"Components", kind},
                      {"Mass per length", number(mu)},
                      {"Element size", number(length / n)}};
      if (kind == "bar")
        wire.emplace_back("Axial stiffness", number(tension));
      if (kind == "string" || (kind == "beam" && draft.random.chance(.5)))
        wire.emplace_back("Tension", number(tension));
      if (kind == "beam")
        wire.emplace_back("Bending stiffness",
                          draft.draw_decades(tension * length * length, -3, -1));
      else
        wire.emplace_back("Degree", std::to_string(draft.random.integer(1, 2)));
      if (draft.random.chance(.4))
        wire.emplace_back("Mass damping", draft.draw(1. / s.t, .01, .5));
      const std::string along = kind == "bar" ? "axial" : "transverse",
                        shape = kind == "bar" ? "" : "*sin(pi*s/" + number(length) + ")";
      if (moves)
        wire.emplace_back("Initial " + along + " velocity",
                          "-" + draft.draw(s.v(), .5, 2.) + shape);
      draft.text.add("Wire", "wire", wire);
      if (kind != "bar")
        draft.text.add("Support", "ends",
                       {{"Wire", "wire"}, {"Positions", "0, " + number(length)}});
      draft.text.set("", "Start", moves ? "given" : "equilibrium");
      draft.text.set("", "Gravity", "0, 0");
      return length;
    }

    std::string kind_of_wire(Draft &draft)
    {
      return draft.random.chance(.5) ? "string" : "beam";
    }

    HuntScene smooth_wire(Draft draft)
    {
      const double length = add_wire(draft, kind_of_wire(draft));
      add_load(draft, "wire @ " + number(short_number(.3 * length)), 10. * draft.scales.f());
      draft.set_time(step_decades_of_wires, 1., 2.5);
      return draft.finish();
    }

    HuntScene wire_on_stop(Draft draft)
    {
      const double length = add_wire(draft, kind_of_wire(draft));
      add_stop(draft, "stop", "wire @ " + number(.5 * length), elastic(draft),
               draft.random.chance(.6));
      draft.set_time(step_decades_of_wires, 1., 2.5);
      return draft.finish();
    }

    HuntScene wire_on_rigid_stop(Draft draft)
    {
      const int kind = draft.random.integer(0, 2);
      const double length = add_wire(draft, kind == 0 ? "bar" : kind == 1 ? "string" : "beam");
      if (kind == 0)
        draft.text.add("Link", "wall",
                       {{"Type", "stop"},
                        {"From", "ground"},
                        {"To", "wire @ 0"},
                        {"Direction", "1, 0"},
                        {"Gap", draft.draw(draft.scales.l, .05, .5)}});
      else
        add_stop(draft, "stop", "wire @ " + number(.5 * length), {});
      draft.set_time(step_decades_of_wires, 1., 2.5);
      return draft.finish();
    }

    /// A mass that is pushed against a wire and moves along it.
    HuntScene moving_contact(Draft draft)
    {
      const Scales &s = draft.scales;
      const double length = add_wire(draft, "beam", false);
      draft.text.add("Mass", "head",
                     {{"Position", number(.2 * length) + ", " + number(-s.l)},
                      {"Motions", "y"},
                      {"Mass", draft.draw_decades(s.m, -1, 0)}});
      draft.text.add("Load", "lift",
                     {{"On", "head"}, {"Direction", "0, 1"}, {"Magnitude", draft.draw(s.f(), 1, 5)}});
      Entries contact = {{"Type", "sliding contact"},
                         {"From", "head"},
                         {"To", "wire @ " + number(.2 * length)},
                         {"Direction", "0, 1"},
                         {"Speed", number(short_number(.2 * length / s.t))}};
      if (draft.random.chance(.7))
        contact.emplace_back("Stiffness", draft.draw_decades(s.k(), 0, 5));
      draft.text.add("Link", "collector", contact);
      draft.text.set("subsection Statistics", "Filter frequency", "0");
      draft.scene.kind = ReferenceKind::program;
      draft.set_time(2., 1., 2.5);
      return draft.finish();
    }

    HuntScene turning_rope(Draft draft)
    {
      const Scales &s = draft.scales;
      Pendulum &p = draft.scene.pendulum;
      p.mass = s.m;
      p.length = s.l;
      p.gravity = s.g();
      p.stiffness = short_number(s.k() * draft.random.decades(0, 6));
      const double angle = draft.random.uniform(-1.5, 1.5), slack = draft.random.uniform(.7, 1.);
      p.start = {short_number(slack * s.l * std::sin(angle)),
                 short_number(-slack * s.l * std::cos(angle)), 0., 0.};
      draft.text.add("Mass", "bob",
                     {{"Position", number(p.start[0]) + ", " + number(p.start[1])},
                      {"Motions", "x, y"},
                      {"Mass", number(p.mass)}});
      draft.text.add("Link", "rope",
                     {{"Type", "dropper"},
                      {"From", "ground @ 0, 0"},
                      {"To", "bob"},
                      {"Turns", "true"},
                      {"Length", number(p.length)},
                      {"Stiffness", number(p.stiffness)}});
      draft.text.set("", "Start", "undeformed");
      draft.text.set("", "Gravity", "0, -" + number(p.gravity));
      draft.scene.kind = ReferenceKind::pendulum;
      draft.set_time(step_decades, 1.5, 4.);
      return draft.finish();
    }

    struct Family
    {
      const char *name;
      HuntScene (*make)(Draft);
    };

    constexpr Family all[] = {{"smooth masses", smooth_masses},
                              {"elastic stop", elastic_stop},
                              {"rigid stop", rigid_stop},
                              {"damped stop", damped_stop},
                              {"several links", several_links},
                              {"law", law},
                              {"adaptive steps", adaptive},
                              {"smooth wire", smooth_wire},
                              {"wire on elastic stop", wire_on_stop},
                              {"wire on rigid stop", wire_on_rigid_stop},
                              {"moving contact", moving_contact},
                              {"turning rope", turning_rope}};
  } // namespace

  const std::vector<std::string> &families()
  {
    static const std::vector<std::string> names = []
    {
      std::vector<std::string> result;
      for (const Family &family : all)
        result.emplace_back(family.name);
      return result;
    }();
    return names;
  }

  HuntScene make_scene(const std::uint64_t seed, const std::size_t number)
  {
    Random random(seed * 1000003 + number);
    const Family &family = all[number % families().size()];
    const Scales scales = draw_scales(random);
    HuntScene scene = family.make({random, scales});
    scene.family = family.name;
    return scene;
  }
} // namespace hunt
