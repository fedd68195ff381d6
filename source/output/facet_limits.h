// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_facet_limits_h
#define taut_facet_limits_h

#include "model/surface_constraints.h"

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Counts straight faces on curves across a contact: n faces if the arcs that they are chords of
   * are 1 / n^2 of the gap or interference high, as in a contact of Hertz.
   *
   * - Degree 1: nodes are on the curve, and gaps are wrong by the heights of the master's arcs; at
   *   most a tenth is good. Meshes that match, most nodes opposite each other, are exact.
   * - Degree 2: middles of faces stand back behind the curve, and pressures alternate by 0.8 / n of
   *   the largest one: by 5 % for n = 16.
   */
  class FacetLimits
  {
  public:
    FacetLimits() = default;
    explicit FacetLimits(const ContactGeometry &geometry);

    /// Of the forces of the constraints [N]. The largest number in a run counts: a contact begins
    /// and ends at a node. Without any load it is that of the mean gap.
    void record(const double *forces);

    double faces() const { return (is_loaded ? loaded : unloaded).faces; }
    double least_faces() const { return least; }

    /// What is wrong and what to do, after the name of the contact.
    std::string text() const;

    /// Stores the largest number so far, for checkpoints.
    template <typename Archive>
    void store(Archive &archive)
    {
      archive &is_loaded &loaded.faces &loaded.gap &loaded.place;
    }

  private:
    struct Row
    {
      double height = 0., face = 0., gap = 0., area = 0.; ///< [m], [m^2]
      Coordinates place;
      unsigned int degree = 1;
      bool is_opposite = false; ///< node of the slave to one of the master
    };
    struct Found
    {
      double faces = 1e300, gap = 0.; ///< number, gap or interference [m]
      std::size_t place = 0;          ///< row of the largest height
    };
    Found find(const double *forces) const;

    std::vector<Row> rows;
    unsigned int degree = 1;
    double least = 0.; ///< 0: no straight faces on curves
    Found unloaded, loaded;
    bool is_loaded = false;
  };

  /// Longest line between neighbours in the list of nodes of a face, for each surface node [m].
  std::vector<double> element_lengths(const ContactSurface &surface);
} // namespace taut

#endif
