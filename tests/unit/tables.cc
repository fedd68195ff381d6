// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a table in a formula has the values of its rows, straight lines or monotone cubics between
// them, and none outside. Sources: sums by hand; a straight line and a parabola; Boost's pchip.
#include "common.h"

#include "base/data_files.h"
#include <taut/scene/expression.h>

#include <math.h> // isnan, which pchip.hpp of Boost 1.74 takes from the global namespace

#include <boost/math/interpolators/pchip.hpp>

#include <thread>

namespace
{
  using taut::Coordinates;
  using taut::Expression;
  using V = Expression::Variables;

  /// Files in a folder of their own.
  class Tables : public ::testing::Test
  {
  protected:
    Tables()
    {
      taut::set_data_folder(folder.path.string());
      write("profile.csv", "s, height, drop\n0, 1, 0\n2, 5, 10\n3, 4, 10\n10, -3, 11\n");
    }
    ~Tables() override { taut::set_data_folder(""); }

    void write(const std::string &name, const std::string &text) const { folder.write(name, text); }

    const verification::Folder folder;
  };

  std::string message_of_table(const std::string &text, const V variables, const double s = 0.)
  {
    return verification::error_of([&] { Expression(text, "Load/Magnitude", variables)(s, 2.); });
  }

  TEST_F(Tables, straight_lines_between_rows)
  {
    const Expression table("table(profile.csv, height)", "entry", V::position);
    for (const auto &[s, value] : {std::pair(0., 1.),
                                   {.5, 2.},
                                   {2., 5.},
                                   {2.25, 4.75},
                                   {3., 4.},
                                   {6.5, .5},
                                   {10., -3.},
                                   {1., 3.},
                                   {9., -2.},
                                   {.25, 1.5}})
      EXPECT_DOUBLE_EQ(table(s, 7.), value) << s;
    EXPECT_FALSE(table.is_zero());
    EXPECT_FALSE(table.depends_on_time());
    EXPECT_EQ(table.formula(), "table(profile.csv, height)");
    EXPECT_DOUBLE_EQ(table(10. + 1e-10, 0.), -3.) << "rounding of a length";
  }

  TEST_F(Tables, inside_of_formulas)
  {
    const Expression sum("0.5*table(profile.csv, height) + table( profile.csv , drop )^2 - s",
                         "entry", V::position),
        both("s*table(profile.csv, height, t) + table (profile.csv, height, s)", "entry"),
        law("table(profile.csv, drop)*d", "entry", V::elongation),
        space("table(profile.csv, height, y) + x*table(profile.csv, drop, t)", "entry", V::space),
        chosen("t < 3 ? 0 : table(profile.csv, drop) - 10", "entry", V::time);
    EXPECT_DOUBLE_EQ(sum(.5, 0.), .5 * 2. + 2.5 * 2.5 - .5);
    EXPECT_DOUBLE_EQ(both(2., .5), 2. * 2. + 5.);
    EXPECT_TRUE(both.depends_on_time());
    EXPECT_DOUBLE_EQ(law(1., 0.), 5.);
    EXPECT_DOUBLE_EQ(space({3., .5, 77.}, 1.), 2. + 3. * 5.);
    EXPECT_DOUBLE_EQ(chosen(0., -1.), 0.) << "what is not chosen has no value";
    EXPECT_DOUBLE_EQ(chosen(0., 6.5), .5);
  }

  TEST_F(Tables, monotone_cubics)
  {
    const Expression cubic("table(profile.csv, drop, cubic)", "entry", V::position),
        of_time("table(profile.csv, drop, t, cubic)", "entry");
    const boost::math::interpolators::pchip<std::vector<double>> curve({0., 2., 3., 10.},
                                                                       {0., 10., 10., 11.});
    double last = 0.;
    for (int i = 0; i <= 1000; ++i)
    {
      const double s = .01 * i, value = cubic(s, 0.);
      EXPECT_NEAR(value, curve(s), 1e-13 * 11.) << s;
      EXPECT_EQ(of_time(0., s), value);
      EXPECT_GE(value, last - 1e-14) << "rows that do not fall";
      last = value;
    }
  }

