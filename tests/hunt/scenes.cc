// SPDX-License-Identifier: LGPL-2.1-or-later
#include "draft.h"

namespace hunt
{
  void add_load(Draft &draft, const std::string &on, const double force)
  {
    const double frequency = short_number(draft.random.uniform(.5, 8.) / draft.scales.t);
    const bool varies = draft.random.chance(.5);
    if (varies)
      draft.scene.frequency = frequency;
    draft.line() << "Load push: On = " << on
                 << "; Direction = 0, 1; Magnitude = " << draft.draw(force, -1., 1.)
                 << (varies ? "*sin(" + number(frequency) + "*t)" : "");
  }

  void add_stop(Draft &draft, const std::string &name, const std::string &on,
                const std::string &spring, const bool is_stop)
  {
    draft.line() << "Link " << name << ": Type = " << (is_stop ? "stop" : "dropper")
                 << "; From = ground; To = " << on << "; Direction = 0, " << (is_stop ? "1" : "-1")
                 << "; Gap = " << draft.draw(draft.scales.l, .05, 1.) << "; " << spring;
    draft.scene.reach = 20. * draft.scales.l;
  }

  std::string given_place(Draft &draft)
  {
    const double frequency = short_number(draft.random.uniform(.5, 8.) / draft.scales.t);
    draft.scene.frequency = frequency;
    draft.scene.is_driven = true;
    return draft.draw(draft.scales.l, -1., 1.) + "*sin(" + number(frequency) + "*t)";
  }

  std::string elastic(Draft &draft)
  {
    return "Stiffness = " + draft.draw_decades(draft.scales.k(), softest, stiffest);
  }

  namespace
  {
    /// Masses one above the other, the first at the bottom, on springs between them; it falls.
    void add_chain(Draft &draft, const int n, const bool held, const bool alike = false)
    {
      const Scales &s = draft.scales;
      const double common = -draft.random.uniform(.5, 2.);
      for (int i = 0; i < n; ++i)
      {
        const std::string name = "m" + std::to_string(i);
        const double own = i == 0 ? common : draft.random.uniform(-2., 1.),
                     speed = alike ? common : own;
        draft.line() << "Mass " << name << ": Position = 0, " << 10. * i * s.l
                     << "; Motions = y; Mass = " << draft.draw_decades(s.m, -.5, .5)
                     << "; Initial velocity = 0, " << short_number(speed * s.v()) << ", 0";
        if (i == 0 && !held)
          continue;
        const std::string spring = "Spring s" + std::to_string(i);
        draft.line() << spring << ": From = " << (i == 0 ? "ground" : "m" + std::to_string(i - 1))
                     << "; To = " << name << "; Stiffness = " << draft.draw_decades(s.k(), -1, 1.3);
        if (draft.random.chance(.4))
          draft.line() << spring << ": Damping = " << draft.draw_decades(s.m / s.t, -2, 0);
      }
      const bool falls = draft.random.chance(.5);
      draft.line() << "Start = given; Gravity = 0, "
                   << (falls ? "-" + draft.draw(s.g(), .2, 2.) : std::string("0"));
    }

    HuntScene smooth_masses(Draft draft)
    {
      const int n = draft.random.integer(1, 4);
      const bool rigid = draft.random.chance(.5); // the ends then move alike at the start
      add_chain(draft, n, true, rigid);
      add_load(draft, "m0", draft.scales.f());
      if (n > 1 && draft.random.chance(.7))
      {
        draft.line() << "Link tie: Type = joint; From = m0; To = m" << n - 1
                     << "; Direction = 0, 1";
        if (!rigid)
          draft.line() << "Link tie: Stiffness = "
                       << draft.draw_decades(draft.scales.k(), softest, 4);
      }
      return draft.finish(step_decades, 1.5, 4.);
    }

    HuntScene elastic_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", elastic(draft));
      return draft.finish(step_decades, 1.5, 4.);
    }

