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

  /// An end of a turning constraint: a place of a body, or of the ground if it has no motion.
  struct LinkEnd
  {
    Coordinates position;                         ///< at U = 0, the same on all ranks [m]
    std::array<std::vector<Term>, 3> motion = {}; ///< along x, y, z, on bodies of this rank [m]
  };

  /**
   * The geometry of a constraint that turns with its ends and acts along the line between them:
   *
   *     D = sign (|Delta| - length),    Delta = start + motion . U.
   *
   * B_i is sign times d . motion along a direction d; d = Delta / |Delta| for forces at one state.
   */
  class TurningDirection : public Geometry
  {
  public:
    /// From end to end; the length is their distance at U = 0. @p push: see @ref sign.
    TurningDirection(const LinkEnd &first, const LinkEnd &second, double push);

    LinkEnd first;

    /// Motion along x, y, z of the second end, then minus that of the first, on this rank [m].
    std::array<std::vector<Term>, 3> motion;
    Coordinates start;  ///< Delta at U = 0, the same on all ranks [m]
    double length = 1.; ///< |Delta| at D = 0, positive; at t = 0 where it changes [m]

    /// The length over time [s], positive, as a winch reels it in and out; empty: it is constant
    /// [m].
    std::function<double(double)> length_at = {};
    double sign = 1.; ///< 1: N > 0 pushes the ends apart; -1: it pulls them together

    Kind kind() const override { return Kind::turning; }
    std::string fault() const override;
    std::vector<const std::vector<Term> *> forms() const override;

    /// D without a spring at t = 0, at the difference of the ends [m].
    double gap(const Coordinates &difference) const { return sign * (norm(difference) - length); }

    /// What a change of the length from one time to another adds to D, 0 if it is constant [s, m].
    double reeled(const double from, const double to) const
    {
      return length_at ? sign * (length_at(from) - length_at(to)) : 0.;
    }

    /// Its rate at the end of a step of this length, from differences within the step [s, m/s].
    double reel_rate(double t, double step) const;

    /// True if the ends are closer than a millionth of the length: they have no direction.
    bool vanishes(const Coordinates &difference) const
    {
      constexpr double least_part = 1e-6; // a direction would have lost six digits
      return !(norm(difference) > least_part * length);
    }

    /// Delta / |Delta|; where it vanishes, the direction at U = 0.
    Coordinates at(const Coordinates &difference) const;

    /// The constraint, linearised at a state: D = terms . U + gap.
    struct Linear
    {
      Coordinates direction; ///< of the link at the state
      double distance;       ///< |Delta| at the state [m]
      std::vector<Term> terms;
      double gap; ///< [m]
    };

    /// Linearises at the state Delta = start + @p motion [m].
    Linear linearised(const Coordinates &motion) const;

    /// Motion along a direction, with one term for each body of each end.
    std::vector<Term> along(const Coordinates &direction) const;
  };

  /// Two unit vectors normal to the unit vector @p d and to each other.
  std::array<Coordinates, 2> across(const Coordinates &d);
} // namespace taut

#endif
