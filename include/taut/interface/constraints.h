// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraints_h
#define taut_constraints_h

#include <taut/complementarity/cone.h>
#include <taut/interface/constraint_spring.h>
#include <taut/interface/geometry.h>
#include <taut/interface/turning_direction.h>

#include <boost/range/irange.hpp>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A constraint without such a source in a scene, for example a cut of a wire.
  constexpr std::size_t no_link = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t no_contact = no_link;

  /**
   * One scalar condition with its multiplier N, made of three parts: the geometry says where it
   * acts, the spring what is between the bodies and N, the cone which N are admitted. With the
   * linear form B_i, D = B_i U + gap + compression of the spring, and N and D complement each
   * other.
   */
  struct ConstraintData
  {
    std::string name;
    std::string origin = {};          ///< path of its section in the parameter file, for messages
    std::size_t link = no_link;       ///< index of its source in the scene
    std::size_t contact = no_contact; ///< the same of one of many of a contact of surfaces
    bool rotational = false;          ///< slopes and moments

    Cone cone = Cone::free();                ///< bilateral, or unilateral: a half line
    ConstraintSpring spring = {};            ///< rigid unless it is given
    std::shared_ptr<Geometry> geometry = {}; ///< sets terms and gap; null: these are fixed
    double gap = 0.;                         ///< D at U = 0, N = 0 [m, rad]
    double gap_size = 0.; ///< of the terms that the gap is a sum of: what it rounds with [m, rad]
    std::vector<Term> terms = {}; ///< B_i

    bool is_link() const { return link != no_link; }

    /// True of a rigid joint that no scene names: it holds parts of one body together.
    bool is_cut() const
    {
      return !is_link() && contact == no_contact && cone.is_free() && spring.is_rigid();
    }

    Geometry::Kind kind() const { return geometry ? geometry->kind() : Geometry::Kind::fixed; }

    /// The linear forms that B_i is combined from, wherever the bodies are: of most constraints B_i
    /// itself.
    std::vector<const std::vector<Term> *> forms() const
    {
      if (kind() == Geometry::Kind::turning)
        return geometry->forms();
      return {&terms};
    }
  };

  /**
   * The geometric stiffness of a link that turns, as a spring of @p stiffness [N/m] along @p
   * direction, without force where the ends have moved by @p motion [m]: a link that pulls holds
   * its ends across itself by N / |Delta|.
   */
  ConstraintData geometric_spring(const std::string &name, const ConstraintData &link,
                                  const Coordinates &direction, double stiffness,
                                  const Coordinates &motion);

  /// The constraints of a system, in rows ordered by their geometry: the fixed constraints, then
  /// the turning ones, then the sliding ones.
  class Constraints
  {
  public:
    /// @p structure is kept by reference. Called by all ranks together; throws EntryError, which
    /// names the constraint, for one that does not fit, see check_constraint().
    Constraints(const Structure &structure, std::vector<ConstraintData> constraints);

    std::size_t size() const { return constraints.size(); }
    const ConstraintData &operator[](std::size_t i) const { return constraints[i]; }

    /// The rows of each kind of geometry, and of all but the fixed ones.
    using Rows = boost::integer_range<std::size_t>;
    Rows fixed_rows() const { return {0, first_turning}; }
    Rows turning_rows() const { return {first_turning, first_sliding}; }
    Rows sliding_rows() const { return {first_sliding, size()}; }
    Rows varying_rows() const { return {first_turning, size()}; }
    bool is_fixed(const std::size_t i) const { return i < first_turning; }
    bool turns(const std::size_t i) const { return i >= first_turning && i < first_sliding; }
    bool slides(const std::size_t i) const { return i >= first_sliding; }

    /// Position of a row among the turning_rows().
    std::size_t turning_index(const std::size_t i) const { return i - first_turning; }

    /// The geometry of a constraint that turns, or slides.
    const TurningDirection &turning(std::size_t i) const;
    MovingPlace &place(std::size_t i) const;

    /// Which constraints are conserving: not 0, one entry a constraint.
    void set_conserving(const std::vector<char> &conserving);

    /// Puts the moving constraints where they are at time t [s]. Throws UserError when one leaves
    /// its wire, or its place gives a form or a gap that does not fit.
    void update(double t);

    /// Before a step to time @p end [s] from @p start, where the bodies have displacements
    /// @p reference + @p U and velocities @p V: moving constraints take the places that they will
    /// have. Called by all ranks together, before update().
    void follow(const BodyVectors &reference, const BodyVectors &U, const BodyVectors &V,
                double start, double end);

    /// Of each moving constraint, see MovingPlace::course().
    std::vector<std::vector<double>> courses() const;
    void set_courses(const std::vector<std::vector<double>> &courses);

    /// Delta of each of the turning_rows() at U = @p reference + @p U, and the part that is linear
    /// in U alone. Called by all ranks together [m].
    std::vector<Coordinates> differences(const BodyVectors &reference, const BodyVectors &U) const;
    std::vector<Coordinates> differences(const BodyVectors &U) const;

    /// Where both ends of a constraint that turns are at U = @p reference + @p U. Called by all
    /// ranks together [m].
    std::array<Coordinates, 2> ends(std::size_t i, const BodyVectors &reference,
                                    const BodyVectors &U) const;

    /// Gives each constraint that turns B_i = sign times its motion along a direction.
    void turn(const std::vector<Coordinates> &directions);

    /// The same with the directions at U = @p reference + @p U. Called by all ranks
    /// together.
    void turn_to(const BodyVectors &reference, const BodyVectors &U);

    /**
     * Makes fixed constraints of the turning ones, with the directions and gaps that they have at U
     * = @p reference, so that no constraint turns any more. With a force N at the reference, one
     * entry a constraint, a link that pulls holds its ends across itself: two springs |N| / |Delta|
     * are added for it, without force there, before the moving constraints. Constraints that push
     * have no such springs. Called by all ranks together, at t = 0 [m, rad; N, N m].
     */
    void keep_directions(const BodyVectors &reference, const std::vector<double> &N);

    /// Position on its wire of a moving constraint at time t [m].
    double position(std::size_t i, double t) const { return place(i).position(t); }

    /// B^T U of each constraint: the motion of the constraints, summed over all ranks [m, rad].
    std::vector<double> motions(const BodyVectors &U) const;

    /// The share of this rank's bodies in it, into @p motion of length size().
    void share_of_motions(const BodyVectors &U, std::vector<double> &motion) const;

    /// The same, and the sums of the absolute terms, which it rounds with, into @p terms_size.
    void share_of_motions(const BodyVectors &U, std::vector<double> &motion,
                          std::vector<double> &terms_size) const;

    /**
     * Rate at which a moving constraint's place changes its gap at time @p t [s], in D' = B^T V +
     * this: its speed times the slope of the displacements, this rank's share of it [m/s].
     */
    double share_of_convection(std::size_t i, double t, const BodyVectors &reference,
                               const BodyVectors &U) const;

    /// The same of the height profile under a moving constraint, from differences within a part of
    /// a step [s]; the same on all ranks [m/s].
    double profile_rate(std::size_t i, double t, double step) const;

    /// Of each constraint: not 0 where it acts, wherever it moves, on a DoF without mass.
    std::vector<char> without_mass() const { return acts_on(&Substructure::dofs_without_mass); }

    /// The same of DoFs without mass and without damping.
    std::vector<char> quasi_static() const { return acts_on(&Substructure::quasi_static_dofs); }

    /// P += B_i N, of one constraint and of all.
    void add_force(std::size_t i, double N, BodyVectors &P) const;
    void add_forces(const std::vector<double> &N, BodyVectors &P) const;

    /// Largest force [N] and moment [N m] of a single constraint on each body, |B_i| |N_i|: their
    /// sum may cancel.
    void largest_forces(const std::vector<double> &N,
                        std::vector<std::array<double, 2>> &result) const;

    /// Index of the constraint of a link of the scene.
    std::size_t index_of_link(std::size_t link) const { return row_index[link]; }

    /// Path in the parameter file of a constraint, for messages; may be empty.
    const std::string &origin(std::size_t i) const { return constraints[i].origin; }

    /// Names of constraints for a message: "a, b and 3 more".
    std::string names(const std::vector<std::size_t> &indices) const;

  private:
    /// One number of B.
    struct Entry
    {
      double value;
      unsigned int body, dof;
    };

    void sort();
    void arrange();
    std::vector<char> acts_on(std::vector<unsigned int> (Substructure::*dofs)() const) const;
    void append(std::size_t i);
    void append_varying();
    void move(std::size_t i, double t);

    const Structure &structure;
    std::vector<ConstraintData> constraints;
    std::vector<std::size_t> row_index;
    std::size_t first_turning = 0, first_sliding = 0;

    std::vector<Entry> entries;     ///< of all constraints, one constraint after the other
    std::vector<std::size_t> begin; ///< of each constraint; one number more

    /// The largest |B_i| of a constraint on a body, of one kind.
    struct Size
    {
      double value;
      unsigned int body, kind, constraint;
    };
    std::vector<Size> sizes; ///< of the fixed constraints by body and kind, then of the others
    std::size_t n_fixed_sizes = 0;
  };
} // namespace taut

#endif
