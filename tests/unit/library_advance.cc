// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a step that ends with an exception leaves the motion before the step, from which it goes
// on; what keeps an object by reference takes no temporary one; errors name options of the library.
// Sources: the same motion without the exception; the interface.
#include "common.h"
#include "fuzz/library_bodies.h"
#include "one_body.h"

#include <taut/interface/contact_schur_operator.h>
#include <taut/substructure/fe_body.h>
#include <taut/time/stepper.h>

#include <type_traits>

namespace
{
  using verification::error_of;
  using verification::has;

  /// Counts calls of the functions of an author, and lets one of them fail. A UserError in a motion
  /// that is not linear would only halve the step.
  struct Failure
  {
    int left = -1; ///< calls until then; negative: never
    void call(const bool by_user_error)
    {
      const char *const text = "the author's function fails";
      if (left < 0 || left-- > 0)
        return;
      if (by_user_error)
        throw taut::UserError(text);
      throw std::runtime_error(text);
    }
  };

  /// Two masses in a row under a load that grows; the first spring has a cubic part and a damper
  /// whose force is cubic in the velocity. It is linear without these.
  class Row : public taut::Substructure
  {
  public:
    Row(Failure &of_author, const bool linear, const double drag = 20.)
        : Substructure("row"), failure(of_author), linear(linear), drag(drag)
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(2);
      M->add(0, 0, 1.);
      M->add(1, 1, 2.);
      add_springs(k, *K);
      constant_force = {0., -library::gravity};
      taut::LinearForm form;
      form.add(1, 1.);
      add_force(form,
                [this](const double t)
                {
                  failure.call(this->linear);
                  return -150. * t;
                });
      finish();
    }
    bool is_linear() const override { return linear; }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      form.add(1, direction.y);
      return form;
    }
    double strain_energy(const std::vector<double> &U) const override
    {
      failure.call(linear);
      return linear ? Substructure::strain_energy(U)
                    : .5 * k * U[0] * U[0] + .25 * cubic * std::pow(U[0], 4) +
                          .5 * k * (U[1] - U[0]) * (U[1] - U[0]);
    }
    void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                        std::vector<double> &f) const override
    {
      failure.call(linear);
      if (linear)
        return Substructure::internal_force(U, V, f);
      const double v = V.empty() ? 0. : V[0], tension = k * (U[1] - U[0]);
      f = {k * U[0] + cubic * U[0] * U[0] * U[0] + drag * v * v * v - tension, tension};
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      failure.call(linear);
      if (linear)
        return Substructure::mean_internal_force(U0, U1, step, f);
      const double a = U0[0], b = U1[0], v = (b - a) / step,
                   tension = .5 * k * (U1[1] - b + U0[1] - a);
      f = {.5 * k * (a + b) + .25 * cubic * (a + b) * (a * a + b * b) + drag * v * v * v - tension,
           tension};
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const std::vector<double> &U,
                                                   const std::vector<double> &V, const double rate,
                                                   const bool definite) const override
    {
      failure.call(linear);
      if (linear)
        return Substructure::tangent(U, V, rate, definite);
      auto A = std::make_unique<taut::CompressedMatrix>(2);
      const double v = V.empty() ? 0. : V[0];
      add_springs(k, *A);
      A->add(0, 0, 3. * cubic * U[0] * U[0] + rate * 3. * drag * v * v);
      return A;
    }

  private:
    static constexpr double k = 100., cubic = 5e3; ///< [N/m, N/m^3]

    static void add_springs(const double k, taut::SymmetricMatrix &A)
    {
      A.add(0, 0, 2. * k);
      A.add(1, 1, k);
      A.add(1, 0, -k);
    }

    Failure &failure;
    const bool linear;
    const double drag; ///< [N s^3/m^3]
  };

  /// A row above a stop that it hits.
  struct Motion
  {
    Motion(const bool linear, const std::string &scheme, const bool adaptive)
        : one("row", failure, linear), stop(add_stop()),
          stepper(one.system, options(scheme, adaptive))
    {
    }
    std::size_t add_stop()
    {
      return one.system.add(
          taut::Constraint::unilateral("stop", one.system.displacement(0, {}, {0., 1., 0.}))
              .gap(.25)
              .stiffness(1e4)
              .damping(5.));
    }
    static taut::StepperOptions options(const std::string &scheme, const bool adaptive)
    {
      taut::StepperOptions result = verification::steps_of(5e-3, taut::Start::equilibrium, scheme);
      result.allow_unsuitable_scheme = true;
      result.solver.interface.form = "assembled dense";
      if (adaptive)
        result.steps.control = "adaptive";
      return result;
    }
    /// All that a user may ask for.
    std::vector<double> all() const
    {
      const taut::State &s = stepper.state();
      std::vector<double> result = {s.time, stepper.multiplier(stop), stepper.gap(stop),
                                    stepper.residuals().complementarity,
                                    stepper.residuals().balance};
      for (const taut::BodyVectors *v : {&s.U, &s.V, &s.A, &s.dU, &s.V_old, &s.KU, &s.balance})
        result.insert(result.end(), v->front().begin(), v->front().end());
      return result;
    }

    Failure failure;
    verification::OneBody<Row> one;
    const std::size_t stop;
    taut::Stepper stepper;
  };

  // What keeps an object takes none that is gone at once.
  template <typename ReusedValues, typename... With>
  constexpr bool takes = std::is_constructible<ReusedValues, With...>::value;
  static_assert(takes<taut::Stepper, const taut::System &>, "");
  static_assert(!takes<taut::Stepper, taut::System>, "");
  static_assert(!takes<taut::Constraints, taut::Structure, std::vector<taut::ConstraintData>>, "");
  static_assert(!takes<taut::BodyConstraints, const taut::Structure &, taut::Constraints>, "");
  static_assert(takes<taut::BodyConstraints, const taut::Structure &, const taut::Constraints &>,
                "");
  using Matrix = const dealii::SparseMatrix<double> &;
  using Free = const dealii::AffineConstraints<double> &;
  static_assert(takes<taut::FEBody<2>, std::string, const dealii::DoFHandler<2> &, Matrix, Matrix,
                      Matrix, Free>,
                "");
  static_assert(
      !takes<taut::FEBody<2>, std::string, dealii::DoFHandler<2>, Matrix, Matrix, Matrix, Free>,
      "");
} // namespace

