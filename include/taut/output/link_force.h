// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_link_force_h
#define taut_link_force_h

#include <cmath>
#include <cstddef>
#include <vector>

namespace taut
{
  /// Extremes and spread of the force of a dropper over the steps of a run, or of a support over
  /// those in the window, by their lengths.
  struct LinkForce
  {
    double least = 0., largest = 0.; ///< [N]
    double mean = 0.;                ///< [N]
    std::size_t n_slackenings = 0;   ///< how often the force came down to 0

    /// Reversals of the force, only if they are kept.
    std::vector<double> reversals;
    bool keeps_reversals = false;

    /// The force at the start, and at the end of a step of @p dt [s].
    void start(double force);
    void add(double force, double dt);

    double deviation() const { return time > 0. ? std::sqrt(squares / time) : 0.; } ///< [N]

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &least &largest &mean &n_slackenings &reversals &last &time &squares;
    }

  private:
    double last = 0., time = 0.;
    double squares = 0.; ///< integral of the squared distance from the mean [N^2 s]
  };
} // namespace taut

#endif
