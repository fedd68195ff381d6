// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a line of unequal spans from lists or a table is the line that its entries describe.
// Sources: the reference line of EN 50318:2002, written as lists and as a table; sums of forces on
// strings; an arm that is a stiff beam on a hinge.
#include "scene_tests.h"

#include "base/text.h"
#include "study/elasticity.h"
#include <taut/output/spans.h>

using namespace verification;

namespace
{
  const Overrides short_run = {"Time/Step=1e-3", "Time/End=0.03", "Time/Scheme=backward Euler",
                               "Statistics/Window="};

  /// Forces of all constraints in all steps of the reference line with other entries.
  std::vector<double> forces_with(const Overrides &overrides)
  {
    std::vector<double> forces;
    run_scene(scene_file("en50318_2002_250"), short_run + overrides,
              [&](const taut::StepView &view) {
                forces.insert(forces.end(), view.state.multiplier.begin(),
                              view.state.multiplier.end());
              });
    return forces;
  }

  /// A file in a folder of its own.
  struct File
  {
    File(const std::string &name, const std::string &text) : path(folder.write(name, text)) {}

    const Folder folder;
    const std::string path;
  };

  std::string repeated(const std::string &text, const int n, const std::string &separator)
  {
    std::string all;
    for (int i = 0; i < n; ++i)
      all += (i > 0 ? separator : "") + text;
    return all;
  }

  /// A line of strings without droppers and pantographs: one span of 40 m unless more is said.
  const std::string bare_strings = R"(Generator = catenary
Start = equilibrium
Catenary: Number of spans = 1; Span length = 40; Pantographs =
Catenary/Contact wire: Model = string; Mass per length = 1; Tension = 10000; Element size = 1
Catenary/Messenger wire: Model = string; Mass per length = 0.8; Tension = 12000; Element size = 1
Catenary/Supports: Arm mass = 0
Catenary/Droppers: Positions =
Time: Step = 1e-3; End = 0; Scheme = backward Euler
)";

  /// Shape of a string of length L under its weight w [N/m] and forces, from its chord.
  double sag(const double x, const double L, const double w, const double T,
             const std::vector<std::pair<double, double>> &forces = {})
  {
    double moment = .5 * w * x * (L - x);
    for (const auto &[at, force] : forces)
      moment += force * std::min(x, at) * (L - std::max(x, at)) / L;
    return moment / T;
  }
} // namespace

TEST(LinesAsBuilt, lists_of_equal_spans_are_the_reference_line)
{
  const std::vector<double> expected = forces_with({});
  EXPECT_EQ(forces_with({"Catenary/Span lengths=" + repeated("60", 10, ", ")}), expected);
  EXPECT_EQ(forces_with({"Catenary/Heights=" + repeated("0", 11, ", "),
                         "Catenary/Encumbrance=" + repeated("1.2", 11, ", "),
                         "Catenary/Droppers/Positions=" +
                             repeated("5, 10.5, 17, 23.5, 30, 36.5, 43, 49.5, 55", 10, "; ")}),
            expected);
  std::string parts;
  for (const double x : {5., 10.5, 17., 23.5, 30., 36.5, 43., 49.5, 55.})
    parts += (parts.empty() ? "" : ", ") + number(x / 60.);
  const std::vector<double> relative = forces_with(
      {"Catenary/Droppers/Positions are=relative", "Catenary/Droppers/Positions=" + parts});
  EXPECT_LE(largest_difference(relative, expected), 1e-9 * largest(expected));
}

TEST(LinesAsBuilt, a_table_is_the_line_of_its_lists)
{
  const std::vector<double> expected = forces_with({});
  const std::string places = "5 10.5 17 23.5 30 36.5 43 49.5 55";
  const File plain("line.csv", "span,droppers,encumbrance\n" +
                                   repeated("60," + places + ",1.2\n", 10, "") + ",,1.2\n");
  EXPECT_EQ(forces_with({"Catenary/Line=" + plain.path}), expected);

  // A byte order mark, semicolons, decimal commas, quotes, comments and line ends of Windows.
  std::string with_commas = places;
  std::replace(with_commas.begin(), with_commas.end(), '.', ',');
  const File other("line.csv", "\xEF\xBB\xBF# a line\r\nencumbrance ; span; droppers\r\n\r\n" +
                                   repeated("1,2; \"60,0\"; " + with_commas + "\r\n", 10, "") +
                                   "1,2;;\r\n");
  EXPECT_EQ(forces_with({"Catenary/Line=" + other.path}), expected);

  // As spreadsheets save tables: capitals, units, tabs or separators at ends of lines, rows of
  // separators alone, line ends of an old Macintosh.
  const File tabs("line.csv", "Span [m]\tDroppers\tEncumbrance (m)\t\t\n" +
                                  repeated("60\t" + with_commas + "\t1,2\t\t\n", 10, "") +
                                  "\t\t1,2\t\t\n\t\t\t\t\n");
  EXPECT_EQ(forces_with({"Catenary/Line=" + tabs.path}), expected);
  const File returns("line.csv", "SPAN;DROPPERS;ENCUMBRANCE;\r" +
                                     repeated(";;;\r60;" + places + ";1.2;\r", 10, "") +
                                     ";;;\r;;1.2\r;;;\r");
  EXPECT_EQ(forces_with({"Catenary/Line=" + returns.path}), expected);
}

