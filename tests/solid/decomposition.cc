// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: FETI takes the iterations of an independent program, and parts of solids hang together.
#include "solid/box_in_parts.h"
#include "verification/scene_tests.h"

namespace
{
  using box_in_parts::Box;

  template <int dim>
  double iterations(const Box &box, const double step, const char *preconditioner = "Dirichlet",
                    const char *coarse_space = "rigid body modes")
  {
    const auto solution = box_in_parts::problem<dim>(box)->solve(
        step, {"matrix-free", preconditioner, coarse_space}, 1e-9);
    EXPECT_TRUE(solution.is_solved);
    std::string name = std::to_string(dim) + "-D, " + std::to_string(box.n) +
                       " boxes a side, H/h " + std::to_string(box.elements) +
                       (box.metis_parts > 0        ? ", METIS"
                        : box.stiffness_jump != 1. ? ", jumps"
                                                   : "") +
                       (step > 0. ? ", c tau / h " + std::to_string(step) : ", statics") + ", " +
                       preconditioner + ", " + coarse_space;
    verification::figure(name, solution.statistics.n_iterations);
    return solution.statistics.n_iterations;
  }

  /// Two blocks of 1 m x 0.5 m, the lower one on the ground, the upper one pressed onto it in the
  /// middle and pulled upwards elsewhere, so that its ends rise; each in 4 x 2 boxes of 10 and 8
  /// elements a side, or @p n times as many.
  std::unique_ptr<verification::InterfaceProblem> blocks_in_parts(const unsigned int n)
  {
    const auto block = [](const std::string &name, const unsigned int elements, const double y,
                          const std::string &conditions)
    {
      return "Body " + name +
             ": Type = solid; Young's modulus = 1; Poisson's ratio = 0.3; Density = 1; " +
             conditions + "\nBody " + name +
             "/Mesh: Generator = subdivided_hyper_rectangle; Arguments = " +
             std::to_string(elements) + ", " + std::to_string(elements / 2) + " : 0, " +
             std::to_string(y) + " : 1, " + std::to_string(y + .5) + "\n";
    };
    const verification::Session session(
        R"(Generator = network; Gravity = 0, 0
)" + block("lower", 40 * n, 0., "Fixed boundaries = 2") +
        "\n" +
        block("upper", 32 * n, .5,
              "Symmetry boundaries = 0; Traction = 3: 0, 1e-4 - 1e-3*exp(-((x-0.45)/0.15)^2)") +
        R"(
Contact joint: Slave = upper: 2; Master = lower: 3
)");
    const taut::Scene scene = session.parameters().scene();
    taut::Partition partition = whole(scene);
    partition.n_parts = 16 * n * n;
    partition.bodies.clear();
    for (const unsigned int b : {0u, 1u})
    {
      const taut::CustomBody &body = scene.bodies[b];
      const auto cells = body.type->division({body.name, body.origin, {}});
      const unsigned int n_x = (b == 0 ? 40 : 32) * n, size = b == 0 ? 10 : 8;
      std::vector<unsigned int> part(cells->cells().size());
      for (unsigned int i = 0; i < n_x; ++i)
        for (unsigned int j = 0; j < n_x / 2; ++j)
          part[cells->cell_at({(i + .5) / n_x, .5 * b + (j + .5) / n_x})] =
              (2 * n * b + j / size) * 4 * n + i / size;
      partition.bodies.push_back({cells, part});
    }
    return std::make_unique<verification::InterfaceProblem>(scene, partition);
  }

  /// What may be more than the reference: the norm in which an iteration ends is another.
  constexpr double excess = 1.2;
} // namespace

// Claim: statics takes as many iterations as FETI with Dirichlet preconditioner and chains of
// constraints is known to take, log^2 (H/h). Expected: an independent program for the same boxes.
TEST(Feti, StaticsOfSquaresAndCubes)
{
  const double in_plane[3][4] = {{10., 15., 18., 24.}, {12., 19., 22., 28.}, {13., 22., 28., 32.}};
  for (const int h : {0, 1, 2})
    for (const int n : {0, 1, 2, 3})
      EXPECT_LE(iterations<2>({2u << n, 4u << h}, 0.), excess * in_plane[h][n]);
  EXPECT_LE(iterations<3>({4, 4}, 0.), excess * 31.);
}

