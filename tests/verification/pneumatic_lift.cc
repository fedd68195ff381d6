// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a pantograph that only the contact wire holds, as with a pneumatic lift, runs. Reference:
// an independent program for the line of EN 50318:2002 at 250 km/h without the spring at the base:
// mean 120.84 N, standard deviation 30.94 N. At the start the contact force is the static one,
// 120 N, by balance.
#include "scene_tests.h"

#include "model/form_finding.h"

using namespace verification;

namespace
{
  const char *const no_base_spring = "Catenary/Pantograph pantograph/Stiffnesses=4200, 0";
}

TEST(PneumaticLift, mean_and_deviation_are_those_of_an_independent_program)
{
  Session session(scene_file("en50318_2002_250"), {no_base_spring});
  double start = 0.;
  session.run(
      [&](const taut::StepView &view)
      {
        if (view.state.time == 0.)
          start = view.state.multiplier.back();
      });
  const taut::Moments force = session.simulation().statistics().contact_quantities(0).filtered;
  EXPECT_NEAR(figure("force at the start without a base spring", start, "N"), 120., 1e-9);
  EXPECT_NEAR(figure("mean force without a base spring", force.mean, "N"), 120.84, .01);
  EXPECT_NEAR(figure("standard deviation without a base spring", force.deviation, "N"), 30.94, .01);
  EXPECT_FALSE(has(session.log(), "Probes: no equilibrium")) << session.log();
}

// Claim: form finding does not depend on what slides along the wire: the same droppers with a base
// spring and without one.
TEST(PneumaticLift, droppers_do_not_depend_on_the_pantograph)
{
  const auto lengths = [](const Overrides &overrides)
  {
    std::vector<double> result;
    Session session(scene_file("en50318_2002_250"), overrides);
    for (const taut::Link &link : session.simulation().scene().links)
      if (link.kind == taut::LinkKind::dropper)
        result.push_back(link.length);
    return result;
  };
  const std::vector<double> with_spring = lengths({});
  ASSERT_EQ(with_spring.size(), 90u);
  EXPECT_LE(largest_difference(with_spring, lengths({no_base_spring})), 1e-13);
}

// Claim: a joint stands in for a contact only where it may be all that holds its mass: not where a
// spring or a fixed link leads to a wire, which the joint would hold with it.
TEST(PneumaticLift, a_joint_replaces_the_contact_of_a_mass_apart_from_the_wires_only)
{
  using Kind = taut::Attachment::Kind;
  taut::Scene scene;
  scene.masses.resize(4);
  taut::Link contact;
  contact.kind = taut::LinkKind::sliding_contact;
  contact.to.kind = Kind::wire;
  contact.direction = {0.6, 0.8};
  for (const std::size_t mass : {0, 2})
  {
    contact.from = {Kind::mass, mass, 0.};
    scene.links.push_back(contact);
  }
  taut::Link hanger; // mass 3, which mass 2 is on, hangs from a wire
  hanger.from.kind = Kind::wire;
  hanger.to = {Kind::mass, 3, 0.};
  scene.links.push_back(hanger);
  for (const auto &[from, to] :
       {std::pair<std::size_t, std::size_t>(0, 1), {3, 2}, {2, taut::ground}, {taut::ground, 0}})
  {
    taut::Spring spring;
    spring.from = from;
    spring.to = to;
    scene.springs.push_back(spring);
  }

  const taut::Scene without = taut::without_sliding_contacts(scene);
  ASSERT_EQ(without.links.size(), 2u);
  EXPECT_EQ(without.links[0].kind, taut::LinkKind::joint);
  EXPECT_EQ(without.links[0].from.kind, Kind::ground);
  EXPECT_EQ(without.links[0].to.kind, Kind::mass);
  EXPECT_EQ(without.links[0].to.index, 0u);
  EXPECT_EQ(without.links[0].direction.x, 0.6);
  EXPECT_EQ(without.links[0].direction.y, 0.8);
  EXPECT_EQ(without.links[1].from.kind, Kind::wire);
}
