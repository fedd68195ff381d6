// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what the cases of a sweep have in common is made once, and no bit of a result shows it.
// Source: the same case by itself, from a parameter file that is read anew, with nothing shared;
// and the members of scene.h, each changed in turn.
#include "scene_tests.h"

#include "model/form_finding.h"
#include "scene/scene_values.h"
#include "study/case_runner.h"
#include <taut/model/scene_bodies.h>

using namespace verification;

namespace
{
  using taut::Scene;

  const Overrides short_run = {"Catenary/Number of spans=3",
                               "Catenary/Uplift positions=90",
                               "Catenary/Contact wire/Element size=2",
                               "Catenary/Messenger wire/Element size=2",
                               "Statistics/Window=62, 68",
                               "Time/Scheme=Newmark",
                               "Time/Step=2e-3",
                               "Time/End=0.12"};

  /// In the place of not-a-number, which is not equal to itself.
  constexpr double not_known = 1e300;

  /// Everything that a case gave, number for number; the message if it failed.
  std::pair<std::vector<double>, std::string> numbers(taut::CaseRunner &runner,
                                                      const Overrides &entries)
  {
    std::vector<double> values;
    const std::string message = error_of(
        [&]
        {
          const taut::CaseResult result = runner.run(entries);
          for (const auto &quantity : result.quantities)
            values.push_back(std::isnan(quantity.value) ? not_known : quantity.value);
          values.insert(values.end(), {result.worst.complementarity, result.worst.balance});
        });
    return {values, message};
  }

  Scene line(const Overrides &overrides = {})
  {
    taut::Parameters parameters;
    parameters.read(scene_file("en50318_2002_250"), short_run + overrides);
    return taut::find_lengths(parameters.scene(), parameters.solver);
  }

  /// One of each part, with a time load.
  Scene one_of_each()
  {
    Scene scene;
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

  template <typename... T>
  auto pointers(T &...members)
  {
    return std::vector{&members...};
  }

  auto numbers_of(Scene &s)
  {
    taut::Wire &wire = s.wires[0];
    taut::Mass &mass = s.masses[0];
    taut::Link &link = s.links[0];
    return pointers(
        s.gravity.y, wire.a.x, wire.a.y, wire.b.z, wire.mass_per_length, wire.axial_stiffness,
        wire.tension, wire.bending_stiffness, wire.element_size, wire.damping.mass,
        wire.damping.stiffness, s.supports[0].stiffness, s.supports[0].damping,
        s.point_masses[0].mass, mass.position.x, mass.mass, mass.inertia, mass.displacement[1],
        mass.displacement[3], mass.velocity[2], mass.velocity[3], s.springs[0].direction.x,
        s.springs[0].stiffness, s.springs[0].damping, link.to.position, link.to.place.x,
        link.unstressed_length, link.direction.x, link.stiffness, link.damping, link.gap,
        link.speed, link.form.prescribed_displacement, link.form.axial_stiffness,
        link.form.mass_per_length, link.length, link.sideways.direction.z, link.sideways.stiffness,
        link.sideways.gap, s.loads[0].direction.x, s.loads[0].speed, s.probes[0].direction.x);
  }

  auto switches_of(Scene &s)
  {
    taut::Wire &wire = s.wires[0];
    taut::Mass &mass = s.masses[0];
    taut::Link &link = s.links[0];
    return pointers(wire.has_axial, wire.has_lateral, wire.weight, s.supports[0].fixed,
                    s.point_masses[0].weight, mass.moves[2], mass.moves[3], mass.weight,
                    s.springs[0].rotational, link.to.has_place, link.turns, link.rotational,
                    link.form.find_length, link.form.find_direction, s.loads[0].rotational,
                    s.loads[0].acts_while_built, s.probes[0].rotational);
  }

  auto texts_of(Scene &s)
  {
    return pointers(s.wires[0].name, s.wires[0].origin, s.supports[0].name, s.supports[0].origin,
                    s.point_masses[0].name, s.point_masses[0].origin, s.masses[0].name,
                    s.masses[0].origin, s.springs[0].name, s.springs[0].origin, s.links[0].name,
                    s.links[0].origin, s.loads[0].name, s.loads[0].origin, s.probes[0].name,
                    s.probes[0].origin);
  }

  auto indices_of(Scene &s)
  {
    return pointers(s.supports[0].wire, s.point_masses[0].wire, s.springs[0].from, s.springs[0].to,
                    s.links[0].from.index, s.loads[0].target.index, s.probes[0].point.index);
  }

  auto formulas_of(Scene &s)
  {
    taut::Wire &wire = s.wires[0];
    return pointers(wire.axial_start.displacement, wire.axial_start.velocity,
                    wire.transverse_start.displacement, wire.transverse_start.velocity,
                    wire.lateral_start.displacement, wire.lateral_start.velocity,
                    s.supports[0].prescribed, s.links[0].profile, s.loads[0].magnitude);
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
      const auto found = numbers(shared, all);
      EXPECT_EQ(found, numbers(alone, all)) << all[i];
      EXPECT_EQ(found.first.empty(), !found.second.empty());
      n_failed += found.first.empty();
      if (reference.empty())
        reference = found.first;
      n_different += found.first != reference;
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
    Scene scene = line(overrides);
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
  std::vector<std::function<void(Scene &)>> changes = {
      [](Scene &s) { s.start = taut::Start::given; },
      [](Scene &s) { s.wires[0].mass_per_length = -0.; },
      [](Scene &s) { s.wires[0].transverse = taut::TransverseKind::beam; },
      [](Scene &s) { s.wires[0].degree = 3; },
      [](Scene &s) { s.wires[0].mass_matrix = taut::MassMatrix::lumped; },
      [](Scene &s) { s.supports[0].positions = {1.}; },
      [](Scene &s) { s.supports[0].motion = taut::WireMotion::slope; },
      [](Scene &s) { s.point_masses[0].positions = {1.}; },
      [](Scene &s) { s.links[0].kind = taut::LinkKind::stop; },
      [](Scene &s) { s.links[0].from.kind = taut::Attachment::Kind::mass; },
      [](Scene &s) { s.links[0].contact_mass = taut::ContactMass::keeps_total; },
      [](Scene &s) { s.loads[0].kind = taut::Load::Kind::moving; },
      [](Scene &s) { s.wires.push_back(s.wires[0]); },
      [](Scene &s) { s.links.clear(); }};
  const auto add = [&](const auto members, const auto change)
  {
    Scene scene = one_of_each();
    for (std::size_t i = 0; i < members(scene).size(); ++i)
      changes.push_back([members, change, i](Scene &s) { change(*members(s)[i]); });
  };
  add(numbers_of, [](double &value) { value = 7.; });
  add(switches_of, [](bool &value) { value = !value; });
  add(texts_of, [](std::string &value) { value = "a"; });
  add(indices_of, [](std::size_t &value) { value = 7; });
  add(formulas_of,
      [](taut::Expression &value) { value = taut::Expression("sin(t)", "Load/Magnitude"); });
  EXPECT_EQ(changes.size(), 105u);
  std::vector<std::string> seen = {taut::values_of(one_of_each())};
  EXPECT_EQ(taut::values_of(one_of_each()), seen[0]);
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    Scene scene = one_of_each();
    changes[i](scene);
    seen.push_back(taut::values_of(scene));
    for (std::size_t k = 0; k + 1 < seen.size(); ++k)
      EXPECT_NE(seen.back(), seen[k]) << "changes " << i + 1 << " and " << k;
  }
}
