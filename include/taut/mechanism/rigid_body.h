// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rigid_body_h
#define taut_rigid_body_h

#include <taut/base/coordinates.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/substructure.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// The data of a rigid body in its undeformed position.
  struct RigidBodyData
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    double mass = 0.;   ///< [kg]
    Coordinates centre; ///< of mass [m]
    std::array<Coordinates, 3> axes = {
        {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}}; ///< principal: unit vectors, right-handed
    std::array<double, 3> moments = {{0., 0., 0.}};  ///< of inertia about the axes [kg m^2]
    Coordinates gravity;                             ///< [m/s^2]
    Coordinates velocity, angular_velocity;          ///< at t = 0, with Start = given [m/s, rad/s]
    std::vector<Coordinates> outline;                ///< places that a line joins in pictures [m]
  };

  /**
   * A rigid body in space that moves and turns by any amount (finite rotations). Take it for a part
   * that hardly deforms. It has natural coordinates (P. Betsch, P. Steinmann, Computer Methods in
   * Applied Mechanics and Engineering 191 (2001), 467-488): the place c of the centre and three
   * vectors (directors) d_i along the principal axes, as long as the radius of gyration l. The mass
   * matrix is constant, and every place on the body is a linear function of the coordinates,
   *
   *     x = c + sum_i (xi_i / l) d_i,
   *
   * so that links, loads and contacts act as on any other body. U has the change of these twelve
   * coordinates [m], c, d_1, d_2, d_3, and six Lagrange multipliers s [1]. The multipliers belong
   * to the conditions that keep the d_i orthogonal and of equal length, in the order 11, 22, 33,
   * 12, 13, 23,
   *
   *     g_ij = (d_i . d_j - D_i . D_j) / l^2 = 0, half of it for i = j,    f = Lambda (G^T s, g).
   *
   * Lambda [N m] scales s to ordinary numbers. The internal force does no work. The mean force over
   * a step has G in the middle of the step and the s of the step, so that G_mean dq = g_1 - g_0
   * exactly. Energy, momentum and angular momentum are kept (P. Betsch, P. Steinmann, Multibody
   * System Dynamics 8 (2002), 367-391), and g does not drift.
   *
   * Impulses meet the mass matrix with the same conditions, see mass_at(). At rest the tangent is
   * the geometric stiffness of s, without the part that would turn the body over, and a part of the
   * mass, which falls as the iteration settles. So the body needs no support of its own.
   */
  class RigidBody : public Substructure, public ConstrainedBody
  {
  public:
    /// Throws EntryError for data that make no body.
    explicit RigidBody(const RigidBodyData &data);

    /// The displacement at a place of the undeformed position, on the body or outside, along any
    /// direction in space.
    LinearForm displacement(const Coordinates &place, const Coordinates &direction) const override;

    /// The radius of gyration l [m].
    double radius_of_gyration() const { return length; }

    /// The displaced centre of mass, in the coordinates of the scene [m].
    Coordinates centre(const std::vector<double> &U) const;

    /// The rotation from the undeformed position, along its axis, at most pi long [rad].
    Coordinates rotation(const std::vector<double> &U) const;

    /// The largest |g_ij|, the error of rigidity [1].
    double deformation(const std::vector<double> &U) const;

    bool is_lumped() const override { return true; }
    bool is_linear() const override { return false; }
    double strain_energy(const std::vector<double> &) const override { return 0.; }
    void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                        std::vector<double> &f) const override;
    double rounding_of_force(unsigned int kind) const override;
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             double step, std::vector<double> &f) const override;
    std::unique_ptr<SymmetricMatrix> tangent(const std::vector<double> &U,
                                             const std::vector<double> &V, double rate,
                                             bool definite) const override;
    std::unique_ptr<SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                  const std::vector<double> &U1, double rate,
                                                  bool definite) const override;
    std::unique_ptr<SymmetricMatrix> mass_at(const std::vector<double> &U) const override;
    void take_back(std::unique_ptr<SymmetricMatrix> tangent) const override
    {
      spare = std::move(tangent);
    }
    std::unique_ptr<LocalSolver> make_solver() const override;

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override;

    /// The outline of the body, or its principal axes, with the displacement.
    bool has_fields() const override { return true; }
    void write_vtu(const std::string &path, const std::vector<double> &U) const override;

  private:
    using Directors = std::array<Coordinates, 3>;
    using Multipliers = std::array<double, 6>;

    void check() const;
    Directors directors(const std::vector<double> &U) const;
    Coordinates place(const std::vector<double> &U, const Coordinates &undeformed) const;
    Multipliers conditions(const Directors &d) const;
    void add_forces(const Directors &d, const std::vector<double> &U, std::vector<double> &f) const;
    void add_conditions(const Directors &d, double part, SymmetricMatrix &A) const;
    void add_geometric(const std::vector<double> &U, bool definite, SymmetricMatrix &A) const;
    double resistance_at_rest(const std::vector<double> &U) const;
    std::unique_ptr<SymmetricMatrix> zero_matrix() const;

    RigidBodyData data;
    double length = 0., scale = 0.;                 ///< l [m], Lambda [N m]
    mutable std::vector<double> middle;             ///< in mean_tangent()
    mutable std::unique_ptr<SymmetricMatrix> spare; ///< a tangent that came back
  };
} // namespace taut

#endif
