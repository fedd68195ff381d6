// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: static states are those of string and beam theory. Sources: sums of forces (strings), beam
// theory (flexibilities L^3/(3 EI), F L^2/(16 EI), M L/(3 EI)), the heavy beam lifted from a floor:
// lifted length (24 EI h/q)^(1/4), end force and point reaction q l/2.
#include "scene_tests.h"

#include <taut/time/static_equilibrium.h>

using namespace verification;

namespace
{

  /// A wire of 30 m along x, one step of a run that stays at rest, and what changes that.
  std::string one_wire(const std::string &wire, const std::string &items)
  {
    return R"(Support ends: Wire = wire; Positions = 0, 30
Wire wire: To = 30, 0
Time: Scheme = backward Euler; Step = 1; End = 1
Wire wire: )" +
           wire + "\n" + items;
  }

  /// What the first state of a run shows.
  void at_rest(const std::string &scene, const Callback &callback)
  {
    run_scene(scene, {"Time.End=1e-3", "Time.Step=1e-3"},
              [&](const taut::StepView &view)
              {
                if (view.state.time == 0.)
                  callback(view);
              });
  }
} // namespace

TEST(String, sags_by_weight_over_eight_tensions)
{
  const double m = 1.35, T = 20000., L = 30.;
  double sag = 0.;
  run_scene(
      one_wire("Components = string; Mass per length = 1.35; Tension = 20000; Element size = 0.7",
               ""),
      {}, [&](const taut::StepView &view) { sag = -displacement(view, 0, .5 * L); });
  const double exact = m * g * L * L / (8. * T);
  figure("string, sag in the middle over m g L^2/(8 T) - 1", sag / exact - 1.);
  EXPECT_NEAR(sag, exact, 1e-12 * exact);
}

// Free length on each side sqrt(2 T d/(m g)); the end's pull shows it: T w'(0) = m g l.
TEST(String, lies_flat_on_a_floor_between_its_free_lengths)
{
  const double m = 1.35, T = 2000., L = 30., d = .1;
  const double exact = std::sqrt(2. * T * d / (m * g)); // 5.496 m
  double left = 0., right = 0., first = 0., last = 0., least = 0., resting = 0.;
  run_scene(
      one_wire("Components = string; Mass per length = 1.35; Tension = 2000; Element size = 0.1",
               "Link floor: Type = stop; To = wire @ 0:0.1:30; Direction = 0, 1; Gap = 0.1\n"),
      {},
      [&](const taut::StepView &view)
      {
        left = -T * displacement(view, 0, 0., {0., 0., 1.}, true) / (m * g);
        right = T * displacement(view, 0, L * (1. - 1e-12), {0., 0., 1.}, true) / (m * g);
        first = L;
        resting = 0.;
        for (std::size_t i = 0; i < view.constraints.size(); ++i)
        {
          const double x = view.scene.links[view.constraints[i].link].to.position;
          const double N = view.state.multiplier[i];
          least = std::min({least, N, view.state.complementarity_gap[i]});
          resting += N;
          if (N > 0.)
          {
            first = std::min(first, x);
            last = std::max(last, x);
          }
        }
      });
  figure("string over a floor, free length left, from the pull of its end", left, "m");
  figure("string over a floor, free length, exact", exact, "m");
  figure("string over a floor, first support that carries, spacing 0.1 m", first, "m");
  EXPECT_NEAR(left, exact, 1e-3 * exact);
  EXPECT_NEAR(right, exact, 1e-3 * exact);
  EXPECT_NEAR(first, exact, .1);
  EXPECT_NEAR(last, L - exact, .1);
  EXPECT_NEAR(resting, m * g * (L - left - right), 1e-9 * m * g * L);
  EXPECT_GE(least, -1e-12);
}