TEST(LinesAsBuilt, tables_that_are_no_lines_are_refused)
{
  const auto error = [](const std::string &text)
  {
    const File file("line.csv", text);
    return error_of([&] { Session(bare_strings, {"Catenary/Line=" + file.path}); });
  };
  EXPECT_EQ(error("span,droppers\n40,10 20\n,\n"), "");
  EXPECT_TRUE(has(error("span,dropers\n40,10 20\n,\n"), "did you mean 'droppers'?"));
  EXPECT_TRUE(has(error("span\n40\n\n"), "has no column 'droppers'"));
  EXPECT_TRUE(has(error("span,droppers\n40,10 2x\n,\n"), "line 2: '2x' in column 'droppers'"));
  EXPECT_TRUE(has(error("span,droppers\n40,10 20,3\n,\n"), "line 2: 3 cells for 2 columns"));
  EXPECT_TRUE(
      has(error("span,droppers,pre-sag\n40,10 20,0.1\n,,\n"), "1 values in 'pre-sag' for 2"));
  EXPECT_TRUE(has(error("span,droppers\n40,10 20\n40,\n"), "line 3: the last mast has no span"));
  EXPECT_TRUE(has(error("span,droppers\n"), "has no rows"));
  EXPECT_EQ(error("span,droppers\n40,10 20\n,\n,\n,\n"), "");
  EXPECT_TRUE(
      has(error("span [mm],droppers\n40000,10 20\n,\n"), "are in 'mm'; give them in units"));
  EXPECT_TRUE(has(error("span,droppers\n# M\xfc"
                        "ller\n40,10 20\n,\n"),
                  "Latin-1, by its line 2"));
  EXPECT_TRUE(has(error(std::string("\xFF\xFEs\0p\0a\0n\0", 10)), "in UTF-16"));
  EXPECT_TRUE(has(error_of([] { Session(bare_strings, {"Catenary/Line=none.csv"}); }),
                  "cannot read the file"));
}

namespace
{
  std::string checked(const std::string &scene, const Overrides &overrides = {})
  {
    Session session(scene, overrides);
    session.simulation().check();
    return session.log();
  }
} // namespace

// Source: lines have system heights of 0.5 to 3 m and staggers of up to 0.6 m. Each value is in
// another unit, or has a digit too many.
TEST(LinesAsBuilt, values_of_another_unit_have_warnings_as_they_were_read)
{
  const std::string unit = "Lengths are read in m",
                    droppers = "Catenary/Droppers: Positions = 10, 20, 30; Lengths = ";
  EXPECT_FALSE(has(checked(bare_strings), unit));
  EXPECT_FALSE(has(checked(bare_strings + "Catenary: Encumbrance = 0.1, 10\n"
                                          "Catenary/Contact wire: Stagger = 2\n"),
                   unit));
  EXPECT_TRUE(has(checked(bare_strings + "Catenary: Encumbrance = 1.4, 1400; Begin = 100\n"),
                  "Warning: Catenary: a system height (encumbrance) of 1400 m at x = 140 m is not "
                  "between 0.1 and 10 m. Lengths are read in m"));
  EXPECT_TRUE(has(checked(bare_strings + "Catenary: Encumbrance = 0.012\n"),
                  "a system height (encumbrance) of 0.012 m at x = 0 m"));
  EXPECT_TRUE(has(checked(bare_strings + "Catenary/Contact wire: Stagger = -30\n"),
                  "a stagger of -30 m at x = 0 m is above 2 m"));
  EXPECT_TRUE(has(checked(bare_strings + "Catenary/Messenger wire: Stagger = 0.2, 2.1\n"),
                  "a stagger of 2.1 m at x = 40 m is above 2 m"));
  EXPECT_TRUE(has(checked(bare_strings + droppers + "0.9, 0.8, 900\n"),
                  "a dropper of 900 m at x = 30 m is longer than the system height of 1.2 m"));
  const File table("line.csv",
                   "span,droppers,lengths,encumbrance\n40,10 20,0.9 1.31,1.1\n,,,1.3\n");
  const std::string log = checked(bare_strings, {"Catenary/Line=" + table.path});
  EXPECT_TRUE(has(log, "a dropper of 1.31 m at x = 20 m is longer than the system height of 1.3 m"))
      << log;
}

