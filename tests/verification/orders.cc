// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: on smooth problems backward Euler is of first order; BDF2, Newmark (1/4, 1/2),
// generalised-alpha (0.8) and (0), HHT (0.1) and (0.3) are of second order, whatever the bodies
// hang on. The reference knows nothing of the time stepper: the matrices of the bodies, joints
// eliminated, integrated by the classical Runge-Kutta method of fourth order with a step of 1/16 of
// the smallest tested one or less.
#include "scene_tests.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace verification;

namespace
{
  using Vector = dealii::Vector<double>;
  using Matrix = dealii::FullMatrix<double>;

  /// All bodies in one vector.
  Vector flat(const taut::BodyVectors &U)
  {
    std::vector<double> all;
    for (const std::vector<double> &block : U)
      all.insert(all.end(), block.begin(), block.end());
    return Vector(all.begin(), all.end());
  }

  /// Motion of a moving support and its derivatives.
  struct Given
  {
    double u = 0., v = 0., a = 0.;
  };
  using Motion = std::function<Given(double)>;

  /**
   * M u" + C u' + K u = P(t) of all bodies in one vector. A joint with a stiffness adds k b b^T and
   * c b b^T; a rigid one is eliminated, u = T y with T the identity but for one constraint. A
   * support that moves is a given part of u.
   */
  class Reference
  {
  public:
    Reference(const taut::Structure &structure, const taut::Constraints &constraints,
              const Motion &motion)
        : structure(structure), motion(motion), n(structure.n_dofs()), M(n), C(n), K(n),
          T(dealii::IdentityMatrix(n)), M_inverse(n), constrained(n, 0), moving(n, 0)
    {
      unsigned int offset = 0;
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        offsets.push_back(offset);
        const auto add = [&](const taut::SymmetricMatrix &from, Matrix &to)
        {
          from.visit([&](unsigned int i, unsigned int j, double value)
                     { to(offset + i, offset + j) = to(offset + j, offset + i) = value; });
        };
        add(structure[k].mass(), M);
        add(structure[k].damping(), C);
        add(structure[k].stiffness(), K);
        for (const taut::ConstrainedDof &c : structure[k].constraints())
        {
          constrained[offset + c.dof] = 1;
          moving[offset + c.dof] = static_cast<bool>(c.motion);
        }
        offset += structure[k].n_dofs();
      }
      for (std::size_t r = 0; r < constraints.size(); ++r)
        add_joint(constraints[r]);
      M_inverse.triple_product(M, T, T, true);
      for (unsigned int i = 0; i < n; ++i)
        if (is_eliminated(i))
          for (unsigned int j = 0; j < n; ++j)
            M_inverse(i, j) = M_inverse(j, i) = i == j;
      M_inverse.gauss_jordan();
    }

    /// Displacements at multiples of @p step from given U and V, all bodies in one vector.
    std::vector<Vector> solve(Vector u, Vector v, const double step, const int substeps,
                              const int n_steps)
    {
      const double dt = step / substeps;
      const auto sum = [](Vector x, double f, const Vector &y)
      {
        x.add(f, y);
        return x;
      };
      std::vector<Vector> result = {u};
      forces = {multiplier(0., u, v)};
      double t = 0.;
      for (int i = 0; i < n_steps; ++i)
      {
        for (int k = 0; k < substeps; ++k)
        {
          t = i * step + k * dt;
          const Vector a1 = acceleration(t, u, v);
          const Vector u2 = sum(u, .5 * dt, v), v2 = sum(v, .5 * dt, a1),
                       a2 = acceleration(t + .5 * dt, u2, v2);
          const Vector u3 = sum(u, .5 * dt, v2), v3 = sum(v, .5 * dt, a2),
                       a3 = acceleration(t + .5 * dt, u3, v3);
          const Vector v4 = sum(v, dt, a3), a4 = acceleration(t + dt, sum(u, dt, v3), v4);
          u.add(dt / 6., v, dt / 3., v2);
          u.add(dt / 3., v3, dt / 6., v4);
          v.add(dt / 6., a1, dt / 3., a2);
          v.add(dt / 3., a3, dt / 6., a4);
          set_given(t + dt, u, v);
        }
        result.push_back(u);
        forces.push_back(multiplier(t + dt, u, v));
      }
      return result;
    }