// A beam that only unilateral supports and one link at its end hold: its two rigid motions are
// unknowns. EI = 2e5 N m^2, 20 kg/m, lifted by 0.1 m. With the distance xi from the lift-off point,
// EI w = (q l/2) xi^3/6 - q xi^4/24.
TEST(Beam, heavy_beam_lifts_off_a_floor)
{
  const double EI = 2e5, q = 20. * g, h = .1, L = 12., spacing = .05;
  const double l = std::pow(24. * EI * h / q, .25), force = .5 * q * l;
  Session session(one_wire(
      "Components = beam; Mass per length = 20; Bending stiffness = 2e5; Element size = 0.05; To = "
      "12, 0",
      "Support ends: -\nNetwork: -Supports\nLink lift: Type = joint; To = wire @ 0; Direction = 0, "
      "1; Gap = -0.1\n"
      "Link floor: Type = stop; To = wire @ 0:" +
          number(spacing) + ":12; Direction = 0, 1\n"));
  const taut::Scene &scene = session.simulation().scene();
  const taut::SceneBodies &structure = session.simulation().structure();
  const taut::Constraints &constraints = session.simulation().constraints();
  const taut::StaticState state =
      static_equilibrium(structure, constraints, session.parameters().solver, 0.);
  EXPECT_EQ(structure[0].null_space().vectors.size(), 2u);

  double end_force = 0., error = 0., first = L, point_reaction = 0., least = 0., sum = 0.,
         unevenness = 0.;
  for (std::size_t i = 0; i < constraints.size(); ++i)
  {
    const double x = scene.links[constraints[i].link].to.position, N = state.multiplier[i];
    sum += N;
    if (constraints[i].name == "lift")
    {
      end_force = N;
      continue;
    }
    least = std::min({least, N, state.complementarity_gap[i]});
    if (N > 0.)
      first = std::min(first, x);
    // What the supports near the lift-off carry above their share of the weight.
    const double reach = l + 10.5 * spacing;
    if (x < reach)
      point_reaction += N;
    if (x < reach && x + spacing >= reach)
      point_reaction -= q * (x + .5 * spacing - l);
    if (x > l + 2. && x < L - 1.)
      raise(unevenness, N / (q * spacing) - 1.);
  }
  for (double x = 0.; x < L; x += .01)
  {
    const double xi = std::max(0., l - x),
                 w = force * xi * xi * xi / (6. * EI) - q * std::pow(xi, 4) / (24. * EI);
    std::vector<taut::Term> terms;
    structure.motion({taut::Attachment::Kind::wire, 0, x}, false, {0., 1.}, 1., terms);
    raise(error, evaluate(terms, state.displacement) - w);
  }
  figure("lifted beam, end force, exact q l/2", force, "N");
  figure("lifted beam, lifted length from the end force", 2. * end_force / q, "m");
  figure("lifted beam, lifted length, exact", l, "m");
  figure("lifted beam, first support that carries, spacing 0.05 m", first, "m");
  figure("lifted beam, point reaction at the lift-off", point_reaction, "N");
  figure("lifted beam, largest error of the displacement over the lift", error / h);
  figure("lifted beam, supports that lie flat, force over its share of the weight - 1", unevenness);
  figure("lifted beam, residual of the links", state.residuals.complementarity);
  EXPECT_NEAR(figure("lifted beam, end force", end_force, "N"), force, 1e-3 * force);
  EXPECT_LT(error, 1e-3 * h);
  EXPECT_NEAR(first, l, spacing);
  EXPECT_NEAR(point_reaction, force, 1e-3 * force);
  EXPECT_LT(unevenness, 1e-3) << "rigid supports 5 cm apart amplify the rounding of gaps";
  EXPECT_NEAR(sum, q * L, 1e-8 * q * L);
  EXPECT_GE(least, -1e-12);
}

// Both ends of a beam of 4 m sink by 10 mm, the stop in its middle stays: N = 48 EI d/L^3 = 7.5 N.
TEST(Beam, sunken_supports_bend_it_over_a_stop)
{
  const double EI = 1000., L = 4., d = .01;
  double force = 0., end = 0.;
  at_rest(
      one_wire("Components = beam; Mass per length = 2; Weight = false; Bending stiffness = 1000; "
               "Element size = 0.5; To = 4, 0",
               "Support ends: Positions = 0, 4; Displacement = -0.01\n"
               "Link stop: Type = stop; To = wire @ 2; Direction = 0, 1\n"),
      [&](const taut::StepView &view)
      {
        force = view.state.multiplier[0];
        end = displacement(view, 0, 0.);
      });
  const double exact = 48. * EI * d / (L * L * L);
  EXPECT_NEAR(figure("beam with sunken ends over a stop, force", force, "N"), exact, 1e-9 * exact);
  EXPECT_NEAR(end, -d, 1e-15);
}

