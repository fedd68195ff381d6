// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_reference_h
#define taut_hunt_reference_h

#include "linear_model.h"
#include "scenes.h"

namespace hunt
{
  /// How far two histories are apart, relative to the largest values of the first.
  struct Difference
  {
    double place = 0., impulse = 0., energy = 0.;
  };

  /// Bounds of the promise, fixed before the first hunt.
  constexpr double place_bound = .02, impulse_bound = .02, energy_bound = .05;

  /// Places are compared at the same times. Impulses and energies jump at an impact, and the bound
  /// of the places lets it be early or late by what the fastest place takes for so much motion:
  /// those of the run may be anything that the reference has within this time, or within a step.
  /// The times of the run are the first ones of the reference.
  Difference difference(const History &reference, const History &run);

  /// Rigid unilateral constraints that repeat another one share its impulse in any way: gives it to
  /// the first of them.
  void join_repeated(const LinearModel &model, History &history);

  /// Two references of one scene, one disturbed: what they do not agree about is chaos.
  struct Reference
  {
    History history;
    bool has_places = true, has_sums = true; ///< impulses and energies
    std::string missing;                     ///< why there is none; empty: there is one
  };

  /// The motion of a scene at the times of a run and a little longer; @p chosen is its log.
  Reference make_reference(const HuntScene &scene, const LinearModel *model,
                           const std::vector<double> times, const std::string &chosen);

  /// Samples of a run of the program, as it goes; and its model, once it has one.
  class Recorder
  {
  public:
    explicit Recorder(double frequency, const Pulse &pulse = {})
        : frequency(frequency), pulse(pulse)
    {
    }
    void operator()(const taut::StepView &view);

    History history;
    std::unique_ptr<LinearModel> model;

  private:
    double frequency;
    Pulse pulse;
    std::vector<double> impulse, multiplier;
  };
} // namespace hunt

#endif