// Expected of two strings at rest: how far apart they are, less the length.
TEST(LinesAsBuilt, wires_whose_droppers_are_all_slack_have_a_warning)
{
  const std::string tight = bare_strings + "Catenary/Contact wire: Tension = 30000\n",
                    droppers = "Catenary/Droppers: Positions = 10, 20, 30; Lengths = ";
  const double gap = 1.18 - (1.2 - sag(20., 40., .8 * g, 12000.) + sag(20., 40., g, 30000.));
  const std::string log = checked(tight + droppers + "1.2, 1.18, 1.2\n");
  EXPECT_TRUE(has(log, taut::to_text("Warning: all 3 droppers of wire 'messenger' are slack at the "
                                     "start, 'dropper 1.2' by the least, ",
                                     std::setprecision(4), gap, " m at its length of 1.18 m")))
      << log;
  EXPECT_FALSE(has(log, "droppers of wire 'contact'"));
  EXPECT_FALSE(has(checked(tight + droppers + "1.2, 0.9, 1.2\n"), "are slack at the start"));
  // Of two contact wires one hangs on its dropper no more.
  const std::string both =
      checked(bare_strings + "Catenary: Contact wires = 2; Twin droppers = in turn\n" + droppers +
              "0.9, 1.3, 0.9\n");
  EXPECT_TRUE(has(both, "the only dropper of wire 'twin contact' is slack")) << both;
}

TEST(LinesAsBuilt, entries_beside_a_table_are_said_not_to_be_used)
{
  const File table("line.csv", "span,droppers\n40,10 20\n50,20\n,\n");
  const std::string log = checked(
      bare_strings + "Catenary/Droppers: Positions = 7, 8\nCatenary/Contact wire: Stagger = 0.2\n",
      {"Catenary/Line=" + table.path});
  const std::string beside = " (beside Line = " + table.path + ")";
  EXPECT_FALSE(
      has(checked(bare_strings + "Catenary: Point masses = clamp\nCatenary/Point mass clamp: "
                                 "Positions = 7; Mass = 1\n",
                  {"Catenary/Line=" + table.path}),
          "not used: Catenary/Point mass"));
  for (const std::string entry :
       {"Catenary/Span length = 40", "Catenary/Number of spans = 1",
        "Catenary/Droppers/Positions = 7, 8", "Catenary/Contact wire/Stagger = 0.2"})
    EXPECT_TRUE(has(log, "  not used: " + entry + beside)) << entry << '\n' << log;
  EXPECT_TRUE(has(checked(bare_strings, {"Catenary/Span lengths=40, 50"}),
                  "not used: Catenary/Span length = 40 (beside Span lengths = 40, 50)"));
  EXPECT_FALSE(has(checked(bare_strings), "not used: "));
}

// One value is for the inner masts; where each mast has its own, ends have none.
TEST(LinesAsBuilt, stitch_wires_and_mid_points_at_ends_are_refused)
{
  const auto error = [](const Overrides &overrides)
  { return error_of([&] { Session(bare_strings, overrides); }); };
  const std::string spans = "Catenary/Span lengths=40, 50";
  EXPECT_TRUE(has(error({spans, "Catenary/Stitch lengths=12, 16, 0"}),
                  "12 m at the end of the line at x = 0 m, where there is none; give 0 there"));
  EXPECT_TRUE(has(error({spans, "Catenary/Mid-points=0, 0, 9", "Catenary/Begin=10"}),
                  "9 m at the end of the line at x = 100 m"));
  for (const std::string column : {"stitch length", "mid-point"})
  {
    const File table("line.csv", "span,droppers," + column + "\n40,10 20,\n50,20,0\n,,14\n");
    EXPECT_TRUE(
        has(error({"Catenary/Line=" + table.path}), "14 m at the end of the line at x = 90 m"))
        << column;
  }
}

TEST(LinesAsBuilt, droppers_hold_the_contact_wire_at_the_heights_of_the_masts)
{
  const std::vector<double> spans = {40., 55., 48., 60.}, heights = {0., 0., 0.1, 0.3, 0.3},
                            encumbrances = {1.2, 1.3, 1.1, 1.2, 1.4};
  double mast = 0.;
  run_scene(bare_strings,
            {"Catenary/Span lengths=40, 55, 48, 60", "Catenary/Heights=0, 0, 0.1, 0.3, 0.3",
             "Catenary/Encumbrance=1.2, 1.3, 1.1, 1.2, 1.4",
             "Catenary/Droppers/Positions are=relative",
             "Catenary/Droppers/Positions=0.1, 0.3, 0.5, 0.7, 0.9",
             "Catenary/Droppers/Pre-sag=0, 0.01, 0.02, 0.01, 0"},
            [&](const taut::StepView &view)
            {
              const double sags[] = {0., .01, .02, .01, 0.};
              double begin = 0.;
              for (std::size_t span = 0; span < spans.size(); ++span)
              {
                const double low = heights[span], high = heights[span + 1];
                for (int i = 0; i < 5; ++i)
                {
                  const double x = begin + spans[span] * (.1 + .2 * i),
                               y = displacement(view, 1, x) + sags[i];
                  EXPECT_GE(y, std::min(low, high) - 1e-9); // a level span is level
                  EXPECT_LE(y, std::max(low, high) + 1e-9);
                }
                begin += spans[span];
              }
              for (std::size_t i = 0; i < heights.size(); ++i)
              {
                EXPECT_NEAR(1.2 + displacement(view, 0, mast), heights[i] + encumbrances[i], 1e-12);
                if (i < spans.size())
                  mast += spans[i];
              }
              EXPECT_NEAR(displacement(view, 1, mast), .3, 1e-12);
              for (const double force : view.state.multiplier)
                EXPECT_GT(force, 0.);
            });
  EXPECT_EQ(mast, 203.);
}

