// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a formula has the values that deal.II's FunctionParser gives, to the last bit, in threads.
#include "common.h"

#include <taut/scene/expression.h>

#include <deal.II/base/function_parser.h>

#include <thread>

namespace
{
  using taut::Coordinates;
  using taut::Expression;

  /// With each function and operator, with blanks, and as in the scenes.
  const std::vector<std::string> formulas = {
      "0.001*sin(2*pi*s/1.2)",
      "120 + 22.2*9.81",
      "if(t < 1, 0, 100*sin(pi*(t-1))^2)",
      "if (s > 5, 0.0004*(s-5)^2, 0)+0.0004*sin(6.9813*s)+0.0003*sin (4.4880*s+1)",
      "1e4*s + 2e8*s^3",
      "s*2*3*t+s*s/7-t^3",
      "cos(s)+tan(t)+asin(s/20)+acos(s/20)+atan(s)+atan2(s,t+1)",
      "sinh(t)+cosh(t)+tanh(s)+asinh(s)+acosh(1+s)+atanh(t/10)",
      "log(1+s)+log2(1+s)+log10(1+s)+ln(1+t)+exp(-s)+sqrt(s)",
      "sign(s-2)+rint(s)+abs(t-1)+min(s,t,2)+max(s,t)+sum(s,t)+avg(s,t,3)",
      "int(s)+ceil(s)+floor(t)+cot(1+s)+csc(1+s)+sec(s)+pow(s,2.5)+erfc(s)",
      "(s > 2) & (t < 3) | (s < 1)",
      "(s >= 2) && (t <= 3) || (s == 1) + (t != 2)",
      "s > 2 ? t : -s",
      "-s^2 + _pi - _e",
      "1, s + t",
      "\ts *\t2 ",
      "2*s;",
  };

  std::uint64_t bits(const double value)
  {
    std::uint64_t result;
    std::memcpy(&result, &value, sizeof result);
    return result;
  }

  TEST(Formulas, values_of_deal_ii)
  {
    for (const std::string &text : formulas)
    {
      const Expression formula(text, "formula");
      dealii::FunctionParser<1> reference;
      reference.initialize("s,t", text, {{"pi", dealii::numbers::PI}}, true);
      for (const double s : {0., .3, 1., 1.7, 2., 4.99, 7.3, 19.})
        for (const double t : {0., .2, 1., 2., 3., 4.7})
        {
          reference.set_time(t);
          EXPECT_EQ(bits(formula(s, t)), bits(reference.value(dealii::Point<1>(s))))
              << text << " at " << s << ", " << t;
        }
    }
  }

  TEST(Formulas, in_space)
  {
    const std::string text = "1e5*x*sin(2*pi*t) + if(y > z, y, z^2)";
    const Expression formula(text, "formula", Expression::Variables::space);
    dealii::FunctionParser<3> reference;
    reference.initialize("x,y,z,t", text, {{"pi", dealii::numbers::PI}}, true);
    for (const double x : {-1., 0., 2.5})
      for (const double t : {0., .3})
      {
        reference.set_time(t);
        EXPECT_EQ(bits(formula({x, 2. * x, .5}, t)),
                  bits(reference.value(dealii::Point<3>(x, 2. * x, .5))));
      }
    EXPECT_EQ(bits(formula(2., .3)), bits(formula({2., 0., 0.}, .3)));
  }

  TEST(Formulas, of_an_elongation)
  {
    const Expression formula("5e4*d+1e8*d^3", "formula", Expression::Variables::elongation);
    EXPECT_DOUBLE_EQ(formula(.01, 0.), 600.);
  }

  /// A formula without variables is no number of the scene, but has one value.
  TEST(Formulas, without_variables)
  {
    const Expression formula("2*pi", "formula"), zero("0*1", "formula");
    EXPECT_EQ(formula(3., 4.), 2. * dealii::numbers::PI);
    EXPECT_EQ(formula.constant_part(), 0.);
    EXPECT_FALSE(zero.is_zero());
    EXPECT_FALSE(formula.depends_on_time());
  }

