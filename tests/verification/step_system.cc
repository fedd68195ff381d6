// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a tangent that is not definite is replaced by another one for its own body alone, in each
// step and at rest. Source: of two equal wires one has a tangent with a negative pivot at first.
#include "run.h"

#include <taut/base/exceptions.h>
#include <taut/time/step_system.h>

#include <gtest/gtest.h>

using namespace verification;

TEST(StepSystem, tangents_are_made_definite_body_by_body)
{
  Session session(
      "set Generator = network\nset Gravity = 0, 0\nset Start = undeformed\n"
      "subsection Network\n set Wires = one, two\n set Supports = a, b\n"
      " subsection Wire one\n  set To = 1, 0\n  set Components = string\n"
      "  set Mass per length = 1\n  set Tension = 100\n  set Element size = 0.25\n end\n"
      " subsection Wire two\n  set From = 0, 1\n  set To = 1, 1\n  set Components = string\n"
      "  set Mass per length = 1\n  set Tension = 100\n  set Element size = 0.25\n end\n"
      " subsection Support a\n  set Wire = one\n  set Positions = 0, 1\n end\n"
      " subsection Support b\n  set Wire = two\n  set Positions = 0, 1\n end\n"
      "end\nsubsection Time\n set Step = 0.01\n set End = 0.01\nend\n");
  const taut::Structure &structure = session.simulation().structure();
  ASSERT_EQ(structure.size(), 2u);

  for (const std::size_t softer : {0u, 1u})
    for (const int first_definite : {0, 1, 3})
    {
      using Attempt = std::pair<std::size_t, int>;
      std::vector<Attempt> asked_for, expected;
      for (std::size_t k = 0; k < 2; ++k)
        for (int attempt = 0; attempt <= (k == softer ? first_definite : 0); ++attempt)
          expected.emplace_back(k, attempt);

      taut::StepSystem system(structure, session.simulation().constraints(),
                              session.parameters().solver);
      system.set_nonlinear({0, 1},
                           [&](const std::size_t k, const int attempt)
                           {
                             asked_for.emplace_back(k, attempt);
                             auto K = structure[k].stiffness().clone();
                             if (k == softer && attempt < first_definite)
                               K->add(2, 2, -1e6);
                             return K;
                           });
      taut::StepCoefficients step;
      step.velocity = 100.;
      step.acceleration = 1e4;
      for (const taut::StepCoefficients &c : {step, taut::StepCoefficients()})
        for (const bool again : {false, true})
        {
          SCOPED_TRACE(std::to_string(softer) + ", " + std::to_string(first_definite) +
                       (c.is_at_rest() ? ", at rest" : "") + (again ? ", again" : ""));
          asked_for.clear();
          if (again)
            system.linearise();
          else
            system.prepare(c, {});
          EXPECT_EQ(asked_for, expected);
          EXPECT_EQ(system.has_own_tangents(), first_definite == 0);
        }
    }
}
