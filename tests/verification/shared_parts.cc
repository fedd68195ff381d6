// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what the cases of a sweep have in common is made once, and no bit of a result shows it.
// Source: the same case by itself, from a parameter file that is read anew, with nothing shared;
// and the members of scene.h, each changed in turn.
#include "scene_tests.h"

#include <taut/model/form_finding.h>
#include <taut/model/scene_bodies.h>
#include <taut/scene/scene_values.h>
#include <taut/study/case_runner.h>

using namespace verification;

namespace
{
  const Overrides short_run = {"Catenary/Number of spans=3",
                               "Catenary/Uplift positions=90",
                               "Catenary/Contact wire/Element size=2",
                               "Catenary/Messenger wire/Element size=2",
                               "Statistics/Window=62, 68",
                               "Time/Scheme=Newmark",
                               "Time/Step=2e-3",
                               "Time/End=0.12"};

  /// Everything that a case gave, number for number; the message if it failed.
  std::vector<double> numbers(taut::CaseRunner &runner, const Overrides &entries,
                              std::string &message)
  {
    std::vector<double> values;
    message = verification::error_of(
        [&]
        {
          const taut::CaseResult result = runner.run(entries);
          for (const auto &quantity : result.quantities)
            values.push_back(quantity.value);
          values.push_back(result.worst.complementarity);
          values.push_back(result.worst.balance);
        });
    return values;
  }

  taut::Scene line(const Overrides &overrides = {})
  {
    const Overrides all = short_run + overrides;
    taut::Parameters parameters;
    parameters.read(scene_file("en50318_2002_250"), all);
    return taut::find_lengths(parameters.scene(), parameters.solver);
  }

  /// One of each part, with a time load.
  taut::Scene one_of_each()
  {
    taut::Scene scene;
    scene.wires.resize(1);
    scene.supports.resize(1);
    scene.point_masses.resize(1);
    scene.masses.resize(1);
    scene.springs.resize(1);
    scene.links.resize(1);
    scene.loads.resize(1);
    scene.probes.resize(1);
    return scene;
  }
} // namespace

// Each entry changes one thing that is shared, or should not be, and is changed back.
TEST(SharedParts, cases_have_the_bits_of_runs_alone)
{
  const std::string pantograph = "Catenary/Pantograph pantograph/",
                    file = scene_file("en50318_2002_250");
  const std::vector<std::pair<std::string, std::vector<std::string>>> entries = {
      {pantograph + "Masses", {"7.2, 15", "6, 18"}},
      {pantograph + "Stiffnesses", {"4200, 50", "5000, 60"}},
      {pantograph + "Dampings", {"10, 90", "30, 70"}},
      {pantograph + "Static force", {"120", "130"}},
      {pantograph + "Speed", {"250", "210"}},
      {pantograph + "Start", {"60", "61.3"}},
      {pantograph + "Contact stiffness", {"50000", "70000"}},
      {"Catenary/Contact wire/Mass per length", {"1.35", "1.2"}},
      {"Catenary/Contact wire/Tension", {"20000", "22000"}},
      {"Catenary/Contact wire/Bending stiffness", {"195", "150"}},
      {"Catenary/Contact wire/Mass damping", {"0.0125", "0.05"}},
      {"Catenary/Contact wire/Stiffness damping", {"1e-4", "2e-4"}},
      {"Catenary/Contact wire/Element size", {"2", "1.7"}},
      {"Catenary/Messenger wire/Tension", {"16000", "15000"}},
      {"Catenary/Supports/Arm mass", {"1", "1.5"}},
      {"Catenary/Droppers/Positions",
       {"5, 10.5, 17, 23.5, 30, 36.5, 43, 49.5, 55",
        "5, 10.5, 17.3, 23.5, 30, 36.5, 43, 49.5, 55"}},
      {"Catenary/Droppers/Stiffness", {"100000", "80000"}},
      {"Catenary/Encumbrance", {"1.2", "1.3"}},
      {"Gravity", {"0, -9.81", "0, -9.7"}},
      {"Solver/Local solver", {"block tridiagonal", "sparse direct"}},
      {"Solver/Interface operator", {"automatic", "assembled sparse"}},
      {"Partition/Number of substructures", {"1", "2"}},
      {"Time/Scheme", {"Newmark", "BDF2", "no such"}},
      {"Time/Step", {"2e-3", "3e-3", "-1"}},
      {"Time/Mass redistribution", {"automatic", "mass"}},
      {"Statistics/Filter frequency", {"20", "10"}},
      {"Catenary/Number of spans", {"3", "4"}}};
  taut::CaseRunner shared(file, short_run);
  Overrides all;
  for (const auto &[path, values] : entries)
    all.push_back(path + "=" + values[0]);
  std::vector<double> reference;
  std::size_t n_different = 0, n_failed = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t v = i == 0 ? 0 : 1; v <= entries[i].second.size(); ++v)
    {
      const std::string &value = entries[i].second[v % entries[i].second.size()];
      all[i] = entries[i].first + "=" + value;
      taut::CaseRunner alone(file, short_run);
      std::string message, expected_message;
      const std::vector<double> found = numbers(shared, all, message),
                                expected = numbers(alone, all, expected_message);
      EXPECT_EQ(found, expected) << all[i];
      EXPECT_EQ(message, expected_message) << all[i];
      EXPECT_EQ(found.empty(), !message.empty());
      n_failed += found.empty();
      if (reference.empty())
        reference = found;
      n_different += found != reference;
    }
  EXPECT_EQ(n_failed, 2u);
  // All but the interface operator and the local solver may be the same to the last bit.
  EXPECT_GE(n_different, entries.size() - 2);
}

