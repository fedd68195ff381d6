// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: more elastic links than are looked at one by one with each other are judged as few are:
// those of bodies that nothing connects for themselves, those of one mass by their sum.
// Source: a mass m on a stop k has the ratio k step^2 / (3.9 m), as generalised-alpha with spectral
// radius 0.8 has M / (beta' step^2) in the matrix of a step; n stops side by side are one of n k.
#include "scene_tests.h"

#include "model/scene_constraints.h"
#include "time/choose_scheme.h"

using namespace verification;

namespace
{
  constexpr double step = 1e-3;

  /// Masses of 1 kg, each with stops of a stiffness below.
  taut::Scene masses_on_stops(const int n_masses, const int n_stops, const double stiffness)
  {
    taut::Scene scene;
    scene.gravity = {0., -9.81};
    scene.start = taut::Start::given;
    for (int i = 0; i < n_masses; ++i)
    {
      scene.masses.emplace_back();
      taut::Mass &mass = scene.masses.back();
      mass.name = "mass " + std::to_string(i);
      mass.position = {double(i), .05};
      mass.mass = 1.;
    }
    for (int i = 0; i < n_masses * n_stops; ++i)
    {
      taut::Link link;
      link.name = "stop " + std::to_string(i);
      link.kind = taut::LinkKind::stop;
      link.to = {taut::Attachment::Kind::mass, static_cast<std::size_t>(i / n_stops), 0.};
      link.direction = {0., 1.};
      link.gap = .05;
      link.stiffness = stiffness;
      scene.links.push_back(link);
    }
    return scene;
  }

  struct Judgement
  {
    double least = 1e300, largest = 0.; ///< ratios
    std::string scheme;
  };
  Judgement judge(const taut::Scene &scene)
  {
    const taut::SceneBodies structure(scene);
    const taut::Constraints constraints = taut::scene_constraints(scene, structure);
    const taut::ContactResolution resolution(structure, constraints, taut::SolverParameters(), step,
                                             step, 0.);
    Judgement result;
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      result.least = std::min(result.least, resolution.ratio(i));
      result.largest = std::max(result.largest, resolution.ratio(i));
    }
    result.scheme = taut::choose_scheme(structure, constraints, resolution, 0.).name;
    return result;
  }

  /// k step^2 / (m (1 - alpha_m) / (beta (1 - alpha_f))), Chung and Hulbert, spectral radius 0.8.
  double exact_ratio(const double stiffness)
  {
    const double rho = .8, alpha_m = (2. * rho - 1.) / (rho + 1.), alpha_f = rho / (rho + 1.),
                 beta = .25 * std::pow(1. - alpha_m + alpha_f, 2);
    return stiffness * step * step * beta * (1. - alpha_f) / (1. - alpha_m);
  }
} // namespace

// Their sum would be 16 times that of a rigid link.
TEST(ManyStops, of_masses_apart_are_judged_as_one)
{
  const double k = 4e4, exact = exact_ratio(k);
  for (const int n : {3, 1600})
  {
    const Judgement found = judge(masses_on_stops(n, 1, k));
    figure(std::to_string(n) + " masses, a stop of 4e4 N/m each: largest ratio", found.largest);
    EXPECT_NEAR(found.least, exact, 1e-6 * exact) << n;
    EXPECT_NEAR(found.largest, exact, 1e-6 * exact) << n;
    EXPECT_EQ(found.scheme, "generalised-alpha") << n;
  }
}

// 100 of them are resolved, 1600 are 16 times as stiff and are not.
TEST(ManyStops, of_one_mass_count_together)
{
  for (const int n : {100, 1400, 1600})
  {
    const Judgement found = judge(masses_on_stops(1, n, 400.));
    const double exact = exact_ratio(400. * n);
    figure(std::to_string(n) + " stops of 400 N/m below one mass: ratio", found.largest);
    EXPECT_NEAR(found.least, exact, .01 * exact) << n;
    EXPECT_NEAR(found.largest, exact, .01 * exact) << n;
    EXPECT_EQ(found.scheme, n == 100 ? "generalised-alpha" : "Moreau-Jean") << n;
  }
}

// A mass with many stops does not count for those beside it.
TEST(ManyStops, do_not_count_for_other_bodies)
{
  taut::Scene scene = masses_on_stops(2, 1, 4e4);
  const taut::Scene many = masses_on_stops(1, 1600, 400.);
  for (taut::Link link : many.links)
  {
    link.name += " more";
    scene.links.push_back(link);
  }
  const Judgement found = judge(scene);
  EXPECT_NEAR(found.least, exact_ratio(4e4), 1e-6 * exact_ratio(4e4));
  EXPECT_NEAR(found.largest, exact_ratio(4e4 + 1600. * 400.), .01 * found.largest);
}
