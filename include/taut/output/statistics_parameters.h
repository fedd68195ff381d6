// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_statistics_parameters_h
#define taut_statistics_parameters_h

#include <taut/scene/scene.h>

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
} // namespace taut

#endif
