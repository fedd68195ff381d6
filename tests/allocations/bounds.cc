// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a step of a scene allocates no more often than listed here. All allocations count: those
// of CHOLMOD, Belos and the pools of other libraries go through the same functions. What is left
// are records that grow, at two of a hundred steps, and steps that change their length or their
// active set. The numbers are those of `allocations`, with a tenth of room. Lower a bound when a
// step allocates less.
#include "counted_run.h"

#include <extremes/observation.h>
#include <extremes/scene_matrix.h>

namespace
{
  using namespace allocations;

  /// Largest mean number of allocations of a step. Steps of the real line come to lengths that are
  /// new in the counted steps, for which F is set up once.
  const std::map<std::string, double> bounds = {
      {"bar_on_two_cables", 3.49},
      {"bar_on_wall", 0.03},
      {"beam_angular_stop", 0.07},
      {"beam_over_supports", 0.07},
      {"block_and_tackle", 0.07},
      {"block_impact", 0.07},
      {"bouncing_bar", 0.03},
      {"bracket_and_cables", 0.07},
      {"bump_stop", 0.1},
      {"cable_on_floor", 0.07},
      {"en50318_2002_250", 0.14},
      {"en50318_2002_250_two", 0.2},
      {"en50318_2002_300", 0.14},
      {"en50318_2002_sweep", 0.09},
      {"en50318_in_space", 0.14},
      {"guyed_mast", 0.07},
      {"inclined_cable", 0.07},
      {"line_of_cables", 0.14},
      {"line_of_cables_with_weights", 0.14},
      {"line_with_droppers", 0.09},
      {"oscillator_with_stop", 0.03},
      {"pendulum_cable", 0.6},
      {"plucked_cable", 0.05},
      {"real_line", 56.},
      {"snap_load", 0.07},
      {"string_on_stop", 0.08},
      {"swinging_load_on_guys", 0.07},
      {"winch", 0.07},
      {"wire_in_space", 0.07},
  };

  const std::string matrix_free = "Solver/Interface operator=matrix-free";

  TEST(Allocations, hook_counts)
  {
    const long before = count();
    const std::vector<double> a(1000);
    void *const b = std::malloc(10), *const c = std::realloc(b, 100);
    EXPECT_EQ(count() - before, 3);
    std::free(c);
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

  /// Krylov solvers of Belos allocate in each iteration, and lines of tables for their quantities.
  TEST(Allocations, of_krylov_solvers_and_tables)
  {
    struct Setting
    {
      std::string name;
      std::vector<std::string> overrides;
      double bound;
    };
    for (const auto &[name, overrides, bound] :
         {Setting{"matrix-free", {matrix_free}, 1180.},
          Setting{"tables", {"Output/Interval=0", "Output/Link interval=0"}, 5.8}})
    {
      const CountedRun run = run_counted("en50318_2002_250", {}, overrides);
      ASSERT_EQ(run.by_step.size(), 100u) << name;
      const double mean = static_cast<double>(run.total()) / 100.;
      EXPECT_LE(mean, bound) << name;
      std::cout << name << ": " << mean << " allocations a step\n";
    }
  }

  /// Allocations of the steps of some scenes, and the number of these steps.
  struct Sum
  {
    double allocations = 0., n_steps = 0.;
  };

  /// Of the scenes of a family that have an answer, 40 steps after 20, by the solver that searches
  /// the multipliers.
  std::map<std::string, Sum> sums_of(const std::vector<extremes::Case> &family)
  {
    std::map<std::string, Sum> sums;
    for (extremes::Case c : family)
      try
      {
        c.n_steps = 60;
        verification::Session session = extremes::session_of(c);
        const CountedRun run = run_counted(session, {});
        Sum &sum =
            sums[c.interface_operator == "matrix-free" ? c.interface_operator : c.complementarity];
        sum.allocations += static_cast<double>(run.total());
        sum.n_steps += static_cast<double>(run.by_step.size());
      }
      catch (const taut::UserError &)
      {
      }
    return sums;
  }

  TEST(Allocations, of_extreme_scenes)
  {
    const std::string newton = "semismooth Newton", other = "energy-ordered",
                      krylov = "matrix-free";
    struct Family
    {
      std::string name;
      std::vector<extremes::Case> cases;
      std::map<std::string, double> bounds;
    };
    const std::vector<Family> families = {
        {"masses", extremes::masses(1), {{newton, .1}, {other, 31.}, {krylov, 160.}}},
        {"wires", extremes::wires(1), {{newton, 6.2}, {other, 72.}, {krylov, 504.}}},
        {"sliding", extremes::sliding(1), {{newton, .5}, {other, 36.}, {krylov, 409.}}}};
    for (const Family &family : families)
    {
      std::map<std::string, Sum> sums = sums_of(family.cases);
      for (const auto &[solver, bound] : family.bounds)
      {
        const Sum &sum = sums[solver];
        ASSERT_GT(sum.n_steps, 100.) << family.name;
        EXPECT_LE(sum.allocations / sum.n_steps, bound) << family.name << ", " << solver;
        std::cout << family.name << ", " << solver << ": " << sum.allocations / sum.n_steps
                  << " allocations a step\n";
      }
    }
  }
} // namespace
