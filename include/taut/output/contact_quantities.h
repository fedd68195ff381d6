// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_quantities_h
#define taut_contact_quantities_h

#include <taut/scene/scene.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Parameters of the statistics, with expected ranges.
  struct StatisticsParameters
  {
    std::vector<double> window;    ///< positions of a sliding contact [m]; empty: whole run
    double filter_frequency = 20.; ///< [Hz]

    /// Limits of the mean force over the speed v: a, b for a v^2 + b, with v in km/h, then above a
    /// speed others, a, b, v1, c, d; empty: none.
    std::vector<double> least_mean, largest_mean;

    /// "none", or "AC", "DC 3 kV", "DC 1.5 kV": the largest mean force where `largest_mean` is
    /// empty.
    std::string supply = "none";

    std::vector<std::string> sums;   ///< "NAME: CONTACT + CONTACT", see contact_sums()
    std::vector<std::string> tables; ///< to write: "histogram", "spectrum", "cycles"
    double class_width = 10.;        ///< of the histogram [N]

    /// Lower and upper bound by quantity; empty: no bounds.
    std::map<std::string, std::vector<double>> expected;

    /// Names of the probes that the range of "Uplift" is for; empty: all displacements in m.
    std::vector<std::string> uplift_probes;

    /// Declares the members in subsection "Statistics".
    void declare_parameters(dealii::ParameterHandler &prm);

    /// Throws an EntryError if a limit of the mean force is incomplete.
    void check() const;

    bool has_table(const std::string &name) const;

    /// Where the largest mean force comes from if the supply says it; else empty.
    std::string source_of_largest_mean() const;

    /// Least and largest mean force at a speed [m/s], infinite without a limit; empty if
    /// neither limits it.
    std::vector<double> mean_force_range(double speed) const;

    /// Throws an EntryError if no sliding contact enters the window before @p end_time [s].
    void check_window(const Scene &scene, double end_time) const;

    /// Throws an EntryError if the scene lacks one of the `uplift_probes`, if one of them records
    /// no displacement in m, or if there is no range for them.
    void check_probes(const Scene &scene) const;

    /// Whether the range of "Uplift" is for a probe.
    bool has_uplift(const std::string &probe) const;

    /// Whether a position lies in the window, up to rounding.
    bool is_in_window(double position) const;
  };

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

  /// Figures of the contact force in the window beside ContactQuantities, as EN 50318 and EN 50367
  /// have them.
  struct ContactFigures
  {
    /// Standard deviation of the unfiltered force between two frequencies, by its power_spectrum().
    struct Band
    {
      double from, to;          ///< [Hz]
      double deviation = 0.;    ///< [N]
      bool is_resolved = false; ///< by steps shorter than a quarter of a period
    };
    std::array<Band, 4> bands = {{{0., 2.}, {0., 5.}, {5., 20.}, {0., 20.}}};

    /// Times without contact that are longer than a duration. They stand in for arcs, of which the
    /// model has none.
    struct Losses
    {
      double longer_than; ///< [s]
      std::size_t number = 0;
      double share = 0.; ///< of the samples
    };
    std::array<Losses, 3> losses = {{{5e-3}, {10e-3}, {20e-3}}};

    double height_range = 0.; ///< of the contact point along the direction of the contact [m]

    /// From a record at increasing @p times [s].
    static ContactFigures of(const ContactRecord &record, const std::vector<double> &times,
                             const StatisticsParameters &parameters);
  };

  /// Numbers of samples of the losses of contact, one after another: of the runs of zeros.
  std::vector<std::size_t> lengths_of_losses(const std::vector<double> &force);

  /// A histogram with equal classes.
  struct Histogram
  {
    double begin = 0., width = 0.; ///< of the first class
    std::vector<std::size_t> number;
  };

  /// Classes of @p width from the multiple of it below the smallest value to the largest one.
  Histogram histogram(const std::vector<double> &record, double width);
} // namespace taut

#endif