TEST(LinesAsBuilt, point_masses_hang_at_their_places)
{
  const double T = 10000., m = 3.;
  run_scene(bare_strings + "Catenary: Point masses = insulator; Begin = 100\n"
                           "Catenary/Point mass insulator: Positions = 115; Mass = 3\n",
            {},
            [&](const taut::StepView &view)
            {
              for (const double x : {5., 15., 30.})
                EXPECT_NEAR(displacement(view, 1, x), -sag(x, 40., g, T, {{15., m * g}}), 1e-10);
            });
  const std::string mass = "Catenary: Point masses = insulator; Begin = 100\n"
                           "Catenary/Point mass insulator: Mass = 3; Positions = ";
  EXPECT_TRUE(has(error_of([&] { Session(bare_strings + mass + "15\n"); }),
                  "no wire 'contact' is at 15 m; the line is from 100 to 140 m"));
}

TEST(LinesAsBuilt, stitch_wires_take_their_tension_from_the_messenger)
{
  // Two spans of 50 m. The stitch wire of 16 m, whose clamps are at 42 and 58 m, carries two
  // droppers at 45 and 55 m, which carry the contact wire alone.
  const double T = 12000., S = 3000., w = .8 * g, own = .3 * g;
  int n_seen = 0;
  run_scene(bare_strings +
                "Catenary: Span lengths = 50, 50; Stitch lengths = 16\n"
                "Catenary/Stitch wires: Model = string; Mass per length = 0.3; Tension = 3000\n"
                "Catenary/Droppers: Positions = 45; 5\n",
            {},
            [&](const taut::StepView &view)
            {
              ++n_seen;
              const std::size_t contact = 1, stitch = 2;
              ASSERT_EQ(view.scene.links.size(), 4u); // two clamps, two droppers
              const double force = view.state.multiplier[2];
              EXPECT_NEAR(view.state.multiplier[3], force, 1e-9);
              EXPECT_NEAR(displacement(view, contact, 45.), 0., 1e-9);
              // The chord of the contact wire between droppers and end.
              EXPECT_NEAR(force, g * .5 * (45. + 10.), 1e-6);
              const double end = displacement(view, stitch, 0.);
              EXPECT_NEAR(end, displacement(view, 0, 42.), 1e-12);
              for (const double x : {2., 3., 8., 12.})
                EXPECT_NEAR(displacement(view, stitch, x),
                            end - sag(x, 16., own, S, {{3., force}, {13., force}}), 1e-9);
              // Equilibrium of the messenger's clamp: slopes of the parabolas before and behind it.
              const double at = displacement(view, 0, 42.), before = at / 42. + w * 42. / (2. * T),
                           behind = -at / 8. - w * 8. / (2. * (T - S));
              EXPECT_NEAR(T * before - (T - S) * behind, -(own * 8. + force), 1e-6);
            });
  EXPECT_EQ(n_seen, 1);
}

TEST(LinesAsBuilt, a_hinged_arm_moves_as_a_stiff_beam_on_a_hinge)
{
  // The contact wire of two spans swings down from the start under its weight, with an arm at its
  // middle: as a lever, and as a beam of 1.2 m with a third of a metre to each element.
  const std::string start = "Start = undeformed\nTime: End = 0.4; Scheme = generalised-alpha\n";
  const std::string lever = bare_strings + start +
                            "Catenary: Number of spans = 2\n"
                            "Catenary/Supports: Arm kind = hinged; Arm mass = 6\n";
  const std::string beam = start + R"(Generator = network
Wire contact: To = 80, 0; Components = string; Mass per length = 1; Tension = 10000; Element size = 1;
  Mass damping = 0.0125; Stiffness damping = 1e-4
Wire arm: From = 40, 0, 1.2; To = 40, 0, 0; Components = beam; Mass per length = 5; Bending stiffness = 1e7; Element size = 0.3
Support ends: Wire = contact; Positions = 0, 80
Support hinge: Wire = arm; Positions = 0
Link clamp: Type = joint; From = arm @ 1.2; To = contact @ 40; Direction = 0, 1
Time: Step = 1e-3
)";
  const auto middle = [](const std::size_t wire)
  { return [wire](const taut::StepView &view) { return displacement(view, wire, 40.); }; };
  const std::vector<double> of_lever = history_of(lever, {}, middle(1)),
                            of_beam = history_of(beam, {}, middle(0));
  EXPECT_GT(largest(of_lever), .1);
  EXPECT_LE(largest_difference(of_lever, of_beam), 1e-4 * largest(of_lever));
}

