// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_longest_step_h
#define taut_longest_step_h

#include <taut/base/force_law.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  /// The longest step that resolves a contact of a constraint with a damper: a part of the time of
  /// the contact, which is that of the stiffness that the spring has where it is compressed to.
  struct LongestStep
  {
    /// Of the constraint alone on its bodies, without its damper and with the largest stiffness of
    /// its spring [s]; infinite: steps of any length will do.
    double contact_time = std::numeric_limits<double>::infinity();
    double damping_ratio = 0.;     ///< damping over the critical one, with this stiffness [1]
    const ForceLaw *law = nullptr; ///< of the spring; null: it is linear
    double factor = 1.;            ///< steps are so many times as long

    /// At the largest stiffness of the spring [s].
    double shortest() const { return at_stiffness(1.); }

    /// For a step between two compressions of the spring, negative where it is open [s].
    double between(const double u, const double v) const
    {
      const auto stiffness = [this](const double w) { return law->stiffness(std::max(0., w)); };
      return law ? at_stiffness(std::max(stiffness(u), stiffness(v)) / law->largest_stiffness())
                 : shortest();
    }

  private:
    /// Steps of a contact with a damper for a rebound within a percent: a number in the time of a
    /// contact without damper, and more in proportion to the part of the critical damping. A strong
    /// damper acts faster than the spring. Measured: restitution within 2 % at
    /// zeta = 0.02, 0.1 and 0.3 (ResolvedContacts.a_link_with_a_damper_is_met_by_shorter_steps).
    static constexpr double steps_of_a_damped_contact = 16., more_by_damping = 32.;

    /// With a part of the largest stiffness: a softer spring has longer contacts, and its damper is
    /// a larger part of the critical one.
    double at_stiffness(const double part) const
    {
      return factor * contact_time /
             (steps_of_a_damped_contact * std::sqrt(part) + more_by_damping * damping_ratio);
    }
  };
} // namespace taut

#endif