    /// Force of the rigid joint at the times of the last solve().
    std::vector<double> forces;

  private:
    bool is_eliminated(const unsigned int i) const
    {
      return constrained[i] || static_cast<int>(i) == pivot;
    }

    void add_joint(const taut::ConstraintData &constraint)
    {
      Vector b(n);
      for (const taut::Term &term : constraint.terms)
        for (std::size_t i = 0; i < term.form.index.size(); ++i)
          b[offsets[term.substructure] + term.form.index[i]] += term.form.value[i];
      if (!constraint.spring.is_rigid())
      {
        Matrix bb(n);
        bb.outer_product(b, b);
        K.add(constraint.spring.stiffness, bb);
        C.add(constraint.spring.damping, bb);
        return;
      }
      pivot = 0;
      for (unsigned int i = 0; i < n; ++i)
        if (std::fabs(b[i]) > std::fabs(b[pivot]) && !constrained[i])
          pivot = i;
      pivot_factor = b[pivot];
      for (unsigned int i = 0; i < n; ++i)
        T(pivot, i) = static_cast<int>(i) == pivot ? 0. : -b[i] / pivot_factor;
    }

    void set_given(const double t, Vector &u, Vector &v) const
    {
      for (unsigned int i = 0; i < n; ++i)
        if (moving[i])
        {
          u[i] = motion(t).u;
          v[i] = motion(t).v;
        }
    }

