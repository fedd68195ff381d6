// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what the library says and does beside the motion: schemes, bodies and observers of a
// program. Sources: at the tests.
#include "common.h"
#include "fuzz/library_bodies.h"
#include "one_body.h"

#include <taut/base/registry.h>
#include <taut/simulation/observed_run.h>
#include <taut/time/stepper.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

namespace
{
  using verification::error_of;
  using verification::has;
} // namespace

// A load 0 1 1 0 0 at the ends of five steps of a free mass: its impulses over F h are those of the
// table in doc/library.md, from the difference equations of the schemes.
TEST(LibrarySteps, impulses_of_a_load_that_jumps)
{
  // BDF2 has 3 v_n - 4 v_(n-1) + v_(n-2) = 2 h F_n / m, so that impulses are 2/3 F_n + 1/3 of the
  // one before. Generalised-alpha follows from its four equations with rho = 0.8.
  const double rho = .8, alpha_m = (2. * rho - 1.) / (rho + 1.), alpha_f = rho / (rho + 1.),
               gamma = .5 - alpha_m + alpha_f;
  const std::array<double, 5> load = {0., 1., 1., 0., 0.};
  std::array<double, 5> bdf2, alpha;
  double before = 0., a = 0., old_load = 0.;
  for (int n = 0; n < 5; ++n)
  {
    before = bdf2[n] = 2. / 3. * load[n] + before / 3.;
    const double next =
        ((1. - alpha_f) * load[n] + alpha_f * old_load - alpha_m * a) / (1. - alpha_m);
    alpha[n] = (1. - gamma) * a + gamma * next;
    a = next;
    old_load = load[n];
  }
  const std::pair<std::string, std::array<double, 5>> expected[] = {
      {"backward Euler", load},
      {"Moreau-Jean", {0., .5, 1., .5, 0.}},
      {"BDF2", bdf2},
      {"generalised-alpha", alpha}};
  for (const auto &[scheme, impulses] : expected)
  {
    constexpr double mass = 3., step = .02, force = 7.;
    double now = 0.;
    taut::System system;
    system.add("mass",
               [&]
               {
                 auto body = std::make_unique<library::Chain>("mass", std::vector<double>{mass},
                                                              std::vector<double>{0.});
                 taut::LinearForm form;
                 form.add(0, 1.);
                 body->add_force(form, mass * library::gravity); // no weight
                 body->add_force(form, [&](double) { return now; });
                 return body;
               });
    taut::Stepper stepper(system, verification::steps_of(step, taut::Start::undeformed, scheme));
    stepper.advance(); // backward Euler, where a scheme needs a step before
    for (int n = 0; n < 5; ++n)
    {
      now = force * load[n];
      const double v = stepper.state().V[0][0];
      stepper.advance();
      EXPECT_NEAR(mass * (stepper.state().V[0][0] - v) / (force * step), impulses[n], 1e-12)
          << scheme << ", step " << n;
    }
  }
}

namespace
{
  /// A scheme with an entry at the top, and one below two sections.
  class Layered : public taut::TimeIntegrator
  {
  public:
    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Alpha", alpha, "", dealii::Patterns::Double(0., .3));
      prm.enter_subsection("Layered");
      prm.add_parameter("Alpha", second, "");
      prm.enter_subsection("Inner");
      prm.add_parameter("Beta", beta, "");
      prm.leave_subsection();
      prm.leave_subsection();
    }
    taut::StepCoefficients coefficients(const double step) const override
    {
      return taut::hht(step, alpha);
    }
    std::string description() const override
    {
      std::ostringstream out;
      out << "layered " << alpha << ' ' << second << ' ' << beta;
      return out.str();
    }

  private:
    double alpha = .1, second = 2., beta = 3.;
  };
  const taut::Register<taut::TimeIntegrator, Layered> layered("layered", "of a test");
} // namespace

