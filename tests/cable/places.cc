// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what acts at a place on a cable acts there or is refused, and results say where the place
// is in space. Expected values: the same scene written otherwise, closed forms, and the messages.
#include "cable/errors_of_runs.h"

#include "output/scene_report.h"
#include "output/scene_sketch.h"

namespace
{
  using namespace verification;
  using namespace taut;

  /// A span with these items of a network, and with other sections.
  std::string span(const std::string &network, const std::string &top = "")
  {
    return R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body span: Type = cable; From = 0, 0, 0; To = 30, 0, 0; Unstressed length = 31;
  Axial stiffness = 1e6; Mass per length = 1
Time: End = 0; Step = 0.01
)" + top + network;
  }

  std::string load(const std::string &name, const std::string &on, const std::string &magnitude)
  {
    return "Load " + name + ": On = " + on +
           "; Direction = 0.3, -1, 0.5; Magnitude = " + magnitude + "\n";
  }

  std::string link(const std::string &name, const std::string &type, const std::string &from,
                   const std::string &to, const std::string &more = "")
  {
    return "Link " + name + ": Type = " + type + "; From = " + from + "; To = " + to + "; " + more +
           "\n";
  }

  const std::string lamp = "Mass lamp: Position = 30, 0; Motions = x, y, z; Mass = 2\n";

  BodyVectors last(const std::string &scene, const Overrides &overrides)
  {
    BodyVectors U;
    const auto record = [&](const StepView &step)
    {
      U = step.reference.displacement;
      for (std::size_t k = 0; k < U.size(); ++k)
        for (std::size_t i = 0; i < U[k].size(); ++i)
          U[k][i] += step.state.U[k][i];
    };
    run_scene(scene, overrides, record);
    return U;
  }

  std::vector<float> array_in(const std::string &path, const std::string &name)
  {
    const std::string text = file_text(path), mark = "Name=\"" + name + "\"";
    const std::size_t at = text.find(mark), offset = text.find("offset=\"", at) + 8,
                      data = text.find("encoding=\"raw\">\n_") + 17;
    EXPECT_NE(at, std::string::npos) << name;
    const char *const begin = text.data() + data + std::stoul(text.substr(offset));
    std::uint64_t size = 0;
    std::memcpy(&size, begin, sizeof size);
    std::vector<float> values(size / sizeof(float));
    std::memcpy(values.data(), begin + sizeof size, size);
    return values;
  }
} // namespace

TEST(CablePlaces, a_load_knows_its_arc_length)
{
  for (const std::string geometry : {"linearised", "nonlinear"})
    for (const std::string factor : {"2", "(2+t)"})
    {
      // Slack has no small motions.
      const Overrides entries = {"Body span/Geometry=" + geometry,
                                 "Body span/Unstressed length=" +
                                     std::string(geometry == "linearised" ? "29.9" : "31"),
                                 "Time/End=" + std::string(factor == "2" ? "0" : "0.02")};
      const auto last_with = [&](const std::string &loads) { return last(span(loads), entries); };
      const auto formula = last_with(load("a", "span @ 9, 0; 21.5, 0", factor + "*s")),
                 numbers = last_with(load("a", "span @ 9, 0", factor + "*9") +
                                     load("b", "span @ 21.5, 0", factor + "*21.5")),
                 none = last_with(load("a", "span @ 9, 0; 21.5, 0", "0"));
      ASSERT_EQ(formula.size(), 1u);
      EXPECT_LT(largest_difference(numbers[0], formula[0]), 1e-9);
      EXPECT_GT(largest_difference(formula[0], none[0]), 1e-5) << geometry << factor;
    }
}

TEST(CablePlaces, a_load_elsewhere_has_no_arc_length)
{
  const std::string scene = span(lamp + load("a", "lamp", "2*s"));
  expect(error_of(scene), {"Load a/Magnitude", "does not depend on s", "formula in t"});
}