  TEST_F(Tables, are_read_once_and_differ_by_content)
  {
    const std::string text = "table(profile.csv, height)";
    const Expression before(text, "entry", V::position), copy = before;
    write("profile.csv", "s, height\n0, 1\n10, 2\n");
    const Expression same(text, "entry", V::position);
    EXPECT_EQ(same.content(), before.content()) << "read once";
    taut::set_data_folder(folder.path.string());
    const Expression after(text, "entry", V::position);
    EXPECT_EQ(after.formula(), before.formula());
    EXPECT_NE(after.content(), before.content());
    EXPECT_NE(Expression("table(profile.csv, height) + 0*s", "entry", V::position).content(),
              after.content());
    EXPECT_DOUBLE_EQ(copy(2., 0.), 5.);
    EXPECT_DOUBLE_EQ(after(2., 0.), 1.2);
    EXPECT_EQ(Expression("2*s", "entry").content(), "2*s");
  }

  TEST_F(Tables, on_several_threads)
  {
    std::string rows = "s; v\n";
    for (int i = 0; i <= 1000; ++i)
      rows += std::to_string(i) + ";" + std::to_string(i * i) + ",0\n";
    write("squares.csv", rows);
    const Expression alone("table(squares.csv, v)", "entry", V::position),
        inside("1*table(squares.csv, v)", "entry", V::position);
    std::vector<int> n_wrong(4, 0);
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread)
      threads.emplace_back(
          [&, thread]
          {
            for (int i = 0; i < 20000; ++i)
            {
              const int row = (i * (2 * thread + 1) + 250 * thread) % 1000;
              const double expected = row * row + .5 * (2 * row + 1);
              n_wrong[thread] += (i % 2 ? alone : inside)(row + .5, 0.) != expected;
            }
          });
    for (std::thread &thread : threads)
      thread.join();
    EXPECT_EQ(n_wrong, std::vector<int>(4, 0));
  }

  TEST_F(Tables, errors_name_file_and_remedy)
  {
    write("one.csv", "s, v\n1, 2\n");
    write("twice.csv", "s, v\n0, 2\n1, 3\n1, 4\n");
    write("infinite.csv", "s, v\n0, 2\n1, inf\n");
    write("three.csv", "s, v\n0, 2\n1, 3\n2, 4\n");
    const auto has = [](const std::string &text, const std::string &part)
    { return verification::has(text, "Load/Magnitude") && verification::has(text, part); };
    const std::string outside = message_of_table("2*table(profile.csv, height)", V::position, 130.);
    EXPECT_PRED2(has, outside, "has no value at s = 130 m");
    EXPECT_PRED2(has, outside,
                 "file 'profile.csv' has 'height' from 0 to 10 and none at 130; the rows have to "
                 "cover what is used");
    EXPECT_PRED2(has, message_of_table("table(profile.csv, height)", V::position, -1.),
                 "none at -1");
    EXPECT_PRED2(has, message_of_table("table(profile.csv, width)", V::time),
                 "has no column 'width'");
    EXPECT_PRED2(has, message_of_table("table(profil.csv, height)", V::time),
                 "cannot read the file");
    EXPECT_PRED2(has, message_of_table("table(profile.csv)", V::time),
                 "does not name a file and a column");
    EXPECT_PRED2(has, message_of_table("table(profile.csv, height", V::time), "never closed");
    EXPECT_PRED2(has, message_of_table("table(profile.csv, height)", V::both),
                 "one of s, t, as in");
    EXPECT_PRED2(has, message_of_table("table(profile.csv, height, t)", V::position),
                 "'t' is no word");
    EXPECT_PRED2(has, message_of_table("table(one.csv, v)", V::time), "has 1 row; a table takes 2");
    EXPECT_PRED2(has, message_of_table("table(three.csv, v, cubic)", V::time), "takes 4 and more");
    EXPECT_PRED2(has, message_of_table("table(twice.csv, v)", V::time),
                 "line 4: 's' is 1 after 1; sort");
    EXPECT_PRED2(has, message_of_table("table(infinite.csv, v)", V::time), "line 3: 'inf'");
    EXPECT_PRED2(has, message_of_table("profile.csv", V::time), "'table(FILE.csv, column)'");
  }
} // namespace
