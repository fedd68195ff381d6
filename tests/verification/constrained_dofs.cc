// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: constraints may act on any number of DoFs of a body, none and very many included.
#include "common.h"

#include <taut/time/stepper.h>

namespace
{
  /// Points on springs of 1 N/m, of which the first ones have no mass, under a force of 1 N each.
  class Points : public taut::Substructure
  {
  public:
    Points(const unsigned int n, const unsigned int n_massless) : Substructure("points")
    {
      const auto make = [&] { return std::make_unique<taut::CompressedMatrix>(n); };
      M = make();
      C = make();
      K = make();
      for (unsigned int i = 0; i < n; ++i)
      {
        K->add(i, i, 1.);
        if (i >= n_massless)
          M->add(i, i, 1.);
      }
      constant_force.assign(n, 1.);
      finish();
    }
    bool has_definite_mass() const override { return false; }
  };
} // namespace

TEST(ConstrainedDofs, a_constraint_on_256_dofs_without_mass_is_one_on_none_with_mass)
{
  for (const unsigned int n : {1u, 127u, 128u, 255u, 256u, 512u})
  {
    taut::System system;
    system.add("points", [n] { return std::make_unique<Points>(n + 1, n); });
    taut::LinearForm mean, mass;
    for (unsigned int i = 0; i < n; ++i)
      mean.add(i, 1. / n);
    mass.add(n, 1.);
    system.add(taut::Constraint::unilateral("mean", {{0, mean}}));
    system.add(taut::Constraint::unilateral("mass", {{0, mass}}));
    const taut::Constraints constraints = system.constraints(system.structure());
    EXPECT_TRUE(constraints.without_mass()[0]) << n;
    EXPECT_FALSE(constraints.without_mass()[1]) << n;
  }
}

TEST(ConstrainedDofs, a_constraint_on_none_is_refused_by_name)
{
  taut::System system;
  system.add("points", [] { return std::make_unique<Points>(3, 0); });
  const std::string refusal = verification::error_of(
      [&] {
        system.add(taut::Constraint::unilateral("none", {{0, {}}}).gap(1.));
      });
  EXPECT_TRUE(verification::has(refusal, "'none'")) << refusal;
}
