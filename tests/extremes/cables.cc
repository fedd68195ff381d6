// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables are right, or end in one error with its reason, whatever their numbers: taut ones
// and ones of twenty times their span, EA 1e12 times the weight, ropes and springs, one element and
// 256, steep and upside down; moving, they turn around several times, fly freely, go slack and snap
// without energy or momentum from nowhere. Source: catenaries, twins in other units, conservation.
#include "cable/elastic_catenary.h"
#include "common.h"
#include "levels.h"
#include "one_body.h"

#include "base/dot.h"
#include <taut/cable/cable.h>

using verification::pi;

using namespace extremes;

namespace
{
  using namespace taut;

  constexpr double largest_part_of_errors = .05;
  /// What Newton's method leaves of energies and momenta in a step, of the largest.
  constexpr double of_energy = 1e-6;
  constexpr double bar = -1.; ///< instead of EI

  unsigned int n_scenes = 0, n_errors = 0;

  void refused(const Levels &level, const std::string &message)
  {
    ++n_errors;
    std::printf("no answer | %s | %s\n", level.name().c_str(), message.c_str());
  }

  /// Metres, kilograms and seconds in which one unit of the twin is expressed.
  struct Units
  {
    double length, mass;
  };

  CableData in_units(CableData data, const Units &unit)
  {
    const double L = unit.length, m = unit.mass;
    data.to = add_scaled({}, 1. / L, data.to);
    data.gravity = add_scaled({}, 1. / L, data.gravity);
    data.length /= L;
    data.section.axial_stiffness /= m * L;
    data.section.bending_stiffness /= m * L * L * L;
    data.section.mass_per_length *= L / m;
    data.section.axial_damping /= m * L;
    return data;
  }

  /// Relative to the weight w L of the cable.
  const std::vector<Dimension> shapes = {
      {"length over distance", {.9995, 1., 1.0001, 1.05, 2., 20.}},
      {"EA over weight", {3e2, 1e4, 1e7}},
      {"EI over weight L^2", {bar, 0., 1e-9, 1e-3, .01}},
      {"elements", {2, 4, 16, 256}},
      {"slope", {0., 1., -30.}},
      {"sideways", {0., 1.}},
      {"distance", {1e-4, 1., 1e5}},
      {"mass per length", {1e-6, 1., 1e5}},
      {"gravity", {1e-6, 9.81}}};

  void set_bending(const double EI, const double w, CableData &data)
  {
    data.element = EI == bar ? CableElement::bar : CableElement::ancf;
    if (EI != bar)
      data.section.bending_stiffness = EI * w * std::pow(data.length, 3);
  }

  CableData make_shape(const Levels &level)
  {
    CableData data;
    data.name = "cable";
    const double slope = level["slope"], distance = level["distance"],
                 part = distance / std::hypot(std::hypot(1., slope), level["sideways"]);
    data.to = {part, part * slope, part * level["sideways"]};
    data.length = distance * level["length over distance"];
    const double w = level["mass per length"] * level["gravity"];
    data.section.mass_per_length = level["mass per length"];
    data.section.axial_stiffness = w * data.length * level["EA over weight"];
    set_bending(level["EI over weight L^2"], w, data);
    data.gravity = {0., -level["gravity"], 0.};
    data.n_elements = static_cast<unsigned int>(level["elements"]);
    data.largest_strain = .3; // two elements of a cable of twenty times its span
    return data;
  }

  /// Of the middle, from the first end.
  Coordinates middle(const CableData &data)
  {
    const Cable cable(data);
    return cable.elements().position(cable.shape().positions, .5 * data.length);
  }

  /// As a part of the length: interpolation of a catenary that falls or rises steeply at its ends.
  double tolerance(const CableData &data)
  {
    return data.n_elements >= 256 ? 3e-4 : data.n_elements >= 16 ? 2e-2 : 1.;
  }