TEST(CablePlaces, what_acts_at_a_held_end_only_is_refused)
{
  const std::string remedy = "Held ends of the cable leave that end free";
  expect(error_of(span(load("a", "span @ 31, 0", "5"))),
         {"Load a/On", "a held end of cable 'span'", "no effect", remedy});
  expect(error_of(span(load("a", "span @ 1e-11, 0", "5"))), {"Load a/On"});
  expect(error_of(span(link("a", "ball joint", "ground", "span @ 0, 0"))),
         {"Link a/To", "a held end of cable 'span'", "does not move either", remedy});
  expect(error_of(span(link("a", "dropper", "span @ 31, 0", "ground @ 30, -3",
                            "Turns = true; Stiffness = 10"))),
         {"Link a/From", "does not move either"});
  expect(error_of(span(link("a", "joint", "span @ 31, 0", "span @ 0, 0", "Direction = 1, 0"))),
         {"Link a/From", "does not move either"});
  EXPECT_EQ(error_of(span(load("a", "span @ 0.01, 0", "5"))), "");
  EXPECT_EQ(error_of(span(load("a", "span @ 31, 0", "5") +
                          link("b", "ball joint", "span @ 31, 0", "ground")),
                     {"Body span/Held ends=from"}),
            "");
}

TEST(CablePlaces, links_that_a_held_end_grounds_are_named)
{
  const std::string scene = span(lamp + link("tie", "ball joint", "span @ 31, 0", "lamp"));
  Session held(scene), free(scene, {"Body span/Held ends=from", "Start=undeformed"});
  held.run();
  free.run();
  expect(held.log(), {"at held ends of cables, which stand like the ground: 'tie x', 'tie y', "
                      "'tie z'\n"});
  EXPECT_FALSE(has(free.log(), "held ends"));
}

TEST(CablePlaces, ball_joints_hold_one_place)
{
  // A thousandth of the cable of 31 m.
  const auto scene = [](const std::string &place)
  {
    return span("Mass lamp: Position = " + place + "; Motions = x, y, z; Mass = 2\n" +
                link("tie", "ball joint", "span @ 31, 0", "lamp") + "\n");
  };
  EXPECT_EQ(error_of(scene("30, 0.03, 0")), "");
  expect(error_of(scene("30, 0, 0.2")), {"Link tie/To", "0.2 m apart", "From is at 30, 0, 0",
                                         "To at 30, 0, 0.2", "to 0.031 m", "joint along each"});
  expect(error_of(scene("30, 0.032, 0")), {"0.032 m apart"});
}

TEST(CablePlaces, ball_joints_of_wires_and_rigid_bodies)
{
  const std::string bar = R"(Body bar: Type = rigid body; Mass = 8; Centre = 1, 0;
  Moments of inertia = 4, 4, 8
Time: End = 0
)";
  const auto pinned = [&](const std::string &to)
  { return error_of(bar + link("pin", "ball joint", "bar @ 0, 0", "ground @ " + to)); };
  EXPECT_EQ(pinned("0, 0.0009"), ""); // a radius of gyration of 1 m
  expect(pinned("0, 0.0011"), {"Link pin/To", "0.0011 m apart", "to 0.001 m"});
  EXPECT_EQ(error_of(bar + link("pin", "ball joint", "bar @ 0, 0", "ground")), "");
  const auto wire = [](const std::string &place)
  {
    return error_of(R"(Time: End = 0
Wire line: To = 10, 0; Components = string, lateral; Mass per length = 1; Tension = 1000
Support ends: Wire = line; Positions = 0, 10
Support aside: Wire = line; Motion = lateral; Positions = 0, 10
Mass lamp: Motions = x, y, z; Mass = 1; Position = )" +
                    place + "\n" + link("tie", "ball joint", "line @ 5", "lamp"));
  };
  EXPECT_EQ(wire("5, 0.009"), "");
  expect(wire("5, 0, 1"), {"Link tie/To", "1 m apart", "From is at 5, 0, 0"});
}

