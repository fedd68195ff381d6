// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_constraints_h
#define taut_constraints_h

#include <taut/base/force_law.h>
#include <taut/base/lasting.h>
#include <taut/complementarity/cone.h>
#include <taut/interface/geometry.h>

#include <boost/range/irange.hpp>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class SharedRows;
  struct MatrixEntries;

  /// The spring between the bodies and the multiplier of a constraint: rigid, linear with a damper,
  /// or with a law. Forces are in N, or N m; compressions in m, or rad.
  struct ConstraintSpring
  {
    double stiffness = std::numeric_limits<double>::infinity(); ///< [N/m, N m/rad]
    double damping = 0.;                                        ///< [N s/m, N m s/rad]

    /// Force as a function of compression, for unilateral constraints; null: linear. The stiffness
    /// then is the largest stiffness of the law.
    std::shared_ptr<const ForceLaw> law = {};

    /// True if the work of a mean force over a step is the change of the spring's energy, also in
    /// closing and opening; see ContactResolution.
    bool conserving = false;

    bool is_rigid() const { return std::isinf(stiffness); }

    /// S of the spring with its damper, whose velocity changes by @p rate [1/s] times its
    /// compression; 0 for a rigid spring [m/N, rad/(N m)].
    double compliance(const double rate = 0.) const { return 1. / (stiffness + rate * damping); }

    /// Force at rest under a compression, and compression under a force; 0 for a rigid spring.
    double force(double compression) const;
    double compression(double force) const;

    /// Stored energy; 0 for a rigid spring [J].
    double energy(double compression) const;

    /// Error in the numbers, for a message; empty: none.
    std::string fault() const;
  };

  /// Index of a constraint without a link in the scene, for example a cut of a wire.
  constexpr std::size_t no_link = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t no_contact = no_link;

  /// One scalar condition with its multiplier N. Its geometry gives the place, its spring the
  /// compliance between the bodies and N, its cone the admissible N. With the linear form B_i,
  /// D = B_i U + gap + compression of the spring; N and D are complementary.
  struct ConstraintData
  {
    std::string name;
    std::string origin = {};          ///< path of its section in the parameter file, for messages
    std::size_t link = no_link;       ///< index of its link in the scene
    std::size_t contact = no_contact; ///< index of its contact of surfaces in the scene
    bool rotational = false;          ///< on slopes, with moments

    Cone cone = Cone::free();                ///< free: bilateral; half line: unilateral
    ConstraintSpring spring = {};            ///< rigid by default
    std::shared_ptr<Geometry> geometry = {}; ///< sets terms and gap; null: both are fixed
    double gap = 0.;                         ///< D at U = 0, N = 0 [m, rad]
    double gap_size = 0.;         ///< size of the terms of the gap, its rounding scale [m, rad]
    std::vector<Term> terms = {}; ///< B_i

    bool is_link() const { return link != no_link; }

    /// True for a rigid joint without a link in the scene: it holds parts of one body together.
    bool is_cut() const
    {
      return !is_link() && contact == no_contact && cone.is_free() && spring.is_rigid();
    }

    Geometry::Kind kind() const { return geometry ? geometry->kind() : Geometry::Kind::fixed; }

    /// The linear forms that combine to B_i at all positions of the bodies; for most only B_i.
    std::vector<const std::vector<Term> *> forms() const
    {
      if (kind() == Geometry::Kind::turning)
        return geometry->forms();
      return {&terms};
    }
  };

  /// Geometric stiffness of a turning link that pulls, which resists lateral motions of the ends of
  /// each @p segment with N / |Delta|. It is a spring of @p stiffness [N/m] along @p direction,
  /// without force where Delta has moved by @p motion [m].
  ConstraintData geometric_spring(const std::string &name, const ConstraintData &link,
                                  std::size_t segment, const Coordinates &direction,
                                  double stiffness, const Coordinates &motion);

  /// Which of the first rows a rank has, where not all ranks have all of them.
  struct RowNumbers
  {
    std::size_t n_of_all = 0;           ///< rows of all ranks
    std::vector<std::size_t> here = {}; ///< numbers of the rows of this rank, ascending
  };

  /**
   * The constraints of a system, with rows in the order cuts, other fixed ones, turning, sliding.
   * All ranks have all of them, unless they are distributed: each rank then has the fixed ones that
   * act on its bodies. All ranks have the other rows, the common ones.
   */
  class Constraints
  {
  public:
    /// @p structure is kept by reference. Throws EntryError with the name of an invalid constraint,
    /// see check_constraint(). Called by all ranks together.
    Constraints(Lasting<Structure> structure, std::vector<ConstraintData> constraints);

    /// Rows that are distributed from the start: the cuts among @p constraints, in their order, are
    /// those with @p numbers. Called by all ranks together.
    Constraints(Lasting<Structure> structure, std::vector<ConstraintData> constraints,
                RowNumbers numbers);

    /// Fixed constraints in place of all of @p others, in their order and on the same ranks, and
    /// then more, which all ranks have. Called by all ranks together.
    Constraints(const Constraints &others, std::vector<ConstraintData> constraints);

    /// With @p are_distributed, each rank drops the fixed rows that do not act on its bodies: for a
    /// matrix-free F. Otherwise all ranks get all cuts, if those of a body are distributed from the
    /// start. Throws std::logic_error if called twice. Called by all ranks together.
    void distribute(bool are_distributed);

    /// The distributed rows; null: all ranks have all of them.
    const SharedRows *shared() const { return shared_rows.get(); }
    const Communicator &communicator() const { return structure.communicator(); }

    /// Number of rows of this rank, and of all ranks.
    std::size_t size() const { return constraints.size(); }
    std::size_t n_of_all() const;

    /// The rows that are no cuts; the common rows, which all ranks have; and whether a row is owned
    /// by this rank: one rank owns it.
    boost::integer_range<std::size_t> rows_but_cuts() const { return {n_cuts, size()}; }
    boost::integer_range<std::size_t> common_rows() const { return {first_common, size()}; }
    bool is_own(std::size_t i) const;

    /// A sum over the rows that are no cuts has those that each rank counts(), and is then added up
    /// over the ranks. Where all ranks have these rows, each counts them, and nothing is added.
    bool counts(const std::size_t i) const { return !shared_rows || is_own(i); }
    void add_up(std::vector<double> &values) const;
    double added_up(double value) const;

    /// Values over the rows of the first @p n links of the scene, and of all rows of one of its
    /// contacts of surfaces, on all ranks, in the place of @p to. Called by all ranks together.
    std::vector<double> of_links(const std::vector<double> &values, std::size_t n,
                                 std::vector<double> to = {}) const;
    std::vector<double> of_contact(const std::vector<double> &values, std::size_t contact,
                                   std::vector<double> to = {}) const;

    /// Number of a row among those of all ranks, ascending with the row, those of cuts first; and
    /// back, no_link for a row that this rank does not have.
    std::size_t number(std::size_t i) const;
    std::size_t index(std::size_t number) const;
    std::size_t n_cuts_of_all() const { return n_all_cuts; }

    /// Each entry of vectors over the rows becomes the sum of what the ranks that have the row have
    /// there, by one message. Called by all ranks together, as are the next ones, to gather().
    void sum(std::initializer_list<std::vector<double> *> vectors) const;
    void sum(std::vector<double> &values) const { sum({&values}); }

    /// Each rank has shares of the entries of a matrix over the rows, by their numbers, and gets
    /// the sums over the ranks for the rows that it has, ordered by rows and columns.
    void sum_entries(MatrixEntries &entries, std::size_t n_columns) const;

    /// The largest value that any rank found on its rows, not-a-number if one is.
    double max(double value) const;
    bool any(const bool is_true) const { return max(is_true ? 1. : 0.) > 0.; }

    /// The sum of one value for each row of all ranks.
    double total(const std::vector<double> &values) const;

    /// How a message calls a row: its name, and its path in the parameter file, which may be empty.
    struct Label
    {
      std::string name, origin;
    };

    /// Labels of rows of all ranks by their numbers, ascending. A rank that has a row names it.
    std::vector<Label> labels(const std::vector<std::size_t> &numbers) const;

    /// Name of one row by its number, empty for no_link.
    std::string name(std::size_t number) const;

    /// Names of rows for a message: "'a', 'b' and 3 more".
    static std::string names(const std::vector<Label> &labels);
    std::string names(const std::vector<std::size_t> &numbers) const
    {
      return names(labels(numbers));
    }

    /// The lowest number of the rows that ranks name by their indices @p i, no_link for none.
    std::size_t number_of_first(std::size_t i) const;

    /// The numbers of all rows that ranks name by their indices, ascending. All ranks that have a
    /// row name it.
    std::vector<std::size_t> numbers_of(const std::vector<std::size_t> &rows) const;

    /// Each rank found values, and their rows by index, no_link for none. Each value becomes the
    /// largest one of all ranks, and the row its number, the lowest one of equal values.
    void take_largest(std::vector<double> &values, std::vector<std::size_t> &rows) const;

    /// The values of the rows with some numbers, the same on all ranks.
    std::vector<double> of_rows(const std::vector<double> &values,
                                const std::vector<std::size_t> &numbers) const;

    /// The values of all rows by their numbers, from those over the rows; and back, in place.
    void gather(const std::vector<double> &values, std::vector<double> &all) const;
    void pick(std::vector<double> &values) const;

    const ConstraintData &operator[](std::size_t i) const { return constraints[i]; }

    /// Rows of each kind of geometry; varying: turning or sliding.
    using Rows = boost::integer_range<std::size_t>;
    Rows fixed_rows() const { return {0, first_turning}; }
    Rows turning_rows() const { return {first_turning, first_sliding}; }
    Rows sliding_rows() const { return {first_sliding, size()}; }
    Rows varying_rows() const { return {first_turning, size()}; }
    bool is_fixed(const std::size_t i) const { return i < first_turning; }
    bool turns(const std::size_t i) const { return i >= first_turning && i < first_sliding; }
    bool slides(const std::size_t i) const { return i >= first_sliding; }

    /// Index of a row in turning_rows(), and its segments among those of all these rows.
    std::size_t turning_index(const std::size_t i) const { return i - first_turning; }
    boost::integer_range<std::size_t> segments(const std::size_t i) const
    {
      return {first_segments[turning_index(i)], first_segments[turning_index(i) + 1]};
    }

    /// Geometry of a turning, or of a sliding constraint.
    const TurningDirection &turning(std::size_t i) const;
    MovingPlace &place(std::size_t i) const;

    /// Sets which constraints are conserving: one entry a constraint, not 0 if conserving.
    void set_conserving(const std::vector<char> &conserving);

    /// Moves the sliding constraints to their places at time t [s]. Throws UserError if one leaves
    /// its wire, or if its place has an unsuitable form or gap.
    void update(double t);

    /// Before a step from @p start to @p end [s]: predicts the places of sliding constraints from
    /// displacements @p reference + @p U and velocities @p V. Called by all ranks together, before
    /// update().
    void follow(const BodyVectors &reference, const BodyVectors &U, const BodyVectors &V,
                double start, double end);

    /// What MovingPlace::append_course() says of each sliding constraint.
    std::vector<std::vector<double>> courses() const;
    void copy_courses(std::vector<std::vector<double>> &to) const;
    void set_courses(const std::vector<std::vector<double>> &courses);

    /// Delta of each segment of the turning_rows() at U = @p reference + @p U; without
    /// @p reference, its part linear in U. Called by all ranks together [m].
    std::vector<Coordinates> differences(const BodyVectors &reference, const BodyVectors &U) const;
    std::vector<Coordinates> differences(const BodyVectors &U) const;
    void copy_differences(const BodyVectors &reference, const BodyVectors &U,
                          std::vector<Coordinates> &to) const;
    void copy_differences(const BodyVectors &U, std::vector<Coordinates> &to) const;

    /// Ends of one of the segments(@p i) at U = @p reference + @p U [m]. Called by all ranks
    /// together.
    std::array<Coordinates, 2> ends(std::size_t i, std::size_t segment,
                                    const BodyVectors &reference, const BodyVectors &U) const;

    /// Sets B_i of the turning constraints by a direction for each segment.
    void turn(const std::vector<Coordinates> &directions);

    /// Calls turn() with the directions at U = @p reference + @p U. Called by all ranks together.
    void turn_to(const BodyVectors &reference, const BodyVectors &U);

    /**
     * Replaces turning constraints by fixed ones with their directions and gaps at
     * U = @p reference. A link that pulls with force N there, one entry a turning constraint,
     * resists lateral motions of the ends of its segments. Each gets two springs |N| / |Delta|,
     * without force at the reference, in rows before the sliding constraints. Constraints that push
     * have no such springs. Called by all ranks together, at t = 0 [m, rad; N, N m].
     */
    void keep_directions(const BodyVectors &reference, const std::vector<double> &N);

    /// Position of a sliding constraint on its wire at time t [m].
    double position(std::size_t i, double t) const { return place(i).position(t); }

    /// What the gap has at time @p t [s] beside that of the place: 0, or where a sliding constraint
    /// is beyond the ends of its body a distance out of reach [m].
    double distance_beyond(std::size_t i, double t) const;

    /// B^T U: motions of the constraints, summed over all ranks [m, rad].
    std::vector<double> motions(const BodyVectors &U) const;

    /// Sets @p motion, of length size(), to the part of this rank in B^T U.
    void share_of_motions(const BodyVectors &U, std::vector<double> &motion) const;

    /// Sets also @p terms_size to the sums of absolute terms, the rounding scale of @p motion.
    void share_of_motions(const BodyVectors &U, std::vector<double> &motion,
                          std::vector<double> &terms_size) const;

    /// Convection rate in the D' of a sliding constraint at time @p t [s], without profile_rate():
    /// speed times slope of the displacements; the part of this rank [m/s].
    double share_of_convection(std::size_t i, double t, const BodyVectors &reference,
                               const BodyVectors &U) const;

    /// Rate of the height profile under a sliding constraint, from differences within a part of a
    /// step [s]; the same on all ranks [m/s].
    double profile_rate(std::size_t i, double t, double step) const;

    /// Not 0 for a constraint that acts on a massless DoF anywhere on its way.
    std::vector<char> without_mass() const { return acts_on(&Substructure::dofs_without_mass); }

    /// Not 0 for a constraint that acts on a DoF without mass and damping.
    std::vector<char> quasi_static() const { return acts_on(&Substructure::quasi_static_dofs); }

    /// P += B_i N, for one constraint or all.
    void add_force(std::size_t i, double N, BodyVectors &P) const;
    void add_forces(const std::vector<double> &N, BodyVectors &P) const;

    /// Largest force [N] and moment [N m] of a single constraint on each body, |B_i| |N_i|: sums of
    /// forces may cancel.
    void largest_forces(const std::vector<double> &N,
                        std::vector<std::array<double, 2>> &result) const;

    /// Row of the constraint of a link in the scene; no_link where this rank does not have it. And
    /// how many links have an index, the same on all ranks.
    std::size_t index_of_link(std::size_t link) const
    {
      return link < row_index.size() ? row_index[link] : no_link;
    }
    std::size_t n_links() const { return row_index.size(); }

    /// Path of a constraint in the parameter file, for messages; may be empty.
    const std::string &origin(std::size_t i) const { return constraints[i].origin; }

  private:
    /// An entry of B.
    struct Entry
    {
      double value;
      unsigned int body, dof;
    };

    void check(const Rows &rows) const;
    void share(RowNumbers numbers);
    void share_like(const SharedRows &others);
    void gather_cuts();
    void number_contacts();
    std::size_t n_segments() const { return first_segments.back(); }
    void add_motions_of_places(const BodyVectors &U, double *sum) const;
    void replace_first(std::size_t n, std::vector<ConstraintData> rows);
    void sort();
    void arrange();
    std::vector<char> acts_on(std::vector<unsigned int> (Substructure::*dofs)() const) const;
    void append(std::size_t i);
    void append_varying();
    void move(std::size_t i, double t);

    const Structure &structure;
    std::vector<ConstraintData> constraints;
    std::vector<std::size_t> row_index;
    std::size_t n_cuts = 0, first_turning = 0, first_sliding = 0;
    std::size_t n_all_cuts = 0;   ///< of all ranks
    std::size_t first_common = 0; ///< of the rows that all ranks have
    bool is_chosen = false;       ///< whether rows are distributed

    /// The first number and how many there are, of the rows of a contact of surfaces.
    struct RowsOfContact
    {
      std::size_t first = 0, n = 0;
    };
    std::vector<RowsOfContact> of_contacts;
    std::vector<std::size_t> first_segments; ///< of each turning row, and their number
    std::shared_ptr<const SharedRows> shared_rows;

    std::vector<Entry> entries;     ///< of all constraints, in the order of rows
    std::vector<std::size_t> begin; ///< first entry of each constraint, and the end

    /// Largest |B_i| of a constraint on a body for one kind.
    struct Size
    {
      double value;
      unsigned int body, kind, constraint;
    };
    std::vector<Size> sizes; ///< of fixed constraints by body and kind, then of others
    std::size_t n_fixed_sizes = 0;

    mutable std::vector<Term> slope;  ///< in share_of_convection()
    mutable std::vector<double> sums; ///< in copy_differences()
  };
} // namespace taut

#endif
