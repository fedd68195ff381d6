// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the certificate sees a step that is wrong. Source: matrices, constraints and gaps are
// changed behind the back of the factors, by the amount that the residual then has to have, and the
// step is refused with the name of what is wrong.
#include "scene_tests.h"

#include "model/scene_constraints.h"
#include <taut/time/motion.h>
#include <taut/time/static_equilibrium.h>

using namespace verification;

namespace
{
  // A mass of 2 kg hangs from a string by a dropper of 10 kN/m, and stays where it is.
  const char *const scene =
      R"(Gravity = 0, -9.81; Start = equilibrium
Wire wire: To = 4, 0; Components = string; Mass per length = 1; Tension = 1000; Element size = 0.5
Support ends: Wire = wire; Positions = 0, 4
Mass mass: Position = 2, -1; Mass = 2; Motions = y
Link hanger: Type = dropper; From = wire @ 2; To = mass; Stiffness = 10000
Time: Scheme = BDF2; Step = 1e-3; End = 1e-3
)";

  /// A stepper that has factored the matrices of the scene, and what it was made from.
  class Steps
  {
  public:
    /// The middle of the string starts with @p velocity [m/s], the gap is @p gap_error [m] off the
    /// displacements.
    explicit Steps(const double velocity, const double gap_error = 0.,
                   const std::string &text = scene)
        : session(text)
    {
      taut::InitialState start;
      session.run(
          [&](const taut::StepView &view)
          {
            if (view.state.time > 0.)
              return;
            start.reference = view.reference;
            start.state = view.state;
          });
      start.state.V[0][start.state.V[0].size() / 2] = velocity;
      start.state.distance[0] += gap_error;
      constraints = std::make_unique<taut::Constraints>(
          taut::scene_constraints(session.simulation().scene(), structure()));
      taut::StepperOptions options;
      options.start = taut::Start::undeformed;
      options.solver = session.parameters().solver;
      own = std::make_unique<taut::Structure>(structure());
      stepper = std::make_unique<taut::Motion>(*own, *constraints, options, start,
                                               taut::make_integrator("BDF2"));
    }

    const taut::SceneBodies &structure() { return session.simulation().structure(); }

    /// What is said about the first step that is refused; empty if ten are accepted.
    std::string refusal()
    {
      return verification::error_of(
          [&]
          {
            for (int i = 0; i < 10; ++i)
              stepper->advance();
          });
    }

    std::unique_ptr<taut::Constraints> constraints;
    std::unique_ptr<taut::Structure> own; ///< shares the bodies
    std::unique_ptr<taut::Motion> stepper;

  private:
    Session session;
  };
} // namespace

TEST(Certificate, right_steps_pass)
{
  for (const double velocity : {0., .1})
  {
    Steps steps(velocity);
    EXPECT_EQ(steps.refusal(), "");
    EXPECT_LT(steps.stepper->residuals().max(), 1e-13);
    figure("certificate of a mass on a string, first velocity " + std::to_string(velocity) + " m/s",
           steps.stepper->residuals().max());
  }
}

TEST(Certificate, a_stiffness_that_was_not_factored_misses_the_balance)
{
  Steps steps(.1);
  const taut::Substructure &string = steps.structure()[0];
  const unsigned int middle = string.n_dofs() / 2;
  // 4 of 4000 N/m
  const_cast<taut::SymmetricMatrix &>(string.stiffness()).add(middle, middle, 4.);
  const std::string refusal = steps.refusal();
  EXPECT_TRUE(has(refusal, "body 'wire (transverse)' misses the contact tolerance in its equation"))
      << refusal;
  EXPECT_TRUE(has(refusal, "check stiffness and mass")) << refusal;
  EXPECT_FALSE(has(refusal, "'Contact tolerance'")) << refusal;
}