TEST(CablePlaces, places_in_space_are_shown)
{
  const std::string scene = span(
      lamp + load("a", "span @ 15.5, 0", "1") + link("tie", "ball joint", "span @ 31, 0", "lamp") +
          link("rope", "dropper", "lamp", "span @ 15.5, 0", "Turns = true; Length = 40"),
      "Probe p: Point = span @ 15.5, 0\n");
  Session session(scene, {"Body span/From=0, 0, 4", "Body span/To=30, 0, 4",
                          "Network/Mass lamp/Position=30, 0, 4", "Network/Load a/Magnitude=0"});
  const ScenePlaces places =
      places_in_space(session.simulation().scene(), session.simulation().structure());
  const double lowest = places.loads[0].y;
  EXPECT_NEAR(lowest, -3.40, .03); // a catenary without stretch: -3.395
  for (const Coordinates &at : {places.loads[0], places.probes[0], places.links.back().back()})
  {
    EXPECT_NEAR(at.x, 15., 1e-6);
    EXPECT_EQ(at.y, lowest);
    EXPECT_NEAR(at.z, 4., 1e-12);
  }
  ASSERT_EQ(places.cables.size(), 1u);
  EXPECT_NEAR(places.cables[0][16].y, lowest, 1e-9);
  EXPECT_NEAR(places.cables[0].back().x, 30., 1e-9);
  std::ostringstream tables;
  print_scene(session.simulation().scene(), places, tables);
  expect(tables.str(), {"span @ 31 (at 30, 0, 4)", "span @ 15.5 (at 15, -3."});
  EXPECT_FALSE(has(tables.str(), "e-1")) << tables.str();
  write_sketch(session.simulation().scene(), places, session.folder() + ".svg");
  const std::string drawing = file_text(session.folder() + ".svg");
  std::remove((session.folder() + ".svg").c_str());
  expect(drawing, {">span</text>", "cx=\"540\""}); // half of 1000 beside a margin of 40
  EXPECT_FALSE(has(drawing, "nan"));
  EXPECT_FALSE(has(drawing, "e+"));
  session.run();
  const std::string start = file_text(session.folder() + "/start.csv");
  EXPECT_EQ(start.substr(0, 29), "link,x [m],y [m],z [m],force ");
  const auto rope = cells_of(start.substr(start.find("\nrope,") + 6));
  for (const auto &[i, expected] : {std::pair{0, 15.}, {1, lowest}, {2, 4.}})
    EXPECT_NEAR(std::stod(rope.at(i)), expected, 1e-6);
}

// Claim: the sketch of a tall scene fits on a page, with one scale, and guys go to their ground. A
// mast of 40 m with two guys: one to a place 30 m away, one along its direction, 45 degrees.
TEST(CablePlaces, a_sketch_of_a_guyed_mast_fits_on_a_page)
{
  Session session(
      "Generator = network; Gravity = 0, 0; Start = undeformed\n"
      "Body mast: Type = cable; From = 0, 0, 0; To = 0, 40, 0; Unstressed length = "
      "39.99; Axial stiffness = 1e6; Mass per length = 1\n"
      "Link left: Type = dropper; Turns = true; From = ground @ -30, 0; To = mast @ 30, 0\n"
      "Link right: Type = joint; From = ground; To = mast @ 20, 0; Direction = 1, -1; "
      "Stiffness = 10\nTime: End = 0; Step = 0.01\n");
  const ScenePlaces places =
      places_in_space(session.simulation().scene(), session.simulation().structure());
  write_sketch(session.simulation().scene(), places, session.folder() + ".svg");
  const std::string drawing = file_text(session.folder() + ".svg");
  std::remove((session.folder() + ".svg").c_str());
  // 50 x 40 m on 700 pixels of height: 17.5 pixels a metre, margins of 40.
  expect(drawing, {"height=\"780\"", "heights x 1<", "M40 740 l-5 8 h10 z", "M915.0"});
}

