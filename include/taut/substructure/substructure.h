// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_substructure_h
#define taut_substructure_h

#include <taut/base/archive_forward.h>
#include <taut/base/coordinates.h>
#include <taut/base/linear_form.h>
#include <taut/substructure/symmetric_matrix.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class LocalSolver;

  /// A force on a substructure that changes in time, see Substructure::time_loads.
  class TimeLoad
  {
  public:
    virtual ~TimeLoad() = default;

    /// P += the force at time t [s].
    virtual void add(double t, std::vector<double> &P) const = 0;

    /// A number that changes in time as the force does, such as its size or the sum of its sizes at
    /// a few places [N]. The search for pulses between the steps evaluates it many times; not a
    /// number: this load is not searched.
    virtual double sample(double /*t*/) const { return std::numeric_limits<double>::quiet_NaN(); }

    /// The same sum of a load in space at @p n_places places, which shows pulses on a part of the
    /// body. Not a number: sample() shows all.
    virtual double sample_at_places(double /*t*/, std::size_t /*n_places*/) const
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  };

  /// A DoF whose displacement is prescribed.
  struct ConstrainedDof
  {
    unsigned int dof = 0;

    /// u(t) [m, rad] at t [s]; none: u is `displacement` at all times.
    std::function<double(double)> motion = {};
    double displacement = 0.; ///< [m, rad]

    double at(double t) const { return motion ? motion(t) : displacement; }
  };

  /**
   * A discretised body (a subdomain) that touches others only through constraints:
   *
   *     M U" + C U' + f(U, U') = P + B N.
   *
   * Derive from it to bring a body of your own. FEBody is the substructure of a model of deal.II. A
   * linear body has f = K U, or f(0) + K U if it overrides internal_force(). A body that moves by
   * large amounts is not linear: K is the tangent of f in the undeformed body, and the body
   * overrides f. A DoF is a displacement [m] or a slope or rotation [rad]. kind(i) numbers these
   * kinds, because forces and moments are never compared.
   */
  class Substructure
  {
  public:
    /// @p origin is the path of the section of the body in the parameter file, for messages; may be
    /// empty.
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

    /// DoFs without mass whose row of C is zero, too: only elastic forces act on them.
    std::vector<unsigned int> quasi_static_dofs() const;

    /// True if the displacement of a support changes in time.
    bool has_moving_constraints() const { return moving_constraints; }

    /// True if a support has a displacement, constant or not: an increment may then have a
    /// prescribed part.
    bool has_displaced_constraints() const { return displaced_constraints; }

    /// The whole external force at time t [s]; P is resized. [N, N m]
    void external_force(double t, std::vector<double> &P) const;

    /// The parts of the external force that change in time.
    const std::vector<std::shared_ptr<const TimeLoad>> &loads_in_time() const { return time_loads; }

    /// True if the external force changes in time.
    bool external_force_varies() const { return !time_loads.empty(); }

    /**
     * Throws UserError unless finish() was called and null_space() fits the DoFs. The vectors must
     * have finite numbers, one entry a DoF. There must be as many fixing DoFs, different from each
     * other. Structure::add() calls it.
     */
    void check_consistency() const;

    /// Adds a force along @p form, constant or of magnitude(t) [N]. Throws UserError for a form
    /// that does not fit the DoFs, for no magnitude, and for a magnitude that is not finite.
    void add_force(const LinearForm &form, double magnitude);
    void add_force(const LinearForm &form, std::function<double(double)> magnitude);

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
    /// these rows has an inverse to working precision.
    virtual bool has_definite_mass() const { return true; }

    /// True if the body is lumped masses and springs: it has no element that resolves a force in
    /// time.
    virtual bool is_lumped() const { return false; }

    /**
     * The displacement of a place on the body along a direction, as a linear form on the DoFs of
     * the body [m]. A body of lumped masses without places ignores the place. Throws UserError if
     * the place is not on the body, or if the body has no places.
     */
    virtual LinearForm displacement(const Coordinates &place, const Coordinates &direction) const;

    /// The position of a place at U = 0 [m]: the place itself, unless a body numbers its places
    /// otherwise.
    virtual Coordinates position(const Coordinates &place) const { return place; }

    /// The displacement of a node of the surface of the body (BodyType::surface()) along a
    /// direction, as displacement(). Throws UserError if the body has no surface.
    virtual LinearForm node_displacement(unsigned int node, const Coordinates &direction) const;

    /// The local solver of the body for A = mass M + damping C + K, mass in 1/s^2, damping in 1/s;
    /// nullptr: the solver that suits the matrices, see make_local_solver().
    virtual std::unique_ptr<LocalSolver> make_solver() const;

    /// True if write_vtu() writes the body; wires and masses are written together, elsewhere.
    virtual bool has_fields() const { return false; }

    /// Writes the displacement @p U from the undeformed body as a .vtu file. Throws UserError if
    /// the file cannot be written.
    virtual void write_vtu(const std::string &path, const std::vector<double> &U) const;

    /// Displacement and velocity at t = 0; zero unless a body overrides the function. The vectors
    /// are resized.
    virtual void initial_state(std::vector<double> &U, std::vector<double> &V) const;

    /**
     * A basis of the rigid body modes: motions that cost no energy and that no support prevents.
     * Each mode has a DoF to hold: with springs on these DoFs the stiffness is definite. Empty for
     * a body that supports hold.
     */
    struct NullSpace
    {
      std::vector<std::vector<double>> vectors; ///< one entry a DoF
      std::vector<unsigned int> fixing_dofs;    ///< as many, different from each other
    };
    virtual NullSpace null_space() const { return {}; }

    /// True if the internal force is f(0) + K U. If it is not, or if f(0) is not zero, the body
    /// overrides the functions that follow. The functions of this class are those of K U alone, and
    /// throw UserError for a body that is not linear. check_body() compares the functions with each
    /// other.
    virtual bool is_linear() const { return true; }

    /// Energy of the internal force, zero at U = 0 or at another state that the body chooses [J].
    virtual double strain_energy(const std::vector<double> &U) const;

    /// f(U, V) for schemes with forces at the end of a step. V [m/s] is for the damping of the
    /// material; an empty V is a body at rest. @p f is resized [N, N m].
    virtual void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                                std::vector<double> &f) const;

    /// The rounding error of the balance of forces of this kind, see kind(), where the internal
    /// force is a difference of large terms [N, N m]. No balance can be better than this error.
    virtual double rounding_of_force(unsigned int) const { return 0.; }

    /**
     * A mean of f over a step [s] from U0 to U1, for energy-momentum schemes. f . (U1 - U0) is
     * strain_energy(U1) - strain_energy(U0) plus the energy that the damping of the material took.
     * @p f is resized [N, N m].
     */
    virtual void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                                     double step, std::vector<double> &f) const;

    /**
     * The symmetric tangent df/dU + rate df/dV at U and V, with the pattern of K [N/m, N m/rad]. An
     * empty V is a body at rest, as in internal_force(). df/dU may be that at rest: damping may
     * make it unsymmetric. @p rate is dV/dU of the scheme [1/s], 0 at rest. @p definite leaves out
     * the parts that may make the tangent indefinite, such as the geometric stiffness of
     * compression; searches of an equilibrium use it.
     */
    virtual std::unique_ptr<SymmetricMatrix> tangent(const std::vector<double> &U,
                                                     const std::vector<double> &V, double rate,
                                                     bool definite) const;

    /// Twice the derivative of mean_internal_force() with respect to U1, or a symmetric matrix
    /// close to it. The default is the tangent in the middle of the step, with the mean velocity
    /// rate / 2 (U1 - U0).
    virtual std::unique_ptr<SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                          const std::vector<double> &U1,
                                                          double rate, bool definite) const;

    /// Takes back a tangent of this body that nobody uses any more: the next one may have its
    /// memory.
    virtual void take_back(std::unique_ptr<SymmetricMatrix>) const {}

    /// Store and read, for a checkpoint, the state of the body beside displacements, velocities and
    /// accelerations. The default state is empty.
    virtual void save(OutputArchive &) const {}
    virtual void load(InputArchive &) {}

    /// A part of a message: the place where elements are so unequal that the stiffness of the
    /// smallest hides that of the others, and the remedy. Empty if there is no such place.
    virtual std::string uneven_elements() const { return ""; }

  protected:
    /// Sorts the constraints, notes whether a constraint moves, and closes the matrices. Call it at
    /// the end of a constructor. Throws EntryError if matrices, forces, kinds and constraints do
    /// not fit each other, if a mass is negative, or if a matrix or a force is not finite, as with
    /// extreme numbers of a scene.
    void finish();

    std::unique_ptr<SymmetricMatrix> M, C, K;                ///< of one size and kind
    std::vector<unsigned char> kinds = {0};                  ///< see kind_pattern()
    std::vector<double> constant_force;                      ///< one entry a DoF [N, N m]
    std::vector<std::shared_ptr<const TimeLoad>> time_loads; ///< added to constant_force
    std::vector<ConstrainedDof> constrained;                 ///< each DoF once

  private:
    void check_sizes() const;
    void check_numbers() const;
    void require_linear(const char *function) const;

    std::string body_name, body_origin;
    bool moving_constraints = false, displaced_constraints = false, is_finished = false;
  };

  /// P += magnitude(t) * shape.
  class PointLoad : public TimeLoad
  {
  public:
    PointLoad(const LinearForm &shape, std::function<double(double)> magnitude)
        : shape(shape), magnitude(std::move(magnitude))
    {
    }
    void add(double t, std::vector<double> &P) const override { shape.add_to(magnitude(t), P); }
    double sample(const double t) const override { return magnitude(t); }

    /// The fault that makes this no load on @p n_dofs DoFs, as a part of a message; empty: none.
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