// A pantograph does not change the wires, nor the form; what they are made of does.
TEST(SharedParts, wires_and_forms_are_made_once)
{
  taut::SharedParts shared;
  const auto bodies = [&](const Overrides &overrides)
  {
    shared.begin();
    taut::Scene scene = line(overrides);
    return taut::SceneBodies(scene, taut::whole(scene), taut::Communicator(), &shared);
  };
  const taut::SceneBodies first = bodies({}),
                          second = bodies({"Catenary/Pantograph pantograph/Masses=6, 18"}),
                          third = bodies({"Catenary/Contact wire/Tension=22000"});
  ASSERT_EQ(first.size(), 3u);
  unsigned int n_new = 0;
  for (std::size_t k = 0; k < 2; ++k)
  {
    EXPECT_EQ(&first[k], &second[k]) << first[k].name();
    n_new += &third[k] != &second[k];
  }
  EXPECT_NE(&first[2], &second[2]);
  EXPECT_EQ(n_new, 1u);
  EXPECT_EQ(shared.wires.size(), 3u);
  shared.begin();
  EXPECT_EQ(shared.wires.size(), 2u) << "what the last run did not ask for is forgotten";
}

// A value that is missing in the key would make two different wires one.
TEST(SharedParts, every_value_of_a_scene_is_in_its_values)
{
  using taut::Scene;
  const taut::Expression formula("sin(t)", "Load/Magnitude");
  const std::vector<std::function<void(Scene &)>> changes = {
      [](Scene &s) { s.gravity.y = -9.; },
      [](Scene &s) { s.start = taut::Start::given; },
      [](Scene &s) { s.wires[0].name = "a"; },
      [](Scene &s) { s.wires[0].origin = "a"; },
      [](Scene &s) { s.wires[0].a.x = 1.; },
      [](Scene &s) { s.wires[0].a.y = 1.; },
      [](Scene &s) { s.wires[0].b.z = 1.; },
      [](Scene &s) { s.wires[0].mass_per_length = 1.; },
      [](Scene &s) { s.wires[0].mass_per_length = -0.; },
      [](Scene &s) { s.wires[0].has_axial = true; },
      [](Scene &s) { s.wires[0].axial_stiffness = 1.; },
      [](Scene &s) { s.wires[0].transverse = taut::TransverseKind::beam; },
      [](Scene &s) { s.wires[0].has_lateral = true; },
      [](Scene &s) { s.wires[0].tension = 1.; },
      [](Scene &s) { s.wires[0].bending_stiffness = 1.; },
      [](Scene &s) { s.wires[0].degree = 3; },
      [](Scene &s) { s.wires[0].mass_matrix = taut::MassMatrix::lumped; },
      [](Scene &s) { s.wires[0].element_size = 2.; },
      [](Scene &s) { s.wires[0].damping.mass = 1.; },
      [](Scene &s) { s.wires[0].damping.stiffness = 1.; },
      [](Scene &s) { s.wires[0].weight = false; },
      [&](Scene &s) { s.wires[0].axial_start.displacement = formula; },
      [&](Scene &s) { s.wires[0].axial_start.velocity = formula; },
      [&](Scene &s) { s.wires[0].transverse_start.displacement = formula; },
      [&](Scene &s) { s.wires[0].transverse_start.velocity = formula; },
      [&](Scene &s) { s.wires[0].lateral_start.displacement = formula; },
      [&](Scene &s) { s.wires[0].lateral_start.velocity = formula; },
      [](Scene &s) { s.supports[0].name = "a"; },
      [](Scene &s) { s.supports[0].origin = "a"; },
      [](Scene &s) { s.supports[0].wire = 1; },
      [](Scene &s) { s.supports[0].positions = {1.}; },
      [](Scene &s) { s.supports[0].motion = taut::WireMotion::slope; },
      [](Scene &s) { s.supports[0].fixed = false; },
      [&](Scene &s) { s.supports[0].prescribed = formula; },
      [](Scene &s) { s.supports[0].stiffness = 1.; },
      [](Scene &s) { s.supports[0].damping = 1.; },
      [](Scene &s) { s.point_masses[0].name = "a"; },
      [](Scene &s) { s.point_masses[0].origin = "a"; },
      [](Scene &s) { s.point_masses[0].wire = 1; },
      [](Scene &s) { s.point_masses[0].positions = {1.}; },
      [](Scene &s) { s.point_masses[0].mass = 1.; },
      [](Scene &s) { s.point_masses[0].weight = false; },
      [](Scene &s) { s.masses[0].name = "a"; },
      [](Scene &s) { s.masses[0].origin = "a"; },
      [](Scene &s) { s.masses[0].position.x = 1.; },
      [](Scene &s) { s.masses[0].mass = 1.; },
      [](Scene &s) { s.masses[0].inertia = 1.; },
      [](Scene &s) { s.masses[0].moves[2] = true; },
      [](Scene &s) { s.masses[0].moves[3] = true; },
      [](Scene &s) { s.masses[0].displacement[3] = 1.; },
      [](Scene &s) { s.masses[0].velocity[3] = 1.; },
      [](Scene &s) { s.masses[0].weight = false; },
      [](Scene &s) { s.masses[0].displacement[1] = 1.; },
      [](Scene &s) { s.masses[0].velocity[2] = 1.; },
      [](Scene &s) { s.springs[0].name = "a"; },
      [](Scene &s) { s.springs[0].origin = "a"; },
      [](Scene &s) { s.springs[0].from = 0; },
      [](Scene &s) { s.springs[0].to = 0; },
      [](Scene &s) { s.springs[0].rotational = true; },
      [](Scene &s) { s.springs[0].direction.x = 1.; },
      [](Scene &s) { s.springs[0].stiffness = 1.; },
      [](Scene &s) { s.springs[0].damping = 1.; },
      [](Scene &s) { s.links[0].name = "a"; },
      [](Scene &s) { s.links[0].origin = "a"; },
      [](Scene &s) { s.links[0].kind = taut::LinkKind::stop; },
      [](Scene &s) { s.links[0].from.kind = taut::Attachment::Kind::mass; },
      [](Scene &s) { s.links[0].from.index = 1; },
      [](Scene &s) { s.links[0].to.position = 1.; },
      [](Scene &s) { s.links[0].to.place.x = 1.; },
      [](Scene &s) { s.links[0].to.has_place = true; },
      [](Scene &s) { s.links[0].turns = true; },
      [](Scene &s) { s.links[0].unstressed_length = 1.; },
      [](Scene &s) { s.links[0].rotational = true; },
      [](Scene &s) { s.links[0].direction.x = 1.; },
      [](Scene &s) { s.links[0].stiffness = 1.; },
      [](Scene &s) { s.links[0].damping = 1.; },
      [](Scene &s) { s.links[0].gap = 1.; },
      [](Scene &s) { s.links[0].speed = 1.; },
      [&](Scene &s) { s.links[0].profile = formula; },
      [](Scene &s) { s.links[0].form.find_length = true; },
      [](Scene &s) { s.links[0].form.prescribed_displacement = 1.; },
      [](Scene &s) { s.links[0].form.axial_stiffness = 1.; },
      [](Scene &s) { s.links[0].form.mass_per_length = 1.; },
      [](Scene &s) { s.links[0].length = 1.; },
      [](Scene &s) { s.links[0].form.find_direction = true; },
      [](Scene &s) { s.links[0].sideways.direction.z = 1.; },
      [](Scene &s) { s.links[0].sideways.stiffness = 1.; },
      [](Scene &s) { s.links[0].sideways.gap = 1.; },
      [](Scene &s) { s.links[0].contact_mass = taut::ContactMass::keeps_total; },
      [](Scene &s) { s.loads[0].name = "a"; },
      [](Scene &s) { s.loads[0].origin = "a"; },
      [](Scene &s) { s.loads[0].kind = taut::Load::Kind::moving; },
      [](Scene &s) { s.loads[0].target.index = 1; },
      [](Scene &s) { s.loads[0].rotational = true; },
      [](Scene &s) { s.loads[0].direction.x = 1.; },
      [&](Scene &s) { s.loads[0].magnitude = formula; },
      [](Scene &s) { s.loads[0].speed = 1.; },
      [](Scene &s) { s.loads[0].acts_while_built = false; },
      [](Scene &s) { s.probes[0].name = "a"; },
      [](Scene &s) { s.probes[0].origin = "a"; },
      [](Scene &s) { s.probes[0].point.index = 1; },
      [](Scene &s) { s.probes[0].rotational = true; },
      [](Scene &s) { s.probes[0].direction.x = 1.; },
      [](Scene &s) { s.wires.push_back(s.wires[0]); },
      [](Scene &s) { s.links.clear(); }};
  std::vector<std::string> seen = {taut::values_of(one_of_each())};
  EXPECT_EQ(taut::values_of(one_of_each()), seen[0]);
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    taut::Scene scene = one_of_each();
    changes[i](scene);
    seen.push_back(taut::values_of(scene));
    for (std::size_t k = 0; k + 1 < seen.size(); ++k)
      EXPECT_NE(seen.back(), seen[k]) << "changes " << i + 1 << " and " << k;
  }
}