    /// P - C v - K u, and minus M times the acceleration of moving supports.
    Vector balance(const double t, const Vector &u, const Vector &v) const
    {
      Vector r(n), given(n), product(n);
      std::vector<double> P;
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        structure[k].external_force(t, P);
        std::copy(P.begin(), P.end(), r.begin() + offsets[k]);
      }
      for (unsigned int i = 0; i < n; ++i)
        given[i] = moving[i] ? motion(t).a : 0.;
      C.vmult(product, v);
      K.vmult(product, u, true);
      M.vmult(product, given, true);
      r -= product;
      return r;
    }

    Vector acceleration(const double t, Vector u, Vector v) const
    {
      set_given(t, u, v);
      Vector reduced(n), y(n), a(n);
      T.Tvmult(reduced, balance(t, u, v));
      for (unsigned int i = 0; i < n; ++i)
        if (is_eliminated(i))
          reduced[i] = 0.;
      M_inverse.vmult(y, reduced);
      T.vmult(a, y);
      for (unsigned int i = 0; i < n; ++i)
        if (constrained[i])
          a[i] = moving[i] ? motion(t).a : 0.;
      return a;
    }

    double multiplier(const double t, const Vector &u, const Vector &v) const
    {
      if (pivot < 0)
        return 0.;
      Vector Ma(n);
      M.vmult(Ma, acceleration(t, u, v));
      return (Ma[pivot] - balance(t, u, v)[pivot]) / pivot_factor;
    }

    const taut::Structure &structure;
    const Motion motion;
    const unsigned int n;
    Matrix M, C, K, T, M_inverse;
    std::vector<unsigned int> offsets;
    std::vector<char> constrained, moving;
    int pivot = -1;
    double pivot_factor = 1.;
  };

  struct Scheme
  {
    std::string name;
    Overrides overrides;
    double order;
    double force_order = order; ///< a mean over the step is late by half of it
  };
  const std::vector<Scheme> schemes = {
      {"backward Euler", {"Time.Scheme=backward Euler"}, 1.},
      {"BDF2", {"Time.Scheme=BDF2"}, 2.},
      {"Newmark (1/4, 1/2)", {"Time.Scheme=Newmark"}, 2.},
      {"generalised-alpha (0.8)", {"Time.Scheme=generalised-alpha"}, 2.},
      {"generalised-alpha (0)",
       {"Time.Scheme=generalised-alpha", "Time.Generalised-alpha.Spectral radius=0"},
       2.},
      {"HHT (0.1)", {"Time.Scheme=HHT"}, 2.},
      {"HHT (0.3)", {"Time.Scheme=HHT", "Time.HHT.Alpha=0.3"}, 2.},
      {"Moreau-Jean (1/2)", {"Time.Scheme=Moreau-Jean"}, 2., 1.},
      {"Moreau-Jean of velocities (1/2)",
       {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=velocities"},
       2.,
       1.},
      {"Moreau-Jean of gaps (1/2)",
       {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=gaps"},
       2.,
       1.}};

  struct Orders
  {
    std::map<std::string, double> displacement, force;
  };

  /**
   * Runs a scene with all schemes, N, 2 N, 4 N, ... steps to @p end, and compares all displacements
   * at N times, and the force of a rigid joint over the second half of the run.
   */
  Orders measure(const std::string &name, const std::string &scene, const double end,
                 const Motion &motion = {}, const int coarsest = 200, const int refinements = 5)
  {
    Session session(scene, {"Time.Step=1e-3", "Time.End=1e-3"});
    const taut::Structure &structure = session.simulation().structure();
    Vector start_u, start_v;
    session.run(
        [&](const taut::StepView &view)
        {
          if (view.state.time > 0.)
            return;
          start_u = flat(view.state.U);
          start_u += flat(view.reference.displacement);
          start_v = flat(view.state.V);
        });
    Reference reference(structure, session.simulation().constraints(), motion);
    const std::vector<Vector> exact =
        reference.solve(start_u, start_v, end / coarsest, 16 << (refinements - 1), coarsest);
    const double force_size = largest(reference.forces);
    double size = 0.;
    for (const Vector &u : exact)
      size = std::max(size, u.linfty_norm());

    Orders orders;
    for (const Scheme &scheme : schemes)
    {
      std::vector<double> steps, errors, force_errors;
      for (int k = 0; k < refinements; ++k)
      {
        // Backward Euler reaches its order at shorter steps only.
        const int ratio = (scheme.order == 1. ? 16 : 1) << k;
        steps.push_back(end / (coarsest * ratio));
        const Overrides overrides =
            scheme.overrides +
            Overrides{"Time.Step=" + number(steps.back()), "Time.End=" + number(end)};
        double error = 0., force_error = 0.;
        int i = 0;
        run_scene(scene, overrides,
                  [&](const taut::StepView &view)
                  {
                    const int number = i++;
                    if (number % ratio != 0)
                      return;
                    Vector u = flat(view.state.U);
                    u += flat(view.reference.displacement);
                    u -= exact[number / ratio];
                    raise(error, u.linfty_norm());
                    if (force_size > 0. && number / ratio > coarsest / 2)
                      raise(force_error,
                            view.state.multiplier[0] - reference.forces[number / ratio]);
                  });
        errors.push_back(error / size);
        force_errors.push_back(force_size > 0. ? force_error / force_size : 1.);
      }
      orders.displacement[scheme.name] = fitted_order(steps, errors);
      figure(name + ", order of " + scheme.name, orders.displacement[scheme.name]);
      figure(name + ", relative error of " + scheme.name + " at the smallest step", errors.back());
      if (force_size > 0.)
      {
        orders.force[scheme.name] = fitted_order(steps, force_errors);
        figure(name + ", order of the joint's force, " + scheme.name, orders.force[scheme.name]);
        figure(name + ", relative error of the joint's force, " + scheme.name +
                   " at the smallest step",
               force_errors.back());
      }
      EXPECT_NEAR(orders.displacement[scheme.name], scheme.order, .1)
          << name << ", " << scheme.name;
    }
    return orders;
  }

  /// A beam of 4 m on supports at its ends.
  const std::string beam = R"(Gravity = 0, 0
Wire beam: To = 4, 0; Components = beam; Mass per length = 1.5; Tension = 60;
  Bending stiffness = 20; Element size = 1
Support ends: Wire = beam; Positions = 0, 4
)";
} // namespace

