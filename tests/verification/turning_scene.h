// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_turning_scene_h
#define taut_verification_turning_scene_h

#include "scene_tests.h"

#include "mechanism/mechanism.h"

/// Point masses in space and links between them that turn.
namespace turning
{
  using taut::Coordinates;
  using verification::g, verification::pi, verification::has, verification::number,
      verification::operator+, verification::Overrides;

  /// What a step ends with.
  struct Motion
  {
    double time = 0.;
    std::vector<Coordinates> place, velocity; ///< of the masses
    std::vector<double> multiplier, gap;      ///< of the links
    double energy = 0.;                       ///< of motion, weight and springs
    Coordinates momentum, moment_of_momentum; ///< the latter about the origin
  };

  inline std::string text(const Coordinates &c)
  {
    return number(c.x) + ", " + number(c.y) + ", " + number(c.z);
  }

  /// A link of a rope of a given length.
  inline std::string rope(const std::string &from, const std::string &to, const double length)
  {
    return "Type = dropper; From = " + from + "; To = " + to + "; Length = " + number(length);
  }

  struct Mass
  {
    double mass;
    Coordinates place, velocity;
  };

  struct Scene
  {
    std::vector<Mass> masses;       ///< m0, m1, ...
    std::vector<std::string> links; ///< entries of each but 'Turns'
    Coordinates gravity = {0., -g, 0.};
    std::string start = "equilibrium";
    double step = 1e-3, end = 0.;

    std::string parameters() const
    {
      std::ostringstream out;
      out << "Gravity = " << text(gravity) << "; Start = " << start
          << "\nTime: Step = " << number(step) << "; End = " << number(end) << "\n";
      for (std::size_t i = 0; i < masses.size(); ++i)
      {
        const Coordinates &v = masses[i].velocity;
        out << "Mass m" << i << ": Position = " << text(masses[i].place)
            << "; Mass = " << number(masses[i].mass)
            << "; Motions = x, y, z; Initial velocity = " << number(v.x) << ", " << number(v.y)
            << ", 0, " << number(v.z) << "\n";
      }
      for (std::size_t i = 0; i < links.size(); ++i)
        out << "Link l" << i << ": Turns = true; " << links[i] << "\n";
      return out.str();
    }

    Motion motion(const taut::StepView &view) const
    {
      Motion result;
      result.time = view.state.time;
      for (std::size_t i = 0; i < masses.size(); ++i)
      {
        double u[3], v[3];
        for (unsigned int c = 0; c < 3; ++c)
        {
          const auto terms = verification::point_of_mass(
              view, i, {c == 0 ? 1. : 0., c == 1 ? 1. : 0., c == 2 ? 1. : 0.});
          u[c] = verification::displacement(view, terms);
          v[c] = evaluate(terms, view.state.V);
        }
        const Coordinates x = add_scaled(masses[i].place, 1., {u[0], u[1], u[2]}),
                          rate = {v[0], v[1], v[2]};
        const double m = masses[i].mass;
        result.place.push_back(x);
        result.velocity.push_back(rate);
        result.energy += .5 * m * dot(rate, rate) - m * dot(gravity, x);
        result.momentum = add_scaled(result.momentum, m, rate);
        result.moment_of_momentum = add_scaled(result.moment_of_momentum, m, cross(x, rate));
      }
      for (std::size_t i = 0; i < links.size(); ++i)
      {
        const std::size_t row = view.constraints.index_of_link(i);
        result.multiplier.push_back(view.state.multiplier[row]);
        result.gap.push_back(view.state.distance[row]);
        result.energy += view.constraints[row].spring.energy(view.state.springs[row].u);
      }
      return result;
    }

    void run(const std::function<void(const Motion &)> &callback,
             const Overrides &overrides = {}) const
    {
      verification::run_scene(parameters(), overrides,
                              [&](const taut::StepView &view) { callback(motion(view)); });
    }
  };

  /// Masses that start with their velocities.
  inline Scene thrown(const std::vector<Mass> &masses, const std::vector<std::string> &links,
                      const double end, const double step = 1e-3,
                      const Coordinates &gravity = {0., -g, 0.})
  {
    return {masses, links, gravity, "given", step, end};
  }

  const Coordinates weightless = {0., 0., 0.};
} // namespace turning

#endif