// A tolerance below rounding is what the remedy is about; a residual above the usual one is not.
TEST(Certificate, a_tolerance_below_rounding_is_said_to_be_so)
{
  const std::string refusal = verification::error_of(
      []
      {
        run_scene("Gravity = 0, -9.81, 0; Start = given\n"
                  "Body arm: Type = rigid body; Mass = 2; Centre = 0.5, 0, 0; "
                  "Moments of inertia = 0.5, 0.4, 0.3\n"
                  "Link pivot: Type = ball joint; From = arm @ 0, 0, 0; To = ground\n"
                  "Time: Step = 2e-3; End = 0.2\nSolver: Contact tolerance = 1e-15\n",
                  {});
      });
  EXPECT_TRUE(has(refusal, "misses the contact tolerance")) << refusal;
  EXPECT_TRUE(has(refusal, "take the default 'Contact tolerance', 1e-08")) << refusal;
}

TEST(Certificate, a_row_that_is_not_in_F_misses_the_gaps)
{
  Steps steps(.1);
  auto &constraint = const_cast<taut::ConstraintData &>((*steps.constraints)[0]);
  for (taut::Term &term : constraint.terms)
    for (double &value : term.form.value)
      value *= 1.001;
  const std::string refusal = steps.refusal();
  EXPECT_TRUE(has(refusal, "link 'hanger' misses the contact tolerance: residual")) << refusal;
}

TEST(Certificate, a_gap_away_from_its_displacements_is_seen)
{
  Steps steps(0., 1e-4);
  const std::string refusal = steps.refusal();
  EXPECT_TRUE(has(refusal, "link 'hanger' misses the contact tolerance: residual")) << refusal;
}

// The start's own rounding of a gap stays in it: over a small compliance it would be a force.
TEST(Certificate, a_moving_row_keeps_the_offset_of_its_start)
{
  std::string text = scene;
  const std::string dropper = "Type = dropper; From = wire @ 2; To = mass";
  text.replace(text.find(dropper), dropper.size(),
               "Type = sliding contact; From = mass; To = wire @ 2; Direction = 0, -1; Speed = 0");
  for (const double offset : {0., 1e-9})
  {
    Steps steps(0., offset, text);
    EXPECT_EQ(steps.refusal(), "");
    const taut::ConstraintData &constraint = (*steps.constraints)[0];
    const double motion = evaluate(constraint.terms, steps.stepper->reference().displacement) +
                          evaluate(constraint.terms, steps.stepper->state().U);
    EXPECT_NEAR(steps.stepper->state().distance[0] - constraint.gap - motion, offset, 1e-13);
  }
}

// Without a link there is nothing but the balance to measure; its rounding is more than 1e-30.
TEST(Certificate, statics_measure_their_balance)
{
  Session session(scene);
  taut::Scene alone = session.simulation().scene();
  alone.links.clear();
  alone.masses.clear();
  const taut::SceneBodies structure(alone);
  const taut::Constraints constraints = taut::scene_constraints(alone, structure);
  taut::SolverParameters parameters;
  const taut::Residuals certificate =
      taut::static_equilibrium(structure, constraints, parameters, 0.).residuals;
  EXPECT_GT(certificate.balance, 1e-18);
  EXPECT_LT(certificate.balance, 1e-14);
  parameters.contact_tolerance = 1e-30;
  EXPECT_THROW(taut::static_equilibrium(structure, constraints, parameters, 0.), taut::UserError);
}

// Claim: rounding is no error: a beam that lies on supports at all of its nodes has static
// displacements of nothing but rounding, and supports far from the load move by less than is kept
// of the columns of A^-1. Expected: certificates as small as with finer elements.
TEST(Certificate, does_not_take_rounding_for_a_drift)
{
  const std::vector<double> certificates = history_of(
      scene_file("beam_over_supports"), {"Network/Wire beam/Element size=1", "Time/End=0.1"},
      [](const taut::StepView &view) { return view.residuals.max(); });
  EXPECT_LT(
      figure("beam over supports, elements of 1 m: largest certificate", largest(certificates)),
      1e-11);
}
