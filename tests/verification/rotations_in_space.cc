// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: moments, angular gaps and recorded rotations of wires are about any axis in space.
#include "scene_tests.h"

using namespace verification;
using taut::add_scaled;
using taut::Coordinates;

namespace
{
  constexpr double beam_length = 3., bending_stiffness = 500., moment = 7.;

  std::string text(const Coordinates &x)
  {
    return number(x.x) + ", " + number(x.y) + ", " + number(x.z);
  }

  Coordinates unit(const Coordinates &a)
  {
    return add_scaled({}, 1. / norm(a), a);
  }

  /// A beam from the origin, clamped there, with a moment at its end.
  std::string cantilever(const Coordinates &along, const Coordinates &about)
  {
    std::ostringstream scene;
    scene << "Gravity = 0, 0; Start = equilibrium\nTime: End = 0\nWire beam: From = 0, 0, 0; To = "
          << text(add_scaled({}, beam_length, along))
          << "; Components = beam, lateral; Mass per length = 1; Bending stiffness = "
          << bending_stiffness << "; Element size = 1\n";
    for (const auto &[name, motion] : {std::pair("up", "transverse"),
                                       {"slope", "slope"},
                                       {"side", "lateral"},
                                       {"side slope", "lateral slope"}})
      scene << "Support " << name << ": Wire = beam; Positions = 0; Motion = " << motion << "\n";
    scene << "Load moment: On = beam @ " << beam_length
          << "; Rotational = true; Axis = " << text(about) << "; Magnitude = " << moment << "\n";
    return scene.str();
  }

  /// Of the beam with an angular stop of prm/: the moment, the rotation at its left end, the
  /// middle, step by step.
  using Motion = std::array<std::vector<double>, 3>;

  Motion angular_stop(const Overrides &overrides, const Coordinates &up, const Coordinates &about)
  {
    Motion result;
    run_scene(scene_file("beam_angular_stop"), overrides,
              [&](const taut::StepView &view)
              {
                result[0].push_back(view.state.multiplier[0]);
                result[1].push_back(displacement(view, 0, 0., about, true));
                result[2].push_back(displacement(view, 0, 2., up));
              });
    return result;
  }
} // namespace

// Euler and Bernoulli: the part of the moment across the beam turns its end by M L / EI about
// itself and moves it by M L^2 / 2 EI; nothing turns it about its own axis.
TEST(RotationsInSpace, moments_bend_a_beam_about_their_axis)
{
  double worst = 0.;
  int n_compared = 0;
  for (const Coordinates &along :
       {Coordinates{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}, {.6, 0., .8}, {1., -2., 2.}})
    for (const Coordinates &about :
         {Coordinates{0., 0., 1.}, {0., 1., 0.}, {1., 0., 0.}, {-.3, .5, .9}})
    {
      const Coordinates t = unit(along), a = unit(about), across = add_scaled(a, -dot(a, t), t);
      if (norm(across) < .1)
        continue;
      const double turn = moment * beam_length / bending_stiffness, shift = .5 * turn * beam_length;
      const Coordinates rotation = add_scaled({}, turn, across),
                        motion = add_scaled({}, shift, cross(across, t));
      run_scene(cantilever(t, about), {},
                [&](const taut::StepView &view)
                {
                  for (const Coordinates &e : {Coordinates{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}})
                  {
                    const double turned = displacement(view, 0, beam_length, e, true),
                                 moved = displacement(view, 0, beam_length, e);
                    EXPECT_NEAR(turned, dot(rotation, e), 1e-11 * turn);
                    EXPECT_NEAR(moved, dot(motion, e), 1e-11 * shift);
                    worst = std::max({worst, std::fabs(turned - dot(rotation, e)) / turn,
                                      std::fabs(moved - dot(motion, e)) / shift});
                    ++n_compared;
                  }
                });
    }
  EXPECT_GE(n_compared, 45);
  figure("rotation and displacement under moments in space, relative", worst);
}

// The scene turned by 90 degrees about the beam: y becomes z, and the stop is about -y.
TEST(RotationsInSpace, an_angular_stop_turned_about_x_acts_as_in_the_plane)
{
  const std::string wire = "Network/Wire beam/", support = "Network/Support ends/";
  const Motion plane = angular_stop({}, {0., 1., 0.}, {0., 0., 1.}),
               space = angular_stop(
                   {wire + "Components = beam, lateral", support + "Motion = lateral",
                    "Network/Supports = ends, upright", "Network/Support upright/Wire = beam",
                    "Network/Support upright/Positions = 0, 4",
                    "Network/Load force/Direction = 0, 0, -1",
                    "Network/Link angular stop/Axis = 0, -2, 0"},
                   {0., 0., 1.}, {0., -1., 0.});
  EXPECT_GT(plane[0].front(), 20.);
  double worst = 0.;
  for (const int i : {0, 1, 2})
    raise(worst, largest_difference(plane[i], space[i]) / largest(plane[i]));
  EXPECT_LT(worst, 1e-10);
  figure("angular stop turned about x against the plane, relative", worst);
}

TEST(RotationsInSpace, an_axis_that_nothing_turns_about_is_an_error)
{
  const std::string link = "Network/Link angular stop/";
  for (const auto &[overrides, part] : std::vector<std::pair<Overrides, std::string>>{
           {{link + "Axis = 1, 0, 0"}, "neither end can turn about it"},
           {{link + "Axis = 0, 1, 0"}, "neither end can turn about it"}, // no lateral component
           {{link + "Axis = 0, 0, 0"}, "Axis"},
           {{link + "Direction = 0, 1"}, "turns about an Axis"},
           {{"Output/Probe left slope/Direction = 0, 1"}, "turns about an Axis"},
           {{"Network/Load force/Axis = 0, 0, 1"}, "set 'Rotational = true'"},
           {{"Output/Probe middle/Axis = 0, 0, 1"}, "set 'Rotational = true'"},
           {{"Output/Probe left slope/Axis = 0, 1, 0"}, "cannot turn about it"}})
  {
    const std::string error =
        error_of([&, o = overrides] { Session session(scene_file("beam_angular_stop"), o); });
    EXPECT_TRUE(has(error, part)) << overrides[0] << ": " << error;
  }
}