// Every call of a function of the author fails once, within some steps before and after the row
// meets its stop: the motion is then that before the step, and goes on as if nothing had been.
TEST(LibrarySteps, an_error_leaves_the_motion_before_the_step)
{
  constexpr int n_steps = 60;
  for (const bool linear : {true, false})
    for (const bool adaptive : {false, true})
      for (const char *scheme :
           {"backward Euler", "BDF2", "generalised-alpha", "Newmark", "Moreau-Jean"})
      {
        Motion sound(linear, scheme, adaptive);
        double largest = 0.;
        for (int n = 0; n < n_steps; ++n)
        {
          sound.stepper.advance();
          largest = std::max(largest, sound.stepper.multiplier(sound.stop));
        }
        const std::vector<double> end = sound.all();
        EXPECT_GT(largest, 0.) << scheme;
        Motion failing(linear, scheme, adaptive);
        int n_failures = 0;
        for (int n = 0; n < n_steps; ++n)
        {
          std::vector<double> before = failing.all();
          bool has_advanced = false;
          for (int call = 0; !has_advanced; ++call)
          {
            failing.failure.left = n % 5 == 0 ? call : -1;
            try
            {
              failing.stepper.advance();
              has_advanced = true;
              continue;
            }
            catch (const std::exception &error)
            {
              ASSERT_TRUE(has(error.what(), "the author's function fails")) << error.what();
            }
            ++n_failures;
            // The first part of a step that is halved remains.
            if (failing.stepper.time() > before.front())
              before = failing.all();
            ASSERT_EQ(failing.all(), before) << scheme << ", step " << n << ", call " << call;
            ASSERT_LT(before.front(), (n + .75) * 5e-3 + adaptive) << scheme;
          }
        }
        EXPECT_GE(n_failures, n_steps / 5) << scheme;
        const std::vector<double> found = failing.all();
        for (std::size_t i = 0; i < end.size(); ++i)
          EXPECT_NEAR(found[i], end[i], 1e-9 * (1. + std::fabs(end[i]))) << scheme << ' ' << i;
      }
}

// Newton's method knows the derivative of a damper whose force is cubic in the velocity.
TEST(LibrarySteps, a_damping_material_takes_few_iterations)
{
  for (const char *scheme : {"backward Euler", "Moreau-Jean"})
  {
    Failure none;
    verification::OneBody<Row> one("row", none, false, 300.);
    taut::Stepper stepper(one.system, verification::steps_of(.02, taut::Start::undeformed, scheme));
    for (int n = 0; n < 50; ++n)
      stepper.advance();
    EXPECT_LT(stepper.n_newton_iterations(), 50 * 12) << scheme;
  }
}

TEST(LibrarySteps, errors_name_options_of_the_library)
{
  verification::OneBody<library::Chain> one("mass", "mass", std::vector<double>{1.},
                                            std::vector<double>{100.});
  one.system.add(
      taut::Constraint::unilateral("stop", one.system.displacement(0, {}, {0., 1., 0.})));
  const std::string scheme = error_of(
      [&]
      {
        taut::Stepper stepper(one.system,
                              verification::steps_of(1e-3, taut::Start::given, "Newmark"));
      });
  EXPECT_TRUE(has(scheme, "StepperOptions::scheme: ")) << scheme;
  EXPECT_TRUE(has(scheme, "set StepperOptions::allow_unsuitable_scheme")) << scheme;
  EXPECT_FALSE(has(scheme, "Time/")) << scheme;
}
