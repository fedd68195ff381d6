// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_model_limits_h
#define taut_model_limits_h

#include "output/linear_forms.h"
#include "output/solid_limits.h"
#include <taut/base/warning.h>
#include <taut/output/observer.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Checks assumptions of the equations: small slopes, wires that do not pass each other, contacts
   * slower than waves, and steps that resolve the filter of the statistics. The worst case of each
   * kind in a run is kept.
   *
   * - A slope of 0.1 rad stretches a wire by slope^2 / 2 = 0.5 %, which the equations neglect: a
   *   copper wire of 100 mm^2 would gain 60 kN of tension. All motions across the wire count, also
   *   lateral ones. For a linearised cable it is the change of direction since the state of
   *   linearisation, for a linear one since its shape at rest.
   * - Two wires above each other at the start, without a link that pushes them apart, must not come
   *   closer by more than their distance.
   * - A rigid body that tilts by more than 1 rad from its given place to the equilibrium may have
   *   fallen off its supports.
   * - Waves of a wire run at sqrt(T / m); nothing runs ahead of a faster contact.
   * - A peak that is sampled n times a period is found up to 1 - cos(pi / n) of its height: 5 % for
   *   n = 10.
   */
  class ModelLimits : public Observer
  {
  public:
    /// Samples places every @p interval steps. Compares @p step [s] with @p filter_frequency [Hz],
    /// 0: no filter. Called by all ranks together.
    ModelLimits(const Scene &scene, const SceneBodies &structure, double filter_frequency,
                double step, long interval);

    /// Records the start, then each step. Throws the errors of SolidLimits::record(). Called by all
    /// ranks together.
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// At most one warning of each kind.
    std::vector<Warning> warnings() const;

    /// A line for each warning, and the nodes that searches of contacts left out.
    void report(std::ostream &log, bool failed) const override;

  private:
    /// Samples along a wire or a cable, or along the overlap of two wires.
    struct Line
    {
      std::string name, other;       ///< "wire 'contact'"
      std::size_t first = 0, n = 0;  ///< samples
      std::vector<double> positions; ///< on the wire [m]
      std::vector<double> distances; ///< to the wire above; empty: checks slopes [m]

      /// Forms of all samples, direction by direction: directions across a wire, or x, y, z.
      unsigned int n_directions = 1;
      std::vector<Coordinates> chords;   ///< of a cable, from sample to sample [m]
      bool turns_from_reference = false; ///< chords are those of the reference, not those at U = 0
    };

    /// Worst case of a kind so far.
    struct Extreme
    {
      double excess = 0.; ///< value over limit
      double value = 0., limit = 0., position = 0., time = 0.;
      std::size_t line = 0;
    };

    template <typename Archive>
    void store(Archive &archive);
    void add_slopes(const Scene &scene, const SceneBodies &structure);
    void add_cables(const Scene &scene, const SceneBodies &structure);
    void take_chords_at_reference(const Communicator &processes);
    double slope_after(const Line &line, const double *u, std::size_t sample) const;
    bool may_exceed(const Line &line, const double *u) const;
    void add_distances(const Scene &scene, const SceneBodies &structure);
    void record_turned_bodies(const StepView &step);
    void compare_speeds(const Scene &scene);
    void compare_filter(const Scene &scene, double frequency, double step);

    long interval, n_calls = 0;
    LinearForms forms;
    std::vector<Line> lines;
    std::vector<double> at_reference, values;
    Extreme slope, distance, turned;
    std::string turned_body;
    std::vector<Warning> constant; ///< known before the first step
    SolidLimits solids;
  };
} // namespace taut

#endif
