// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: steps of 1/(20 f) and elements of v/(4 f) give the figures of the force of a contact that
// moves at the speed v, low-passed at f, within the bounds of doc/accuracy.md; half the step gives
// the extremes better. Source: the same line with a tenth of the step and less than a third of the
// elements, and the standard's filter.
#include "scene_tests.h"

#include <array>

using namespace verification;

namespace
{
  /// Mean, standard deviation, largest and smallest force [N].
  using Figures = std::array<double, 4>;

  Figures figures(const std::string &file, const double step, const double element)
  {
    Session session(scene_file(file),
                    {"Time/Scheme=generalised-alpha", "Time/Check steps=no",
                     "Time/Step=" + number(step),
                     "Catenary/Contact wire/Element size=" + number(element),
                     "Catenary/Messenger wire/Element size=" + number(element),
                     "Output/Interval=1e9", "Output/Link interval=1e9", "Output/Field interval=0"});
    session.run();
    const taut::Moments &m = session.simulation().statistics().contact_quantities(0).filtered;
    return {m.mean, m.deviation, m.maximum, m.minimum};
  }

  /// Errors of the mean in itself, and of the others in the standard deviation [%].
  Figures errors(const Figures &value, const Figures &reference)
  {
    Figures result;
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = 100. * std::fabs(value[i] - reference[i]) / reference[i == 0 ? 0 : 1];
    return result;
  }
} // namespace

TEST(RuleOfThumb, of_steps_and_elements_on_the_reference_line)
{
  constexpr double f = 20.;
  struct Line
  {
    std::string file;
    double speed;                     ///< [m/s]
    double mean, deviation, extremes; ///< bounds [%]
    double half_deviation, half_extremes;
  };
  for (const Line &line : {Line{"en50318_2002_250", 250. / 3.6, .1, 2., 6., .2, 7.},
                           Line{"en50318_2002_300", 300. / 3.6, .1, 1., 17., .2, 7.}})
  {
    SCOPED_TRACE(line.file);
    const Figures reference = figures(line.file, 2.5e-4, .25),
                  rule =
                      errors(figures(line.file, 1. / (20. * f), line.speed / (4. * f)), reference),
                  half =
                      errors(figures(line.file, 1. / (40. * f), line.speed / (4. * f)), reference);
    const std::string at = line.file + ", rule of thumb: ";
    EXPECT_LE(figure(at + "mean [%]", rule[0]), line.mean);
    EXPECT_LE(figure(at + "deviation [%]", rule[1]), line.deviation);
    EXPECT_LE(figure(at + "extremes [% of the deviation]", std::max(rule[2], rule[3])),
              line.extremes);
    EXPECT_LE(figure(at + "deviation with half the step [%]", half[1]), line.half_deviation);
    EXPECT_LE(
        figure(at + "extremes with half the step [% of the deviation]", std::max(half[2], half[3])),
        line.half_extremes);
    EXPECT_GT(rule[1] + rule[2] + rule[3], 1e-3); // the runs differ
  }
}
