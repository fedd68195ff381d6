// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a step of a scene allocates no more often than listed here. The numbers are those of
// `allocations`, with a tenth of room. Lower a bound when a step allocates less.
#include "counted_run.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <map>

namespace
{
  using namespace allocations;

  /// Largest mean number of allocations of a step.
  const std::map<std::string, double> bounds = {
      {"bar_on_two_cables", 235.},
      {"bar_on_wall", 0.5},
      {"beam_angular_stop", 4.4},
      {"beam_over_supports", 4.4},
      {"block_impact", 6.},
      {"bouncing_bar", 0.5},
      {"bracket_and_cables", 1.7},
      {"bump_stop", 2.5},
      {"cable_on_floor", 9.3},
      {"en50318_2002_250", 12.1},
      {"en50318_2002_250_two", 23.1},
      {"en50318_2002_300", 12.2},
      {"en50318_2002_sweep", 11.5},
      {"en50318_in_space", 12.1},
      {"guyed_mast", 1.4},
      {"inclined_cable", 1.7},
      {"line_of_cables", 115.},
      {"line_of_cables_with_weights", 115.},
      {"line_with_droppers", 40.},
      {"oscillator_with_stop", 0.5},
      {"pendulum_cable", 69.},
      {"plucked_cable", 8.3},
      {"real_line", 99.7},
      {"snap_load", 9.3},
      {"string_on_stop", 2.2},
      {"swinging_load_on_guys", 91.1},
      {"wire_in_space", 3.6},
  };

  TEST(Allocations, hook_counts)
  {
    const long before = count();
    const std::vector<double> a(1000);
    void *const b = std::malloc(10), *const c = std::realloc(b, 100);
    EXPECT_EQ(count() - before, 3);
    std::free(c);
  }

  TEST(Allocations, sites_have_callers)
  {
    const CountedRun run = run_counted("bump_stop", {10, 20}, 8);
    ASSERT_EQ(run.by_step.size(), 20u);
    ASSERT_FALSE(run.sites.empty());
    long n = 0;
    bool is_named = false;
    for (const Site &site : run.sites)
    {
      n += site.count;
      for (const std::string &caller : site.callers)
        is_named = is_named || caller == "taut::TimeStepper::advance";
    }
    EXPECT_GE(n, run.total());
    EXPECT_TRUE(is_named);
  }

  TEST(Allocations, bounds_are_of_the_moving_scenes)
  {
    std::vector<std::string> names;
    for (const auto &[name, bound] : bounds)
      names.push_back(name);
    EXPECT_EQ(names, moving_scenes());
  }

  TEST(Allocations, of_steps)
  {
    for (const auto &[name, bound] : bounds)
    {
      const CountedRun run = run_counted(name, {});
      ASSERT_FALSE(run.by_step.empty()) << name;
      EXPECT_EQ(run.ending, "") << name;
      const double mean = static_cast<double>(run.total()) / run.by_step.size();
      EXPECT_LE(mean, bound) << name;
      std::cout << name << ": " << mean << " allocations a step, " << run.n_without() << " of "
                << run.by_step.size() << " steps without\n";
    }
  }
} // namespace
