// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the lengths of droppers in start.csv are those that the entry Lengths takes: a line with
// them has the state at rest of the line whose lengths were found, and a folder of results keeps a
// line as it was built. Sources: the found line itself; N/k, the stretch of a dropper; strings
// under a force in closed form.
#include "scene_tests.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace verification;

namespace
{
  struct AtRest
  {
    std::vector<double> force, length, stretched, height;
  };

  AtRest at_rest(const Overrides &overrides, const std::vector<double> &lengths)
  {
    std::string list;
    for (const double length : lengths)
      list += (list.empty() ? "Catenary/Droppers/Lengths=" : ", ") + number(length);
    Session session(scene_file("en50318_2002_250"),
                    overrides +
                        Overrides{"Time/End=0", "Catenary/Number of spans=1",
                                  "Catenary/Uplift positions=", "Statistics/Window="} +
                        (list.empty() ? Overrides() : Overrides{list}));
    AtRest result;
    session.run(
        [&](const taut::StepView &step)
        {
          for (double x = 1.; x < 60.; x += 1.)
            for (const std::size_t wire : {0, 1})
              result.height.push_back(displacement(step, wire, x));
        });
    const auto start = read_table(session.folder() + "/start.csv");
    const auto column = [&](const std::string &title)
    { return std::vector<double>(start.at(title).begin(), start.at(title).begin() + 9); };
    result.force = column("force [N or N m]");
    result.length = column("length [m]");
    result.stretched = column("stretched length [m]");
    return result;
  }
} // namespace

TEST(DropperLengths, of_start_csv_give_the_same_state_at_rest)
{
  double worst = 0.;
  for (const double stiffness : {1e5, 1e4})
  {
    const Overrides overrides = {"Catenary/Droppers/Stiffness=" + number(stiffness),
                                 "Catenary/Droppers/Pre-sag=0, 0.01, 0.02, 0.03, 0.03, 0.03, 0.02,"
                                 " 0.01, 0"};
    const AtRest found = at_rest(overrides, {}), given = at_rest(overrides, found.length);
    for (std::size_t i = 0; i < found.length.size(); ++i)
    {
      EXPECT_GT(found.force[i], 10.);
      EXPECT_NEAR(found.stretched[i] - found.length[i], found.force[i] / stiffness, 1e-12);
      EXPECT_NEAR(given.force[i], found.force[i], 1e-6 * found.force[i]) << i;
      EXPECT_NEAR(given.length[i], found.length[i], 1e-15) << i;
      EXPECT_NEAR(given.stretched[i], found.stretched[i], 1e-9) << i;
    }
    raise(worst, largest_difference(found.height, given.height));
  }
  figure("line with given lengths, largest distance from the line of found ones", worst, "m");
  EXPECT_LT(worst, 1e-9);
}

namespace
{
  /// A string of 40 m on one dropper in its middle, under another.
  std::string one_dropper(const std::string &more = "")
  {
    return R"(Generator = catenary
Start = equilibrium
Catenary: Number of spans = 1; Span length = 40; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 1; Tension = 10000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Positions = 20
Time: Step = 1e-3; End = 0; Scheme = backward Euler
)" + more;
  }

  /// Forces of the droppers at rest, by name.
  std::map<std::string, double> forces_of(Session &session)
  {
    std::map<std::string, double> forces;
    session.run(
        [&](const taut::StepView &view)
        {
          for (std::size_t i = 0; i < view.scene.links.size(); ++i)
            forces[view.scene.links[i].name] =
                view.state.multiplier[view.constraints.index_of_link(i)];
        });
    return forces;
  }
} // namespace

// The contact wire is level at the dropper: half of its weight, 20 g, hangs there. With another
// tension T of the messenger wire it would hang elsewhere: found anew, the length changes and the
// force does not. As it was built, L + N / k = 1.2 - (m L^2 / 8 + N L / 4) / T + (m' L^2 / 8 - N L
// / 4) / T'.
TEST(DropperLengths, of_a_line_as_built_stay_where_the_tension_changes)
{
  const double k = 1e5, N = 20. * g, length = 1.2 - (.8 * g * 200. + 10. * N) / 12000. - N / k,
               kept = (1.2 - length - .8 * g * 200. / 11000. + g * 200. / 10000.) /
                      (1. / k + 10. / 11000. + 10. / 10000.);
  Session built(one_dropper());
  EXPECT_NEAR(forces_of(built).at("dropper 1.1"), N, 1e-8);
  EXPECT_TRUE(has(built.log(), "  1 length of droppers found anew")) << built.log();
  EXPECT_TRUE(has(built.log(), "'Droppers/Lengths = " + built.folder() + "'")) << built.log();
  const std::string slacker = "Catenary/Messenger wire: Tension = 11000\n";
  Session anew(one_dropper(slacker)),
      as_built(one_dropper(slacker), {"Catenary/Droppers/Lengths=" + built.folder()});
  EXPECT_NEAR(forces_of(anew).at("dropper 1.1"), N, 1e-8);
  EXPECT_NEAR(forces_of(as_built).at("dropper 1.1"), kept, 1e-8);
  EXPECT_GT(std::fabs(kept - N), 1.);
  EXPECT_FALSE(has(as_built.log(), "found anew")) << as_built.log();
}

