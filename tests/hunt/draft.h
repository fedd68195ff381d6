// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_draft_h
#define taut_hunt_draft_h

#include "scene_text.h"
#include "scenes.h"

namespace hunt
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

  struct Draft
  {
    Random &random;
    Scales scales;
    SceneText text = {};
    HuntScene scene = {};

    SceneText::Line line() { return text.line(); }
    std::string draw(const double unit, const double a, const double b)
    {
      return number(short_number(unit * random.uniform(a, b)));
    }
    std::string draw_decades(const double unit, const double a, const double b)
    {
      return number(short_number(unit * random.decades(a, b)));
    }

    /// With a step up to so many decades below its largest, and a duration in time scales.
    HuntScene finish(const double decades, const double least, const double most)
    {
      scene.step = short_number(scales.t * largest_step * random.decades(-decades, 0));
      const double duration = scales.t * random.uniform(least, most);
      scene.n_steps = std::max(8., std::round(duration / scene.step));
      line() << "Time: Step = " << scene.step << "; End = " << scene.n_steps * scene.step;
      line() << "Output: Field interval = 0";
      scene.text = text.text();
      return scene;
    }
  };

  /// A load on a point, constant or of one frequency.
  void add_load(Draft &draft, const std::string &on, double force);

  /// A stop under a point, or a dropper that holds it from falling.
  void add_stop(Draft &draft, const std::string &name, const std::string &on,
                const std::string &spring, bool is_stop = true);

  std::string elastic(Draft &draft); ///< a stiffness anywhere in the ten decades

  HuntScene smooth_wire(Draft draft);
  HuntScene wire_on_stop(Draft draft);
  HuntScene wire_on_rigid_stop(Draft draft);
  HuntScene moving_contact(Draft draft);
  HuntScene moving_support(Draft draft);
  HuntScene moving_strip(Draft draft);

  /// A sine of one frequency for a prescribed place.
  std::string given_place(Draft &draft);
} // namespace hunt

#endif
