// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_substructure_h
#define taut_substructure_h

#include <taut/base/archive_forward.h>
#include <taut/base/coordinates.h>
#include <taut/base/linear_form.h>
#include <taut/substructure/symmetric_matrix.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class LocalSolver;

  /// A force on a substructure that changes in time.
  class TimeLoad
  {
  public:
    virtual ~TimeLoad() = default;

    /// P += the force at time t [s].
    virtual void add(double t, std::vector<double> &P) const = 0;
  };

  /// A DoF whose displacement is given.
  struct ConstrainedDof
  {
    unsigned int dof = 0;

    /// u(t) [m, rad] at t [s]; none: it stays at zero.
    std::function<double(double)> motion = {};

    double at(double t) const { return motion ? motion(t) : 0.; }
  };

  /**
   * One body between interfaces, discretised: M U" + C U' + f(U, U') = P + B N. Of a linear body f
   * is K U, or f(0) + K U if it says so; of others, which move by large amounts, K is the tangent
   * of f in the undeformed body, and they say what f is. Its DoFs are displacements [m] and slopes
   * or rotations [rad], each of one kind: kind(i) numbers the kinds, because forces and moments are
   * never compared.
   */
  class Substructure
  {
  public:
    /// @p origin is the path of its section in the parameter file, for messages; may be empty.
    explicit Substructure(std::string name, std::string origin = "")
        : body_name(std::move(name)), body_origin(std::move(origin))
    {
    }
    virtual ~Substructure() = default;

    const std::string &name() const { return body_name; }
    const std::string &origin() const { return body_origin; }
    unsigned int n_dofs() const { return K->size(); }

    /// M [kg, kg m^2], C [N s/m, N m s/rad], K [N/m, N m/rad], rows of constraints() included.
    const SymmetricMatrix &mass() const { return *M; }
    const SymmetricMatrix &damping() const { return *C; }
    const SymmetricMatrix &stiffness() const { return *K; }

    /// Sorted by DoF.
    const std::vector<ConstrainedDof> &constraints() const { return constrained; }
    std::vector<unsigned int> constrained_dofs() const;

    /// DoFs whose row of M is zero, sorted.
    std::vector<unsigned int> dofs_without_mass() const;

    /// Those of them whose row of C is zero, too: only elastic forces act on them.
    std::vector<unsigned int> quasi_static_dofs() const;

    /// True if a support moves: an increment then has a given part.
    bool has_moving_constraints() const { return moving_constraints; }

    /// The whole external force at time t [s]; P is resized. [N, N m]
    void external_force(double t, std::vector<double> &P) const;

    /// True if it is not the same at all times.
    bool external_force_varies() const { return !time_loads.empty(); }

    /**
     * Throws UserError unless finish() was called and null_space() fits the DoFs: vectors of finite
     * numbers, one entry a DoF, and as many fixing DoFs, different from each other.
     * Structure::add() calls it.
     */
    void check_consistency() const;

    /// Adds a force along @p form, of its magnitude or of magnitude(t) [N]. Throws UserError for a
    /// form that does not fit, no magnitude, or one that is not finite.
    void add_force(const LinearForm &form, double magnitude);
    void add_force(LinearForm form, std::function<double(double)> magnitude);

    /// Kind of DoF i: 0 a displacement, 1 a slope or rotation.
    unsigned int kind(unsigned int i) const
    {
      // Wires have patterns of one or two: no division.
      const std::size_t n = kinds.size();
      return kinds[n == 1 ? 0 : n == 2 ? i & 1 : i % n];
    }

    /// The kinds of the first DoFs, repeated over all: {0, 1} for a beam.
    const std::vector<unsigned char> &kind_pattern() const { return kinds; }

    /// True if inertia resists all motions but those of DoFs whose row of M is zero: M without
    /// these rows has an inverse that is worth its name.
    virtual bool has_definite_mass() const { return true; }

    /// True if the body is masses and springs: it has no element that resolves a force in time.
    virtual bool is_lumped() const { return false; }

    /**
     * The displacement of a place of its own along a direction, as a linear form on its DoFs [m]. A
     * body of lumped masses without places ignores the place. Throws UserError if the place is not
     * on the body, or if the body has no such places.
     */
    virtual LinearForm displacement(const Coordinates &place, const Coordinates &direction) const;

    /// Where such a place is at U = 0 [m]: the place itself, unless a body counts places otherwise.
    virtual Coordinates position(const Coordinates &place) const { return place; }

    /// The same of a node of the surface that the body shows to contacts (BodyType::surface()).
    /// Throws UserError if the body has no such surface.
    virtual LinearForm node_displacement(unsigned int node, const Coordinates &direction) const;

    /// A local solver of its own for A = mass M + damping C + K, mass in 1/s^2, damping in 1/s;
    /// nullptr: by the matrices, see make_local_solver().
    virtual std::unique_ptr<LocalSolver> make_solver() const;

    /// True if write_vtu() shows the body; wires and masses are shown together, elsewhere.
    virtual bool has_fields() const { return false; }

    /// Writes the displacement @p U from the undeformed body as a .vtu file. Throws UserError if
    /// the file cannot be written.
    virtual void write_vtu(const std::string &path, const std::vector<double> &U) const;

    /// Displacement and velocity at t = 0; zero unless a body says otherwise. The vectors are
    /// resized.
    virtual void initial_state(std::vector<double> &U, std::vector<double> &V) const;

    /**
     * A basis of the motions that cost no energy and that no support prevents (rigid body modes),
     * and for each of them a DoF to hold: with springs on these DoFs the stiffness is definite.
     * Empty for a body that is held.
     */
    struct NullSpace
    {
      std::vector<std::vector<double>> vectors; ///< one entry a DoF
      std::vector<unsigned int> fixing_dofs;    ///< as many, different from each other
    };
    virtual NullSpace null_space() const { return {}; }

    /// True if the internal force is f(0) + K U. If it is not, or if f(0) is not zero, the
    /// functions that follow are the body's own: those of this class are of K U alone, and throw
    /// UserError for a body that is not linear. check_body() compares them with each other.
    virtual bool is_linear() const { return true; }

    /// Energy of the internal force, zero at U = 0 or at another state of the body's choice [J].
    virtual double strain_energy(const std::vector<double> &U) const;

    /// f(U, V) for schemes that take forces at the end of a step, V [m/s] for the damping of the
    /// material; empty: at rest. @p f is resized [N, N m].
    virtual void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                                std::vector<double> &f) const;

    /// About what rounding leaves of the balance of forces of this kind, see kind(), where the
    /// internal force is a difference of large terms; a balance to that is as good as any
    /// [N, N m].
    virtual double rounding_of_force(unsigned int) const { return 0.; }

    /**
     * A mean of f over a step [s] from U0 to U1, for energy-momentum schemes: f . (U1 - U0) is
     * strain_energy(U1) - strain_energy(U0), and what the damping of the material took. @p f is
     * resized [N, N m].
     */
    virtual void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                                     double step, std::vector<double> &f) const;

    /**
     * The tangent df/dU + rate df/dV at U and V = 0, symmetric, with the pattern of K [N/m, N
     * m/rad]; @p rate is dV/dU of the scheme [1/s], 0 at rest. @p definite: without the parts that
     * may make it indefinite, such as the geometric stiffness of compression; for searches of an
     * equilibrium.
     */
    virtual std::unique_ptr<SymmetricMatrix> tangent(const std::vector<double> &U, double rate,
                                                     bool definite) const;

    /// Twice the derivative of mean_internal_force() with respect to U1, or a symmetric matrix
    /// close to it; unless a body says otherwise, the tangent in the middle.
    virtual std::unique_ptr<SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                          const std::vector<double> &U1,
                                                          double rate, bool definite) const;

    /// Stores in a checkpoint what the body keeps from step to step beside displacements,
    /// velocities and accelerations, and reads it again: nothing, unless a body says otherwise.
    virtual void save(OutputArchive &) const {}
    virtual void load(InputArchive &) {}

    /// Where its elements are so unequal that the stiffness of the smallest hides the others, and
    /// what to do, as a part of a message; empty if nowhere.
    virtual std::string uneven_elements() const { return ""; }

  protected:
    /// Sorts the constraints, notes whether one moves, and closes the matrices. Called at the end
    /// of a constructor. Throws EntryError if matrices, forces, kinds and constraints do not fit
    /// each other, if a mass is negative, or if the numbers of the scene are so extreme that a
    /// matrix or a force is not finite.
    void finish();

    std::unique_ptr<SymmetricMatrix> M, C, K;          ///< of one size and kind
    std::vector<unsigned char> kinds = {0};            ///< see kind_pattern()
    std::vector<double> constant_force;                ///< one entry a DoF [N, N m]
    std::vector<std::unique_ptr<TimeLoad>> time_loads; ///< added to it
    std::vector<ConstrainedDof> constrained;           ///< a DoF once

  private:
    void check_sizes() const;
    void check_numbers() const;
    void require_linear(const char *function) const;

    std::string body_name, body_origin;
    bool moving_constraints = false, is_finished = false;
  };

  /// P += magnitude(t) * shape.
  class PointLoad : public TimeLoad
  {
  public:
    PointLoad(LinearForm shape, std::function<double(double)> magnitude)
        : shape(std::move(shape)), magnitude(std::move(magnitude))
    {
    }
    void add(double t, std::vector<double> &P) const override { shape.add_to(magnitude(t), P); }

    /// What makes it no load on @p n_dofs DoFs, as a part of a message; empty: nothing.
    std::string fault(std::size_t n_dofs) const
    {
      return magnitude ? shape.fault(n_dofs) : "has no magnitude in time";
    }

  private:
    LinearForm shape;
    std::function<double(double)> magnitude;
  };
} // namespace taut

#endif
