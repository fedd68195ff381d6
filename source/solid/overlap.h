// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_overlap_h
#define taut_overlap_h

#include "solid/surface_geometry.h"
#include <taut/solid/contact_constraints.h>

#include <functional>
#include <memory>

namespace taut
{
  /// How deep two bodies are in each other, from all faces of their boundaries.
  class Overlap
  {
  public:
    /// Keeps references.
    Overlap(const SurfaceGeometry &slave, const SurfaceGeometry &master,
            const WholeBoundaries &boundaries);
    ~Overlap();

    /// No overlap is closed over more than this: half of the diagonal of the smaller body [m].
    double reach() const { return limit; }

    /// Whether a contact closes the distance between places of both sides, each behind the other:
    /// it is at most half of the thickness of the thinner body on the line through both. Otherwise
    /// the overlap is deeper, or there is none: one place is on the far side of its body.
    bool is_closed(const Coordinates &slave, const Coordinates &master) const;

    /// Throws the UserError for a place of the slave that is in the master too deeply, below a face
    /// whose normal it @p faces. A place that is nearer to another side of the master may be in it
    /// by a contact of that side: it counts if the bodies have @p no_contact.
    void check(const Coordinates &slave,
               const std::function<bool(const Coordinates &normal)> &faces, bool no_contact) const;

  private:
    struct Boundaries;
    const Boundaries &boundaries() const;

    const SurfaceGeometry &slave, &master;
    const WholeBoundaries whole;
    double limit;
    mutable std::unique_ptr<const Boundaries> made; ///< at the first overlap
  };
} // namespace taut

#endif