// Stiffness EA over length, mass, stagger, twin wires and unequal spans: the same line again.
TEST(DropperLengths, of_results_give_the_same_line)
{
  const std::string line = one_dropper(R"(Catenary: Span lengths = 40, 50, 30; Contact wires = 2
Catenary/Droppers: Positions = 5, 20, 35; 5, 15, 25, 35, 45; 8, 22; Axial stiffness = 1e5
  ; Mass per length = 0.14
)");
  for (const char *const stagger : {"0", "0.2"})
  {
    const Overrides aside = {"Catenary/Contact wire/Stagger=" + std::string(stagger)};
    Session built(line, aside);
    const auto expected = forces_of(built);
    Session again(line, aside + Overrides{"Catenary/Droppers/Lengths=" + built.folder()});
    const auto found = forces_of(again);
    ASSERT_EQ(found.size(), 20u);
    for (const auto &[name, force] : expected)
      EXPECT_NEAR(found.at(name), force, 1e-6 * force) << name << ", stagger " << stagger;
  }
}

// The others keep their lengths: those of the list without it.
TEST(DropperLengths, of_results_stay_where_a_dropper_breaks_or_moves)
{
  const auto with = [](const std::string &positions)
  { return one_dropper("Catenary/Droppers: Positions = " + positions + "\n"); };
  Session built(with("8, 16, 24, 32"));
  forces_of(built);
  const std::vector<double> cut = read_table(built.folder() + "/droppers.csv").at("cut length [m]");
  const auto expect_lengths = [&](const std::string &positions, const std::vector<double> &lengths)
  {
    std::string list = "Catenary/Droppers/Lengths=";
    for (std::size_t i = 0; i < lengths.size(); ++i)
      list += (i > 0 ? ", " : "") + number(lengths[i]);
    Session listed(with(positions), {list}),
        kept(with(positions), {"Catenary/Droppers/Lengths=" + built.folder()});
    EXPECT_EQ(forces_of(kept), forces_of(listed)) << positions;
  };
  expect_lengths("8, 24, 32", {cut[0], cut[2], cut[3]});
  expect_lengths("8, 16, 26, 32", cut);
  EXPECT_TRUE(
      has(error_of(
              [&] { Session(with("8, 17, 24"), {"Catenary/Droppers/Lengths=" + built.folder()}); }),
          "none of them at 17 m"));
}

