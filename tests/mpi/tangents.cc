// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: where the tangent of one body is not definite, all bodies take the next one, on any number
// of ranks. Source: of two wires one has a tangent with a negative pivot at first.
#include "../verification/run.h"

#include "time/step_equations.h"

using namespace verification;

TEST(Tangents, are_made_definite_on_all_ranks_together)
{
  Session session(
      R"(Gravity = 0, 0; Start = undeformed
Wire one: To = 1, 0; Components = string; Mass per length = 1; Tension = 100; Element size = 0.25
Wire two: From = 0, 1; To = 1, 1; Components = string; Mass per length = 1; Tension = 100;
  Element size = 0.25
Support a: Wire = one; Positions = 0, 1
Support b: Wire = two; Positions = 0, 1
Time: Step = 0.01; End = 0.01
)",
      {}, taut::Communicator(MPI_COMM_WORLD));
  const taut::Structure &structure = session.simulation().structure();
  ASSERT_EQ(structure.all_bodies().size(), 2u);
  std::vector<std::size_t> own(structure.size());
  std::iota(own.begin(), own.end(), 0);

  for (const std::string softer : {"one", "two"})
    for (const int first_definite : {0, 1, 3})
    {
      std::vector<std::vector<int>> asked_for(structure.size());
      taut::StepEquations system(structure, session.simulation().constraints(),
                                 session.parameters().solver);
      system.set_nonlinear(own,
                           [&](const std::size_t k, const int attempt)
                           {
                             asked_for[k].push_back(attempt);
                             auto K = structure[k].stiffness().clone();
                             if (structure[k].name().find(softer) == 0 && attempt < first_definite)
                               K->add(2, 2, -1e6);
                             return K;
                           });
      taut::StepCoefficients step;
      step.velocity = 100.;
      step.acceleration = 1e4;
      for (const taut::StepCoefficients &c : {step, taut::StepCoefficients()})
      {
        SCOPED_TRACE(softer + ", " + std::to_string(first_definite) +
                     (c.is_at_rest() ? ", at rest" : ""));
        std::vector<int> expected(first_definite + 1);
        std::iota(expected.begin(), expected.end(), 0);
        for (std::vector<int> &attempts : asked_for)
          attempts.clear();
        system.prepare(c, {});
        for (const std::vector<int> &attempts : asked_for)
          EXPECT_EQ(attempts, expected);
        EXPECT_EQ(system.has_own_tangents(), first_definite == 0);
      }
    }
}
