// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_turning_at_rest_h
#define taut_turning_at_rest_h

#include <taut/interface/constraints.h>
#include <taut/time/static_equilibrium.h>

#include <memory>
#include <vector>

namespace taut
{
  /**
   * The constraints for the iterations of a search of an equilibrium: those that turn become linear
   * about the last displacements, D + B (U - U_i), and have their geometric stiffness N / |Delta|
   * across them, as two springs without force at U_i, if they pull. As long as directions change, a
   * part of the loads stands in for N, along them, too, so that no iteration goes far. All
   * functions are called by all ranks together.
   */
  class TurningAtRest
  {
  public:
    /// The arguments are kept by reference; @p load is the sum of the loads [N].
    TurningAtRest(const Structure &structure, const Constraints &constraints, double load);

    bool empty() const { return !all.has_turning(); }

    /// Begins a search at displacements @p U.
    void begin(const BodyVectors &U);

    /// For one iteration: in the order of the given ones, then the springs.
    const Constraints &constraints() const { return empty() ? all : *linear; }

    /// By how much the result of an iteration misses its own directions and gaps: changes of
    /// directions [1], gaps over |Delta|, of constraints that carry a force or should.
    double change(const StaticState &state);

    /// Goes on from a state.
    void go_on(const StaticState &state);

    /// The state of the given constraints: without the springs.
    void finish(StaticState &state) const;

    /// D of the given constraints, without springs [m].
    std::vector<double> gaps(const BodyVectors &U) const;

  private:
    void set(const BodyVectors &U, const std::vector<double> &N);
    void add_spring(const ConstraintData &of, const Coordinates &direction, double stiffness,
                    const Coordinates &motion, std::vector<ConstraintData> &list) const;

    const Structure &structure;
    const Constraints &all;
    const BodyVectors undeformed;
    double load;
    double turned = 1.;                  ///< largest change of a direction in the last iteration
    std::vector<Coordinates> directions; ///< of the last displacements
    std::unique_ptr<Constraints> linear;
    std::vector<std::size_t> source; ///< constraint that a spring belongs to
  };
} // namespace taut

#endif
