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
      {"bar_on_two_cables", 365.},
      {"bar_on_wall", 0.5},
      {"beam_angular_stop", 5.2},
      {"beam_over_supports", 5.9},
      {"block_impact", 13.8},
      {"bouncing_bar", 0.5},
      {"bracket_and_cables", 4.7},
      {"bump_stop", 5.5},
      {"cable_on_floor", 15.6},
      {"en50318_2002_250", 20.3},
      {"en50318_2002_250_two", 35.8},
      {"en50318_2002_300", 20.4},
      {"en50318_2002_sweep", 20.8},
      {"en50318_in_space", 22.5},
      {"guyed_mast", 2.2},
      {"inclined_cable", 2.5},
      {"line_of_cables", 4132.},
      {"line_of_cables_with_weights", 4134.},
      {"line_with_droppers", 726.},
      {"oscillator_with_stop", 2.4},
      {"pendulum_cable", 132.},
      {"plucked_cable", 14.8},
      {"real_line", 190.},
      {"snap_load", 20.},
      {"string_on_stop", 3.},
      {"swinging_load_on_guys", 162.},
      {"wire_in_space", 4.5},
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