TEST(LibrarySteps, entries_of_a_scheme_are_read_wherever_they_are)
{
  using Entries = std::map<std::string, std::string>;
  const auto scheme = [](const Entries &entries)
  {
    verification::OneBody<library::Chain> one("mass", "mass", std::vector<double>{1.},
                                              std::vector<double>{1.});
    taut::StepperOptions options;
    options.scheme = "layered";
    options.scheme_entries = entries;
    return taut::Stepper(one.system, options).scheme();
  };
  EXPECT_EQ(scheme({}), "layered 0.1 2 3");
  EXPECT_EQ(scheme({{"Alpha", "0.25"}}), "layered 0.25 2 3");
  EXPECT_EQ(scheme({{"Alpha", "0"}, {"Layered/Alpha", "5"}, {"Layered/Inner/Beta", "-7"}}),
            "layered 0 5 -7");
  EXPECT_TRUE(has(error_of([&] { scheme({{"Alfa", "0"}}); }), "did you mean 'Alpha'"));
  EXPECT_TRUE(has(error_of([&] { scheme({{"Alpha", "0.5"}}); }), "'Alpha' cannot be '0.5'"));
}

// A body that nothing holds, or that has no stiffness, says so in each form of F.
TEST(LibrarySteps, bodies_that_nothing_holds)
{
  for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
    for (const bool has_other : {false, true})
    {
      taut::System system;
      system.add("loose", [] { return library::chain_of("loose", {1., 2.}, {0., 30.}); });
      if (has_other)
      {
        const auto held = system.add("held", [] { return library::chain_of("held", {1.}, {5.}); });
        system.add(
            taut::Constraint::unilateral("stop", system.displacement(held, {}, {0., 1., 0.})));
      }
      taut::StepperOptions options;
      options.solver.interface.form = form;
      const std::string message = error_of([&] { taut::Stepper stepper(system, options); });
      EXPECT_TRUE(has(message, "body 'loose' is not held")) << form << ": " << message;
      // It falls where no equilibrium is asked for.
      options.start = taut::Start::undeformed;
      options.step = .01;
      taut::Stepper stepper(system, options);
      for (int k = 0; k < 10; ++k)
        stepper.advance();
      EXPECT_NEAR(stepper.state().V[0][0], -library::gravity * .1, 1e-9) << form;
    }
}

namespace
{
  /// A body of two DoFs whose stiffness has no entry, and that names no motion without energy.
  class WithoutStiffness : public taut::Substructure
  {
  public:
    explicit WithoutStiffness(const bool sparse) : Substructure("soft")
    {
      for (auto *matrix : {&M, &C, &K})
        if (sparse)
          *matrix = std::make_unique<taut::CompressedMatrix>(2);
        else
          *matrix = std::make_unique<taut::CompressedMatrix>(2);
      M->add(0, 0, 1.);
      M->add(1, 1, 1.);
      constant_force = {1., 1.};
      finish();
    }
  };

  /// Writes a note when it finishes, and may throw then.
  class Finishing : public taut::Observer
  {
  public:
    Finishing(const std::string &failure, std::string &said) : failure(failure), said(said) {}
    void begin(const taut::RunView &) override {}
    void record(const taut::StepView &) override {}
    void finish() override
    {
      said += "f";
      if (!failure.empty())
        throw taut::UserError(failure);
    }

  private:
    const std::string failure;
    std::string &said;
  };
} // namespace

TEST(LibrarySteps, a_body_without_stiffness_is_named)
{
  for (const bool sparse : {true, false})
    for (const char *form : {"assembled dense", "assembled sparse", "matrix-free"})
    {
      taut::System system;
      system.add("soft", [&] { return std::make_unique<WithoutStiffness>(sparse); });
      taut::StepperOptions options;
      options.solver.interface.form = form;
      const std::string message = error_of([&] { taut::Stepper stepper(system, options); });
      EXPECT_TRUE(has(message, "body 'soft'")) << form << ": " << message;
      EXPECT_TRUE(has(message, "holds")) << form << ": " << message;
    }
}

TEST(LibrarySteps, all_observers_finish)
{
  const verification::Folder folder;
  std::string said;
  verification::OneBody<library::Chain> one("mass", "mass", std::vector<double>{1.},
                                            std::vector<double>{1.});
  taut::Stepper stepper(one.system, verification::steps_of(1e-3, taut::Start::given));
  taut::ObservedRun run(stepper, folder.path.string());
  for (const char *failure : {"", "first", "", "second", ""})
    run.observe(std::make_unique<Finishing>(failure, said));
  run.begin();
  run.advance();
  EXPECT_EQ(error_of([&] { run.finish(); }), "first");
  EXPECT_EQ(said, "fffff");
}
