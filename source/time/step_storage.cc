// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/time/time_stepper.h>

namespace taut
{
  template <typename Archive>
  void TimeStepper::store(Archive &archive)
  {
    archive &current &last &coefficients &step.conditions().gaps();
    archive &clock;
    for (double &size : errors.largest_motions)
      archive &size;
    std::vector<std::vector<double>> courses = constraints.courses();
    archive &courses;
    constraints.set_courses(courses);
  }

  void TimeStepper::save(OutputArchive &archive)
  {
    store(archive);
    const std::vector<double> largest_rates =
        projection ? projection->largest_rates() : std::vector<double>();
    archive << largest_rates;
    reset_caches(largest_rates);
  }

  void TimeStepper::load(InputArchive &archive, State state)
  {
    current = std::move(state);
    store(archive);
    std::vector<double> largest_rates;
    archive >> largest_rates;
    constraints.update(current.time);
    nonlinear.follow(current);
    reset_caches(largest_rates);
  }

  void TimeStepper::reset_caches(const std::vector<double> &largest_rates)
  {
    step.reset();
    projection.reset();
    prepare(coefficients);
    if (projection && !largest_rates.empty())
      projection->set_largest_rates(largest_rates);
  }
} // namespace taut