  /// Threads evaluate one formula and its copy at the same time.
  TEST(Formulas, on_several_threads)
  {
    const Expression formula(formulas[3], "formula"), copy = formula;
    constexpr int n_threads = 4, n_values = 20000;
    std::vector<int> n_wrong(n_threads, 0);
    std::vector<std::thread> threads;
    const auto expected = [](const double s, const double t)
    {
      return (s > 5. ? .0004 * (s - 5.) * (s - 5.) : 0.) + .0004 * std::sin(6.9813 * s) +
             .0003 * std::sin(4.4880 * s + 1.) + 0. * t;
    };
    const auto compare = [&](const int thread)
    {
      for (int i = 0; i < n_values; ++i)
      {
        const double s = 1e-3 * i + thread;
        n_wrong[thread] += !(std::fabs((i % 2 ? formula : copy)(s, 1.) - expected(s, 1.)) < 1e-15);
      }
    };
    for (int thread = 1; thread < n_threads; ++thread)
      threads.emplace_back(compare, thread);
    compare(0);
    for (std::thread &thread : threads)
      thread.join();
    EXPECT_EQ(n_wrong, std::vector<int>(n_threads, 0));
  }

  double value_of(const Expression::Separated::Travelling &term, const double s, const double t)
  {
    double result = term.of_time(0., t);
    for (const auto &[form, a, b] : term.factors)
      result *= form((a(0., t) * s + b(0., t) - b(0., 0.)) / a(0., 0.), 0.);
    return result;
  }

  /// Values of a formula that is taken apart are those of the whole, to rounding.
  void expect_same(const std::string &text, const std::size_t n_products, const bool has_rest,
                   const std::vector<std::size_t> &n_shapes = {})
  {
    SCOPED_TRACE(text);
    const Expression formula(text, "formula");
    const Expression::Separated parts = formula.separated();
    EXPECT_EQ(parts.products.size(), n_products);
    EXPECT_EQ(!parts.rest.is_zero(), has_rest);
    std::vector<std::size_t> found;
    for (const auto &term : parts.travelling)
      found.push_back(term.factors.size());
    EXPECT_EQ(found, n_shapes);
    for (const auto &[of_place, of_time] : parts.products)
      EXPECT_TRUE(of_place(1., 2.) == of_place(1., 3.) && of_time(1., 2.) == of_time(5., 2.));
    for (const double s : {.3, 1., 1.7, 4.99, 7.3})
      for (const double t : {.2, 1., 2., 3., 4.7})
      {
        double sum = parts.rest(s, t), size = std::fabs(sum);
        for (const auto &[of_place, of_time] : parts.products)
        {
          sum += of_place(s, 0.) * of_time(0., t);
          size += std::fabs(of_place(s, 0.) * of_time(0., t));
        }
        for (const auto &term : parts.travelling)
        {
          EXPECT_NEAR(term.whole(s, t), value_of(term, s, t), 2e-14) << s << ", " << t;
          sum += term.whole(s, t);
          size += std::fabs(term.whole(s, t));
        }
        EXPECT_NEAR(sum, formula(s, t), 1e-14 * size) << s << ", " << t;
      }
  }

  TEST(Formulas, products_of_place_and_time_are_taken_apart)
  {
    for (const std::string &text : formulas)
    {
      const Expression::Separated parts = Expression(text, "formula").separated();
      expect_same(text, parts.products.size(), !parts.rest.is_zero());
    }
    expect_same("120*sin(2*pi*t)", 1, false);
    expect_same("-3e-1*sin(s) * cos(t) /(1+s)/ (2+t)", 1, false);
    expect_same("1e+2*s - 2*t - exp(-s)*t^2 - -s", 4, false);
    expect_same("2^-s*t", 1, false);
    expect_same("3*t - -sin(s*t) + -cos(s*t)", 1, true);
    expect_same("if(t<1,0,t-1)*(s>2) + min(s,3)*max(t,1)", 2, false);
    expect_same("t < 1 ? 0 : t", 1, false);
    expect_same("t < 1 ? 0 : s", 0, true);
    expect_same("s > 2 & t < 3", 0, true);
    expect_same("(s > 2)*(t < 3)", 1, false);
  }

