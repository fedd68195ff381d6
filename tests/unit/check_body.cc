// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: check_body() finds nothing in a body whose energy, forces and tangents belong together,
// and names the function of each that do not. Source: a chain of springs with a cubic law, whose
// functions are derivatives of its energy by hand; mistakes of a thousandth in each of them.
#include "common.h"

#include <taut/cable/cable.h>
#include <taut/mechanism/rigid_body.h>
#include <taut/substructure/check_body.h>

namespace
{
  using Vector = std::vector<double>;

  constexpr double k = 100.; ///< [N/m]

  /// Masses in a row; before each but the first a spring of force k e + cubic e^3 and a damper.
  /// What the mistake names is too large by a thousandth.
  class BodyRow : public taut::Substructure
  {
  public:
    BodyRow(const unsigned int n, const std::string &mistake = "", const bool linear = false)
        : Substructure("row"), mistake(mistake), linear(linear), cubic(linear ? 0. : 3e3),
          viscosity(linear ? 0. : 7.), drag(linear ? 0. : 50.)
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(n);
      for (unsigned int i = 0; i < n; ++i)
        M->add(i, i, 1.);
      K->add(1., *matrix(Vector(n, 0.), {}, 1., 0.));
      constant_force.assign(n, 0.);
      finish();
    }
    bool is_linear() const override { return linear; }
    NullSpace null_space() const override
    {
      NullSpace result{{Vector(n_dofs(), 1.)}, {0}};
      if (mistake == "null space")
        result.vectors[0][1] *= wrong;
      return result;
    }
    double strain_energy(const Vector &U) const override
    {
      double sum = 0.;
      for (std::size_t i = 1; i < U.size(); ++i)
        sum += energy(U[i] - U[i - 1]);
      return sum * (mistake == "energy" ? wrong : 1.);
    }
    void internal_force(const Vector &U, const Vector &V, Vector &f) const override
    {
      f.assign(U.size(), 0.);
      for (std::size_t i = 1; i < U.size(); ++i)
        add(i,
            force(U[i] - U[i - 1]) * (mistake == "force" && i == 2 ? wrong : 1.) +
                (V.empty() ? 0. : damping(V[i] - V[i - 1])),
            f);
    }
    void mean_internal_force(const Vector &U0, const Vector &U1, const double step,
                             Vector &f) const override
    {
      f.assign(U0.size(), 0.);
      for (std::size_t i = 1; i < U0.size(); ++i)
      {
        const double a = U0[i] - U0[i - 1], b = U1[i] - U1[i - 1],
                     mean = .5 * k * (a + b) + .25 * cubic * (a + b) * (a * a + b * b),
                     // The force in the middle does another work.
            middle = force(.5 * (a + b));
        add(i,
            (mistake == "work" ? middle : mean) * (mistake == "mean force" ? wrong : 1.) +
                damping((b - a) / step),
            f);
      }
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const Vector &U, const Vector &V,
                                                   const double rate, bool) const override
    {
      return matrix(U, mistake == "velocity" ? Vector() : V, mistake == "tangent" ? wrong : 1.,
                    mistake == "damping" ? wrong * rate : rate);
    }
    std::unique_ptr<taut::SymmetricMatrix> mean_tangent(const Vector &U0, const Vector &,
                                                        const double rate, bool) const override
    {
      return matrix(U0, {}, mistake == "mean tangent" ? wrong : 1., rate);
    }

  private:
    static constexpr double wrong = 1.001;

    double energy(const double e) const { return .5 * k * e * e + .25 * cubic * e * e * e * e; }
    double force(const double e) const { return k * e + cubic * e * e * e; }

    double damping(const double v) const { return viscosity * v + drag * v * v * v; }

    static void add(const std::size_t i, const double tension, Vector &f)
    {
      f[i] += tension;
      f[i - 1] -= tension;
    }

    std::unique_ptr<taut::SymmetricMatrix> matrix(const Vector &U, const Vector &V,
                                                  const double factor, const double rate) const
    {
      auto A = std::make_unique<taut::CompressedMatrix>(U.size());
      for (unsigned int i = 1; i < U.size(); ++i)
      {
        const double e = U[i] - U[i - 1], v = V.empty() ? 0. : V[i] - V[i - 1],
                     slope =
                         factor * (k + 3. * cubic * e * e) + rate * (viscosity + 3. * drag * v * v);
        A->add(i, i, slope);
        A->add(i - 1, i - 1, slope);
        A->add(i, i - 1, -slope);
      }
      return A;
    }