TEST(LinesAsBuilt, messenger_supports_have_stiffness_and_damping)
{
  Session session(bare_strings,
                  {"Catenary/Number of spans=3", "Catenary/Supports/Messenger stiffness=4e5",
                   "Catenary/Supports/Messenger damping=300"});
  const taut::Scene scene = session.parameters().scene();
  const auto found = std::find_if(scene.supports.begin(), scene.supports.end(),
                                  [](const taut::Support &support)
                                  { return support.name == "messenger at masts"; });
  ASSERT_NE(found, scene.supports.end());
  EXPECT_EQ(found->stiffness, 4e5);
  EXPECT_EQ(found->damping, 300.);
  EXPECT_TRUE(has(error_of(
                      []
                      {
                        Session(bare_strings, {"Catenary/Number of spans=3",
                                               "Catenary/Supports/Messenger damping=300"});
                      }),
                  "a rigid support has none"));
}

// Claim: springs of supports at other heights than the first carry what hangs on them. Expected:
// the weight.
TEST(LinesAsBuilt, springs_of_supports_at_heights_carry_the_weight)
{
  const Overrides rail = {"Catenary/Kind=conductor rail", "Catenary/Contact wire/Model=beam",
                          "Catenary/Contact wire/Bending stiffness=2e5",
                          "Catenary/Supports/Arm stiffness=1e6"};
  for (const auto &[kind, mass] : {std::pair(Overrides{}, 1.8), {rail, 1.}})
  {
    double sum = 0., largest = 0.;
    run_scene(bare_strings,
              kind + Overrides{"Catenary/Number of spans=3", "Catenary/Heights=0.1, 0.3, -0.1, 0",
                               "Catenary/Supports/Messenger stiffness=2e5"},
              [&](const taut::StepView &view)
              {
                sum = 0.;
                for (const double force : view.supports)
                {
                  sum += force;
                  largest = std::max(largest, std::fabs(force));
                }
              });
    EXPECT_NEAR(sum, mass * 9.81 * 120., 1e-6 * largest);
    EXPECT_LT(largest, 2. * mass * 9.81 * 120.);
  }
  EXPECT_TRUE(has(error_of(
                      []
                      {
                        Session("Generator = network\nNetwork: Wires = w; Supports = s\n"
                                "Network/Wire w: To = 1, 0; Components = string; Tension = 1; "
                                "Mass per length = 1\n"
                                "Network/Support s: Wire = w; Type = elastic; Stiffness = 1; "
                                "Displacement = t\n");
                      }),
                  "is free of force at one place"));
}

// Claim: formulas and tables of a line are of x, wherever it begins. Expected: the line that begins
// at x = 0.
TEST(LinesAsBuilt, formulas_of_a_line_are_of_x_wherever_it_begins)
{
  const auto forces = [](const double begin, const std::string &variable)
  {
    std::string rows = "x,m\n";
    for (int i = 0; i <= 60; ++i)
      rows += number(begin + 10. * i) + "," +
              number(1. - .2 * std::exp(-std::pow(.1 * i - 1., 2))) + "\n";
    const File wear("wear (new).csv", rows);
    const auto at = [&](const double x) { return number(begin + x); };
    return forces_with(
        {"Catenary/Begin=" + at(0.),
         "Catenary/Contact wire/Remaining mass=table(" + wear.path + ", m" + variable + ")",
         "Catenary/Contact wire/Vertical load=-table(" + wear.path + ", m, s)*(s-(" + at(0.) +
             "))/100",
         "Catenary/Pantograph pantograph/Height profile=0.01*exp(-(s-(" + at(62.) + "))^2)",
         "Catenary/Pantograph pantograph/Start=" + at(60.),
         "Catenary/Uplift positions=" + at(240.)});
  };
  const std::vector<double> expected = forces(0., "");
  EXPECT_GT(largest_difference(expected, forces_with({})), .01 * largest(expected));
  for (const double begin : {100., -50.})
    for (const std::string variable : {"", ", s", ", cubic", ", s - 0, cubic"})
    {
      const std::vector<double> other = forces(0., variable), found = forces(begin, variable);
      EXPECT_LT(figure("from " + number(begin) + variable,
                       largest_difference(other, found) / largest(other)),
                1e-7);
    }
}

TEST(LinesAsBuilt, bump_stops_and_lift_of_a_pantograph_act_as_their_formulas)
{
  // Under 300 N and the lift of 180 km/h, 50 m/s, of 0.008 and 0.012 N s^2/m^2. The head's spring
  // of 5 kN/m is stopped at 30 mm by 50 kN/m.
  const double force = 300. + 30., on_head = 20.;
  int n_seen = 0;
  run_scene(bare_strings + R"(Catenary: Pantographs = pantograph; Number of spans = 2
Catenary/Supports: Messenger stiffness = rigid
Pantograph pantograph: Masses = 7, 15; Stiffnesses = 5000, 0; Dampings = 10, 90; Static force = 300; Start = 20;
  Speed = 180; Lift = 0.008, 0.012; Bump stop gaps = 0.03, 0; Bump stop stiffnesses = 5e4, 0
Statistics: Window =
)",
            {},
            [&](const taut::StepView &view)
            {
              ++n_seen;
              ASSERT_EQ(view.scene.links.size(), 2u);
              const double head = displacement(view, point_of_mass(view, 0)),
                           frame = displacement(view, point_of_mass(view, 1)),
                           compression = frame - head;
              EXPECT_NEAR(view.state.multiplier[1], force + on_head, 1e-9);
              EXPECT_NEAR(view.state.multiplier[0], 5e4 * (compression - .03), 1e-9);
              EXPECT_NEAR(5e3 * compression + 5e4 * (compression - .03), force, 1e-9);
            });
  EXPECT_EQ(n_seen, 1);
}

