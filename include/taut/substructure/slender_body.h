// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_slender_body_h
#define taut_slender_body_h

#include <taut/substructure/substructure.h>

#include <memory>
#include <vector>

namespace taut
{
  /// What a body that is much stiffer along itself than across says beside Substructure: a base of
  /// its own.
  class SlenderBody
  {
  public:
    virtual ~SlenderBody() = default;

    /// The derivative of Substructure::displacement() at a place along the body by this place, that
    /// of x [1/m]: what a contact that slides along is displaced by.
    virtual LinearForm slope(double place, const Coordinates &direction) const = 0;

    /// EA [N]
    virtual double axial_stiffness() const = 0;

    /// The body with this EA instead, with the same DoFs and without its loads: searches of an
    /// equilibrium that begin far from it begin with softer bodies.
    virtual std::unique_ptr<Substructure> with_axial_stiffness(double EA) const = 0;

    /// The axial stiffnesses below @p EA that such a search goes through under a load [N]: the
    /// softest is 2 to 20 times the load, and they rise by factors of ten. Empty: begin with EA.
    static std::vector<double> softer_axial_stiffnesses(double EA, double load);

    /**
     * The body that takes the place of this one, which @p self owns, once the displacement U [m,
     * rad] is known that a run starts from: a linear one with the same DoFs, supports and loads,
     * with the internal force that this one has at U and its tangent there as K. nullptr: none
     * does. Throws EntryError if the body has no small motions about U.
     */
    virtual std::shared_ptr<Substructure> linearised(const std::shared_ptr<const Substructure> &,
                                                     const std::vector<double> &) const
    {
      return nullptr;
    }

    /// Whether linearised() will make a linear body, unless it throws.
    virtual bool is_to_be_linearised() const { return false; }

    /// A place that is under compression though the body resists tension only, and what then keeps
    /// the body in shape beside its inertia.
    struct Slack
    {
      double place = 0.;             ///< along the body [m]
      double bending_stiffness = 0.; ///< [N m^2]
      double axial_damping = 0.;     ///< [N s]
    };

    /// True if the body is slack at a displacement U [m, rad] from the undeformed body; then fills
    /// @p slack.
    virtual bool is_slack(const std::vector<double> &U, Slack &slack) const = 0;

    /// True if it is in tension at such a displacement, all but its ends, which may have none.
    virtual bool is_in_tension(const std::vector<double> &) const { return false; }

    /// Throws EntryError if the body is stretched more than it may be at rest, or has a free end
    /// that nothing keeps straight, at a displacement U from the undeformed body.
    virtual void check_at_rest(const std::vector<double> &U) const = 0;
  };
} // namespace taut

#endif
