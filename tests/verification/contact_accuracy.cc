// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: with conditions on gaps, then velocities, motions in contact are as near to the solution
// in time as an independent program found them with the same scheme, times 1.5, and of second order
// where they are smooth. Reference: the same discrete scene with a much smaller step of the same
// scheme, which BDF2 at a small step agrees with.
#include "scene_tests.h"

using namespace verification;

namespace
{
  using History = std::vector<std::vector<double>>; ///< displacements at common times [m]

  /// A scene, the point of its first wire that is compared, and times to compare at. Masses are
  /// compared, too.
  struct Problem
  {
    std::string name, scene;
    double end, interval;
    double wire_point;   ///< s [m]; negative: none
    Overrides more = {}; ///< entries of the scene
  };

  const Overrides ours = {"Time.Scheme=Moreau-Jean",
                          "Time.Moreau-Jean.Conditions=gaps then velocities",
                          "Time.Mass redistribution=no"},
                  bdf2 = {"Time.Scheme=BDF2", "Time.Mass redistribution=no",
                          "Time.Allow unsuitable scheme=true", "Time.Allow energy gain=true"};

  History run(const Problem &problem, const Overrides &overrides, const double step)
  {
    const long every = std::lround(problem.interval / step);
    History history;
    long i = 0;
    run_scene(problem.scene,
              problem.more + overrides +
                  Overrides{"Time.Step=" + number(step), "Time.End=" + number(problem.end)},
              [&](const taut::StepView &view)
              {
                if (i++ % every != 0)
                  return;
                history.emplace_back();
                if (problem.wire_point >= 0.)
                  history.back().push_back(displacement(view, 0, problem.wire_point));
                for (std::size_t m = 0; m < view.scene.masses.size(); ++m)
                  history.back().push_back(displacement(view, point_of_mass(view, m)));
              });
    return history;
  }

  /// Root mean square of the difference, over that of the reference unless @p absolute.
  double error(const History &a, const History &reference, const bool absolute = false)
  {
    EXPECT_EQ(a.size(), reference.size());
    double sum = 0., size = 0.;
    std::size_t n = 0;
    for (std::size_t i = 0; i < std::min(a.size(), reference.size()); ++i)
      for (std::size_t j = 0; j < a[i].size(); ++j, ++n)
      {
        sum += std::pow(a[i][j] - reference[i][j], 2);
        size += std::pow(reference[i][j] - reference[0][j], 2);
      }
    return std::sqrt(sum / (absolute ? n : size));
  }

  /// Errors at steps [s], at most 1.5 times those given.
  std::vector<double> compare(const Problem &problem, const double finest,
                              const std::vector<std::pair<double, double>> &expected,
                              const double agreement, const bool absolute = false,
                              const Overrides &other = bdf2,
                              const std::string &its_name = "the other scheme")
  {
    const History reference = run(problem, ours, finest);
    const double apart = error(run(problem, other, finest), reference, absolute);
    figure(problem.name + ", " + its_name + " minus the reference", apart);
    EXPECT_LT(apart, agreement) << problem.name;
    std::vector<double> errors;
    for (const auto &[step, bound] : expected)
    {
      errors.push_back(error(run(problem, ours, step), reference, absolute));
      figure(problem.name + ", step " + number(step) + " s, error (table: " + number(bound) + ")",
             errors.back());
      EXPECT_LT(errors.back(), 1.5 * bound) << problem.name << ", " << step;
    }
    return errors;
  }

  /// 120 m of wire on springs, and a two-mass pantograph at 250 km/h under it.
  std::string line(const std::string &contact, const std::string &force)
  {
    return R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 120, 0; Components = beam; Mass per length = 1.35; Tension = 20000;
  Bending stiffness = 195; Element size = 0.5; Mass damping = 0.0125; Stiffness damping = 1e-4
Support ends: Wire = wire; Positions = 0, 120
Support soft: Wire = wire; Type = elastic; Positions = 6:6:54, 66:6:114; Stiffness = 3000
Support hard: Wire = wire; Type = elastic; Positions = 60; Stiffness = 18000
Mass head: Position = 15, 0; Motions = y; Mass = 7.2
Mass frame: Position = 15, -1; Motions = y; Mass = 15
Spring upper: From = frame; To = head; Stiffness = 4200; Damping = 10
Spring lower: From = ground; To = frame; Stiffness = 50; Damping = 90
Link contact: Type = sliding contact; From = head; To = wire @ 15; Direction = 0, 1;
  Speed = 69.444444444444443; )" +
           contact + R"(
Load lift: Type = point; On = frame; Magnitude = )" +
           force + R"(
Time: End = 1
)";
  }

  Problem moving_contact(const std::string &name, const std::string &contact = "",
                         const std::string &force = "120")
  {
    return {name, line(contact, force), 1., 4e-3, -1.};
  }
} // namespace