// Claim: a bump stop with a law pushes as its table says. Reference: the table of two straight
// parts, 200 N at 2 mm and 2 kN at 4 mm beyond the gap, solved for the compression under 330 N
// and 1.2 kN.
TEST(LinesAsBuilt, a_bump_stop_follows_its_table)
{
  for (const double force : {330., 1200.})
  {
    int n_seen = 0;
    run_scene(bare_strings + R"(Catenary: Pantographs = pantograph; Number of spans = 2
Pantograph pantograph: Masses = 7, 15, 4; Stiffnesses = 5000, 1e6, 0; Dampings = 10, 90, 0; Start = 20;
  Speed = 0; Bump stop gaps = 0.03, 0, 0; Static force = )" +
                  number(force) + "\nStatistics: Window =\n",
              {"Catenary/Pantograph pantograph/Bump stop laws=0.002: 200, 0.004: 2000; "},
              [&](const taut::StepView &view)
              {
                ++n_seen;
                ASSERT_EQ(view.scene.links.size(), 2u);
                ASSERT_TRUE(has(view.scene.links[0].name, "bump stop 1"));
                const double compression = displacement(view, point_of_mass(view, 1)) -
                                           displacement(view, point_of_mass(view, 0));
                const double expected = 5e3 * .032 + 200. > force
                                            ? (force + .03 * 1e5) / (5e3 + 1e5)
                                            : (force - 200. + .032 * 9e5) / (5e3 + 9e5);
                EXPECT_NEAR(compression, expected, 1e-12);
                EXPECT_NEAR(view.state.multiplier[0], force - 5e3 * expected, 1e-8);
              });
    EXPECT_EQ(n_seen, 1);
  }
}

// Claim: the base motion of a pantograph is that of the roof under its lowest spring. References: a
// roof 10 mm up is a static force of 10 mm times the lowest stiffness, 500 N/m; a motion in time is
// that over the place at a constant speed. What spring and damper make of a motion is the claim of
// Oscillator.mass_on_a_base_that_moves.
TEST(LinesAsBuilt, the_base_of_a_pantograph_is_a_roof_that_moves)
{
  const auto heights = [](const std::string &more)
  {
    std::vector<double> result;
    run_scene(bare_strings + R"(Catenary: Pantographs = pantograph; Number of spans = 3
Catenary/Supports: Messenger stiffness = rigid
Pantograph pantograph: Masses = 7, 15; Stiffnesses = 5000, 500; Dampings = 10, 90;
  Start = 20; Speed = 72; Bump stop gaps = 0.03, 0; Bump stop stiffnesses = 5e4, 0; )" +
                  more + "\nTime: Step = 5e-4; End = 1; Scheme = Newmark\nStatistics: Window =\n",
              {},
              [&](const taut::StepView &view)
              {
                for (const std::size_t mass : {0, 1})
                  result.push_back(displacement(view, point_of_mass(view, mass)));
              });
    return result;
  };
  const std::vector<double> still = heights("Static force = 100"),
                            in_time = heights("Static force = 100; Base motion = "
                                              "0.005*(1 - cos(12*t))"),
                            on_track = heights("Static force = 100; Base motion = "
                                               "0.005*(1 - cos(0.6*(s - 20)))");
  EXPECT_GT(largest_difference(in_time, still), 1e-3);
  EXPECT_LT(largest_difference(in_time, on_track), 1e-11);
  EXPECT_LT(largest_difference(heights("Static force = 100; Base motion = 0.01"),
                               heights("Static force = 105")),
            1e-12);
}

namespace
{
  /// Uplift of the reference line at rest under a pantograph that stands at x [m], over its force.
  double uplift_over_force(const double x, const double force)
  {
    const auto height = [&](const Overrides &overrides)
    {
      return history_of(scene_file("en50318_2002_250"),
                        Overrides{"Time/End=0", "Statistics/Window="} + overrides,
                        [&](const taut::StepView &view) { return displacement(view, 1, x); })
          .front();
    };
    const std::string section = "Catenary/Pantograph pantograph/";
    const auto under = [&](const double f)
    {
      // Hardly held from below, so that the wire carries the whole force.
      return height({section + "Start=" + number(x), section + "Static force=" + number(f),
                     section + "Stiffnesses=4200, 1e-6"});
    };
    return (under(force) - under(0.)) / force;
  }

  taut::ElasticityOfWire elasticity_of_line(const Overrides &overrides,
                                            const std::string &name = "en50318_2002_250")
  {
    Session session(scene_file(name));
    std::ostringstream log;
    taut::Elasticity elasticity(
        scene_file(name),
        Overrides{"Output/Folder=" + session.folder(), "Elasticity/Range=240, 300"} + overrides,
        true, log);
    return elasticity.run().front();
  }
} // namespace