    const std::string mistake;
    const bool linear;
    const double cubic, viscosity, drag; ///< [N/m^3, N s/m, N s^3/m^3]
  };

  Vector some_displacement(const std::size_t n, const double size)
  {
    Vector U(n);
    for (std::size_t i = 0; i < n; ++i)
      U[i] = size * std::sin(1. + 1.7 * i);
    return U;
  }

  std::string text_of(const std::vector<std::string> &lines)
  {
    std::string result;
    for (const std::string &line : lines)
      result += line + "\n";
    return result;
  }
} // namespace

TEST(CheckBody, finds_each_mistake)
{
  const std::map<std::string, std::string> names = {
      {"", ""},
      {"energy", "internal_force() at DoF"},
      {"force", "internal_force() at DoF"},
      {"tangent", "tangent() at DoFs"},
      {"damping", "tangent() at DoFs"},
      {"velocity", "tangent(), part with the rate, at DoFs"},
      {"mean force", "mean_internal_force() from U to U"},
      {"work", "work of mean_internal_force()"},
      {"mean tangent", "mean_tangent() at DoFs"}};
  for (const auto &[mistake, name] : names)
  {
    const BodyRow row(5, mistake);
    const std::string found = text_of(taut::check_body(row, some_displacement(5, .2), .1));
    EXPECT_TRUE(name.empty() ? found.empty() : verification::has(found, "body 'row': " + name))
        << mistake << ": " << found;
  }
}

TEST(CheckBody, reports_the_place_and_both_values)
{
  const BodyRow row(5, "force");
  const std::vector<std::string> found = taut::check_body(row, some_displacement(5, .2), .1);
  ASSERT_FALSE(found.empty());
  Vector f, sound;
  const Vector U = some_displacement(5, .2);
  row.internal_force(U, {}, f);
  BodyRow(5).internal_force(U, {}, sound);
  double said = 0., expected = 0.;
  unsigned int dof = 0;
  ASSERT_EQ(std::sscanf(found[0].c_str(),
                        "body 'row': internal_force() at DoF %u, of strain_energy(): %lf, and by "
                        "differences %lf",
                        &dof, &said, &expected),
            3)
      << found[0];
  EXPECT_TRUE(dof == 1 || dof == 2) << dof;
  EXPECT_NEAR(said, f[dof], 1e-8 * std::fabs(f[dof]));
  EXPECT_NEAR(expected, sound[dof], 1e-7 * std::fabs(f[dof]));
}

TEST(CheckBody, linear_bodies_and_their_null_space)
{
  const Vector U = some_displacement(4, 3.);
  EXPECT_EQ(text_of(taut::check_body(BodyRow(4, "", true), U)), "");
  const std::string found = text_of(taut::check_body(BodyRow(4, "null space", true), U));
  EXPECT_TRUE(verification::has(found, "null_space()")) << found;
}

TEST(CheckBody, bodies_of_the_library_are_sound)
{
  for (const taut::CableElement element : {taut::CableElement::ancf, taut::CableElement::bar})
  {
    taut::CableData data;
    data.name = "cable";
    data.to = {6., 0., 0.};
    data.length = 6.2;
    data.section = {1e5, element == taut::CableElement::ancf ? 2. : 0., 1., 30.};
    data.gravity = {0., -9.81, 0.};
    data.n_elements = 5;
    data.element = element;
    const taut::Cable cable(data);
    EXPECT_EQ(text_of(taut::check_body(cable, some_displacement(cable.n_dofs(), .01), .1)), "");
  }
  taut::RigidBodyData data;
  data.name = "bar";
  data.mass = 3.;
  data.moments = {1., 1.5, 2.};
  data.gravity = {0., -9.81, 0.};
  const taut::RigidBody bar(data);
  EXPECT_EQ(text_of(taut::check_body(bar, some_displacement(bar.n_dofs(), .1))), "");
}

TEST(CheckBody, needs_what_fits)
{
  const BodyRow row(3);
  EXPECT_THROW(taut::check_body(row, Vector(2, 0.)), taut::UserError);
  EXPECT_THROW(taut::check_body(row, Vector(3, 0.), -1.), taut::UserError);
}
