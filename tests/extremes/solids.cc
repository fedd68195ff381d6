// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: solids in contact are right, or end in one error with its reason, whatever their numbers:
// cells of an aspect ratio of 1e4, moduli 1e12 apart, Poisson's ratio of 0.4999, overlaps of 1e-8
// of a cell, contacts open, closed, by turns, grazing, statics and steps of 1e-6 to 1e6 times the
// time of a wave through a cell. Source: a copy of each scene in 120 digits, a twin in other units.
#include "levels.h"
#include "solid_case.h"
#include "tally.h"

using namespace extremes;

namespace
{
  Tally tally;
  std::map<std::string, unsigned int> chosen; ///< schemes, by `automatic`

  const std::vector<Dimension> dimensions = {
      {"dim", {2, 3}},
      {"cells", {0, 1, 2}},                   // one; 4 x 2; 8 x 1
      {"aspect ratio", {1., 1e2, 1e4, 1e-4}}, // of all cells up to 1e2; beyond of a layer of cells
      {"ratio of moduli",
       {1., 1e3, 1e-6, 1e-12}}, // of the right half to the left one, which is held
      {"Poisson's ratio", {0., .3, .4999, -.9}},
      {"touching", {0, 1, 2, 3, 4}}, // plane, mortar, overlaps of 1e-3 and 1e-8 cells, nodes
      {"state", {0, 1, 2, 3}},       // open, closed, grazing, by turns
      {"strain of the load", {1e-12, 1e-6, 1.}},
      {"compliance", {0., 1e-9, 1.}},
      {"start", {0, 1, 2}},
      {"step", {1e-6, 1e-2, 1., 1e3, 1e6}}, // over the time of a wave through a cell
      {"scheme", {0, 1, 2, 3, 4}},
      {"held", {1, 0}},
      {"mass", {0, 1, 2}},
      {"length", {1e-6, 1., 1e6}},
      {"modulus", {1e-3, 2e11}},
      {"plane stress", {0, 1}},
      {"solver", {0, 1, 2, 3}},
      {"units", {0, 1, 2}}};

  SolidCase make(const Levels &level)
  {
    SolidCase c;
    c.name = level.name();
    c.dim = static_cast<unsigned int>(level["dim"]);
    const int cells = static_cast<int>(level["cells"]);
    c.upper.n = cells == 0   ? std::array<unsigned int, 3>{1, 1, 1}
                : cells == 1 ? std::array<unsigned int, 3>{c.dim == 2 ? 4u : 2u, 2, 1}
                             : std::array<unsigned int, 3>{c.dim == 2 ? 8u : 3u, 1, 1};
    const double cell = level["length"];
    const double aspect =
        cells > 0 ? level["aspect ratio"] : std::clamp(level["aspect ratio"], 1e-2, 1e2);
    const bool is_layered = cells > 0 && aspect != 1. && aspect != 1e2;
    c.upper.size = {cell * (is_layered ? 1. : aspect) * c.upper.n[0], cell * c.upper.n[1], cell};
    // Thin cells at the contact or the held side; a rod that slender is lost in rounding.
    if (is_layered && aspect > 1.)
      c.upper.first[1] = 1. / aspect / c.upper.n[1];
    else if (is_layered)
      c.upper.first[0] = aspect / c.upper.n[0];
    c.lower = c.upper;
    c.lower.n[0] = c.upper.n[0] + (cells > 0);
    c.lower.from[1] = -c.lower.size[1];
    const int touching = static_cast<int>(level["touching"]);
    c.touching = touching == 0                ? Touching::plane
                 : touching < 4 && c.dim == 2 ? Touching::mortar
                                              : Touching::nodes_to_faces;
    // In space nodes of an overhanging slave have no face: a sliver is none there.
    if (c.dim == 2 && (touching == 2 || touching == 3))
      c.lower.from[0] = c.upper.size[0] * (1. - (touching == 2 ? 1e-3 : 1e-8) / c.upper.n[0]);
    const int state = static_cast<int>(level["state"]);
    c.held = level["held"] == 1. || state == 2 || c.lower.from[0] != 0.;
    c.E[0] = level["modulus"];
    c.E[1] = c.E[0] * level["ratio of moduli"];
    c.nu[0] = level["Poisson's ratio"];
    c.density[0] = c.density[1] = 1e3;
    c.plane_stress = level["plane stress"] == 1.;
    const char *const masses[] = {"consistent", "lumped", "reduced"};
    c.mass = masses[static_cast<int>(level["mass"])];
    c.thickness = cell;
    const double strain = level["strain of the load"], closing = strain * c.upper.size[1];
    c.load = state == 2 ? 0. : c.E[0] * strain;
    c.pull = state == 2 ? c.E[0] * strain : 0.;
    c.slope = state == 3 ? 1.4 : 0.;
    c.gap = state == 0 ? 2. * closing : 0.;
    c.compliance = level["compliance"] * c.upper.size[1] / c.E[0];
    const double wave = cell / std::sqrt(c.E[0] / c.density[0]);
    // The reduced mass does not resist all motions, and the stiffness is lost beside it below that.
    c.step = c.mass == "reduced" ? std::max(level["step"], 1.) * wave /
                                       std::sqrt(std::min(1., level["ratio of moduli"]))
                                 : level["step"] * wave;
    c.growth = .5 / c.step;
    const char *const starts[] = {"equilibrium", "undeformed", "given"};
    c.start = starts[static_cast<int>(level["start"])];
    c.velocity = strain * cell / wave;
    const char *const schemes[] = {"backward Euler", "BDF2", "generalised-alpha", "Moreau-Jean",
                                   "automatic"};
    c.scheme = schemes[static_cast<int>(level["scheme"])];
    // Projections of velocities need a mass matrix that can be inverted.
    if (c.scheme == "Moreau-Jean" && c.mass == "reduced")
      c.scheme = "automatic";
    const int solver = static_cast<int>(level["solver"]);
    if (solver == 1)
      c.interface_operator = "matrix-free";
    if (solver == 2)
      c.interface_operator = "assembled sparse";
    if (solver == 3)
      c.complementarity = "energy-ordered";
    return c;
  }