  /// A cable that moves from its shape, turned about the x axis, spinning about its first end.
  class SpinningCable : public Cable
  {
  public:
    SpinningCable(const CableData &data, const double angle, const Coordinates &spin)
        : Cable(data), angle(angle), spin(spin)
    {
    }
    void initial_state(std::vector<double> &U, std::vector<double> &V) const override
    {
      U = shape().positions;
      V.resize(U.size());
      for (std::size_t i = 0; i < U.size(); i += 3)
      {
        const Coordinates r = {U[i], std::cos(angle) * U[i + 1] - std::sin(angle) * U[i + 2],
                               std::sin(angle) * U[i + 1] + std::cos(angle) * U[i + 2]},
                          v = cross(spin, r);
        for (int c = 0; c < 3; ++c)
        {
          U[i + c] = r[c] - shape().positions[i + c];
          V[i + c] = v[c];
        }
      }
      for (const ConstrainedDof &constraint : constraints())
        U[constraint.dof] = V[constraint.dof] = 0.;
    }

  private:
    double angle;
    Coordinates spin;
  };

  struct Balance
  {
    double energy = 0.;
    Coordinates momentum;
  };

  Balance balance(const Cable &cable, const std::vector<double> &U, const std::vector<double> &V)
  {
    Balance result;
    const std::vector<double> MV = verification::matrix_times(cable.mass(), V);
    std::vector<double> P;
    cable.external_force(0., P);
    result.energy = .5 * taut::dot(V, MV) + cable.strain_energy(U) - taut::dot(P, U);
    // Rigid translations move positions and no slopes.
    const bool is_bar = cable.elements().element() == CableElement::bar;
    for (std::size_t i = 0; i < U.size(); i += is_bar ? 3 : 6)
      result.momentum = add_scaled(result.momentum, 1., {MV[i], MV[i + 1], MV[i + 2]});
    return result;
  }

  const std::vector<Dimension> motions = {{"length over distance", {1., 1.25, 3.}},
                                          {"EA over weight", {1e3, 1e5, 1e6}},
                                          {"EI over weight L^2", {bar, 0., 1e-8, 1e-3, .03}},
                                          {"elements", {2, 8, 32}},
                                          {"ends", {2, 1, 0}},        // held
                                          {"turned", {0., .5, 1.}},   // half turns
                                          {"spin", {0., 1., 10.}},    // of a pendulum's frequency
                                          {"step", {1e-3, 1e-2, .1}}, // of its period over 2 pi
                                          {"damping", {0., 1e-3}}, // time of axial damping over it
                                          {"scheme", {0, 1}},
                                          {"length", {1e-3, 1., 1e3}}};

