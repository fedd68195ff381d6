// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: mass and stiffness of a wire as Structure assembles them give the natural frequencies of
// beam, string and bar. Source: simply supported tensioned beam, omega_n^2 = (T q^2 + EI q^4)/m,
// q = n pi/L; fixed bar or string, omega_n = n pi c/L.
#include "scene_tests.h"

#include <deal.II/lac/lapack_templates.h>

using namespace verification;

namespace
{
  /// Squares of the natural frequencies of a body [1/s^2], ascending.
  std::vector<double> eigenvalues(const taut::Substructure &body)
  {
    std::vector<int> number(body.n_dofs(), 0);
    for (const unsigned int dof : body.constrained_dofs())
      number[dof] = -1;
    int n = 0;
    for (int &i : number)
      if (i == 0)
        i = n++;
    std::vector<double> K(n * n, 0.), M(n * n, 0.), w(n), work(40 * n);
    const auto fill = [&](const taut::SymmetricMatrix &matrix, std::vector<double> &full)
    {
      matrix.visit(
          [&](unsigned int i, unsigned int j, double value)
          {
            if (number[i] >= 0 && number[j] >= 0)
              full[number[i] * n + number[j]] = full[number[j] * n + number[i]] = value;
          });
    };
    fill(body.stiffness(), K);
    fill(body.mass(), M);
    const int type = 1, lwork = work.size();
    int info = 0;
    dealii::sygv(&type, "N", "L", &n, K.data(), &n, M.data(), &n, w.data(), work.data(), &lwork,
                 &info);
    EXPECT_EQ(info, 0);
    return w;
  }

  /// A wire of 6 m and 1.35 kg/m on supports, inclined: positions along it, not along x.
  taut::Scene wire_scene(const double element_size, const taut::TransverseKind kind,
                         const double tension, const std::vector<double> &supports = {0., 6.})
  {
    taut::Scene scene;
    scene.wires.resize(1);
    taut::Wire &wire = scene.wires[0];
    wire.name = "wire";
    wire.a = {1., 2.};
    wire.b = {1. + 4.8, 2. + 3.6};
    wire.mass_per_length = 1.35;
    wire.element_size = element_size;
    wire.transverse = kind;
    wire.tension = tension;
    scene.supports.resize(1);
    scene.supports[0].positions = supports;
    return scene;
  }

  /// Natural frequencies of its only body [1/s].
  std::vector<double> frequencies(const taut::Scene &scene)
  {
    std::vector<double> values = eigenvalues(taut::SceneBodies(scene)[0]);
    for (double &v : values)
      v = std::sqrt(v);
    return values;
  }

  /// Relative errors of the first frequencies for several element sizes, and their orders.
  void check_orders(const std::string &name, const std::vector<double> &sizes,
                    const std::function<std::vector<double>(double)> &frequencies,
                    const std::function<double(int)> &exact, const double order,
                    const double tolerance)
  {
    for (int n = 1; n <= 4; ++n)
    {
      std::vector<double> errors;
      for (const double h : sizes)
        errors.push_back(std::fabs(frequencies(h)[n - 1] / exact(n) - 1.));
      const double fitted = fitted_order(sizes, errors);
      figure(name + ", order of frequency " + std::to_string(n), fitted);
      figure(name + ", error of frequency " + std::to_string(n) + " on the finest grid",
             errors.back());
      EXPECT_NEAR(fitted, order, tolerance) << name << ", frequency " << n;
    }
  }

  /// Frequencies of a string of tension T with a point mass [1/s].
  std::vector<double> string_with_a_mass(const double T, const std::vector<double> &supports,
                                         const double place, const double mass)
  {
    taut::Scene scene = wire_scene(.05, taut::TransverseKind::string, T, supports);
    scene.point_masses.resize(1);
    scene.point_masses[0].positions = {place};
    scene.point_masses[0].mass = mass;
    return frequencies(scene);
  }

  /// z tan(z) = a within a quarter of a circle from @p low on.
  double root_of_z_tan_z(const double a, const double low)
  {
    return end_of(low, low + .5 * std::acos(-1.), [a](double z) { return z * std::tan(z) < a; });
  }
} // namespace

TEST(Frequencies, tensioned_beam_converges_with_order_4)
{
  const double T = 2000., EI = 195., m = 1.35, L = 6.;
  check_orders(
      "tensioned beam", {.75, .5, .375, .25, .1875},
      [&](const double h)
      {
        taut::Scene scene = wire_scene(h, taut::TransverseKind::beam, T);
        scene.wires[0].bending_stiffness = EI;
        return frequencies(scene);
      },
      [&](const int n)
      {
        const double q = n * pi / L;
        return std::sqrt((T * q * q + EI * q * q * q * q) / m);
      },
      4., .1);
}

