// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: in a step that brings bodies back from afar, links end as they do in any other step: stops
// that let go have no force, stops that are reached push, joints hold, compliant stops follow their
// springs and dampers, with each scheme that carries forces of the step before. Expected: the
// equations of one step, solved by hand.
#include "scene_tests.h"

using namespace verification;

namespace
{
  struct Mass
  {
    double mass, stiffness, displacement;
    std::string load;
  };

  /// Masses on springs, one above the other; the link acts between ground and the first one, or
  /// between the first two.
  std::string scene(const std::vector<Mass> &masses, const std::string &link,
                    const std::string &time)
  {
    std::ostringstream text;
    text << "Gravity = 0, 0; Start = given\nTime: " << time << "\n";
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
      const Mass &m = masses[i];
      text << "Mass m" << i << ": Position = 0, " << i << "; Motions = y; Mass = " << m.mass
           << "; Initial displacement = 0, " << m.displacement << ", 0\nSpring m" << i
           << ": From = ground; To = m" << i << "; Direction = 0, 1; Stiffness = " << m.stiffness
           << "\nLoad m" << i << ": On = m" << i << "; Direction = 0, 1; Magnitude = " << m.load
           << "\n";
    }
    const bool is_pair = masses.size() > 1;
    text << "Link link: Direction = 0, 1; From = " << (is_pair ? "m0" : "ground")
         << "; To = " << (is_pair ? "m1" : "m0") << "; " << link;
    return text.str();
  }
} // namespace

TEST(Refinement, a_stop_that_lets_go_does_not_pull)
{
  const double step = 1e6;
  double u[2] = {0., 0.}, v[2] = {0., 0.};
  run_scene(scene({{1.7, 777.7, 0., "if(t<1.5e6, 4e4, -1e-9)"}, {2.9, 3111.3, 0., "0"}},
                  "Type = stop; Stiffness = rigid",
                  "Scheme = backward Euler; Step = 1e6; End = 2e6"),
            {},
            [&](const taut::StepView &view)
            {
              if (view.state.time > 1.5e6)
              {
                const double m1 = 1.7 / (step * step), m2 = 2.9 / (step * step),
                             u1 = (-1e-9 + m1 * (u[0] + step * v[0])) / (m1 + 777.7),
                             u2 = m2 * (u[1] + step * v[1]) / (m2 + 3111.3);
                EXPECT_EQ(view.state.multiplier[0], 0.);
                EXPECT_NEAR(view.state.U[0][0], u1, 1e-9 * std::fabs(u1));
                EXPECT_NEAR(view.state.distance[0], u2 - u1, 1e-9 * std::fabs(u1));
              }
              else if (view.state.time > 0.)
              {
                EXPECT_GT(view.state.multiplier[0], 3e4);
              }
              for (int k : {0, 1})
              {
                u[k] = view.state.U[k][0];
                v[k] = view.state.V[k][0];
              }
            });
}

TEST(Refinement, a_stop_that_is_reached_pushes)
{
  const double P = -3e-17, u0 = 10., step = 1e9, N = -P - u0 / (step * step);
  run_scene(scene({{1., 1000.3, u0, "-3e-17"}}, "Type = stop; Stiffness = rigid",
                  "Scheme = backward Euler; Step = 1e9; End = 1e9"),
            {},
            [&](const taut::StepView &view)
            {
              if (view.state.time == 0.)
                return;
              EXPECT_NEAR(view.state.multiplier[0], N, 1e-9 * N);
              EXPECT_NEAR(view.state.distance[0], 0., 1e-9 * N / 1000.3);
            });
}

// The load is less than the rounding of the way: without a refinement the joint has no force.
TEST(Refinement, a_joint_without_force_holds)
{
  const double P = 1e-14, m = 1e-12, k = 1000., u = (.5 * P + m * 10.) / (m + k);
  run_scene(scene({{1., k, 10., "1e-14"}, {1., k, 10., "0"}}, "Type = joint; Stiffness = rigid",
                  "Scheme = backward Euler; Step = 1e6; End = 1e6"),
            {},
            [&](const taut::StepView &view)
            {
              if (view.state.time == 0.)
                return;
              EXPECT_NEAR(std::fabs(view.state.multiplier[0]), .5 * P, 1e-9 * P);
              for (int i = 0; i < 2; ++i)
                EXPECT_NEAR(view.state.U[i][0], u, 1e-9 * u);
              EXPECT_NEAR(view.state.distance[0], 0., 1e-9 * P / k);
            });
}

// A mass on a spring and on a stop with a spring and a damper, which stays closed: an oscillator.
// The load falls to a trace of itself in the second step; the third needs all that the second left.
// The balance of the first, which the second adds a part of, is known to the rounding of its load.
TEST(Refinement, compliant_stops_and_mean_balances)
{
  struct Case
  {
    std::string entries;
    double alpha_m, alpha_f, beta, gamma;
  };
  for (const Case &c :
       {Case{"Scheme = HHT\nTime/HHT: Alpha = 0.2", 0., .2, .36, .7},
        Case{"Scheme = generalised-alpha\nTime/Generalised-alpha: Spectral radius = 0.25", -.4, .2,
             .64, 1.1}})
  {
    const double m = 1000., d = 1e-3, k = 1000., ks = 2000., step = 1e6;
    double u = 0., v = 0., a = 0., r = 0.;
    int n = 0;
    run_scene(scene({{m, k, 0., "if(t<1.5e6, -4e4, -3e-7)"}},
                    "Type = stop; Stiffness = 2000; Damping = 1e-3",
                    "Allow unsuitable scheme = true; Step = 1e6; End = 3e6; " + c.entries),
              {},
              [&](const taut::StepView &view)
              {
                if (n == 1)
                {
                  u = -4e4 / (m / (step * step) + d / step + k + ks);
                  v = u / step;
                  a = v / step;
                  r = m * a;
                }
                else if (n > 1)
                {
                  const double now = 1. - c.alpha_m, P = (1. - c.alpha_f) * -3e-7,
                               a_u = 1. / (c.beta * step * step),
                               a_0 = -a_u * (u + step * v) - (.5 / c.beta - 1.) * a,
                               v_u = c.gamma * step * a_u,
                               v_0 = v + step * ((1. - c.gamma) * a + c.gamma * a_0);
                  u = (P - (1. - c.alpha_f) * d * v_0 + c.alpha_f * r - m * now * a_0 -
                       m * c.alpha_m * a) /
                      (m * now * a_u + (1. - c.alpha_f) * (d * v_u + k + ks));
                  v = v_u * u + v_0;
                  r = (m * (now * (a_u * u + a_0) + c.alpha_m * a) - c.alpha_f * r) /
                      (1. - c.alpha_f);
                  a = a_u * u + a_0;
                }
                if (n > 0)
                {
                  const double N = -ks * u - d * v;
                  EXPECT_NEAR(view.state.U[0][0], u, 1e-5 * std::fabs(u)) << c.entries << n;
                  EXPECT_NEAR(view.state.multiplier[0], N, 1e-5 * N) << c.entries << n;
                  EXPECT_NEAR(view.state.complementarity_gap[0], 0., 1e-9 * std::fabs(u))
                      << c.entries << n;
                }
                ++n;
              });
    EXPECT_EQ(n, 4);
  }
}