  TEST(Formulas, shapes_that_travel_are_taken_apart)
  {
    expect_same("-s^2*t + 1.5E-1*exp(-(s-2*t)^2) - 4", 2, false, {1});
    expect_same("3*s*t - exp(-(s-2*t)^2)/(1+s)", 1, false, {2});
    expect_same("sin(0.5*s-3*t) + cos((s/2 - t*3)*1)", 0, false, {1}); // as they are written
    expect_same("sin(.5*s-3*t)*(1+t)/exp(s+t^2)", 0, false, {2});
    expect_same("tanh((s-2*t-1)/(3+t))*(t<2)", 0, false, {1});
    expect_same("abs(s-2*t) < .3 ? 1 : (s-2*t)^3", 0, false, {1});
    expect_same("max(0,1-abs(s-int(t))/2)", 0, false, {1});
    expect_same("sin(s-2*t)+sin(2*s-3*t)-cos(3*s-6*t)", 0, false, {1, 1});
    expect_same("exp(-((-(s-4)/3+2*t)/.7)^2)*(3-(-s+6*t))", 0, false, {1});
    // Not in sums of s alone, or in sums of different ways.
    for (const std::string text : {"sin(s-2*t)^t", "exp(-(s-t)^2-t)", "sin((s-t)*(s-2*t))",
                                   "sin(s*t)", "sin(s^2-t)", "s<2*t ? 1 : 0", "sin(s-1/(t-t))"})
      EXPECT_TRUE(Expression(text, "formula").separated().travelling.empty()) << text;
  }

  std::string message(const std::string &text, const Expression::Variables variables)
  {
    return verification::error_of([&] { Expression(text, "Load/Magnitude", variables)(0., 2.); });
  }

  TEST(Formulas, errors_name_what_is_wrong)
  {
    using V = Expression::Variables;
    const auto has = [](const std::string &text, const std::string &part)
    { return verification::has(text, "Load/Magnitude") && verification::has(text, part); };
    EXPECT_PRED2(has, message("10*sine(t)", V::time), "Unexpected token");
    EXPECT_PRED2(has, message("10*(", V::time), "cannot evaluate '10*('");
    EXPECT_PRED2(has, message("1;2", V::both), "it is not one formula");
    EXPECT_PRED2(has, message("", V::both), "cannot evaluate ''");
    EXPECT_PRED2(has, message("1/s", V::both), "'1/s' is not finite at s = 0 m, t = 2 s");
    EXPECT_PRED2(has, message("sqrt(-1)", V::both), "'sqrt(-1)' is not finite at s = 0 m");
    EXPECT_PRED2(has, message("1/d", V::elongation), "not finite at d = 0 m");
    EXPECT_PRED2(has, message("y/x", V::space), "not finite at x, y, z = 0, 0, 0 m, t = 2 s");
  }

  // A load is taken apart, and its user knows the formula as it is written.
  TEST(Formulas, errors_of_parts_quote_the_whole)
  {
    const std::string text = "sin(s)*sqrt(1-t) + 3*exp(-(s-20*t)^2)/(s-20*t)";
    const Expression::Separated parts = Expression(text, "Load/Magnitude").separated();
    ASSERT_EQ(parts.products.size(), 1u);
    ASSERT_EQ(parts.travelling.size(), 1u);
    for (const std::string &error :
         {verification::error_of([&] { parts.products[0].of_time(0., 2.); }),
          verification::error_of(
              [&]
              {
                for (const auto &[form, a, b] : parts.travelling[0].factors)
                  form(0., 0.);
              })})
      EXPECT_TRUE(verification::has(error, "'" + text + "' is not finite at s = ")) << error;
  }
} // namespace