// A load q sin(pi s/L) bends a simply supported tensioned beam by q sin(pi s/L)/(T k^2 + EI k^4),
// k = pi/L; a spring K under the middle of a string of flexibility L/(4 T) takes F/(1 + 4 T/(K L)).
TEST(Loads, distributed_load_and_elastic_support)
{
  const double T = 600., EI = 50., L = 30., k = std::acos(-1.) / L;
  double error = 0., largest = 0.;
  run_scene(one_wire("Components = beam; Mass per length = 2; Weight = false; Tension = 600; "
                     "Bending stiffness = 50; Element size = 1",
                     "Load load: Type = distributed; On = wire; Magnitude = 10*sin(pi*s/30)\n"),
            {},
            [&](const taut::StepView &view)
            {
              for (double s = 0.; s <= L; s += .5)
              {
                const double w = 10. * std::sin(k * s) / (T * k * k + EI * std::pow(k, 4));
                largest = std::max(largest, w);
                raise(error, displacement(view, 0, s) - w);
              }
            });
  figure("distributed load on a beam, largest error over the deflection", error / largest);
  EXPECT_LT(error, 1e-5 * largest);

  double down = 0.;
  run_scene(one_wire("Components = string; Mass per length = 2; Weight = false; Tension = 600; "
                     "Element size = 1",
                     R"(Support spring: Wire = wire; Positions = 15; Type = elastic; Stiffness = 70
Load load: Type = point; On = wire @ 15; Direction = 0, -1; Magnitude = 90
)"),
            {}, [&](const taut::StepView &view) { down = -displacement(view, 0, 15.); });
  figure("string on an elastic support, deflection", down, "m");
  EXPECT_NEAR(down, 90. / (70. + 4. * T / L), 1e-12);
}

// N = F s L^3/(3 EI)/(s^2 L^3/(3 EI) + c^2 L/EA + 1/k) = 0.48/0.0106036 = 45.2676 N; tip
// -(F - N s) L^3/(3 EI) across and -N c L/EA along the beam.
TEST(InclinedCable, force_and_tip_displacement_follow_from_flexibilities)
{
  const double s = .8, c = .6, F = 40., bend = 27. / 1800., stretch = 3. / 3e5, spring = 1e-3;
  const double N = F * s * bend / (s * s * bend + c * c * stretch + spring);
  EXPECT_NEAR(N, 45.2676, 5e-5);
  double force = 0., down = 0., along = 0.;
  at_rest(scene_file("inclined_cable"),
          [&](const taut::StepView &view)
          {
            force = view.state.multiplier[0];
            down = displacement(view, 0, 3.);
            along = displacement(view, 0, 3., {1., 0.});
          });
  figure("inclined cable, tip displacement across the beam", 1e3 * down, "mm");
  figure("inclined cable, tip displacement along the beam", 1e3 * along, "mm");
  EXPECT_NEAR(figure("inclined cable, force", force, "N"), N, 1e-6 * N);
  EXPECT_NEAR(down, -(F - N * s) * bend, 1e-9 * F * bend);
  EXPECT_NEAR(along, -N * c * stretch, 1e-9 * N * c * stretch);
}

// M = (F L^2/(16 EI) - 0.02) 3 EI/L = 22.5 N m, w = F L^3/(48 EI) - M L^2/(16 EI) = 44.1667 mm.
TEST(AngularStop, moment_and_deflection_follow_from_beam_theory)
{
  double moment = 0., down = 0., slope = 0.;
  at_rest(scene_file("beam_angular_stop"),
          [&](const taut::StepView &view)
          {
            moment = view.state.multiplier[0];
            down = displacement(view, 0, 2.);
            slope = displacement(view, 0, 0., {0., 0., 1.}, true);
          });
  figure("angular stop, deflection in the middle", -1e3 * down, "mm");
  EXPECT_NEAR(figure("angular stop, moment", moment, "N m"), 22.5, 1e-9);
  EXPECT_NEAR(-down, .0441666666666667, 1e-12);
  EXPECT_NEAR(figure("angular stop, slope at the stop", slope, "rad"), -.02, 1e-13);
}