// Claim: stiffnesses that jump by 1e3 and 1e6 between neighbours do not slow it down, and parts cut
// by METIS hardly. Expected: the same program, 22 and 17 for cubes with jumps, 30 for METIS.
TEST(Feti, JumpsAndUnevenParts)
{
  EXPECT_LE(iterations<3>({4, 4, 1e3}, 0.), excess * 22.);
  EXPECT_LE(iterations<3>({4, 4, 1e6}, 0.), excess * 17.);
  EXPECT_LE(iterations<2>({8, 8, 1., 64}, 0.), excess * 30.);
  EXPECT_LE(iterations<3>({4, 4, 1., 64}, 0.), excess * 48.);
}

// Claim: with the rigid body modes as coarse space, steps of any size take a bounded number of
// iterations. Expected: the same program, 7, 21, 28 at c tau / h of 1, 10, 100 with 256 squares.
TEST(Feti, StepsOfAnySize)
{
  for (const auto &[step, known] : {std::pair{1., 7.}, {10., 21.}, {100., 28.}, {1e4, 28.}})
    EXPECT_LE(iterations<2>({8, 8}, step), excess * known);
  // Without them it grows: the bound above is theirs.
  EXPECT_GT(iterations<2>({8, 8}, 100., "Dirichlet", "none"), 100.);
}

// Claim: a contact does not slow FETI down: conjugate gradients of the whole search for the active
// set, in which systems are solved roughly as long as the set changes. Expected: an independent
// program for two blocks with mortar constraints between 40 and 32 elements, 39, 61, 74 in all with
// 16, 64 and 256 parts to a relative residual of 1e-9, and 1.3 for another load.
TEST(Feti, ContactsOfTwoBlocks)
{
  const unsigned int n_parts[] = {16, 64, 256}, allowed[] = {39, 61, 74};
  for (const unsigned int refinement : {0u, 1u, 2u})
  {
    const auto contact =
        blocks_in_parts(1u << refinement)
            ->find_contacts({"matrix-free", "Dirichlet", "rigid body modes"}, 1e-9);
    const std::string name =
        "two blocks in contact, " + std::to_string(n_parts[refinement]) + " parts, ";
    verification::figure(name + "iterations", contact.statistics.n_iterations);
    verification::figure(name + "active sets", contact.n_sets);
    verification::figure(name + "closed", contact.n_closed);
    verification::figure(name + "open", contact.n_open);
    EXPECT_GT(contact.n_closed, 8u << refinement);
    EXPECT_GT(contact.n_open, 4u << refinement);
    EXPECT_LE(contact.statistics.n_iterations, 1.3 * allowed[refinement]);
  }
}

// Claim: gradient projections come to the contacts of Newton's method, with more products with F:
// they have no preconditioner. Expected: the same sets of the same blocks.
TEST(Feti, ContactsOfTwoBlocksByProjections)
{
  for (const unsigned int refinement : {0u, 1u})
  {
    const auto blocks = blocks_in_parts(1u << refinement);
    const taut::InterfaceParameters form = {"matrix-free", "Dirichlet", "rigid body modes"};
    const auto newton = blocks->find_contacts(form, 1e-9),
               projections = blocks->find_contacts(form, 1e-9, "MPRGP");
    EXPECT_EQ(projections.n_closed, newton.n_closed);
    EXPECT_GT(projections.statistics.n_applications, newton.statistics.n_applications);
    const std::string name =
        "two blocks in contact, " + std::to_string(blocks->structure.size()) + " parts, products ";
    verification::figure(name + "of Newton's method", newton.statistics.n_applications);
    verification::figure(name + "of MPRGP", projections.statistics.n_applications);
  }
}