TEST(Elasticity, is_that_of_two_static_states_at_each_place)
{
  for (const double force : {100., 200.})
  {
    const taut::ElasticityOfWire found =
        elasticity_of_line({"Elasticity/Spacing=7.5", "Elasticity/Slackening=true",
                            "Elasticity/Force=" + number(force)});
    ASSERT_EQ(found.x.size(), 9u);
    for (std::size_t i = 0; i < found.x.size(); ++i)
      EXPECT_NEAR(found.elasticity[i], uplift_over_force(found.x[i], force), 1e-7 * 5e-4)
          << found.x[i];
  }
}

// Claim: the folder has what it takes to measure the same again.
TEST(Elasticity, can_be_repeated_from_its_folder)
{
  Session session(scene_file("en50318_2002_250"));
  std::ostringstream log;
  const auto run = [&](const std::string &file, const Overrides &overrides)
  {
    taut::Elasticity elasticity(file, overrides, true, log);
    elasticity.run();
    return file_text(session.folder() + "/elasticity.csv");
  };
  const std::string first = run(scene_file("en50318_2002_250"),
                                {"Output/Folder=" + session.folder(), "Elasticity/Range=240, 250"});
  EXPECT_EQ(run(session.folder() + "/elasticity.prm", {}), first);
}

TEST(Elasticity, of_the_lowest_wire_without_a_pantograph)
{
  const Overrides places = {"Elasticity/Spacing=20"},
                  pantograph = {"Catenary/Pantographs=p", "Catenary/Pantograph p/Masses=7",
                                "Catenary/Pantograph p/Stiffnesses=50",
                                "Catenary/Pantograph p/Dampings=50",
                                "Catenary/Pantograph p/Static force=60"};
  const taut::ElasticityOfWire without = elasticity_of_line(places, "line_55m"),
                               with = elasticity_of_line(places + pantograph, "line_55m");
  EXPECT_EQ(without.x, with.x);
  EXPECT_LE(largest_difference(without.elasticity, with.elasticity), 1e-9 * with.largest());
}

TEST(Elasticity, is_linear_as_long_as_no_dropper_opens)
{
  const taut::ElasticityOfWire linear = elasticity_of_line({"Elasticity/Spacing=20"}),
                               light = elasticity_of_line({"Elasticity/Spacing=20",
                                                           "Elasticity/Slackening=true",
                                                           "Elasticity/Force=1"}),
                               heavy = elasticity_of_line({"Elasticity/Spacing=20",
                                                           "Elasticity/Slackening=true",
                                                           "Elasticity/Force=400"});
  for (std::size_t i = 0; i < linear.x.size(); ++i)
  {
    EXPECT_NEAR(light.elasticity[i], linear.elasticity[i], 1e-5 * linear.elasticity[i]);
    EXPECT_GE(heavy.elasticity[i],
              linear.elasticity[i] * (1. - 1e-9)); // slack droppers hold nothing
  }
  EXPECT_GT(heavy.largest(), 1.002 * linear.largest());
}

TEST(Elasticity, at_midspan_follows_the_rule_of_thumb)
{
  // e = L / (3.5 (T_contact + T_messenger)) for a line with level contact wire.
  const taut::ElasticityOfWire found = elasticity_of_line({"Elasticity/Spacing=3"});
  const double rule = 60. / (3.5 * 36000.), middle = found.elasticity[found.x.size() / 2];
  EXPECT_NEAR(middle, rule, .05 * rule);
  EXPECT_NEAR(found.nonuniformity(),
              (found.largest() - found.smallest()) / (found.largest() + found.smallest()), 1e-15);
}

TEST(LinesAsBuilt, the_table_of_droppers_has_what_a_fitter_needs)
{
  // The contact wire hangs between droppers as a chain of parabolas at one height.
  Session session(bare_strings, {"Catenary/Span lengths=40, 50",
                                 "Catenary/Droppers/Positions=10, 20, 30; 10, 20, 30, 40"});
  session.run();
  const std::string path = session.folder() + "/droppers.csv";
  const auto table = read_table(path);
  EXPECT_EQ(table.at("x [m]"), (std::vector<double>{10., 20., 30., 50., 60., 70., 80.}));
  EXPECT_EQ(table.at("from the support before [m]"),
            (std::vector<double>{10., 20., 30., 10., 20., 30., 40.}));
  const double forces[] = {10., 10., 15., 15., 10., 10., 10.};
  for (std::size_t i = 0; i < 7; ++i)
  {
    EXPECT_NEAR(table.at("static force [N]")[i], g * forces[i], 1e-8) << i;
    EXPECT_NEAR(table.at("height of the lower end [m]")[i], 0., 1e-9);
    const bool is_first = i < 3;
    std::vector<std::pair<double, double>> loads;
    for (std::size_t k = is_first ? 0 : 3; k < (is_first ? 3 : 7); ++k)
      loads.emplace_back(table.at("from the support before [m]")[k], g * forces[k]);
    const double depth = sag(table.at("from the support before [m]")[i], is_first ? 40. : 50.,
                             .8 * g, 12000., loads);
    EXPECT_NEAR(table.at("cut length [m]")[i], 1.2 - depth - g * forces[i] / 1e5, 1e-9) << i;
  }
  EXPECT_TRUE(has(file_text(path), "dropper 2.4,messenger,contact,80,40,"));
}