// Claim: solids are drawn by their surface, rigid bodies by the places of their links. A square of
// 1 m with 4 edges, on a rigid arm of 1 m.
TEST(CablePlaces, a_sketch_of_bodies_shows_their_outlines)
{
  Session session(
      "Generator = network; Gravity = 0, 0; Start = undeformed\n"
      "Body square: Type = solid; Young's modulus = 1e9; Density = 1000\n"
      "Body square/Mesh: Generator = subdivided_hyper_rectangle; Arguments = 1, 1 : 0, 1 : 1, 2\n"
      "Body arm: Type = rigid body; Mass = 1; Centre = 0.5, 0.5; "
      "Moments of inertia = 1, 1, 1\n"
      "Link foot: Type = joint; From = ground; To = arm @ 0, 0; Direction = 0, 1\n"
      "Link top: Type = joint; From = arm @ 0, 1; To = square @ 0, 1; "
      "Direction = 0, 1\nTime: End = 0; Step = 0.01\n");
  const ScenePlaces places =
      places_in_space(session.simulation().scene(), session.simulation().structure());
  write_sketch(session.simulation().scene(), places, session.folder() + ".svg");
  const std::string drawing = file_text(session.folder() + ".svg");
  std::remove((session.folder() + ".svg").c_str());
  // 1 x 2 m on 700 pixels of height: 350 pixels a metre.
  const std::string stroke = "stroke=\"black\"/>";
  std::size_t n = 0;
  for (std::size_t at = drawing.find(stroke); at != std::string::npos;
       at = drawing.find(stroke, at + 1))
    ++n;
  EXPECT_EQ(n, 5u) << drawing;
  expect(drawing, {"x1=\"40\" y1=\"740\" x2=\"40\" y2=\"390\"",
                   "x1=\"40\" y1=\"40\" x2=\"390\" y2=\"40\"", ">square</text>", ">arm</text>"});
}

TEST(CablePlaces, contacts_are_drawn_where_the_cable_is)
{
  const std::string scene =
      span("", "Contact floor: Slave = span; Obstacle = plane; Point = 0, -0.5\n");
  Session session(scene, {"Body span/To=10, 0, 0", "Body span/Unstressed length=10.2",
                          "Body span/Axial stiffness=1e5", "Output/Field interval=1"});
  session.run();
  // A line has a force per length on a part of its length.
  const std::string table = file_text(session.folder() + "/contact_floor.csv");
  expect(table.substr(0, table.find('\n')), {",length [m],largest force per length [N/m],"});
  const std::string file = session.folder() + "/fields/contact_floor_00000.vtu";
  const std::vector<float> places = array_in(file, "positions"),
                           displacement = array_in(file, "displacement"),
                           gap = array_in(file, "gap");
  ASSERT_EQ(places.size(), 3 * gap.size());
  ASSERT_EQ(displacement.size(), places.size());
  double lifted = 0.;
  for (std::size_t i = 0; i < gap.size(); ++i)
  {
    EXPECT_NEAR(places[3 * i + 1] + displacement[3 * i + 1] + .5, gap[i], 1e-6);
    lifted = std::max<double>(lifted, displacement[3 * i + 1]);
  }
  EXPECT_NEAR(lifted, .88 - .5, .03); // from its own sag
}

TEST(CablePlaces, strain_is_checked_under_the_loads_of_the_start)
{
  // Of a straight cable with EA = 1 MN, linear, half of the force is added to 3.7 kN in one
  // half. The other half goes slack at 7 kN and has some 0.2 kN left.
  for (const auto &[geometry, enough, too_much] :
       {std::tuple<std::string, const char *, const char *>{"linear", "32e3", "34e3"},
        {"nonlinear", "19e3", "20.5e3"}})
  {
    const auto stretched =
        [&geometry = geometry](const std::string &force, const std::string &limit)
    {
      return error_of(span(load("a", "span @ 14.95, 0", force)),
                      {"Body span/Element=bar", "Body span/Unstressed length=29.9",
                       "Body span/Geometry=" + geometry, "Network/Load a/Direction=1, 0",
                       "Body span/Largest strain=" + limit});
    };
    EXPECT_EQ(stretched(enough, "0.02"), "") << geometry;
    expect(stretched(too_much, "0.02"), {"Body span/Largest strain", "at rest", "more than 0.02"});
    EXPECT_EQ(stretched(too_much, "0.021"), "") << geometry;
  }
}

