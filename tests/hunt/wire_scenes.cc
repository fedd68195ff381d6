// SPDX-License-Identifier: LGPL-2.1-or-later
#include "draft.h"

namespace hunt
{
  namespace
  {
    /// A wire of few elements along x; waves cross it in about the time scale.
    double add_wire(Draft &draft, const std::string &kind, const bool moves = true)
    {
      const Scales &s = draft.scales;
      const double length = short_number(100. * s.l), mu = short_number(s.m / length),
                   tension = short_number(mu * length * length / (s.t * s.t));
      const int n = draft.random.integer(4, 8);
      draft.line() << "Gravity = 0, 0";
      draft.line() << "Wire wire: From = 0, 0; To = " << length << ", 0; Components = " << kind
                   << "; Mass per length = " << mu << "; Element size = " << length / n;
      if (kind == "bar")
        draft.line() << "Wire wire: Axial stiffness = " << tension;
      if (kind == "string" || (kind == "beam" && draft.random.chance(.5)))
        draft.line() << "Wire wire: Tension = " << tension;
      if (kind == "beam")
        draft.line() << "Wire wire: Bending stiffness = "
                     << draft.draw_decades(tension * length * length, -3, -1);
      else
        draft.line() << "Wire wire: Degree = " << draft.random.integer(1, 2);
      if (draft.random.chance(.4))
        draft.line() << "Wire wire: Mass damping = " << draft.draw(1. / s.t, .01, .5);
      if (moves)
        draft.line() << "Start = given\nWire wire: Initial "
                     << (kind == "bar" ? "axial" : "transverse") << " velocity = -"
                     << draft.draw(s.v(), .5, 2.)
                     << (kind == "bar" ? "" : "*sin(pi*s/" + number(length) + ")");
      if (kind != "bar")
        draft.line() << "Support ends: Wire = wire; Positions = 0, " << length;
      return length;
    }

    std::string kind_of_wire(Draft &draft)
    {
      return draft.random.chance(.5) ? "string" : "beam";
    }
  } // namespace

  HuntScene smooth_wire(Draft draft)
  {
    const bool moves = draft.random.chance(.5);
    const double length = add_wire(draft, kind_of_wire(draft), moves);
    add_load(draft, "wire @ " + number(short_number(.3 * length)), 10. * draft.scales.f());
    if (!moves)
    {
      draft.line() << "Mass weight: Position = " << .5 * length
                   << ", 0; Motions = y; Mass = " << draft.draw_decades(draft.scales.m, -1, 1);
      draft.line() << "Link hanger: Type = joint; From = weight; To = wire @ " << .5 * length
                   << "; Direction = 0, 1";
      draft.line() << "Start = undeformed";
    }
    return draft.finish(step_decades_of_wires, 1., 2.5);
  }

  HuntScene wire_on_stop(Draft draft)
  {
    const double length = add_wire(draft, kind_of_wire(draft));
    add_stop(draft, "stop", "wire @ " + number(.5 * length), elastic(draft),
             draft.random.chance(.6));
    return draft.finish(step_decades_of_wires, 1., 2.5);
  }

  HuntScene wire_on_rigid_stop(Draft draft)
  {
    const int kind = draft.random.integer(0, 2);
    const double length = add_wire(draft, kind == 0 ? "bar" : kind == 1 ? "string" : "beam");
    if (kind == 0)
      draft.line()
          << "Link wall: Type = stop; From = ground; To = wire @ 0; Direction = 1, 0; Gap = "
          << draft.draw(draft.scales.l, .05, .5);
    else
      add_stop(draft, "stop", "wire @ " + number(.5 * length), "");
    return draft.finish(step_decades_of_wires, 1., 2.5);
  }

  /// A mass that is pushed against a wire and moves along it.
  HuntScene moving_contact(Draft draft)
  {
    const Scales &s = draft.scales;
    const double length = add_wire(draft, "beam", false);
    draft.line() << "Mass head: Position = " << .2 * length << ", " << -s.l
                 << "; Motions = y; Mass = " << draft.draw_decades(s.m, -1, 0);
    draft.line() << "Load lift: On = head; Direction = 0, 1; Magnitude = "
                 << draft.draw(s.f(), 1, 5);
    draft.line() << "Link collector: Type = sliding contact; From = head; To = wire @ "
                 << .2 * length << "; Direction = 0, 1; Faster than waves = true; Speed = "
                 << short_number(.2 * length / s.t);
    if (draft.random.chance(.7))
      draft.line() << "Link collector: Stiffness = " << draft.draw_decades(s.k(), 0, 5);
    draft.line() << "Statistics: Filter frequency = 0";
    draft.scene.kind = ReferenceKind::program;
    return draft.finish(2., 1., 2.5);
  }

  /// A mass that is pushed against two wires side by side and moves along them.
  HuntScene moving_strip(Draft draft)
  {
    const Scales &s = draft.scales;
    const double length = short_number(100. * s.l), mu = s.m / length,
                 tension = mu * length * length / (s.t * s.t);
    draft.line() << "Gravity = 0, 0";
    for (const std::string &wire : {std::string("one"), std::string("two")})
    {
      const double z = wire == "one" ? 0. : s.l;
      draft.line() << "Wire " << wire << ": From = 0, 0, " << z << "; To = " << length << ", 0, "
                   << z << "; Components = beam; Mass per length = " << draft.draw(mu, .5, 2.)
                   << "; Tension = " << draft.draw(tension, .5, 2.) << "; Bending stiffness = "
                   << draft.draw_decades(tension * length * length, -3, -1)
                   << "; Element size = " << length / draft.random.integer(4, 8);
      draft.line() << "Support ends " << wire << ": Wire = " << wire << "; Positions = 0, "
                   << length;
    }
    draft.line() << "Mass head: Position = " << .2 * length << ", " << -s.l
                 << "; Motions = y; Mass = " << draft.draw_decades(s.m, -1, 0);
    draft.line() << "Load lift: On = head; Direction = 0, 1; Magnitude = "
                 << draft.draw(s.f(), 1, 5);
    draft.line() << "Link collector: Type = sliding contact; From = head; To = one @ "
                 << .2 * length << ", two @ " << .2 * length
                 << "; Direction = 0, 1; Faster than waves = true; Speed = "
                 << short_number(.2 * length / s.t);
    if (draft.random.chance(.7))
      draft.line() << "Link collector: Stiffness = " << draft.draw_decades(s.k(), 0, 5);
    draft.line() << "Statistics: Filter frequency = 0";
    draft.scene.kind = ReferenceKind::program;
    return draft.finish(2., 1., 2.5);
  }

  /// A wire whose end is moved, over a stop or free.
  HuntScene moving_support(Draft draft)
  {
    const double length = add_wire(draft, kind_of_wire(draft), false);
    draft.line() << "Support ends: Positions = 0";
    draft.line() << "Support hand: Wire = wire; Positions = " << length
                 << "; Displacement = " << given_place(draft);
    if (draft.random.chance(.5))
      add_stop(draft, "stop", "wire @ " + number(.5 * length), elastic(draft));
    draft.line() << "Start = given";
    return draft.finish(step_decades_of_wires, 1., 2.5);
  }
} // namespace hunt
