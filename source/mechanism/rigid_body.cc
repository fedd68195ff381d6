// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanism/constrained_solver.h"

#include "substructure/line_fields.h"
#include <taut/base/exceptions.h>
#include <taut/mechanism/rigid_body.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr unsigned int n_coordinates = 12, n_conditions = 6;

    /// Directors of each condition.
    constexpr unsigned int pairs[n_conditions][2] = {{0, 0}, {1, 1}, {2, 2},
                                                     {0, 1}, {0, 2}, {1, 2}};

    constexpr unsigned int first_dof(const unsigned int director)
    {
      return 3 + 3 * director;
    }

    /// Smallest part of the inertia along an axis: bodies may be flat.
    constexpr double least_inertia = 1e-12;

    /// At rest the mass resists motions of the size of the body by this factor times the forces on
    /// the body. The first factor is for the first iteration. Later the factor is proportional to
    /// the rotation of the last iteration, between two bounds.
    constexpr double part_at_first = 5., part_of_rotation = 4., least_part = 1e-4, most_part = 2.;
  } // namespace

  RigidBody::RigidBody(const RigidBodyData &given)
      : Substructure(given.name, given.origin), data(given)
  {
    check();
    const double sum = .5 * (data.moments[0] + data.moments[1] + data.moments[2]);
    length = std::sqrt(sum / data.mass);
    const double weight = data.mass * norm(data.gravity);
    scale = weight > 0. ? weight * length : sum;

    const unsigned int n = n_coordinates + n_conditions;
    kinds.assign(n, 0);
    std::fill(kinds.begin() + n_coordinates, kinds.end(), 1);
    M = std::make_unique<CompressedMatrix>(n);
    C = std::make_unique<CompressedMatrix>(n);
    for (unsigned int c = 0; c < 3; ++c)
      M->add(c, c, data.mass);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        M->add(first_dof(i) + c, first_dof(i) + c,
               std::max(least_inertia * sum, sum - data.moments[i]) / (length * length));
    const std::vector<double> undeformed(n, 0.);
    K = tangent(undeformed, {}, 1., false);
    constant_force.assign(n, 0.);
    for (unsigned int c = 0; c < 3; ++c)
      constant_force[c] = data.mass * data.gravity[c];
    finish();
  }

  void RigidBody::check() const
  {
    const auto require = [&](const bool holds, const std::string &name, const std::string &message)
    {
      if (!holds)
        throw EntryError(data.origin.empty() ? name : data.origin + "/" + name, message);
    };
    require(data.mass > 0., "Mass", "a rigid body needs a positive one [kg]");
    const std::array<double, 3> &J = data.moments;
    require(*std::min_element(J.begin(), J.end()) > 0., "Moments of inertia",
            "a rigid body needs three positive ones [kg m^2]");
    require(*std::max_element(J.begin(), J.end()) <=
                .5 * (J[0] + J[1] + J[2]) * (1. + least_inertia),
            "Moments of inertia",
            "one is more than the two others together, which no body has; check them");
  }

  LinearForm RigidBody::displacement(const Coordinates &place, const Coordinates &direction) const
  {
    const Coordinates arm = place - data.centre;
    LinearForm form;
    for (unsigned int c = 0; c < 3; ++c)
      if (direction[c] != 0.)
      {
        form.add(c, direction[c]);
        for (unsigned int i = 0; i < 3; ++i)
          if (const double part = dot(arm, data.axes[i]) / length; part != 0.)
            form.add(first_dof(i) + c, part * direction[c]);
      }
    return form;
  }

  RigidBody::Directors RigidBody::directors(const std::vector<double> &U) const
  {
    Directors d;
    for (unsigned int i = 0; i < 3; ++i)
    {
      const double *u = U.data() + first_dof(i);
      d[i] = add_scaled({u[0], u[1], u[2]}, length, data.axes[i]);
    }
    return d;
  }

  Coordinates RigidBody::place(const std::vector<double> &U, const Coordinates &undeformed) const
  {
    const Directors d = directors(U);
    Coordinates result = centre(U);
    for (unsigned int i = 0; i < 3; ++i)
      result = add_scaled(result, dot(undeformed - data.centre, data.axes[i]) / length, d[i]);
    return result;
  }

  Coordinates RigidBody::centre(const std::vector<double> &U) const
  {
    return add_scaled(data.centre, 1., {U[0], U[1], U[2]});
  }

  /// By the unit quaternion of the matrix R = sum_i d_i a_i^T / l, from its largest component (S.
  /// W. Shepperd, Journal of Guidance and Control 1 (1978)).
  Coordinates RigidBody::rotation(const std::vector<double> &U) const
  {
    const Directors d = directors(U);
    double R[3][3] = {};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          R[r][c] += d[i][r] / length * data.axes[i][c];
    const double trace = R[0][0] + R[1][1] + R[2][2];
    const double squared[4] = {1. + trace, 1. - trace + 2. * R[0][0], 1. - trace + 2. * R[1][1],
                               1. - trace + 2. * R[2][2]}; // four times those of the quaternion
    const auto skew = [&](const unsigned int k)
    { return R[(k + 2) % 3][(k + 1) % 3] - R[(k + 1) % 3][(k + 2) % 3]; };
    const unsigned int largest = std::max_element(squared, squared + 4) - squared;
    const double twice = std::sqrt(squared[largest]);
    double w, v[3];
    if (largest == 0)
    {
      w = .5 * twice;
      for (unsigned int k = 0; k < 3; ++k)
        v[k] = .5 * skew(k) / twice;
    }
    else
    {
      const unsigned int l = largest - 1;
      w = .5 * skew(l) / twice;
      for (unsigned int k = 0; k < 3; ++k)
        v[k] = k == l ? .5 * twice : .5 * (R[k][l] + R[l][k]) / twice;
    }
    const double sign = w < 0. ? -1. : 1., sine = std::hypot(std::hypot(v[0], v[1]), v[2]);
    return add_scaled({}, sine == 0. ? 0. : sign * 2. * std::atan2(sine, std::fabs(w)) / sine,
                      {v[0], v[1], v[2]});
  }

  RigidBody::Multipliers RigidBody::conditions(const Directors &d) const
  {
    Multipliers g;
    for (unsigned int k = 0; k < n_conditions; ++k)
    {
      const auto [i, j] = pairs[k];
      const double product = dot(d[i], d[j]) / (length * length);
      g[k] = i == j ? .5 * (product - 1.) : product;
    }
    return g;
  }

  double RigidBody::deformation(const std::vector<double> &U) const
  {
    double largest = 0.;
    for (const double g : conditions(directors(U)))
      largest = std::max(largest, std::fabs(g));
    return largest;
  }

  /// Lambda G^T s.
  void RigidBody::add_forces(const Directors &d, const std::vector<double> &U,
                             std::vector<double> &f) const
  {
    for (unsigned int k = 0; k < n_conditions; ++k)
    {
      const auto [i, j] = pairs[k];
      const double factor = scale * U[n_coordinates + k] / (length * length);
      for (unsigned int c = 0; c < 3; ++c)
      {
        f[first_dof(i) + c] += factor * d[j][c];
        if (i != j)
          f[first_dof(j) + c] += factor * d[i][c];
      }
    }
  }

  void RigidBody::internal_force(const std::vector<double> &U, const std::vector<double> &,
                                 std::vector<double> &f) const
  {
    const Directors d = directors(U);
    const Multipliers g = conditions(d);
    f.assign(n_dofs(), 0.);
    add_forces(d, U, f);
    for (unsigned int k = 0; k < n_conditions; ++k)
      f[n_coordinates + k] = scale * g[k];
  }

  void RigidBody::mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                                      double, std::vector<double> &f) const
  {
    const Directors before = directors(U0), after = directors(U1);
    Directors middle;
    for (unsigned int i = 0; i < 3; ++i)
      middle[i] = add_scaled(add_scaled({}, .5, before[i]), .5, after[i]);
    const Multipliers g = conditions(after);
    f.assign(n_dofs(), 0.);
    add_forces(middle, U1, f);
    for (unsigned int k = 0; k < n_conditions; ++k)
      f[n_coordinates + k] = scale * g[k];
  }

  /// The conditions are differences of squares of the directors, which round with these squares.
  double RigidBody::rounding_of_force(const unsigned int kind) const
  {
    constexpr double operations = 8.;
    return kind == 0 ? 0. : operations * std::numeric_limits<double>::epsilon() * scale;
  }

  /// A += part Lambda G, below its transpose.
  void RigidBody::add_conditions(const Directors &d, const double part, SymmetricMatrix &A) const
  {
    const double factor = part * scale / (length * length);
    for (unsigned int k = 0; k < n_conditions; ++k)
    {
      const auto [i, j] = pairs[k];
      for (unsigned int c = 0; c < 3; ++c)
      {
        A.add(n_coordinates + k, first_dof(i) + c, factor * d[j][c]);
        if (i != j)
          A.add(n_coordinates + k, first_dof(j) + c, factor * d[i][c]);
      }
    }
  }

  /**
   * Geometric stiffness Lambda s_ij / l^2 between the directors i and j. It resists rotations as
   * the matrix tr(s) - s. @p definite leaves out the negative part of this matrix.
   */
  void RigidBody::add_geometric(const std::vector<double> &U, const bool definite,
                                SymmetricMatrix &A) const
  {
    dealii::SymmetricTensor<2, 3> s;
    for (unsigned int k = 0; k < n_conditions; ++k)
      s[pairs[k][0]][pairs[k][1]] = U[n_coordinates + k];
    if (definite)
    {
      const auto eigen = dealii::eigenvectors(s);
      const double trace = dealii::trace(s);
      double resistance[3], sum = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        sum += resistance[k] = std::max(0., trace - eigen[k].first);
      s = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        s += (.5 * sum - resistance[k]) *
             dealii::symmetrize(dealii::outer_product(eigen[k].second, eigen[k].second));
    }
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        for (unsigned int c = 0; c < 3; ++c)
          A.add(first_dof(i) + c, first_dof(j) + c, scale / (length * length) * s[i][j]);
  }

  /// A factor of the mass matrix [1/s^2].
  double RigidBody::resistance_at_rest(const std::vector<double> &U) const
  {
    double force = 0., inner_force = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      force = std::max(force, std::fabs(constant_force[c]));
    for (unsigned int k = 0; k < n_conditions; ++k)
      inner_force = std::max(inner_force, std::fabs(U[n_coordinates + k]) * scale / length);
    if (force == 0. && inner_force == 0.)
      return 1.;
    // Directors that turn linearly become longer.
    const double rotation = std::sqrt(2. * deformation(U)),
                 part =
                     inner_force == 0.
                         ? part_at_first
                         : std::min(most_part, std::max(least_part, part_of_rotation * rotation));
    return part * std::max(force, inner_force) / (length * data.mass);
  }

  std::unique_ptr<SymmetricMatrix> RigidBody::zero_matrix() const
  {
    if (!spare)
      return std::make_unique<CompressedMatrix>(n_coordinates + n_conditions);
    spare->set_zero();
    return std::move(spare);
  }

  std::unique_ptr<SymmetricMatrix> RigidBody::tangent(const std::vector<double> &U,
                                                      const std::vector<double> &,
                                                      const double rate, const bool definite) const
  {
    const bool at_rest = rate == 0.;
    std::unique_ptr<SymmetricMatrix> A = zero_matrix();
    add_conditions(directors(U), 1., *A);
    add_geometric(U, definite || at_rest, *A);
    if (at_rest)
      A->add(resistance_at_rest(U), *M);
    A->find_repetitions();
    return A;
  }

  std::unique_ptr<SymmetricMatrix> RigidBody::mean_tangent(const std::vector<double> &U0,
                                                           const std::vector<double> &U1,
                                                           const double, const bool definite) const
  {
    middle = U1;
    for (unsigned int i = 0; i < n_coordinates; ++i)
      middle[i] = .5 * (U0[i] + U1[i]);
    std::unique_ptr<SymmetricMatrix> A = zero_matrix();
    add_conditions(directors(middle), 2., *A);
    add_geometric(middle, definite, *A);
    A->find_repetitions();
    return A;
  }

  std::unique_ptr<SymmetricMatrix> RigidBody::mass_at(const std::vector<double> &U) const
  {
    std::unique_ptr<SymmetricMatrix> A = zero_matrix();
    A->add(1., *M);
    add_conditions(directors(U), 1., *A);
    A->find_repetitions();
    return A;
  }

  std::unique_ptr<LocalSolver> RigidBody::make_solver() const
  {
    return std::make_unique<ConstrainedSolver>(n_coordinates);
  }

  void RigidBody::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    Substructure::initial_state(U, V);
    for (unsigned int c = 0; c < 3; ++c)
      V[c] = data.velocity[c];
    for (unsigned int i = 0; i < 3; ++i)
    {
      const Coordinates rate = cross(data.angular_velocity, data.axes[i]);
      for (unsigned int c = 0; c < 3; ++c)
        V[first_dof(i) + c] = length * rate[c];
    }
  }

  void RigidBody::write_vtu(const std::string &path, const std::vector<double> &U) const
  {
    std::vector<std::vector<LinePoint>> lines;
    const auto add_line = [&](const Coordinates &a, const Coordinates &b)
    {
      lines.emplace_back();
      for (const Coordinates &at : {a, b})
        lines.back().push_back({at, place(U, at) - at, {}});
    };
    for (std::size_t k = 1; k < data.outline.size(); ++k)
      add_line(data.outline[k - 1], data.outline[k]);
    if (lines.empty())
      for (const Coordinates &axis : data.axes)
        add_line(data.centre, add_scaled(data.centre, length, axis));
    write_lines(path, lines, {});
  }
} // namespace taut