TEST(ContactAccuracy, beam_over_supports)
{
  const Problem problem = {"beam over supports", scene_file("beam_over_supports"), 2., 4e-3, 10.};
  const std::vector<double> e = compare(
      problem, 6.25e-5, {{2e-3, .0057}, {1e-3, .0015}, {5e-4, .0003}, {2.5e-4, .0001}}, 2e-4);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, beam_on_stiff_stops)
{
  compare({"beam on stops of 1e6 N/m",
           scene_file("beam_over_supports"),
           2.,
           4e-3,
           10.,
           {"Network.Link support.Stiffness=1e6"}},
          6.25e-5, {{2e-3, .0085}, {1e-3, .0029}, {5e-4, .0007}}, 2e-4, false, bdf2, "BDF2");
}

TEST(ContactAccuracy, rigid_moving_contact)
{
  const std::vector<double> e =
      compare(moving_contact("rigid moving contact"), 6.25e-5,
              {{2e-3, .0103}, {1e-3, .0025}, {5e-4, .0006}, {2.5e-4, .0002}}, 1e-3);
  EXPECT_LT(e[3], e[0] / 16.) << "second order";
}

TEST(ContactAccuracy, rigid_moving_contact_with_loss)
{
  compare(moving_contact("rigid moving contact with loss", "", "120*(1+0.9*sin(2*pi*3*t))"),
          6.25e-5, {{1e-3, .014}, {2.5e-4, .0008}}, 5e-3);
}

TEST(ContactAccuracy, elastic_moving_contact)
{
  compare(moving_contact("moving contact of 5e4 N/m", "Stiffness = 5e4"), 6.25e-5,
          {{2e-3, .0097}, {1e-3, .0024}, {5e-4, .0006}}, 1e-3);
}

// Without mass its head is in equilibrium, and the contact as elastic as the spring under it.
TEST(ContactAccuracy, moving_contact_from_a_head_without_mass)
{
  for (const std::string damping : {"0", "10"})
  {
    Problem problem = moving_contact("contact from a massless head, damping " + damping);
    for (const auto &[entry, value] :
         {std::pair<std::string, std::string>("Mass = 7.2", "Mass = 0"),
          {"Damping = 10", "Damping = " + damping}})
      problem.scene.replace(problem.scene.find(entry), entry.size(), value);
    const std::vector<double> e = compare(
        problem, 6.25e-5, {{2e-3, .0083}, {1e-3, .0021}, {5e-4, .0005}, {2.5e-4, .00012}}, 1e-3);
    EXPECT_LT(e[3], e[0] / 16.) << "second order";
  }
}

// Two masses on a spring fall 0.8 m: errors in millimetres. BDF2 would let them rebound; the other
// scheme has conditions on velocities.
TEST(ContactAccuracy, two_masses_on_a_floor)
{
  const std::string scene =
      R"(Gravity = 0, -10; Start = given
Mass lower: Position = 0, 0.8; Motions = y; Mass = 2
Mass upper: Position = 0, 1.8; Motions = y; Mass = 2
Spring spring: From = lower; To = upper; Stiffness = 400
Link floor: Type = stop; From = ground; To = lower; Direction = 0, 1; Gap = 0.8
Time: End = 1
)";
  const Overrides of_rates = {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=velocities"};
  compare({"two masses on a floor [m]", scene, 1.32, .033, -1.}, 1e-5,
          {{.011, 7.1e-3}, {3.3e-3, 1.7e-3}, {1.1e-3, .7e-3}, {3.3e-4, .13e-3}}, 1e-4, true,
          of_rates);
}

// Two beams, simply supported, face to face: the upper one falls on the lower one.
TEST(ContactAccuracy, colliding_beams)
{
  const auto beam = [](const std::string &name, const std::string &y, const std::string &speed)
  {
    return "Wire " + name + ": From = 0, " + y + "; To = 20, " + y +
           "; Components = beam; Mass per length = 20; Bending stiffness = 2e5; Element size = "
           "0.5; Stiffness damping = 1e-4; Initial transverse velocity = " +
           speed + "\nSupport " + name + ": Wire = " + name + "; Positions = 0, 20\n";
  };
  const std::string scene =
      R"(Gravity = 0, 0; Start = given
)" + beam("lower", "0", "0") +
      "\n" + beam("upper", "0.05", "-sin(pi*s/20)") + R"(
Link stop: Type = stop; From = lower @ 1:1:19; To = upper @ 1:1:19; Direction = 0, 1; Gap = 0.05
Time: End = 1
)";
  compare({"colliding beams", scene, 1., 4e-3, 10.}, 3.125e-5,
          {{2e-3, .040}, {1e-3, .027}, {5e-4, .014}, {2.5e-4, .004}}, 5e-3);
}
