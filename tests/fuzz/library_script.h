// SPDX-License-Identifier: LGPL-2.1-or-later
// A sequence of calls of the library: a system with an exact result, and mistakes between the
// calls.
#ifndef taut_tests_door_script_h
#define taut_tests_door_script_h

#include "library_bodies.h"

#include <taut/time/stepper.h>

#include <cstdint>
#include <random>
#include <stdexcept>

namespace library
{
  /// A mistake of the library: a result that is not exact, or bad input that was taken.
  class Failure : public std::logic_error
  {
  public:
    using std::logic_error::logic_error;
  };

  struct Counts
  {
    std::size_t checked = 0; ///< valid calls whose results were compared
    std::size_t refused = 0; ///< bad calls
    std::size_t open = 0;    ///< calls with extreme numbers: both may come
  };

  /// Random numbers, and the calls with their counts.
  class Calls
  {
  public:
    Calls(const std::uint64_t seed, Counts &counts) : counts(counts), random(seed) {}

    std::size_t below(const std::size_t n) { return random() % n; }
    double between(const double a, const double b)
    {
      return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
    }

    double bad_number()
    {
      static const double numbers[] = {not_a_number, infinite, -infinite};
      return numbers[below(3)];
    }

    double any_number(); ///< a number of any size, of which many are possible

    /// A call that has to be refused, with @p name in the message.
    void refuse(const std::string &what, const std::string &name,
                const std::function<void()> &call);

    void expect(const std::string &what, double value, double expected, double tolerance);
    void expect_true(const std::string &what, bool value);

    Counts &counts;

  private:
    std::mt19937_64 random;
  };

  /// Mistakes before and after a Stepper is made; each names what it is about and leaves no trace.
  void make_mistake(Calls &calls, taut::System &system, std::size_t chain);
  void make_mistake_with_options(Calls &calls, const taut::System &system);
  void make_mistake_with_stepper(Calls &calls, taut::System &system, taut::Stepper &stepper);
} // namespace library

#endif