TEST(Orders, free_vibration_from_a_given_displacement_and_velocity)
{
  measure("free vibration of a beam", beam + R"(Start = given
Wire beam: Initial transverse displacement = 0.01*sin(pi*s/4)+0.004*sin(pi*s/2);
  Initial transverse velocity = 0.1*sin(pi*s/4); Element size = 0.5
)",
          2.);
}

TEST(Orders, rayleigh_damped_beam)
{
  measure("Rayleigh-damped beam", beam + R"(Start = given
Wire beam: Mass damping = 1.5; Stiffness damping = 0.01;
  Initial transverse displacement = 0.01*sin(pi*s/4)
)",
          2.);
}

TEST(Orders, moving_force)
{
  // Enters at a quarter of the span, smoothly: a force that is switched on excites modes that no
  // step here resolves.
  measure("moving force on a beam", beam + R"(Start = undeformed
Load force: Type = moving; On = beam @ 1; Speed = 1; Magnitude = -10*sin(pi*t/4)^4
)",
          2., {}, 3200, 4);
}

TEST(Orders, load_that_changes_from_an_equilibrium)
{
  measure("load from equilibrium", beam + R"(Start = equilibrium
Load force: Type = point; On = beam @ 1.5; Magnitude = 10+5*sin(4*t)^2
)",
          2.);
}

TEST(Orders, rigid_joint_between_two_bodies)
{
  const Orders orders = measure("rigid joint of two beams", beam + R"(Start = undeformed
Wire beam: To = 2, 0
Support ends: Positions = 0
Wire other: From = 2, 0; To = 4, 0; Components = beam; Mass per length = 1.5; Tension = 60;
  Bending stiffness = 20; Element size = 1
Support far end: Wire = other; Positions = 2
Link joint: Type = joint; From = beam @ 2; To = other @ 0; Direction = 0, 1
Load force: Type = point; On = beam @ 1; Magnitude = 10*sin(2*t)^4
)",
                                2.);
  for (const Scheme &scheme : schemes)
    EXPECT_NEAR(orders.force.at(scheme.name), scheme.force_order, .2) << scheme.name;
}

TEST(Orders, moving_support)
{
  // u = 0.01 sin(3 t)^3
  const Motion motion = [](const double t)
  {
    const double s = std::sin(3. * t), c = std::cos(3. * t);
    return Given{.01 * s * s * s, .09 * s * s * c, .27 * (2. * s * c * c - s * s * s)};
  };
  measure("moving support", beam + R"(Start = equilibrium
Wire beam: Mass damping = 0.5; Stiffness damping = 1e-3
Support ends: Positions = 4
Support moving: Wire = beam; Positions = 0; Displacement = 0.01*sin(3*t)^3
)",
          2., motion);
}

TEST(Orders, damped_link_under_a_load)
{
  measure("Kelvin-Voigt link of mass and beam", beam + R"(Start = equilibrium
Mass mass: Position = 1, -1; Mass = 2; Motions = y
Link link: Type = joint; From = mass; To = beam @ 1; Direction = 0, 1; Stiffness = 400;
  Damping = 20
Load force: Type = point; On = mass; Magnitude = 10*sin(2*t)^4
)",
          2.);
}

TEST(Orders, damped_link_of_bodies_that_move_at_the_start)
{
  measure("Kelvin-Voigt link of moving masses", R"(Gravity = 0, 0; Start = given
Mass one: Position = 0, 0; Mass = 2; Motions = y; Initial velocity = 0, 0.5, 0;
  Initial displacement = 0, 0.02, 0
Mass two: Position = 0, 1; Mass = 3; Motions = y; Initial velocity = 0, -0.3, 0
Spring spring: From = ground; To = one; Stiffness = 100
Link link: Type = joint; From = one; To = two; Direction = 0, 1; Stiffness = 400; Damping = 20
)",
          2.);
}
