// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_support_figures_h
#define taut_support_figures_h

#include <taut/output/observer.h>
#include <taut/scene/scene.h>

#include <cmath>
#include <cstddef>
#include <string>
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

  /// Figures of the forces or moments of supports on their wires, with the signs of Reactions.
  class SupportFigures
  {
  public:
    /// One of the support_points().
    struct Figures
    {
      std::string name, wire;
      double position = 0.;  ///< on its wire [m]
      std::string unit;      ///< "N" or "N m"
      double at_start = 0.;  ///< of the run
      LinkForce window = {}; ///< over the steps in the window, by their lengths
      std::size_t n_samples = 0;
    };

    SupportFigures(const Scene &scene);

    /// Adds the @p reactions [N, N m] of the end of a step of @p dt [s]; 0: of the start.
    void record(const std::vector<double> &reactions, double dt, bool in_window);

    const std::vector<Figures> &of_supports() const { return figures; }

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      for (Figures &f : figures)
        archive &f.at_start &f.window &f.n_samples;
    }

  private:
    std::vector<Figures> figures;
  };
} // namespace taut

#endif