TEST(Frequencies, string_and_bar_converge_with_twice_their_degree)
{
  const double L = 6., m = 1.35, stiffness = 2000.;
  for (const bool bar : {false, true})
    for (const unsigned int degree : {1, 2})
    {
      const std::string name =
          std::string(bar ? "bar" : "string") + " of degree " + std::to_string(degree);
      check_orders(
          name, {.3, .15, .075, .0375},
          [&](const double h)
          {
            taut::Scene scene =
                wire_scene(h, bar ? taut::TransverseKind::none : taut::TransverseKind::string,
                           bar ? 0. : stiffness);
            scene.wires[0].degree = degree;
            scene.wires[0].has_axial = bar;
            scene.wires[0].axial_stiffness = bar ? stiffness : 0.;
            scene.supports[0].motion = bar ? taut::WireMotion::axial : taut::WireMotion::transverse;
            return frequencies(scene);
          },
          [&](const int n) { return n * pi / L * std::sqrt(stiffness / m); }, 2. * degree, .1);
    }
}

// A wire with a point mass M in its middle: antisymmetric modes do not feel it, symmetric ones
// solve z tan(z) = m L/M with z = omega L/(2 c).
TEST(Frequencies, point_mass_on_a_string)
{
  const double L = 6., m = 1.35, T = 2000., mass = 2.7, c = std::sqrt(T / m);
  const std::vector<double> w = string_with_a_mass(T, {0., L}, .5 * L, mass);
  const double exact[] = {2. * c * root_of_z_tan_z(m * L / mass, 0.) / L,
                          2. * std::acos(-1.) * c / L};
  for (const int i : {0, 1})
    EXPECT_NEAR(figure(std::string("string with a point mass, error of the ") +
                           (i == 0 ? "first" : "second") + " frequency",
                       w[i] / exact[i] - 1.),
                0., 1e-7);
}

// At the free end of a string that is held at the other, a point mass is in every mode: z tan(z) =
// m L/M with z = omega L/c, one root in each (n pi, n pi + pi/2).
TEST(Frequencies, point_mass_at_the_free_end_of_a_string)
{
  const double L = 6., m = 1.35, T = 2000., mass = 2.7, c = std::sqrt(T / m);
  const std::vector<double> w = string_with_a_mass(T, {0.}, L, mass);
  for (int n = 0; n < 2; ++n)
  {
    EXPECT_NEAR(
        figure("string with a point mass at its end, error of frequency " + std::to_string(n + 1),
               w[n] / (root_of_z_tan_z(m * L / mass, n * pi) * c / L) - 1.),
        0., 1e-7);
  }
}

// A simply supported beam that starts in its first mode decays by exp(-d t), 2 d = alpha + beta
// omega^2 with the factors alpha of the mass and beta of the stiffness in its damping, at the
// frequency sqrt(omega^2 - d^2).
TEST(Damping, first_mode_decays_as_rayleigh_damping_says)
{
  const double T = 60., EI = 20., m = 1.5, L = 4., alpha = .3, beta = .004;
  const double q = pi / L, omega = std::sqrt((T * q * q + EI * q * q * q * q) / m),
               d = .5 * (alpha + beta * omega * omega), damped = std::sqrt(omega * omega - d * d);
  const std::vector<double> errors =
      history_of(R"(Gravity = 0, 0; Start = given
Wire beam: To = 4, 0; Components = beam; Mass per length = 1.5; Tension = 60;
  Bending stiffness = 20; Element size = 0.2; Mass damping = 0.3; Stiffness damping = 0.004;
  Initial transverse displacement = 0.01*sin(pi*s/4)
Support ends: Wire = beam; Positions = 0, 4
Time: Scheme = Newmark; Step = 2.5e-4; End = 4
)",
                 {},
                 [&](const taut::StepView &view)
                 {
                   const double t = view.state.time,
                                u = .01 * std::exp(-d * t) *
                                    (std::cos(damped * t) + d / damped * std::sin(damped * t));
                   return (displacement(view, 0, .5 * L) - u) / .01;
                 });
  EXPECT_LT(figure("damped beam, largest error of the first mode over its amplitude, 6 periods",
                   largest(errors)),
            1e-4);
}
