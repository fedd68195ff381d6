// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: Newmark's method with beta = 1/12 is of fourth order in motions without damping, and
// schemes are refused where a frequency of the scene makes them unstable, and nowhere else.
// Sources: Hughes, The Finite Element Method, 1987, section 9.1; u of a mass on a spring k under P
// (1 - cos Omega t), P/k [1 - (omega^2 cos Omega t - Omega^2 cos omega t)/(omega^2 - Omega^2)];
// frequencies of two masses on springs.
#include "scene_tests.h"

using namespace verification;

namespace
{
  /// m = 1, 3 kg on springs of 4000, 2000 N/m, with one of 9000 N/m between them, one pushed.
  const char *const two_masses =
      R"(Gravity = 0, 0; Start = undeformed
Mass one: Position = 0, 0; Mass = 1; Motions = y
Mass two: Position = 0, 1; Mass = 3; Motions = y
Spring first: From = ground; To = one; Direction = 0, 1; Stiffness = 4000
Spring second: From = ground; To = two; Direction = 0, 1; Stiffness = 2000
Load push: On = one; Direction = 0, 1; Magnitude = 10
Link joint: Type = joint; From = one; To = two; Direction = 0, 1; Stiffness = 9000
Time: Scheme = Newmark
Time/Newmark: Beta = 0.1
)";

  /// Of them: the larger root of (k1 + k - m1 w)(k2 + k - m2 w) = k^2 with w = omega^2.
  double largest_frequency_of_two_masses()
  {
    const double a = 13000., b = 11000. / 3., c = 9000. * 9000. / 3.;
    return std::sqrt(.5 * (a + b) + std::sqrt(.25 * (a - b) * (a - b) + c));
  }

  /// Largest motion of the first mass over 4000 steps.
  double largest_motion(const double step, const Overrides &settings = {})
  {
    return largest(history_of(two_masses,
                              settings + Overrides{"Time/Step=" + std::to_string(step),
                                                   "Time/End=" + std::to_string(4000 * step)},
                              [](const taut::StepView &view) { return view.state.U[0][0]; }));
  }
} // namespace

TEST(ConditionalStability, fourth_order_with_beta_one_twelfth)
{
  const double k = 800., omega = std::sqrt(k / 2.), Omega = 7., P = 8.;
  const char *const scene =
      R"(Gravity = 0, 0; Start = equilibrium
Mass mass: Position = 0, 0; Mass = 2; Motions = y
Spring spring: From = ground; To = mass; Direction = 0, 1; Stiffness = 800
Load push: On = mass; Direction = 0, 1; Magnitude = 8*(1-cos(7*t))
Time: Scheme = Newmark; End = 3.2
Time/Newmark: Beta = 0.08333333333333333
)";
  std::vector<double> errors;
  for (const char *const step : {"0.02", "0.01", "0.005"})
  {
    errors.push_back(largest(history_of(scene, {std::string("Time/Step=") + step},
                                        [&](const taut::StepView &view)
                                        {
                                          const double t = view.state.time,
                                                       u = P / k *
                                                           (1. -
                                                            (omega * omega * std::cos(Omega * t) -
                                                             Omega * Omega * std::cos(omega * t)) /
                                                                (omega * omega - Omega * Omega));
                                          return (view.state.U[0][0] - u) / (P / k);
                                        })));
  }
  figure("Newmark with beta 1/12, a forced oscillator, error at 16 steps a period", errors[0]);
  for (std::size_t i = 1; i < errors.size(); ++i)
  {
    figure("Newmark with beta 1/12, order", std::log2(errors[i - 1] / errors[i]));
    EXPECT_GT(errors[i - 1], 14. * errors[i]);
  }
}

TEST(ConditionalStability, unstable_steps_are_refused_and_no_others)
{
  // 1/sqrt(gamma/2 - beta), of which 2 % are kept away.
  const double limit = 1. / std::sqrt(.15) / largest_frequency_of_two_masses();
  EXPECT_LT(largest_motion(.979 * limit), .02);
  try
  {
    largest_motion(.981 * limit);
    ADD_FAILURE() << "was taken";
  }
  catch (const taut::EntryError &e)
  {
    EXPECT_EQ(e.entry(), "Time/Step");
    EXPECT_TRUE(has(e.what(), "stable for steps up to"));
  }
  const Overrides anyway = {"Time/Allow unsuitable scheme=true"};
  EXPECT_LT(largest_motion(.999 * limit, anyway), .04);
  EXPECT_THROW(largest_motion(1.01 * limit, anyway), taut::UserError); // beyond 1e100
  EXPECT_LT(largest_motion(3. * limit, {"Time/Newmark/Beta=0.25"}), .04);
}
