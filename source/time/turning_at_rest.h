// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_turning_at_rest_h
#define taut_turning_at_rest_h

#include <taut/interface/constraints.h>
#include <taut/substructure/structure.h>
#include <taut/time/static_equilibrium.h>

#include <memory>
#include <vector>

namespace taut
{
  class StaticStep;

  /**
   * The constraints for the iterations of a search of an equilibrium: those that turn become linear
   * about the last displacements, D + B (U - U_i), and have their geometric stiffness N / |Delta|
   * across them, as two springs without force at U_i, if they pull. As long as directions change, a
   * part of the loads stands in for N, along them, too, so that no iteration goes far.
   *
   * The geometric stiffness of those that push is negative, and left out of the iterations. A state
   * that they end in is checked for stability: with springs +|N| / |Delta| across these links in
   * place of -|N| / |Delta|, the state is stable if -2 |N| / |Delta| more leaves the structure
   * definite. All functions are called by all ranks together.
   */
  class TurningAtRest
  {
  public:
    /// The arguments are kept by reference; @p load is the sum of the loads [N].
    TurningAtRest(const Structure &structure, const Constraints &constraints, double load);

    bool empty() const { return all.turning_rows().empty(); }

    /// Begins a search at displacements @p U.
    void begin(const BodyVectors &U);

    /// For one iteration: in the order of the given ones, then the springs.
    const Constraints &constraints() const { return empty() ? all : *linear; }

    /// Of the links that turn; 0: there are none [m].
    double largest_length() const;

    /// By how much the result of an iteration misses its own directions and gaps: changes of
    /// directions [1], gaps over |Delta|, of constraints that carry a force or should.
    double change(const StaticState &state);

    /// Goes on from a state.
    void go_on(const StaticState &state);

    /// The state of the given constraints: without the springs.
    void finish(StaticState &state) const;

    /// D of the given constraints, without springs [m].
    std::vector<double> gaps(const BodyVectors &U) const;

    /// A spring across a link that pushes: its row in constraints(), and N / |Delta| [N/m].
    struct Across
    {
      std::size_t row;
      double stiffness;
    };

    /// Makes constraints() those of the check of a state, with the springs returned; empty: nothing
    /// pushes, and constraints() are as before.
    std::vector<Across> begin_check(const StaticState &state);

    /**
     * After a step with the springs of begin_check(): whether the structure stays definite with
     * -2 s in place of 0 across the links that push, s the stiffness of these springs, by a
     * Cholesky factor of 1/(2 s) - flexibility, which is the Schur complement of the structure in
     * them. Returns the first spring without a positive pivot, or their number. Without
     * flexibilities nothing is known.
     */
    static std::size_t first_that_gives_way(StaticStep &step, const std::vector<Across> &springs);

    /// The constraint that a spring across it belongs to.
    std::size_t constraint_of(const Across &spring) const
    {
      return source[spring.row - all.size()];
    }

  private:
    void set(const BodyVectors &U, const std::vector<double> &N, bool is_check = false);

    const Constraints &all;
    const BodyVectors undeformed;
    double load;
    double turned = 1.;                  ///< largest change of a direction in the last iteration
    std::vector<Coordinates> directions; ///< of the last displacements
    std::unique_ptr<Constraints> linear;
    std::vector<std::size_t> source; ///< constraint that a spring belongs to
  };

  // Both are about the nonlinear bodies of this rank at a displacement U from the undeformed
  // structure [m, rad]. A body that is not slender makes them false.

  /// True if all tangents are definite but for rounding: what a motion costs no energy of is no
  /// tension, as of a cable that lies slack.
  bool are_indifferent(const Structure &structure, const BodyVectors &U);

  /// True if all bodies are in tension but at free ends.
  bool are_in_tension(const Structure &structure, const BodyVectors &U);
} // namespace taut

#endif