TEST(CablePlaces, entries_without_effect_are_named)
{
  expect(error_of(span(""), {"Body span/Held ends=none", "Body span/Clamped=true"}),
         {"Body span/Clamped", "Held ends = none", "set it to false"});
  expect(error_of(span(load("a", "span @ 15, 0", "1")), {"Network/Load a/Speed=3"}),
         {"Load a/Speed", "Type = moving"});
  const std::string floor = "Contact floor: Slave = span; Obstacle = plane; Point = 0, -10\n";
  expect(error_of(span("", floor), {"Contact floor/Encloses body=true"}),
         {"Contact floor/Encloses body", "cylinder or a sphere", "Direction"});
  Session said(span(lamp, floor),
               {"Contact floor/Radius=2", "Contact floor/Height=0.1*x", "Start=undeformed",
                "Network/Mass lamp/Initial velocity=0, 0, 0, 1", "Body span/Start direction=1, 0",
                "Body span/Held ends=from"}),
      silent(span(lamp, floor), {"Contact floor/Radius=1.0", "Start=given",
                                 "Network/Mass lamp/Initial velocity=0, 0, 0, 1",
                                 "Body span/Held ends=from", "Body span/Start direction=1, 0"});
  said.run();
  silent.run();
  for (const char *const entry :
       {"Contact floor/Radius = 2 (with Obstacle = plane)",
        "Contact floor/Height = 0.1*x (with Obstacle = plane)",
        "Network/Mass lamp/Initial velocity = 0, 0, 0, 1 (without Start = given)",
        "Body span/Start direction = 1, 0 (without Start = given)"})
  {
    expect(said.log(), {std::string("not used: ") + entry + "\n"});
    expect(file_text(said.folder() + "/used.prm"), {std::string("Not used: ") + entry});
  }
  EXPECT_FALSE(has(silent.log(), "not used")) << silent.log();
}

// Claim: wires that differ in a number have one label, and masses at one place hang below each
// other, 16 pixels apart.
TEST(CablePlaces, a_sketch_of_a_line_names_families_once_and_draws_chains_of_masses)
{
  Session session("Generator = network; Gravity = 0, 0; Start = undeformed\n"
                  "Network: Wires = w 1, w 2, w 3; Masses = head, frame\n"
                  "Wire w 1: To = 10, 0; Components = string; Tension = 1e3; Mass per length = 1\n"
                  "Wire w 2: From = 10, 0; To = 20, 0; Components = string; Tension = 1e3; "
                  "Mass per length = 1\n"
                  "Wire w 3: From = 20, 0; To = 30, 0; Components = string; Tension = 1e3; "
                  "Mass per length = 1\n"
                  "Mass head: Position = 5, -1; Mass = 1\n"
                  "Mass frame: Position = 5, -1; Mass = 1\n"
                  "Time: End = 0; Step = 0.01\n");
  const ScenePlaces places =
      places_in_space(session.simulation().scene(), session.simulation().structure());
  write_sketch(session.simulation().scene(), places, session.folder() + ".svg");
  const std::string drawing = file_text(session.folder() + ".svg");
  std::remove((session.folder() + ".svg").c_str());
  expect(drawing, {">w 1 to 3</text>", ">head</text>", ">frame</text>"});
  EXPECT_FALSE(has(drawing, ">w 2"));
  // 30 x 1 m on 1000 pixels of width; the height is 120 pixels at least, and 16 for the chain.
  expect(drawing, {"height=\"216\"", "cy=\"160\" r=\"5\"", "cy=\"176\" r=\"5\""});
}