// Two strings of 50 m, of which some droppers have lengths and the others are found. Expected: the
// deflections of strings under their weight and point forces, x (L - s) / (L T) for x < s, and one
// equation for each dropper: its length, or the height of the contact wire.
TEST(DropperLengths, given_beside_found_ones_are_those_of_strings)
{
  constexpr double L = 50., k = 1e5, T[] = {15000., 9000.}, m[] = {1.1, .9}, high = 1.4;
  const std::vector<double> x = {4., 11., 19., 25., 32., 41., 47.};
  const std::size_t n = x.size();
  const auto sag = [&](const int wire, const double at)
  { return m[wire] * g * at * (L - at) / (2. * T[wire]); };
  const auto by_force = [&](const int wire, const double at, const double force)
  { return std::fmin(at, force) * (L - std::fmax(at, force)) / (L * T[wire]); };
  const auto solve = [](dealii::FullMatrix<double> A, const dealii::Vector<double> &b)
  {
    dealii::Vector<double> N(b.size());
    A.gauss_jordan();
    A.vmult(N, b);
    return N;
  };
  // Tensions that hold the contact wire level.
  dealii::FullMatrix<double> of_contact_wire(n);
  dealii::Vector<double> sags(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    sags(i) = sag(1, x[i]);
    for (std::size_t j = 0; j < n; ++j)
      of_contact_wire(i, j) = by_force(1, x[i], x[j]);
  }
  const dealii::Vector<double> level = solve(of_contact_wire, sags);
  for (const std::vector<bool> &found :
       {std::vector<bool>{true, false, true, true, false, true, false},
        {false, false, false, true, false, false, false},
        {true, true, true, true, true, false, true},
        {false, true, true, false, false, true, true}})
  {
    // The given lengths are those of a level wire, but for some mm.
    dealii::FullMatrix<double> A = of_contact_wire;
    dealii::Vector<double> b = sags;
    std::vector<double> given(n, 0.);
    for (std::size_t i = 0; i < n; ++i)
    {
      given[i] = high - sag(0, x[i]) - level(i) / k - .004 + .003 * (i % 3);
      for (std::size_t j = 0; j < n; ++j)
        given[i] -= by_force(0, x[i], x[j]) * level(j);
      if (found[i])
        continue;
      for (std::size_t j = 0; j < n; ++j)
        A(i, j) += by_force(0, x[i], x[j]) + (i == j ? 1. / k : 0.);
      b(i) += high - sag(0, x[i]) - given[i];
    }
    const dealii::Vector<double> N = solve(A, b);
    std::string positions, lengths;
    for (std::size_t i = 0; i < n; ++i)
    {
      positions += (i > 0 ? ", " : "") + number(x[i]);
      lengths += (i > 0 ? ", " : "") + number(found[i] ? 0. : given[i]);
    }
    Session session(R"(Generator = catenary
Start = equilibrium
Catenary: Number of spans = 1; Span length = 50; Encumbrance = 1.4; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 0.9; Tension = 9000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 1.1; Tension = 15000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Stiffness = 1e5; Positions = )" +
                    positions + "; Lengths = " + lengths +
                    "\nTime: Step = 1e-3; End = 0; Scheme = backward Euler\n");
    const auto forces = forces_of(session);
    double worst_force = 0., worst_length = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      ASSERT_GT(N(i), 0.) << i;
      double length = high - sag(0, x[i]) + sag(1, x[i]) - N(i) / k;
      for (std::size_t j = 0; j < n; ++j)
        length -= (by_force(0, x[i], x[j]) + by_force(1, x[i], x[j])) * N(j);
      raise(worst_force, forces.at("dropper 1." + std::to_string(i + 1)) - N(i));
      raise(worst_length, session.simulation().scene().links[i].unstressed_length - length);
    }
    EXPECT_LT(worst_force, 1e-8);
    EXPECT_LT(worst_length, 1e-11);
  }
}

// A line of equal spans has the lengths of ten spans, whatever its number of spans.
TEST(DropperLengths, settle_for_any_number_of_spans)
{
  const auto lengths = [](const int n_spans)
  {
    Session session(scene_file("en50318_2002_250"),
                    {"Time/End=0", "Catenary/Number of spans=" + std::to_string(n_spans),
                     "Catenary/Uplift positions=", "Statistics/Window=",
                     "Catenary/Droppers/Axial stiffness=1e5",
                     "Catenary/Droppers/Mass per length=0.14"});
    std::vector<double> result;
    for (const taut::Link &link : session.simulation().scene().links)
      if (link.name.find("dropper 5.") == 0)
        result.push_back(link.unstressed_length);
    return result;
  };
  const std::vector<double> expected = lengths(10);
  ASSERT_EQ(expected.size(), 9u);
  for (const int n_spans : {30, 200})
    EXPECT_LT(largest_difference(lengths(n_spans), expected), 1e-7) << n_spans;
}

// '..' and '2024' are folders where a table of droppers is there. Its copy is below the results.
TEST(DropperLengths, of_results_in_folders_without_a_letter)
{
  namespace fs = std::filesystem;
  const std::string line = scene_file("en50318_2002_250");
  const Overrides at_rest = {"Time/End=0", "Catenary/Number of spans=1",
                             "Catenary/Uplift positions=", "Statistics/Window="};
  Session built(line, at_rest + Overrides{"Catenary/Droppers/Stiffness=2e4"});
  const auto with = [](const std::string &folder)
  { return Overrides{"Catenary/Droppers/Lengths=" + folder}; };
  const Folder scratch;
  const fs::path &folder = scratch.path;
  fs::create_directories(folder / "scenes" / "2024");
  fs::copy(line, folder / "scenes" / "line.prm");
  forces_of(built);
  for (const fs::path &place : {folder, folder / "scenes" / "2024"})
    fs::copy(built.folder() + "/droppers.csv", place / "droppers.csv");
  Session expected(line, at_rest + with(built.folder())), other(line, at_rest);
  const auto forces = forces_of(expected);
  EXPECT_NE(forces, forces_of(other));
  for (const std::string name : {"..", "2024"})
  {
    Session found((folder / "scenes" / "line.prm").string(),
                  at_rest + with(name) + Overrides{"Output/Folder=" + (folder / "run").string()});
    EXPECT_EQ(forces_of(found), forces) << name;
    EXPECT_TRUE(
        fs::exists(folder / "run" / (name == ".." ? "earlier_run" : name) / "droppers.csv"));
    fs::remove_all(folder / "run");
  }
  const std::string column = "cut length [m]";
  EXPECT_EQ(read_table((folder / "droppers.csv").string()).at(column),
            read_table(built.folder() + "/droppers.csv").at(column));
}
