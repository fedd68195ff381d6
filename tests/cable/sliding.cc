// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a contact slides along a cable as along a wire, and follows its shape at rest. Sources:
// the same scene with a straight wire; a taut string under a force, F x (l - x)/(l T) below its
// parabola. With a speed in space: the elastic catenary; the way that was given.
#include "cable/elastic_catenary.h"
#include "cable/slack_cable.h"
#include "verification/scene_tests.h"

using namespace verification;

namespace
{
  constexpr double tension = 16e3, length = 60.;

  /// A mass that is pushed up slides under a line of 60 m from s = 10 m on, named by `To`.
  std::string scene(const std::string &to, const std::string &rest)
  {
    return rest + R"(Start = equilibrium
Mass head: Position = 0, -1; Mass = 8; Motions = y
Spring soft: From = ground; To = head; Direction = 0, 1; Stiffness = 50; Damping = 90
Load push: On = head; Direction = 0, 1; Magnitude = 120
Link contact: Type = sliding contact; From = head; To = )" +
           to + "; Direction = 0, 1; Stiffness = 5e4\n";
  }

  std::string cable(const std::string &geometry, const std::string &weight)
  {
    return "Gravity = 0, " + weight +
           "\nBody cable: Type = cable; To = 60, 0; Axial stiffness = 13e6; Mass per length = "
           "1.07; Elements = 120; Bending stiffness = 200; Mass damping = 0.02; Geometry = " +
           geometry + "\n";
  }

  std::vector<double> forces(const std::string &text, const Overrides &settings)
  {
    std::vector<double> result;
    run_scene(text,
              Overrides{"Time/Step=5e-3", "Time/End=1.9", "Network/Link contact/Speed=20"} +
                  settings,
              [&](const taut::StepView &view) { result.push_back(view.state.multiplier.back()); });
    return result;
  }

  constexpr std::size_t cable_body = 1; ///< after the mass

  /// A cable of 78 m over 60 m, far above a contact that travels at 4 m/s from s = 13 m on.
  void slack(const Overrides &settings, const Callback &record)
  {
    const Overrides entries = {
        "Body cable/Unstressed length=78", "Body cable/Bending stiffness=0",
        "Network/Loads=push, swing, back", "Network/Link contact/Gap=100",
        "Network/Link contact/Speed=4",    "Network/Link contact/Straight=true"};
    run_scene(scene("cable @ 13, 0", cable("nonlinear", "-9.81")) + R"(
Load swing: On = cable @ 39, 0; Direction = 1, 0
Load back: On = cable @ 39, 0; Direction = -1, 0
)",
              entries + settings, record);
  }

  std::string slack_error(const Overrides &settings)
  {
    return error_of([&] { slack(settings, {}); });
  }

  double place_of_contact(const taut::StepView &view)
  {
    return view.constraints.position(view.constraints.sliding_rows().front(), view.state.time);
  }
} // namespace

TEST(CableSliding, as_along_a_wire)
{
  const std::string wire =
      scene("wire @ 10", "Gravity = 0, 0\n") +
      "Wire wire: To = 60, 0; Components = beam; Bending stiffness = 200; Mass per length = 1.07; "
      "Mass damping = 0.02; Tension = 16000; Element size = 0.5\n"
      "Support ends: Wire = wire; Positions = 0, 60\n";
  // The same mass, and the same place at each time.
  const double unstressed = length / (1. + tension / 13e6), part = unstressed / length;
  std::vector<double> coarser;
  for (const int elements : {120, 240})
  {
    const std::vector<double> expected =
        forces(wire, {"Network/Wire wire/Mass per length=" + std::to_string(1.07 * part),
                      "Network/Wire wire/Element size=" + std::to_string(length / elements)});
    double size = 0.;
    for (const double force : expected)
      size = std::hypot(size, force - 120.);
    std::vector<double> errors;
    for (const std::string geometry : {"linear", "linearised", "nonlinear"})
    {
      const std::vector<double> found =
          forces(scene("cable @ " + std::to_string(10. * part) + ", 0", cable(geometry, "0")),
                 {"Body cable/Unstressed length=" + std::to_string(unstressed),
                  "Body cable/Elements=" + std::to_string(elements),
                  "Network/Link contact/Speed=" + std::to_string(20. * part)});
      ASSERT_EQ(found.size(), expected.size());
      double error = 0.;
      for (std::size_t i = 0; i < found.size(); ++i)
        error = std::hypot(error, found[i] - expected[i]);
      errors.push_back(error / size);
      figure("force under a " + geometry + " cable beside that under a wire, r.m.s., " +
                 std::to_string(elements) + " elements",
             errors.back());
    }
    EXPECT_LT(errors[1], errors[0] + .05); // it has the tension of the start, under the contact
    EXPECT_LT(errors[2], errors[0] + .1);  // the tension changes as the cable moves
    if (!coarser.empty())
    {
      EXPECT_LT(errors[0], .02);
      EXPECT_GT(coarser[0], 6. * errors[0]);
    }
    coarser = errors;
  }
}

