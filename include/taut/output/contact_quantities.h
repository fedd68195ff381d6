// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_quantities_h
#define taut_contact_quantities_h

#include <taut/output/statistics_parameters.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// Mean, standard deviation and extremes of a record.
  struct Moments
  {
    double mean = 0., deviation = 0., minimum = 0., maximum = 0.;
    static Moments of(const std::vector<double> &record);
  };

  /// One value a step of a sliding contact.
  struct ContactRecord
  {
    std::vector<double> position;        ///< on its wire, of a strip on its first wire [m]
    std::vector<double> force = {};      ///< [N]
    std::vector<double> mean_force = {}; ///< over the time that the element resolves [N]
    std::vector<double> height = {};     ///< of the contact along its direction; may be empty [m]

    /// Adds the forces of a wire to those of its strip, equal in number.
    void add(const ContactRecord &wire);

    /// The record at equal intervals, by linear interpolation between increasing times [s], if
    /// steps are not equal: the shortest of them is the interval. Forces are 0 only between two
    /// samples of 0.
    ContactRecord at_equal_steps(const std::vector<double> &times) const;

    /// Those of @p values, one a step, at which the position is in the window.
    std::vector<double> in_window(const std::vector<double> &values,
                                  const StatisticsParameters &parameters) const;
  };

  /// Contact force of one sliding contact in the window.
  struct ContactQuantities
  {
    Moments raw, filtered;
    double loss = 0.; ///< share of the samples without contact
    std::size_t n_samples = 0;
    bool is_filtered = false;
    bool is_complete = true;     ///< the contact passed the whole window
    double begin = 0., end = 0.; ///< positions of the first and last sample [m]
    double speed = 0.;           ///< mean of its size between them [m/s]
    double longest_step = 0.;    ///< that resolves the filter frequency; 0: no filter [s]

    /// Whether expected ranges apply, which are for the filtered force.
    bool are_judged() const { return n_samples > 0 && (is_filtered || longest_step == 0.); }

    /// From a record at increasing @p times [s].
    static ContactQuantities of(const ContactRecord &record, const std::vector<double> &times,
                                const StatisticsParameters &parameters);
  };
} // namespace taut

#endif
