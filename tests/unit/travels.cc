// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the way of a speed in time is its integral to 1e-12. Sources: integrals in closed form.
#include "common.h"

#include "scene/travel.h"

namespace
{
  using taut::parse_speed;
  using taut::Speed;
  using taut::time_of_way;
  using taut::Travel;
  using verification::pi;

  std::shared_ptr<const Travel> travel(const std::string &text, const double end,
                                       const double units = 1.)
  {
    return parse_speed(text, "Load/Speed", units).travel->until(end);
  }

  /// Largest error of the way in [0, end], over the largest way.
  double error(const Travel &travel, const double end, const std::function<double(double)> &exact)
  {
    double worst = 0., size = 0.;
    for (int i = 0; i <= 1000; ++i)
    {
      const double t = end * i / 1000. * (i % 2 ? 1. : .9987);
      worst = std::max(worst, std::fabs(travel.way(t) - exact(t)));
      size = std::max(size, std::fabs(exact(t)));
    }
    return worst / size;
  }

  // A pulse of a ten-thousandth of the time is in the way wherever it is. Expected: 10 m more.
  TEST(Travels, narrow_pulses_of_the_speed_stay_in_the_way)
  {
    for (const double at : {.1, .2, .25, .31234, .5, .7, .7003})
    {
      const auto way = travel("40 + (t > " + std::to_string(at) + " && t < " +
                                  std::to_string(at + 1e-4) + " ? 1e5 : 0)",
                              1.);
      for (const double t : {.05, at + 2e-4, .75, .9, 1.})
        EXPECT_NEAR(way->way(t), 40. * t + (t > at ? 10. : 0.), 1e-8) << at << " " << t;
    }
  }

  TEST(Travels, numbers_are_constant)
  {
    const Speed number = parse_speed("250", "Speed", 3.6), formula = parse_speed("2*pi", "Speed");
    EXPECT_EQ(number.constant, 250. / 3.6);
    EXPECT_FALSE(number.travel);
    EXPECT_DOUBLE_EQ(formula.constant, 2. * std::acos(-1.));
    EXPECT_FALSE(formula.travel);
  }

  TEST(Travels, ways_are_integrals)
  {
    const double end = 12.;
    EXPECT_LT(error(*travel("20 + 0*t", end), end, [](double t) { return 20. * t; }), 1e-12);
    EXPECT_LT(error(*travel("250 + 0*t", end, 3.6), end, [](double t) { return 250. / 3.6 * t; }),
              1e-12);
    EXPECT_LT(error(*travel("3*t^2", end), end, [](double t) { return t * t * t; }), 1e-12);
    EXPECT_LT(error(*travel("10 + 8*sin(20*pi*t)", end), end,
                    [=](double t)
                    { return 10. * t + 8. / (20. * pi) * (1. - std::cos(20. * pi * t)); }),
              1e-12);
    EXPECT_LT(error(*travel("t < 5 ? 2*t : 10", end), end,
                    [](double t) { return t < 5. ? t * t : 25. + 10. * (t - 5.); }),
              1e-12)
        << "a kink";
    EXPECT_LT(error(*travel("if(t < pi, 10, 2)", end), end,
                    [=](double t) { return t < pi ? 10. * t : 10. * pi + 2. * (t - pi); }),
              1e-12)
        << "a jump";
  }

  TEST(Travels, behind_what_is_prepared)
  {
    const auto brief = travel("3*t^2", 1.);
    EXPECT_NEAR(brief->way(7.), 343., 343e-12);
    EXPECT_NEAR(parse_speed("3*t^2", "Speed").travel->way(7.), 343., 343e-12);
  }

  TEST(Travels, ranges)
  {
    // Forwards until t = 2, and back: 4 t - t^2.
    const taut::TravelRange range = travel("4 - 2*t", 6.)->range();
    EXPECT_NEAR(range.greatest, 4., 1e-11);
    EXPECT_NEAR(range.least, -12., 1e-11);
    EXPECT_NEAR(range.fastest, 8., 1e-11);
  }

  TEST(Travels, times_of_ways)
  {
    const Speed number{4., nullptr}, ramp = parse_speed("2*t", "Speed"),
                                     back = parse_speed("4 - 2*t", "Speed");
    EXPECT_DOUBLE_EQ(time_of_way(number, 10., 1e5), 2.5);
    EXPECT_TRUE(std::isinf(time_of_way(number, -10., 1e5)));
    EXPECT_TRUE(std::isinf(time_of_way({}, 10., 1e5)));
    EXPECT_NEAR(time_of_way(ramp, 400., 1e5), 20., 1e-10);
    EXPECT_TRUE(std::isinf(time_of_way(ramp, -1., 100.)));
    EXPECT_NEAR(time_of_way(back, 3., 1e5), 1., 1e-10) << "the first time";
    EXPECT_TRUE(std::isinf(time_of_way(back, 5., 1e3)));
    EXPECT_NEAR(time_of_way(back, -12., 1e3), 6., 1e-10);
  }
} // namespace