// Claim: the diagonal of F at cuts, estimated from sixteen of a part, is that of F but for a factor
// of a few: it bounds what gaps round with, and weighs them against contacts. Expected: products
// with F. The diagonal of A alone is off by 3000.
TEST(Feti, EstimatedFlexibilities)
{
  const auto problem = box_in_parts::problem<2>({2, 32});
  for (const double step : {.1, 10., 1e3})
  {
    taut::FactoredStructure solvers(problem->structure, "block tridiagonal");
    solvers.factor(1. / (step * step), 1. / step);
    const auto schur = taut::make_schur_complement({"matrix-free", "Dirichlet", "rigid body modes"},
                                                   solvers, problem->constraints);
    const std::size_t n = problem->constraints.size();
    schur->setup(std::vector<double>(n, 0.));
    std::vector<double> unit(n, 0.), column;
    double smallest = 1e300, largest = 0.;
    for (std::size_t i = 0; i < n; ++i)
    {
      unit[i] = 1.;
      schur->matrix().apply(unit, column);
      unit[i] = 0.;
      const double ratio = schur->matrix().diagonal(i) / column[i];
      smallest = std::min(smallest, ratio);
      largest = std::max(largest, ratio);
    }
    const std::string name =
        "diagonal of F at cuts over that of products, c tau / h " + std::to_string(step) + ", ";
    verification::figure(name + "smallest", smallest);
    verification::figure(name + "largest", largest);
    EXPECT_GT(smallest, .5);
    EXPECT_LT(largest, 10.);
  }
}

// Claim: every cell is in one part, and the cells of a part hang together by faces, so that no part
// moves like a mechanism. Expected: the definition, on meshes with hanging nodes, too.
TEST(Partition, PartsOfSolidsHangTogether)
{
  for (const unsigned int n_parts : {2u, 7u, 64u, 200u})
  {
    taut::Parameters parameters;
    parameters.read(verification::scene_file("hertz_cylinder"),
                    {"Partition/Number of substructures=" + std::to_string(n_parts)});
    const taut::Partition partition = make_partition(parameters.scene(), parameters.partition);
    const taut::Partition::Division &division = partition.bodies[0];
    const std::size_t n = division.body->cells().size();
    ASSERT_EQ(division.part.size(), n);
    EXPECT_EQ(std::set<unsigned int>(division.part.begin(), division.part.end()).size(), n_parts);
    std::vector<unsigned int> group(n);
    std::iota(group.begin(), group.end(), 0u);
    for (bool has_changed = true; has_changed;)
    {
      has_changed = false;
      for (const auto &[a, b] : division.body->cells().faces)
        if (division.part[a] == division.part[b] && group[a] != group[b])
        {
          group[a] = group[b] = std::min(group[a], group[b]);
          has_changed = true;
        }
    }
    EXPECT_EQ(std::set<unsigned int>(group.begin(), group.end()).size(), n_parts);
    // About equal: METIS with a tolerance, moved cells.
    std::vector<unsigned int> sizes(partition.n_parts, 0);
    for (const unsigned int part : division.part)
      ++sizes[part];
    EXPECT_LT(*std::max_element(sizes.begin(), sizes.end()), 1.3 * n / n_parts + 3.);
  }
}

// Claim: `automatic` cuts solids in space with many DoFs for statics, and nothing else. Expected:
// the table of doc/decomposition.md, where parts are cheaper for up to three solutions.
TEST(Partition, AutomaticNumbersFollowTheTable)
{
  const auto in_space = [](const unsigned int elements)
  {
    const Box box{1, elements};
    return box_in_parts::scene<3>(std::make_shared<const box_in_parts::BoxType<3>>(box));
  };
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(8), 0., false).n, 1u);   // 2187 DoFs
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(15), 0., false).n, 24u); // 12 288 DoFs
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(15), 0., true).n, 1u);
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(33), 0., true).n, 235u); // 117 912 DoFs
  EXPECT_EQ(taut::automatic_number_of_parts(in_space(15), 100., false).n, 1u);
  const auto type = std::make_shared<const box_in_parts::BoxType<2>>(Box{1, 100});
  EXPECT_EQ(taut::automatic_number_of_parts(box_in_parts::scene<2>(type), 0., false).n, 1u);
}
