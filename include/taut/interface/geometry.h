// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_geometry_h
#define taut_geometry_h

#include <taut/substructure/structure.h>

#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /// The place of a constraint that depends on time or motion. A fixed constraint has no Geometry:
  /// its linear form and gap are constant.
  class Geometry
  {
  public:
    virtual ~Geometry() = default;

    /// Constraints order their rows by these kinds.
    enum class Kind
    {
      fixed,
      turning, ///< turns with its ends, see TurningDirection
      sliding  ///< slides along a body, see MovingPlace
    };
    virtual Kind kind() const = 0;

    /// Error in the geometry, for a message; empty: none.
    virtual std::string fault() const { return ""; }

    /// The linear forms that combine to B_i, if they are constant.
    virtual std::vector<const std::vector<Term> *> forms() const { return {}; }
  };

  /// The geometry of a sliding constraint: its linear form at each time. A place that depends on
  /// the motion belongs to one Stepper only.
  class MovingPlace : public Geometry
  {
  public:
    Kind kind() const final { return Kind::sliding; }

    /// Position on its body at time @p t [s], for tables [m].
    virtual double position(double t) const = 0;

    /// Appends the terms of B_i at time @p t [s] to @p terms. Throws an EntryError if the
    /// constraint has no place then.
    virtual void append_terms(double t, std::vector<Term> &terms) const = 0;

    /// Appends the time derivative of B_i: the part of D' by motion of the place, without that of
    /// the gap [1/s].
    virtual void append_rates(double t, std::vector<Term> &terms) const = 0;

    /// D at U = 0, N = 0 [m].
    virtual double gap(double t) const = 0;

    /// Whether the body has not begun at the place at time @p t [s], or has ended: the constraint
    /// is open then. Its terms and gap are those at this end of the body.
    virtual bool is_beyond(double /*t*/) const { return false; }

    /// B U of a linear form at a time near the start of a step, over all ranks [m].
    using Motion = std::function<double(const std::vector<Term> &form, double t)>;

    /// Before a step from @p start to @p end [s]: predicts the place if it depends on the motion of
    /// the bodies. Called by all ranks together.
    virtual void follow(const Motion &, double /*start*/, double /*end*/) {}

    /// Appends the result of follow(), for checkpoints and repeated steps; nothing: none yet.
    virtual void append_course(std::vector<double> &) const {}
    virtual void set_course(const std::vector<double> &) {}
  };
} // namespace taut

#endif
