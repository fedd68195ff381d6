// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_figures_h
#define taut_contact_figures_h

#include <taut/output/contact_quantities.h>

#include <array>
#include <vector>

namespace taut
{
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