TEST(CableSliding, follows_the_shape_at_rest)
{
  const double weight = 1.07 * 9.81;
  const auto sag = [&](const double x) { return weight * x * (length - x) / (2. * tension); };
  const auto raised = [&](const double x)
  { return 120. * x * (length - x) / (length * tension) + 120. / 5e4; };
  const auto way = [](const std::string &geometry, const double start, const double end)
  {
    double up = 0.;
    run_scene(scene("cable @ " + std::to_string(start) + ", 0", cable(geometry, "-9.81")),
              {"Body cable/Horizontal tension=16000", "Network/Link contact/Speed=1",
               "Network/Load push/Magnitude=120+8*9.81", "Network/Spring soft/Stiffness=1e-3",
               "Time/Step=0.05", "Time/End=" + std::to_string(end)},
              [&](const taut::StepView &view)
              { up = view.state.U[0][0] + view.reference.displacement[0][0]; });
    return up;
  };
  const double across = sag(30.) - sag(10.), rise = raised(30.) - raised(10.);
  EXPECT_NEAR(way("linear", 10., 0.), raised(10.), .01 * raised(10.));
  const double linear = way("linear", 10., 20.);
  figure("way of a mass that slides under a linear cable", linear, "m");
  EXPECT_NEAR(linear - raised(10.), rise - across, .05 * across);
  // At rest under the middle, whose height then is the start's.
  const double there = way("nonlinear", 30., 0.) - across, slid = way("nonlinear", 10., 20.);
  figure("way of a mass that slides under a nonlinear cable beside that at rest", slid - there,
         "m");
  EXPECT_NEAR(slid, there, .05 * across);
}

TEST(CableSliding, straight_along_a_catenary)
{
  const ElasticCatenary exact({}, {60., 0.}, {0., -1.07 * 9.81}, 13e6, 78.);
  ASSERT_LT(exact.error, 1e-9);
  const double start = exact.position(13.).x;
  std::vector<double> errors;
  for (const int elements : {30, 60})
  {
    double error = 0., longest = 0.;
    slack({"Body cable/Elements=" + std::to_string(elements), "Time/Step=0.1", "Time/End=11"},
          [&](const taut::StepView &view)
          {
            const double s = place_of_contact(view);
            error = std::max(error, std::fabs(exact.position(s).x - start - 4. * view.state.time));
            longest = std::max(longest, s);
          });
    EXPECT_GT(longest, 63.);
    figure("place of a contact with a speed in space on a slack cable, " +
               std::to_string(elements) + " elements",
           error, "m");
    errors.push_back(error);
  }
  EXPECT_LT(errors[1], 1e-5);
  EXPECT_LT(errors[1], errors[0] / 4.);
}

TEST(CableSliding, straight_along_a_cable_that_swings)
{
  std::vector<double> steps, errors;
  double slid = 0.;
  for (const double step : {.04, .02, .01})
  {
    double error = 0.;
    slid = 0.;
    slack(
        {"Body cable/Elements=40", "Time/End=4", "Network/Load swing/Magnitude=300*sin(2*t)",
         "Time/Step=" + std::to_string(step)},
        [&, start = 0.](const taut::StepView &view) mutable
        {
          const double s = place_of_contact(view);
          const taut::LinearForm form = view.structure[cable_body].displacement({s}, {1., 0., 0.});
          const double moved = form.dot(view.reference.displacement[cable_body]) +
                               form.dot(view.state.U[cable_body]),
                       x = view.structure[cable_body].position({s}).x + moved;
          if (view.state.time == 0.)
            start = x;
          error = std::max(error, std::fabs(x - start - 4. * view.state.time));
          slid = std::max(slid, std::fabs(moved));
        });
    figure("contact with a speed in space off its way, steps of " + std::to_string(step) + " s",
           error, "m");
    steps.push_back(step);
    errors.push_back(error);
  }
  figure("motion of the cable along that way", slid, "m");
  EXPECT_GT(slid, 1.);
  EXPECT_GT(fitted_order(steps, errors), 1.7);
  EXPECT_LT(errors.back(), 1e-3 * slid);
}

TEST(CableSliding, straight_off_the_end_or_into_a_fold)
{
  const std::string expected = "sliding contact 'contact' finds no place of the cable at t = ";
  EXPECT_TRUE(has(slack_error({"Time/Step=0.1", "Time/End=20"}), expected));
  // Drawn back beyond its first end: both legs lead somewhere, but not into each other.
  const Overrides drawn = {"Body cable/Unstressed length=200",
                           "Network/Load swing/On=cable @ 50, 0",
                           "Network/Load swing/Magnitude=-3000", "Time/End=1"};
  for (const std::string step : {"0.01", "0.05"})
  {
    const auto with = [&](const std::string &start, const std::string &speed)
    {
      return slack_error(drawn + Overrides{"Network/Link contact/To=cable @ " + start + ", 0",
                                           "Network/Link contact/Speed=" + speed,
                                           "Time/Step=" + step});
    };
    EXPECT_EQ(with("60", "4"), "");
    EXPECT_EQ(with("20", "4"), "");
    EXPECT_EQ(with("20", "-4"), "");
    for (const std::string start : {"60", "40"})
    {
      const std::string found = with(start, "-30");
      EXPECT_TRUE(has(found, expected)) << found;
    }
  }
}