  void run_motion(const Levels &level)
  {
    SCOPED_TRACE(level.name());
    const double L = level["length"], g = 9.81, time = std::sqrt(L / g), w = g;
    CableData data;
    data.name = "cable";
    data.to = {L / level["length over distance"], 0., 0.};
    data.length = L;
    data.section.mass_per_length = 1.;
    data.section.axial_stiffness = w * L * level["EA over weight"];
    set_bending(level["EI over weight L^2"], w, data);
    data.section.axial_damping = data.section.axial_stiffness * level["damping"] * time;
    data.gravity = {0., -g, 0.};
    data.n_elements = static_cast<unsigned int>(level["elements"]);
    data.holds_from = level["ends"] >= 1.;
    data.holds_to = level["ends"] >= 2.;
    const bool is_free = level["ends"] == 0., is_euler = level["scheme"] == 1.,
               conserves = !is_euler && level["damping"] == 0.;
    constexpr int n_steps = 60;
    ++n_scenes;
    try
    {
      const verification::OneBody<SpinningCable> one("cable", data, pi * level["turned"],
                                                     Coordinates{0., 0., level["spin"] / time});
      const SpinningCable *const cable = one.body;
      StepperOptions options = verification::steps_of(level["step"] * time, Start::given,
                                                      is_euler ? "backward Euler" : "automatic");
      options.allow_unsuitable_scheme = true;
      Stepper stepper(one.system, options);
      std::vector<double> U, V;
      cable->initial_state(U, V);
      const Balance start = balance(*cable, U, V);
      const double kinetic = .5 * taut::dot(V, verification::matrix_times(cable->mass(), V)),
                   scale = w * L * L + kinetic + cable->strain_energy(U),
                   of_momentum = std::sqrt(scale * L);
      double before = start.energy, known = 0.;
      for (int k = 1; k <= n_steps; ++k)
      {
        stepper.advance();
        const Balance now = balance(*cable, stepper.displacement(0), stepper.state().V[0]);
        ASSERT_TRUE(std::isfinite(now.energy));
        // Backward Euler may gain some where the energy of a cable is not convex, and says it.
        EXPECT_LE(now.energy - before,
                  of_energy * scale + stepper.measures().summary().motion_energy - known)
            << "energy from nowhere, step " << k;
        EXPECT_TRUE(!conserves || now.energy - start.energy >= -n_steps * of_energy * scale)
            << "energy lost, step " << k;
        before = now.energy;
        known = stepper.measures().summary().motion_energy;
        if (!is_free)
          continue;
        const double t = stepper.time();
        EXPECT_NEAR(now.momentum.x, start.momentum.x, k * of_energy * of_momentum);
        EXPECT_NEAR(now.momentum.y, start.momentum.y - w * L * t,
                    k * of_energy * (of_momentum + w * L * t));
        EXPECT_NEAR(now.momentum.z, start.momentum.z, k * of_energy * of_momentum);
      }
    }
    catch (const UserError &e)
    {
      refused(level, e.what());
    }
  }

  unsigned int n_seeds()
  {
    const char *const n = std::getenv("TAUT_EXTREMES_CABLES");
    return n == nullptr ? 1 : static_cast<unsigned int>(std::atoi(n));
  }

  void check_errors()
  {
    std::printf("figure | scenes of cables, and those without an answer | %u, %u\n", n_scenes,
                n_errors);
    EXPECT_LE(n_errors, largest_part_of_errors * n_scenes);
    n_scenes = n_errors = 0;
  }
} // namespace

TEST(ExtremeCables, hang_like_catenaries)
{
  double deviation = 0., of_twin = 0.;
  for (unsigned int seed = 1; seed <= n_seeds(); ++seed)
    cover(shapes, seed,
          [&](const Levels &level)
          {
            SCOPED_TRACE(level.name());
            ++n_scenes;
            const CableData data = make_shape(level);
            try
            {
              const Coordinates ours = middle(data);
              const double L = data.length;
              for (const Units &unit : {Units{1e-3, 1e3}, Units{.3048, .4536}})
              {
                const Coordinates twin = middle(in_units(data, unit));
                const double d = norm(add_scaled(ours, -unit.length, twin)) / L;
                EXPECT_LE(d, 1e-7) << "a twin in units of " << unit.length << " m";
                of_twin = std::max(of_twin, d);
              }
              if (level["EI over weight L^2"] > 1e-8)
                return;
              const ElasticCatenary exact({}, data.to, force_per_length(data),
                                          data.section.axial_stiffness, L);
              ASSERT_LE(exact.error, 1e-9 * L);
              const double d = norm(ours - exact.position(.5 * L)) / L;
              EXPECT_LE(d, tolerance(data));
              deviation = std::max(deviation, d / tolerance(data));
            }
            catch (const UserError &e)
            {
              refused(level, e.what());
            }
          });
  std::printf("figure | cables against catenaries, of the tolerance | %.2g\n", deviation);
  std::printf("figure | cables in other units | %.1e of the length\n", of_twin);
  check_errors();
}

TEST(ExtremeCables, move_without_energy_or_momentum_from_nowhere)
{
  for (unsigned int seed = 1; seed <= n_seeds(); ++seed)
    cover(motions, seed, run_motion);
  check_errors();
}
