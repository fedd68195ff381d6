// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_figure_recorder_h
#define taut_figure_recorder_h

#include <taut/output/statistics.h>
#include <taut/simulation/study_parameters.h>

#include <vector>

namespace taut
{
  /// One figure of a study from one run: a number, or a record over time and its root mean square.
  struct StudyFigure
  {
    double value = 0.;
    std::vector<double> time, history; ///< empty for a number

    bool is_history() const { return !time.empty(); }
  };

  /**
   * Difference of a figure to that of a finer run: of numbers its size; of histories the root mean
   * square of the difference at the times of @p figure, where @p reference is interpolated
   * linearly.
   */
  double distance(const StudyFigure &figure, const StudyFigure &reference);

  /// Records the figures of a study in a run, and how long the run took with its output.
  class FigureRecorder : public Observer
  {
  public:
    /// Throws EntryError if the scene has no such item or the item no such quantity.
    FigureRecorder(const StudyParameters &study, const StatisticsParameters &statistics,
                   const Scene &scene, const ContactRows &rows);

    void record(const StepView &step) override;

    /// In the order of the study.
    std::vector<StudyFigure> figures() const;

    const Certificate &worst_certificate() const { return statistics.worst_certificate(); }

  private:
    /// Where a figure comes from.
    struct Source
    {
      enum class Kind
      {
        number,       ///< `index` in Statistics::named_figures()
        force_of_row, ///< history of the force of row `index`
        probe         ///< history of probe `index`
      } kind = Kind::number;
      std::size_t index = 0;
      std::vector<double> history;
    };
    Source find(const StudyParameters::FigureItem &item, const std::string &title,
                const Scene &scene, const ContactRows &rows) const;

    Statistics statistics;
    std::vector<Source> sources;
    std::vector<double> times;
  };
} // namespace taut

#endif
