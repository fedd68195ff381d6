// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tension_length_h
#define taut_tension_length_h

#include "scene/catenary_items.h"
#include "scene/line_geometry.h"

#include <taut/scene/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /**
   * One tension length of an overhead line in a scene: one or two contact wires that hang on
   * droppers under a messenger wire, and on stitch wires at its masts. The wires are straight at U
   * = 0, and their heights are displacements.
   */
  class TensionLength
  {
  public:
    /// @p name is empty for the only one. @p section has its geometry. Adds its wires.
    TensionLength(const LineItems &items, const LineLayout &layout, const std::string &name,
                  const std::string &section, Scene &scene);

    /// Throws EntryError for a geometry that is impossible.
    void check() const;

    void add_supports();
    void add_point_masses();

    /// Those that a point mass is on, where it is beside them.
    std::vector<std::size_t> wires_of(const LineMassItem &item) const;

    /// Probes of the contact wire at places x [m], or at all inner masts; those beyond its ends are
    /// left out.
    void add_probes(const std::vector<double> &x);

    void add_vertical_loads();

    /// Stagger, wind and the curve of the track.
    void add_lateral();
    void add_stitch_wires();
    void add_droppers();

    /// Two ropes at each mid-point, which pull the messenger wire and each contact wire together.
    void add_mid_points();

    const std::vector<std::size_t> &contact_wires() const { return contacts; }
    const LineLayout &layout() const { return line; }
    double begin() const { return line.begin; }
    double end() const { return line.begin + line.length(); }

  private:
    /// Index of the wire that carries the droppers at a place, and the position there.
    Attachment carrier(double x) const;

    /// Supports at places s of a wire, at displacements from its straight line [m].
    void hold(Support support, const std::vector<double> &s,
              const std::vector<double> &displacement);
    void add_arms(std::size_t contact, const std::vector<double> &masts);
    void add_rigid_arm(std::size_t contact, std::size_t mast);
    void add_dropper(const LineDropper &dropper, double height, const std::string &dropper_name,
                     std::size_t contact);
    /// @p is_held says at which masts.
    void add_curvature(std::size_t wire);
    void add_load(std::size_t wire, const std::string &what, const Expression &magnitude,
                  const Coordinates &direction);
    void hold_aside(std::size_t wire, const std::string &name, double LineMast::*stagger,
                    const std::function<bool(std::size_t)> &is_held);
    void check_droppers() const;
    void check_mid_points() const;
    void check_rail() const;
    std::string named(const std::string &what) const;

    const LineItems &items;
    const LineLayout line;
    const std::string name, section;
    Scene &scene;
    std::size_t messenger = 0;         ///< wire of the scene
    std::vector<std::size_t> contacts; ///< wires of the scene
    std::vector<std::size_t> stitches; ///< wire at each mast; `ground`: none
  };
} // namespace taut

#endif