  /// Each of its rows moves both sides alike, and the rows have the area that touches.
  void check_rows(const SolidCase &c, const ContactRows &rows)
  {
    double area = 0.;
    for (const taut::SurfaceConstraint &row : rows.rows)
    {
      double slave = 0., master = 0.;
      for (const taut::NodeWeight &w : row.slave)
        slave += w.weight.y;
      for (const taut::NodeWeight &w : row.master)
        master += w.weight.y;
      EXPECT_NEAR(slave, 1., 1e-12);
      EXPECT_NEAR(master, c.touching == Touching::plane ? 0. : -1., 1e-12);
      EXPECT_GT(row.area, 0.);
      area += row.area;
    }
    if (c.touching == Touching::nodes_to_faces)
      return; // a node beside the end of the master counts with all of its area
    const double length = c.touching == Touching::plane
                              ? c.upper.size[0]
                              : c.upper.from[0] + c.upper.size[0] - c.lower.from[0];
    const double exact = length * (c.dim == 2 ? c.thickness : c.upper.size[2]);
    EXPECT_NEAR(area / exact, 1., c.lower.from[0] != 0. ? 1e-6 : 1e-12);
  }

  void check(const SolidCase &given, const Units &other)
  {
    SolidCase c = given;
    SCOPED_TRACE(c.name);
    ContactRows rows, rows_of_twin;
    const Answer ours = program_answer(c, rows);
    Answer exact;
    std::vector<Answer> neighbours;
    if (ours.error.empty())
    {
      check_rows(c, rows);
      c.conserving = ours.conserving;
      if (c.scheme == "automatic")
        ++chosen[c.scheme = ours.scheme];
      exact = extended_answer(c, rows);
      neighbours = {extended_answer(in_last_digits(c, 1), rows),
                    extended_answer(in_last_digits(c, 2), rows), extended_answer(c, rows, true)};
    }
    tally.judge("solids", c.name, ours, exact, scales({}, exact), neighbours, other,
                [&] { return program_answer(in_units(given, other), rows_of_twin); });
  }
} // namespace

// What holds a part is lost in the rounding of what is attached to it: no answer, and the reason.
TEST(Solids, that_are_lost_in_rounding_are_refused)
{
  SolidCase stiff_on_soft, reduced, rod;
  stiff_on_soft.upper.n = {4, 2, 1};
  stiff_on_soft.E[1] = 1e12;
  reduced.mass = "reduced";
  reduced.step = 1e-7;
  rod.upper.n = {8, 1, 1};
  rod.upper.size = {1e5, 1., 1.};
  for (SolidCase c : {stiff_on_soft, reduced, rod})
  {
    c.load = 1e-6;
    ContactRows rows;
    const std::string error = program_answer(c, rows).error;
    std::printf("refused | %s\n", error.c_str());
    EXPECT_NE(error.find("is lost in the rounding of its stiffness"), std::string::npos) << error;
    EXPECT_NE(error.find("upper"), std::string::npos) << error;
  }
}

// Too large for a copy: a block under a uniform pressure p is shorter by p (1 - nu^2) / E of its
// height, and each node of its foot carries p times its area.
TEST(Solids, of_one_cell_and_of_10000_are_pressed_alike)
{
  for (const unsigned int n : {1u, 10u, 100u})
  {
    SolidCase c;
    c.upper.n = {n, n, 1};
    c.held = false;
    c.load = 1e-3;
    c.n_steps = 1;
    c.scheme = "generalised-alpha";
    ContactRows rows;
    const Answer answer = program_answer(c, rows);
    ASSERT_EQ(answer.error, "") << n;
    double deviation = 0.;
    const Observation &o = answer.steps.front();
    for (std::size_t i = 0; i < rows.slave_points.size(); ++i)
      deviation = std::fmax(
          deviation, std::fabs(o[displacement][2 * i + 1] + 1e-3 * .91 * rows.slave_points[i].y));
    std::printf("figure | pressed block of %u DoFs, deviation | %.1e m of 9.1e-4 m\n",
                2 * (n + 1) * (n + 1), deviation);
    EXPECT_LT(deviation, 1e-12) << n;
    for (std::size_t k = 0; k < rows.rows.size(); ++k)
      EXPECT_NEAR(o[force][k] / rows.rows[k].area, 1e-3, 1e-12) << n;
  }
}

TEST(Solids, are_right_or_end_in_an_error)
{
  // Millimetres, newtons, tons; millimetres, grams, milliseconds; kilometres, tons, hours.
  const Units units[] = {{1e3, 1e-3, 1.}, {1e3, 1e3, 1e3}, {1e-3, 1e-3, 1. / 3600.}};
  for_each_seed(1,
                [&](const unsigned int seed)
                {
                  cover(dimensions, seed,
                        [&](const Levels &level)
                        {
                          const SolidCase c = make(level);
                          if (is_chosen(c.name))
                            check(c, units[static_cast<int>(level["units"])]);
                        });
                });
  for (const auto &[scheme, n] : chosen)
    std::printf("automatic | %u | %s\n", n, scheme.c_str());
  tally.print();
}
