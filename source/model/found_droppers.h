// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_found_droppers_h
#define taut_found_droppers_h

#include "model/shared_parts.h"
#include <taut/base/communicator.h>
#include <taut/scene/scene.h>
#include <taut/time/step_parameters.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace taut
{
  /// A dropper whose length is found, or of a given length and only its direction. With a pull it
  /// is a rope whose ends are apart by `run` across its direction: a spring of constant force
  /// density.
  struct FoundDropper
  {
    Link link;           ///< with the `length` that its mass has [m]
    Coordinates between; ///< from end to end, undeformed [m]
    double run = 0.;     ///< 0: no rope [m]

    bool is_rope() const { return run > 0.; }
    bool is_given() const { return link.unstressed_length > 0.; }

    /// Of a rope: tension over length [N/m].
    double force_density() const { return link.form.pull / run; }

    /// With a distance of its ends across `run` [m].
    double length_over(const double extent) const { return std::hypot(extent, run); }
  };

  /// Whether form finding changes a link.
  inline bool is_found(const Link &link)
  {
    return (link.form.find_length || link.form.find_direction) && !link.moving();
  }

  /// Links of a scene that are found, in their order. Throws EntryError for a rope without a run.
  std::vector<FoundDropper> found_droppers(const Scene &scene);

  /// Half of the mass of a dropper on each of its ends.
  void add_mass(const Link &link, Scene &scene);

  /// Tensions and lengths of the droppers between the parts of a scene without them; links get the
  /// lengths. Called by all ranks together.
  DropperForm find_form(const Scene &base, std::vector<FoundDropper> &droppers,
                        const SolverParameters &parameters, const Communicator &processes);

  /// Length, stiffness, direction and gap of @p link of @p scene, which is number @p i of the form.
  void take_form(const Scene &scene, const FoundDropper &dropper, const DropperForm &form,
                 std::size_t i, Link &link);
} // namespace taut

#endif
