// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_traits_h
#define taut_body_traits_h

#include <taut/base/coordinates.h>
#include <taut/substructure/substructure.h>
#include <taut/substructure/symmetric_matrix.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A second base of a Substructure that is much stiffer along itself than across, such as a
  /// cable. It adds what contacts that slide, searches of an equilibrium and linearised scenes
  /// need.
  class SlenderBody
  {
  public:
    virtual ~SlenderBody() = default;

    /// The derivative of Substructure::displacement() with respect to the place x along the body
    /// [1/m]. A contact that slides along the body needs it.
    virtual LinearForm slope(double place, const Coordinates &direction) const = 0;

    /// EA [N]
    virtual double axial_stiffness() const = 0;

    /// A copy of the body with this EA, with the same DoFs and loads. A search that begins far from
    /// the equilibrium begins with softer bodies.
    virtual std::unique_ptr<Substructure> with_axial_stiffness(double EA) const = 0;

    /// The axial stiffnesses below @p EA that such a search goes through under a load [N]: the
    /// softest is 2 to 20 times the load, and they rise by factors of ten. Empty: begin with EA.
    static std::vector<double> softer_axial_stiffnesses(double EA, double load);

    /**
     * The linear body that replaces this body once the displacement U [m, rad] at the start of a
     * run is known. It has the same DoFs, supports and loads, the internal force
     * of this body at U, and the tangent at U as K. nullptr: the body is not replaced. Throws
     * EntryError if the body has no small motions about U.
     */
    virtual std::shared_ptr<Substructure> linearised(const std::vector<double> &) const
    {
      return nullptr;
    }

    /// Whether linearised() will make a linear body, unless it throws.
    virtual bool is_to_be_linearised() const { return false; }

    /// A place under compression in a body that resists tension only, and the properties that keep
    /// the body in shape there beside inertia.
    struct Slack
    {
      double place = 0.;             ///< along the body [m]
      double bending_stiffness = 0.; ///< [N m^2]
      double axial_damping = 0.;     ///< [N s]
      bool is_straight = false;      ///< it pushes along a line, which only a disturbance ends
      double disturbance = 0.;       ///< size of that [m]
    };

    /// True if the body is slack at a displacement U [m, rad] from the undeformed body; then fills
    /// @p slack.
    virtual bool is_slack(const std::vector<double> &U, Slack &slack) const = 0;

    /// Moves what is straight and pushes at a displacement U [m, rad] a little across its line,
    /// where it gives way to the forces of a step.
    virtual void disturb(std::vector<double> & /*U*/) const {}

    /// True if the body is in tension at a displacement U [m, rad]. Its ends may be without
    /// tension.
    virtual bool is_in_tension(const std::vector<double> &) const { return false; }

    /// Throws EntryError if, at a displacement U from the undeformed body, the body exceeds its
    /// largest strain at rest, or has a free end that nothing keeps straight.
    virtual void check_at_rest(const std::vector<double> &U) const = 0;
  };

  /// Strains above this are not small: terms of second order change stresses by some five per cent.
  constexpr double small_strain = .05;

  /// How a body, or a part of it, is strained.
  struct Straining
  {
    double energy = 0.; ///< of the strains [J]
    double large = 0.;  ///< the part of it where a principal strain exceeds small_strain [J]

    /// The part of it that elements with all modes of bending would not store under the same
    /// displacement of their nodes; of simplices an estimate from the energy that they lack [J].
    double locked = 0.;

    double strain = 0.; ///< the largest magnitude of a principal strain
    Coordinates place;  ///< of this strain [m]
  };

  /// A second base of a Substructure of small strains, so that a run warns of strains that are
  /// large and of elements that lock.
  class StrainedBody
  {
  public:
    virtual ~StrainedBody() = default;

    /// At a displacement U from the undeformed body [m].
    virtual Straining straining(const std::vector<double> &U) const = 0;
  };

  /// A second base of a Substructure that may be one part of a body that is cut, so that a rank
  /// draws all of its parts of the body in one file.
  class PartOfBody
  {
  public:
    virtual ~PartOfBody() = default;

    struct Drawn
    {
      const PartOfBody *part;
      const std::vector<double> *U; ///< displacement from the undeformed body
    };

    /// Paths of the files that a rank writes, and names of the pieces without a folder.
    struct Files
    {
      std::string own;                      ///< the .vtu file
      std::string joined = {};              ///< path of the .pvtu file; empty: none is written
      std::vector<std::string> pieces = {}; ///< the .vtu files of all ranks, which it joins
    };

    /// True if one write_vtu() may draw both.
    virtual bool is_drawn_with(const PartOfBody &other) const = 0;

    /// Writes parts of one body, this one among them, as Substructure::write_vtu().
    virtual void write_vtu(const Files &files, const std::vector<Drawn> &parts) const = 0;
  };

  /// A second base of a Substructure with inner constraints that move with it, such as a rigid
  /// body. Impulses then meet the mass matrix together with these constraints.
  class ConstrainedBody
  {
  public:
    virtual ~ConstrainedBody() = default;

    /// M [kg, kg m^2] and the conditions on velocities at the displacement U [m, rad] from the
    /// undeformed body, with the pattern of K. The local solver of the body factors this matrix.
    virtual std::unique_ptr<SymmetricMatrix> mass_at(const std::vector<double> &U) const = 0;
  };
} // namespace taut

#endif
