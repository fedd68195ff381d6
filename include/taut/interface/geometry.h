// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_geometry_h
#define taut_geometry_h

#include <taut/substructure/structure.h>

#include <functional>
#include <string>
#include <vector>

namespace taut
{
  /// Where a constraint acts, if that changes with the time or with the motion. A fixed constraint
  /// has no Geometry: its linear form and its gap stay as they are.
  class Geometry
  {
  public:
    virtual ~Geometry() = default;

    /// Constraints keep their rows in the order of these kinds.
    enum class Kind
    {
      fixed,
      turning, ///< with its ends, see TurningDirection
      sliding  ///< along a body, see MovingPlace
    };
    virtual Kind kind() const = 0;

    /// What is wrong with it, for a message; empty: nothing.
    virtual std::string fault() const { return ""; }

    /// The linear forms that B_i is combined from, where they are the same at all times.
    virtual std::vector<const std::vector<Term> *> forms() const { return {}; }
  };

  /// The geometry of a constraint that slides: its linear form at each time. A place that depends
  /// on the motion is that of one Stepper.
  class MovingPlace : public Geometry
  {
  public:
    Kind kind() const final { return Kind::sliding; }

    /// Position on what it moves along at time @p t [s], for tables [m].
    virtual double position(double t) const = 0;

    /// B_i at time @p t [s]; throws an EntryError if the constraint has no place then.
    virtual std::vector<Term> terms(double t) const = 0;

    /// The derivative of B_i by time: what the motion of the place adds to D', but for that of the
    /// gap [1/s].
    virtual std::vector<Term> rates(double t) const = 0;

    /// D at U = 0, N = 0 [m].
    virtual double gap(double t) const = 0;

    /// B U of a linear form at a time near the start of a step, over all ranks [m].
    using Motion = std::function<double(const std::vector<Term> &form, double t)>;

    /// Before a step from @p start to @p end [s], of a place that depends on the motion of the
    /// bodies: takes the place that it will have. Called by all ranks together.
    virtual void follow(const Motion &, double /*start*/, double /*end*/) {}

    /// What follow() has found, for checkpoints and for steps that are taken back; empty: nothing
    /// yet.
    virtual std::vector<double> course() const { return {}; }
    virtual void set_course(const std::vector<double> &) {}
  };
} // namespace taut

#endif