    HuntScene rigid_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", "", draft.random.chance(.7));
      if (draft.random.chance(.5))
      {
        draft.scene.restitution = short_number(draft.random.uniform(.1, 1.));
        draft.line() << "Time/Moreau-Jean: Restitution = " << draft.scene.restitution;
      }
      return draft.finish(step_decades, 1.5, 4.);
    }

    HuntScene damped_stop(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 2), draft.random.chance(.5));
      const double k = short_number(draft.scales.k() * draft.random.decades(softest, stiffest)),
                   critical = 2. * std::sqrt(k * draft.scales.m);
      add_stop(draft, "floor", "m0",
               "Stiffness = " + number(k) + "; Damping = " + draft.draw_decades(critical, -2, .5));
      return draft.finish(step_decades, 1.5, 4.);
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
                 "m" + std::to_string(draft.random.integer(0, n - 1)), rigid ? "" : elastic(draft),
                 draft.random.chance(.7));
      }
      if (draft.random.chance(.5))
        draft.line() << "Link between: Type = stop; From = m0; To = m1; Direction = 0, 1; "
                     << elastic(draft) << "; Gap = " << draft.draw(draft.scales.l, .05, 1.);
      return draft.finish(step_decades, 1.5, 4.);
    }

    /// A stop with a law of up to so many decades of stiffness and steps, with more words behind
    /// it.
    HuntScene stop_with_law(Draft draft, const std::string &more, const double most_decades,
                            const double decades)
    {
      const Scales &s = draft.scales;
      add_chain(draft, draft.random.integer(1, 2), draft.random.chance(.5));
      const double k = s.k() * draft.random.decades(-1, most_decades),
                   u = s.l / std::sqrt(k / s.k());
      if (draft.random.chance(.5))
      {
        const double f1 = .3 * k * u, f2 = f1 + .7 * u * k * draft.random.decades(-1, 1.5);
        add_stop(draft, "floor", "m0",
                 "Law = table; Law points = " + number(short_number(.3 * u)) + ": " +
                     number(short_number(f1)) + ", " + number(short_number(u)) + ": " +
                     number(short_number(f2)) + more);
      }
      else
        add_stop(draft, "floor", "m0",
                 "Law = formula; Law formula = " + number(short_number(k)) + "*d + " +
                     number(short_number(k / (u * u))) +
                     "*d^3; Law range = " + number(short_number(10. * u)) + more);
      return draft.finish(decades, 1.5, 4.);
    }

    HuntScene law(Draft draft)
    {
      return stop_with_law(draft, "", 6., step_decades);
    }

    HuntScene law_with_damper(Draft draft)
    {
      const Scales &s = draft.scales;
      draft.scene.kind = ReferenceKind::program;
      const std::string damper = "; Damping = " + draft.draw_decades(std::sqrt(s.k() * s.m), -2, 1);
      return stop_with_law(draft, damper, 3., 2.);
    }

    HuntScene adaptive(Draft draft)
    {
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      add_stop(draft, "floor", "m0", draft.random.chance(.3) ? "" : elastic(draft));
      draft.line() << "Time: Step control = adaptive";
      return draft.finish(step_decades - 1., 1.5, 4.);
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
      draft.line() << "Mass bob: Position = " << p.start[0] << ", " << p.start[1]
                   << "; Motions = x, y; Mass = " << p.mass;
      draft.line()
          << "Link rope: Type = dropper; From = ground @ 0, 0; To = bob; Turns = true; Length = "
          << p.length << "; Stiffness = " << p.stiffness;
      draft.line() << "Start = undeformed; Gravity = 0, -" << p.gravity;
      draft.scene.kind = ReferenceKind::pendulum;
      return draft.finish(step_decades, 1.5, 4.);
    }

    /// Masses that turn about one axis, on torsional springs and stops; numbers as of add_chain().
    HuntScene torsional_stop(Draft draft)
    {
      const Scales &s = draft.scales;
      const int n = draft.random.integer(1, 3);
      const double common = -draft.random.uniform(.5, 2.);
      for (int i = 0; i < n; ++i)
      {
        const std::string name = "m" + std::to_string(i);
        const double speed = i == 0 ? common : draft.random.uniform(-2., 1.);
        draft.line() << "Mass " << name << ": Position = 0, " << 10. * i
                     << "; Motions = rotation; Mass = 1; Inertia = "
                     << draft.draw_decades(s.m, -.5, .5) << "; Initial velocity = 0, 0, "
                     << short_number(speed * s.v());
        draft.line() << "Spring s" << std::to_string(i) << ": Rotational = true; From = "
                     << (i == 0 ? "ground" : "m" + std::to_string(i - 1)) << "; To = " << name
                     << "; Stiffness = " << draft.draw_decades(s.k(), -1, 1.3);
      }
      draft.line() << "Link stop: Type = stop; Rotational = true; From = ground; To = m0; Gap = "
                   << draft.draw(s.l, .05, 1.) << "; "
                   << (draft.random.chance(.3) ? "" : elastic(draft));
      draft.scene.reach = 20. * s.l;
      draft.line() << "Start = given; Gravity = 0, 0";
      return draft.finish(step_decades, 1.5, 4.);
    }

    HuntScene moving_base(Draft draft)
    {
      const Scales &s = draft.scales;
      add_chain(draft, draft.random.integer(1, 3), false);
      draft.line() << "Mass base: Position = 0, " << -10. * s.l
                   << "; Motions = x; Mass = 1e-3; Prescribed y = " << given_place(draft);
      draft.line() << "Spring bearing: From = base; To = m0; Stiffness = "
                   << draft.draw_decades(s.k(), -1, 1.3);
      if (draft.random.chance(.4))
        draft.line() << "Spring bearing: Damping = " << draft.draw_decades(s.m / s.t, -2, 0);
      if (draft.random.chance(.7))
        add_stop(draft, "floor", "m0", draft.random.chance(.3) ? "" : elastic(draft));
      if (draft.random.chance(.2))
        draft.line() << "Time: Step control = adaptive";
      return draft.finish(step_decades, 1.5, 4.);
    }

    /// A pulse of any width from a ten thousandth of the longest motion on: narrower ones may be
    /// missed.
    HuntScene narrow_pulse(Draft draft)
    {
      const Scales &s = draft.scales;
      add_chain(draft, draft.random.integer(1, 3), draft.random.chance(.5));
      if (draft.random.chance(.5))
        add_stop(draft, "floor", "m0", draft.random.chance(.3) ? "" : elastic(draft));
      Pulse &pulse = draft.scene.pulse;
      pulse.begin = short_number(s.t * draft.random.uniform(.1, 1.2));
      pulse.width = short_number(s.t * draft.random.decades(-3.4, 0));
      draft.line() << "Load pulse: On = m0; Direction = 0, 1; Magnitude = "
                   << short_number(s.m * s.v() / pulse.width * draft.random.uniform(-3., 3.))
                   << "*max(0, 1-abs(t-" << number(pulse.begin + .5 * pulse.width) << ")*"
                   << number(pulse.rise()) << ")";
      return draft.finish(step_decades, 1.5, 4.);
    }

    using Family = std::pair<const char *, HuntScene (*)(Draft)>;

    const std::vector<Family> of_given = {{"torsional stop", torsional_stop},
                                          {"moving base", moving_base},
                                          {"moving support", moving_support},
                                          {"narrow pulse", narrow_pulse}};

    const std::vector<Family> of_compound = {{"law with damper", law_with_damper},
                                             {"moving strip", moving_strip}};

    const std::vector<Family> of_contacts = {{"smooth masses", smooth_masses},
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

  namespace
  {
    const std::vector<Family> &families_of(const Field field)
    {
      return field == Field::contacts ? of_contacts
             : field == Field::given  ? of_given
                                      : of_compound;
    }
  } // namespace

  std::vector<std::string> families(const Field field)
  {
    std::vector<std::string> names;
    for (const Family &family : families_of(field))
      names.emplace_back(family.first);
    return names;
  }

  HuntScene make_scene(const std::uint64_t seed, const std::size_t number, const Field field)
  {
    Random random(seed * 1000003 + number);
    const std::vector<Family> &all = families_of(field);
    const auto &[name, make] = all[number % all.size()];
    const Scales scales = {short_number(random.decades(-2, 2)), short_number(random.decades(-2, 1)),
                           short_number(random.decades(-3, 1))};
    HuntScene scene = make({random, scales});
    scene.family = name;
    return scene;
  }
} // namespace hunt