namespace
{
  const std::string twin = bare_strings + R"(Catenary: Contact wires = 2; Pantographs = pantograph
Catenary/Droppers: Positions = 10, 20, 30
Pantograph pantograph: Masses = 7, 15; Stiffnesses = 5000, 0; Dampings = 10, 90; Static force = 200; Start = 25; Speed = 36
Statistics: Window =
)";

  /// Names and forces of the links at rest.
  std::map<std::string, double> forces_at_rest(const std::string &lines)
  {
    std::map<std::string, double> forces;
    run_scene(lines, {},
              [&](const taut::StepView &view)
              {
                for (std::size_t i = 0; i < view.scene.links.size(); ++i)
                  forces[view.scene.links[i].name] = view.state.multiplier[i];
              });
    return forces;
  }
} // namespace

TEST(LinesAsBuilt, twin_contact_wires_share_pantograph_and_messenger)
{
  const std::string without = "Pantograph pantograph: -\nCatenary: Pantographs =\n";
  const auto both = forces_at_rest(twin), alone = forces_at_rest(twin + without);
  EXPECT_NEAR(both.at("pantograph on contact"), 100., 1e-9);
  EXPECT_NEAR(both.at("pantograph on twin contact"), 100., 1e-9);
  EXPECT_NEAR(alone.at("dropper 1.2"), 10. * g, 1e-9);
  EXPECT_NEAR(alone.at("twin dropper 1.2"), 10. * g, 1e-9);

  // In turn: the first wire hangs at 10 and 30 m, its twin at 20 m.
  const auto in_turn = forces_at_rest(twin + without + "Catenary: Twin droppers = in turn\n");
  EXPECT_EQ(in_turn.size(), 3u);
  EXPECT_NEAR(in_turn.at("dropper 1.1"), 15. * g, 1e-9);
  EXPECT_NEAR(in_turn.at("twin dropper 1.2"), 20. * g, 1e-9);
}

TEST(LinesAsBuilt, constants_of_waves_are_their_formulas)
{
  Session session(scene_file("en50318_2002_250"));
  const auto found = taut::line_constants(session.parameters().scene());
  ASSERT_EQ(found.size(), 1u);
  const double c = std::sqrt(20000. / 1.35), v = 250. / 3.6;
  EXPECT_NEAR(found[0].wave_speed, c, 1e-12 * c);
  EXPECT_NEAR(found[0].doppler, (c - v) / (c + v), 1e-14);
  const double above = std::sqrt(16000. * 1.07), below = std::sqrt(20000. * 1.35);
  EXPECT_NEAR(found[0].reflection, above / (above + below), 1e-14);
  EXPECT_NEAR(found[0].amplification * found[0].doppler, found[0].reflection, 1e-14);
}

TEST(LinesAsBuilt, two_strips_on_a_head_that_pitches_share_as_its_equilibrium_says)
{
  // A string without weight under forces N at x: u = G N with the flexibilities G of the string.
  // The head rises by y and pitches by r: strips at y -+ r d / 2 touch with a stiffness.
  const double T = 10000., L = 40., d = 2., k = 4e3, contact = 1e5, force = 150., x = 9.;
  int n_seen = 0;
  run_scene(bare_strings + R"(Gravity = 0, 0
Catenary: Pantographs = pantograph
Pantograph pantograph: Masses = 7, 15; Stiffnesses = 5000, 0; Dampings = 10, 90; Static force = 150; Start = 9; Speed = 0;
  Strip distance = 2; Head inertia = 0.5; Pitch stiffness = 4000; Contact stiffness = 1e5
Statistics: Window =
)",
            {},
            [&](const taut::StepView &view)
            {
              ++n_seen;
              ASSERT_EQ(view.scene.links.size(), 2u);
              EXPECT_EQ(view.scene.links[0].strip, "pantograph");
              const double N1 = view.state.multiplier[0], N2 = view.state.multiplier[1];
              EXPECT_NEAR(N1 + N2, force, 1e-9);
              const double a = x - .5 * d, b = x + .5 * d;
              const auto G = [&](const double p, const double q)
              { return std::min(p, q) * (L - std::max(p, q)) / (L * T); };
              const double u1 = G(a, a) * N1 + G(a, b) * N2, u2 = G(a, b) * N1 + G(b, b) * N2;
              EXPECT_NEAR(displacement(view, 1, a), u1, 1e-12);
              // Strips are N / contact above the wire; the wire pushes them down.
              const double pitch = ((u2 + N2 / contact) - (u1 + N1 / contact)) / d;
              EXPECT_NEAR(k * pitch, .5 * d * (N1 - N2), 1e-9);
              EXPECT_GT(N1, N2 + 1.); // the wire is stiffer towards its end
            });
  EXPECT_EQ(n_seen, 1);
}
