// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: energy that a body of large motions gains from nowhere is a warning and an error whatever
// moves beside it, and the message advises what the scheme and the steps of the run leave to do.
// Source: the same pendulum, whose mean force is a part of what its energy asks for, alone.
#include "common.h"
#include "elastic_pendulum.h"

#include <taut/time/stepper.h>

using namespace verification;

namespace
{
  constexpr double half_pi = 1.57079632679489661923;

  /// A mass of 1000 t that flies with 100 m/s: 5e9 J beside the pendulum's 20 J.
  class Bystander : public taut::Substructure
  {
  public:
    Bystander() : Substructure("bystander")
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(1);
      M->add(0, 0, 1e6);
      constant_force = {0.};
      finish();
    }
    bool is_lumped() const override { return true; }
    void initial_state(std::vector<double> &U, std::vector<double> &V) const override
    {
      U = {0.};
      V = {100.};
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &n) const override
    {
      taut::LinearForm form;
      form.add(0, n[0]);
      return form;
    }
    NullSpace null_space() const override { return {{{1.}}, {0}}; }
  };

  struct Outcome
  {
    taut::ContactMeasures::Summary summary;
    std::vector<taut::Warning> warnings;
    std::string error;
  };

  /// 20 s of a careless pendulum.
  Outcome outcome_of_swing(const double part, const bool has_bystander,
                           taut::StepperOptions options = taut::StepperOptions())
  {
    taut::System system;
    if (has_bystander)
      system.add("bystander", [] { return std::make_unique<Bystander>(); });
    system.add("pendulum",
               [&]
               {
                 auto pendulum = std::make_unique<ElasticPendulum>(half_pi, 1e3);
                 pendulum->change_force = [part](const auto &, const auto &, double, auto &f)
                 {
                   for (double &force : f)
                     force *= part;
                 };
                 return pendulum;
               });
    options.step = .01;
    options.start = taut::Start::given;
    taut::Stepper stepper(system, options);
    while (stepper.time() < 20.)
      stepper.advance();
    EXPECT_EQ(stepper.state().V[0][0] == 100., has_bystander);
    return {stepper.measures().summary(), stepper.measures().warnings(),
            stepper.measures().error()};
  }
} // namespace

TEST(EnergyAccount, energy_from_nowhere_is_an_error)
{
  const Outcome right = outcome_of_swing(1., false), wrong = outcome_of_swing(.3, false);
  EXPECT_EQ(right.error, "");
  EXPECT_LE(right.summary.relative_motion_energy, 1e-7);
  EXPECT_TRUE(has(wrong.error, "bodies that move by large amounts gained")) << wrong.error;
  ASSERT_FALSE(wrong.warnings.empty());
  EXPECT_EQ(wrong.warnings.front().kind, "motion_energy");
}

// Energies are compared within the bodies that links connect.
TEST(EnergyAccount, a_fast_heavy_body_elsewhere_hides_nothing)
{
  for (const double part : {1., .95, .3})
  {
    const Outcome alone = outcome_of_swing(part, false), beside = outcome_of_swing(part, true);
    EXPECT_NEAR(beside.summary.relative_motion_energy, alone.summary.relative_motion_energy,
                1e-6 * alone.summary.relative_motion_energy + 1e-7)
        << part;
    EXPECT_EQ(beside.error.empty(), alone.error.empty()) << part << ' ' << alone.error;
    EXPECT_EQ(beside.warnings.size(), alone.warnings.size()) << part;
    EXPECT_EQ(alone.warnings.empty(), part == 1.);
    EXPECT_EQ(alone.error.empty(), part != .3);
    for (const auto &warning : beside.warnings)
      EXPECT_TRUE(has(warning.message, "bodies that move by large amounts gained"));
  }
}

// What to do about it: another scheme, a shorter step, a smaller tolerance.
TEST(EnergyAccount, the_advice_is_what_the_run_leaves_to_do)
{
  const std::string of_scheme = "Set 'Time/Scheme' to 'automatic', or take a smaller step",
                    of_fixed = "Take a smaller Step, or 'Step control = adaptive'",
                    of_adaptive = "Take a smaller Tolerance";
  taut::StepperOptions fixed, adaptive, named;
  adaptive.steps.control = "adaptive";
  named.scheme = "Moreau-Jean";
  named.scheme_entries = {{"Moreau-Jean/Theta", "0.5"},
                          {"Moreau-Jean/Conditions", "gaps then velocities"}};
  const std::pair<taut::StepperOptions, std::string> runs[] = {
      {fixed, of_fixed}, {adaptive, of_adaptive}, {named, of_scheme}};
  for (const auto &[options, advice] : runs)
  {
    const Outcome found = outcome_of_swing(.3, false, options);
    ASSERT_FALSE(found.warnings.empty()) << advice;
    for (const std::string &text : {found.error, found.warnings.front().message})
    {
      EXPECT_TRUE(has(text, advice)) << text;
      for (const std::string &other : {of_scheme, of_fixed, of_adaptive})
        EXPECT_EQ(has(text, other), other == advice) << text;
    }
  }
}
