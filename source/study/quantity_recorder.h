// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_quantity_recorder_h
#define taut_quantity_recorder_h

#include <taut/output/statistics.h>
#include <taut/simulation/study_parameters.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  class Simulation;

  /// One quantity of a study from one run: a number, or a record over time and its root mean
  /// square.
  struct StudyQuantity
  {
    double value = 0.;
    std::vector<double> time, history; ///< empty for a number

    bool is_history() const { return !time.empty(); }
  };

  /**
   * Distance of a quantity from that of a finer run: the size of the difference for numbers. For
   * histories it is the root mean square of the difference at the times of @p quantity, with linear
   * interpolation of @p reference.
   */
  double distance(const StudyQuantity &quantity, const StudyQuantity &reference);

  /// Quantities of the statistics of a run so far, then those of its other observers.
  std::vector<NamedQuantity> quantities_of(const Simulation &simulation);

  /// Records the quantities of a study in a run, and how long the run took with its output.
  class QuantityRecorder : public Observer
  {
  public:
    /// @p simulation is kept by reference. Throws EntryError if its scene lacks an item of the
    /// study, or the item lacks the quantity.
    QuantityRecorder(const StudyParameters &study, const Simulation &simulation);

    void record(const StepView &step) override;

    /// The quantities, in the order of the study.
    std::vector<StudyQuantity> study_quantities() const;

  private:
    /// The source of a quantity.
    struct Source
    {
      enum class Kind
      {
        number,         ///< `index` in quantities_of()
        force_of_links, ///< history of the force of `links`, of a strip or a sum all of its own
        probe,          ///< history of probe `index`
        support         ///< history of the force of support point `index`
      } kind = Kind::number;
      std::size_t index = 0;
      std::vector<std::size_t> links = {};
      std::vector<double> history = {};
    };
    Source find(const StudyParameters::QuantityItem &item, const std::string &title) const;

    const Simulation &simulation;
    std::vector<Source> sources;
    std::vector<double> times;
  };

  /**
   * Entries of section Study with quantities of interest, "Study/Quantities=...", for a scene that
   * names none. @p known are the quantities of any run of the scene, those that are 0 are left out.
   * Sliding contacts have mean and standard deviation, with the largest motion of probes. Without
   * them it is the extremes of probes. Without probes it is the link with the largest force, and
   * its impulse. Throws EntryError on Study/Quantities if nothing is left.
   */
  std::vector<std::string> default_quantities(const std::vector<NamedQuantity> &known);
} // namespace taut

#endif