TEST(CableSliding, straight_over_a_fold)
{
  // Drawn forth and back: where the first leg ends there is a third one at the same way.
  for (const std::string step : {"0.02", "0.1", "0.3", "0.5"})
  {
    const std::string found =
        slack_error({"Body cable/Unstressed length=200", "Body cable/To=100, 0",
                     "Network/Load swing/On=cable @ 70, 0", "Network/Load swing/Magnitude=3000",
                     "Network/Load back/On=cable @ 130, 0", "Network/Load back/Magnitude=3000",
                     "Network/Link contact/To=cable @ 50, 0", "Network/Link contact/Speed=30",
                     "Time/Step=" + step, "Time/End=1.5"});
    EXPECT_TRUE(has(found, "finds no place of the cable")) << found;
  }
}

TEST(CableSliding, straight_far_from_the_origin)
{
  // On a map, on a way between its axes: numbers of it round by more than a part of the cable.
  const auto last = [](const Overrides &ends)
  {
    double place = 0.;
    slack(ends + Overrides{"Time/Step=0.05", "Time/End=8"},
          [&](const taut::StepView &view) { place = place_of_contact(view); });
    return place;
  };
  const double near = last({"Body cable/To=57.3, 0, 17.7"});
  EXPECT_NEAR(last({"Body cable/From=4600000, 0, 300000", "Body cable/To=4600057.3, 0, 300017.7"}),
              near, 1e-6);
  EXPECT_GT(near, 48.);
}

TEST(CableSliding, leaves_the_cable)
{
  const std::string text = scene("cable @ 10, 0", cable("linear", "0"));
  const Overrides entries = {"Body cable/Unstressed length=59.9", "Time/End=3"};
  const std::string refusal = error_of([&] { forces(text, entries); });
  EXPECT_TRUE(has(refusal, "sliding contact 'contact' at t = 2.5 s"));
  EXPECT_TRUE(has(refusal, "has no place"));
}

TEST(CableSliding, under_a_line_of_cables_as_under_straight_wires)
{
  struct Force
  {
    double mean, deviation;
  };
  // Between the masts at 60 and 120 m.
  const auto force = [](const std::string &name, const Overrides &settings) -> Force
  {
    std::vector<double> N;
    const auto record = [&](const taut::StepView &view)
    {
      const double x = 40. + 250. / 3.6 * view.state.time;
      if (x >= 60. && x <= 120.)
        N.push_back(view.state.multiplier[view.constraints.sliding_rows().front()]);
    };
    run_scene(scene_file(name), settings, record);
    const double mean = std::accumulate(N.begin(), N.end(), 0.) / N.size(),
                 squares = std::inner_product(N.begin(), N.end(), N.begin(), 0.);
    return {mean, std::sqrt(squares / N.size() - mean * mean)};
  };
  const Force cables = force("line_of_cables", {"Time/End=1.16"}),
              wires = force("en50318_2002_250",
                            {"Time/End=1.16", "Time/Step=2e-3", "Catenary/Number of spans=3",
                             "Catenary/Pantograph pantograph/Start=40",
                             "Catenary/Contact wire/Element size=1",
                             "Catenary/Messenger wire/Element size=1",
                             "Catenary/Uplift positions=60, 120", "Statistics/Window=60, 120"});
  figure("mean contact force under cables less that under straight wires", cables.mean - wires.mean,
         "N");
  figure("its standard deviation under cables over that under straight wires",
         cables.deviation / wires.deviation);
  EXPECT_NEAR(cables.mean, wires.mean, .5);
  EXPECT_NEAR(cables.deviation, wires.deviation, .03 * wires.deviation);
}

TEST(CableSliding, slope_is_the_derivative_of_the_displacement)
{
  for (const taut::CableElement element : {taut::CableElement::ancf, taut::CableElement::bar})
  {
    const taut::Cable cable(slack_cable(element));
    const taut::Coordinates direction = {.3, -1., .5};
    std::vector<double> U(cable.n_dofs());
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] = std::sin(1. + 1.7 * i);
    const double h = 1e-4;
    for (const double s : {.7, 31.3, 77.2})
    {
      const double difference = (cable.displacement({s + h, 0.}, direction).dot(U) -
                                 cable.displacement({s - h, 0.}, direction).dot(U)) /
                                (2. * h);
      EXPECT_NEAR(cable.slope(s, direction).dot(U), difference, 1e-6 * std::fabs(difference)) << s;
    }
  }
}
