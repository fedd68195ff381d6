// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_geometry_h
#define taut_geometry_h

#include <taut/base/coordinates.h>
#include <taut/substructure/structure.h>

#include <array>
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

    /// The part of the gap that a formula or table gives, at any time and without communication
    /// [m].
    virtual double profile(const double t) const { return gap(t); }

    /// B U of a linear form at a time near the start of a step, over all ranks [m].
    using Motion = std::function<double(const std::vector<Term> &form, double t)>;

    /// Before a step from @p start to @p end [s]: predicts the place if it depends on the motion of
    /// the bodies. Called by all ranks together.
    virtual void follow(const Motion &, double /*start*/, double /*end*/) {}

    /// Appends the result of follow(), for checkpoints and repeated steps; nothing: none yet.
    virtual void append_course(std::vector<double> &) const {}
    virtual void set_course(const std::vector<double> &) {}
  };

  /// An end of a turning constraint, or a ring that it runs through: a place of a body, or of the
  /// ground if it has no motion.
  struct LinkEnd
  {
    Coordinates position;                         ///< at U = 0, the same on all ranks [m]
    std::array<std::vector<Term>, 3> motion = {}; ///< along x, y, z, on bodies of this rank [m]
  };

  /**
   * The geometry of a constraint that turns with its ends and acts along the line between them, or
   * along the lines through rings without friction, as a rope over pulleys. Delta of a segment goes
   * from one place to the next; with the sum over the segments,
   *
   *     D = sign (sum |Delta| - length),    Delta = start + motion of the places.
   *
   * B_i is sign times the sum of d . motion of Delta along directions d of the segments;
   * d = Delta / |Delta| for forces at one state. All segments have the force N.
   */
  class TurningDirection : public Geometry
  {
  public:
    /// Through two places or more, in their order; the length is that at U = 0. @p push: see
    /// @ref sign.
    TurningDirection(std::vector<LinkEnd> places, double push);

    std::vector<LinkEnd> places;    ///< its ends, and rings between them
    std::vector<Coordinates> start; ///< Delta of each segment at U = 0, the same on all ranks [m]
    double length = 1.;             ///< sum |Delta| at D = 0, positive; at t = 0 if it changes [m]

    /// Number of segments.
    std::size_t size() const { return start.size(); }

    /// The length over time [s], positive, as a winch reels it in and out; empty: it is constant
    /// [m].
    std::function<double(double)> length_at = {};
    double sign = 1.; ///< 1: N > 0 pushes the ends apart; -1: it pulls them together

    Kind kind() const override { return Kind::turning; }
    std::string fault() const override;
    std::vector<const std::vector<Term> *> forms() const override;

    /// Sum of |Delta| of all segments, and D without a spring at t = 0 [m].
    double distance(const Coordinates *differences) const;
    double gap(const Coordinates *differences) const
    {
      return sign * (distance(differences) - length);
    }

    /// The part of the length that a segment has at U = 0 [m].
    double length_of(const std::size_t segment) const
    {
      return length * (norm(start[segment]) / distance(start.data()));
    }

    /// What a change of the length from one time to another adds to D, 0 if it is constant [s, m].
    double reeled(const double from, const double to) const
    {
      return length_at ? sign * (length_at(from) - length_at(to)) : 0.;
    }

    /// Its rate at the end of a step of this length, from differences within the step [s, m/s].
    double reel_rate(double t, double step) const;

    /// True if the ends of a segment are closer than a millionth of the length: it has no
    /// direction.
    bool vanishes(const Coordinates &difference) const
    {
      constexpr double least_part = 1e-6; // a direction would have lost six digits
      return !(norm(difference) > least_part * length);
    }

    /// Delta / |Delta| of a segment; where it vanishes, the direction at U = 0.
    Coordinates at(std::size_t segment, const Coordinates &difference) const;

    /// The constraint, linearised at a state: D = terms . U + gap.
    struct Linear
    {
      std::vector<Coordinates> directions; ///< of the segments at the state
      std::vector<double> distances;       ///< |Delta| of the segments at the state [m]
      std::vector<Term> terms;
      double gap; ///< [m]
    };

    /// Linearises at the state Delta = start + motion of each segment [m].
    Linear linearised(const Coordinates *motions) const;

    /// Motion of Delta of one segment along a direction, with one term for each body of each place.
    std::vector<Term> along(std::size_t segment, const Coordinates &direction) const;
  };

  /// Two unit vectors normal to the unit vector @p d and to each other.
  std::array<Coordinates, 2> across(const Coordinates &d);
} // namespace taut

#endif
