// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_catenary_items_h
#define taut_catenary_items_h

#include <taut/scene/named_items.h>
#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// A formula in s = x, e.g. 's/10 + table(FILE.csv, column, s)', as one in the s of a wire that
  /// begins at x = @p begin [m]. With @p is_of_s a table is of s where it does not say of what.
  std::string along_wire(const std::string &formula, double begin, bool is_of_s = false);

  /// A wire of an overhead line, without its places.
  struct LineWireItem
  {
    std::string model = "beam";
    double mass_per_length, tension, bending_stiffness, element_size;
    double mass_damping = 0.0125, stiffness_damping = 1e-4;
    unsigned int degree = 2;
    std::string wind = "0", vertical_load = "0";
    std::string remaining_mass = "1", remaining_bending = "1";

    /// Whether the parameter file says them: they have no silent default.
    bool has_mass = false, has_tension = false;

    void declare(dealii::ParameterHandler &prm, const std::string &section, bool has_wind);

    /// Throws EntryError unless mass and tension are given; @p usual has those of a known line.
    void check_given(const std::string &section, const LineWireItem &usual,
                     const std::string &known_line) const;

    /// From a to b; @p section is that of the item.
    Wire wire(const std::string &name, const std::string &section, const Coordinates &a,
              const Coordinates &b) const;

    /// Of a tension length that begins at x = @p begin [m], over s on its wire.
    Expression wind_load(const std::string &section, double begin = 0.) const;
    Expression load_along_y(const std::string &section, double begin = 0.) const;
  };

  /// What holds the wires at the inner masts.
  struct LineSupportsItem
  {
    std::string messenger_stiffness = "rigid";
    double messenger_damping = 0.;
    std::string arm_kind = "point mass";
    double arm_mass = 1., arm_stiffness = 0., arm_damping = 0.;
    double arm_reach = 1., arm_rise = .2; ///< of a rigid body

    bool has_rigid_arms() const { return arm_kind == "rigid body"; }
    void declare(dealii::ParameterHandler &prm);
  };

  /// The droppers of an overhead line, without their places and lengths.
  struct LineDropperItem
  {
    std::string stiffness = "100000";
    double damping = 0., axial_stiffness = 0., mass_per_length = 0.;
    double messenger_clamp_mass = 0., contact_clamp_mass = 0.;
    void declare(dealii::ParameterHandler &prm);
  };

  /// Masses on a wire of an overhead line, such as insulators and clamps.
  struct LineMassItem
  {
    std::string wire = "contact", positions;
    double mass = 0.;
    void declare(dealii::ParameterHandler &prm);
  };

  /// The two ropes from the messenger wire to a contact wire at a mid-point.
  struct LineMidPointItem
  {
    double pull = 0., axial_stiffness = 0., mass_per_length = 0., messenger_distance = 0.;
    void declare(dealii::ParameterHandler &prm);
  };

  /// All that the tension lengths of an overhead line share.
  struct LineItems
  {
    bool is_rail = false; ///< a contact wire without a messenger wire
    unsigned int n_contact_wires = 1;
    bool hangs_in_turn = false; ///< droppers hold two contact wires in turn, not both
    LineWireItem contact{"beam", 1.35, 20000., 195., .5},
        messenger{"beam", 1.07, 16000., 131.7, .5}, stitch{"beam", .34, 3500., 0., .5};
    LineSupportsItem supports;
    LineDropperItem droppers;
    LineMidPointItem mid_point;
    NamedItems<LineMassItem> masses{"Catenary", "Point masses", "Point mass",
                                    "masses on the wires, e.g. insulators and clamps"};
    bool lateral = false;        ///< as an entry; see is_in_space
    std::string curvature = "0"; ///< of the track over x [1/m]
    std::string cant = "0";      ///< its angle across, over x [rad]

    /// As LineWireItem::wind_load().
    Expression track_curvature(double begin = 0.) const;
    Expression track_cant(double begin = 0.) const;

    /// Wires move along z, too.
    bool is_in_space = false;
  };
} // namespace taut

#endif
