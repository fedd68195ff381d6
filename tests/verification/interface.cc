// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: each named way to solve for the multipliers gives the answers of the dense one. Sources:
// the dense one; its neighbour where theory says how they differ.
#include "interface_problem.h"
#include "scene_tests.h"

using namespace verification;

namespace
{
  constexpr double statics = 0.;

  taut::Scene catenary(const std::string &n_spans, const Overrides &more = {})
  {
    taut::Parameters parameters;
    parameters.read(scene_file("en50318_2002_250"),
                    Overrides{"Catenary.Number of spans=" + n_spans,
                              "Catenary.Uplift positions=", "Statistics.Window=", "Time.End=0.1"} +
                        more);
    return parameters.scene();
  }

  /// A string fixed at both ends, of bilateral cuts only: what FETI theory is about.
  taut::Scene fixed_string()
  {
    taut::Wire wire;
    wire.name = "string";
    wire.b = {1024., 0.};
    wire.mass_per_length = 1.;
    wire.tension = 1e4;
    wire.transverse = taut::TransverseKind::string;
    wire.degree = 1;
    taut::Scene scene;
    scene.wires = {wire};
    scene.supports.resize(1);
    scene.supports[0].positions = {0., 1024.};
    return scene;
  }

  long iterations(const InterfaceProblem &problem, const double step,
                  const std::string &preconditioner, const std::string &coarse_space)
  {
    const auto solution = problem.solve(step, {"matrix-free", preconditioner, coarse_space}, 1e-9);
    EXPECT_TRUE(solution.is_solved) << preconditioner << ", " << coarse_space << ", " << step;
    return figure("iterations, " + preconditioner + ", " + coarse_space + ", step " +
                      std::to_string(step) + ", " + std::to_string(problem.structure.size()) +
                      " bodies",
                  solution.statistics.n_iterations);
  }
} // namespace

// Claim: all forms, preconditioners and coarse spaces solve the same system. Expected: the dense
// form's multipliers, to 1e-9 of the largest (condition numbers up to 1e6).
TEST(Interface, every_option_gives_the_multipliers_of_the_dense_form)
{
  const InterfaceProblem problem(catenary("6"), 12);
  for (const double step : {1e-3, 1e-1, 10., statics})
  {
    const auto dense = problem.solve(step, {"assembled dense"}, 1e-14);
    ASSERT_TRUE(dense.is_solved);
    EXPECT_EQ(dense.statistics.n_iterations, 0);
    const auto compare = [&](const taut::InterfaceParameters &parameters)
    {
      const auto other = problem.solve(step, parameters, 1e-14);
      EXPECT_TRUE(other.is_solved);
      EXPECT_LT(largest_difference(dense.multiplier, other.multiplier),
                1e-9 * largest(dense.multiplier))
          << other.description << ", step " << step;
      return other;
    };
    EXPECT_EQ(compare({"assembled sparse"}).statistics.n_iterations, 0);
    for (const char *preconditioner : {"diagonal", "Dirichlet"})
      for (const char *coarse_space : {"rigid body modes", "none"})
        EXPECT_GT(compare({"matrix-free", preconditioner, coarse_space}).statistics.n_iterations,
                  0);
  }
}

// Claim: the two preconditioners are two. Expected (Farhat and Roux 1991, Mandel and Tezaur 1996):
// on cuts alone the condition number with Dirichlet does not grow with the elements of a piece; it
// sees the neighbours that the diagonal does not.
TEST(Interface, dirichlet_does_not_feel_the_elements)
{
  // 32.6 m, between two droppers, is a node of both meshes.
  const taut::PartitionParameters cuts = {"given", "1",
                                          "contact @ 32.6:60:340; messenger @ 32.6:60:340"};
  const auto line = [](const std::string &size)
  {
    return catenary("6", {"Catenary/Contact wire/Element size=" + size,
                          "Catenary/Messenger wire/Element size=" + size});
  };
  const InterfaceProblem coarse(line("1.5"), cuts), fine(line("0.1"), cuts);
  ASSERT_EQ(coarse.structure.size(), fine.structure.size());
  const long dirichlet = iterations(coarse, statics, "Dirichlet", "rigid body modes"),
             dirichlet_fine = iterations(fine, statics, "Dirichlet", "rigid body modes"),
             diagonal = iterations(coarse, statics, "diagonal", "rigid body modes");
  EXPECT_LE(dirichlet_fine, dirichlet + 2);
  EXPECT_LT(2 * dirichlet, diagonal);
}

// Claim: with the coarse space the iterations grow neither with the number of pieces nor with the
// step; without it they grow with both. Expected for a string of n pieces at a step in which waves
// cross all of it: information travels one piece an iteration, so n / 2 at least.
TEST(Interface, the_coarse_space_bounds_the_iterations)
{
  const InterfaceProblem few(fixed_string(), 8), many(fixed_string(), 64);
  for (const char *preconditioner : {"diagonal", "Dirichlet"})
  {
    SCOPED_TRACE(preconditioner);
    const long with_few = iterations(few, 100., preconditioner, "rigid body modes"),
               with_many = iterations(many, 100., preconditioner, "rigid body modes"),
               without_few = iterations(few, 100., preconditioner, "none"),
               without_many = iterations(many, 100., preconditioner, "none"),
               with_short_step = iterations(many, 1e-2, preconditioner, "rigid body modes"),
               without_short_step = iterations(many, 1e-2, preconditioner, "none");
    EXPECT_LE(with_many, with_few + 5);
    EXPECT_LE(with_many, 20);
    EXPECT_GE(without_many, 32);
    EXPECT_GE(without_many, 3 * without_few);
    EXPECT_LE(with_many, with_short_step + 15);
    EXPECT_GE(without_many, without_short_step + 20);
  }
}

// Claim: so on a line with droppers, and the count of the best choice is 40 at most. Expected: the
// aim for the interface solve.
TEST(Interface, a_line_takes_forty_iterations_at_most)
{
  for (const unsigned int n : {4, 32, 128})
  {
    const InterfaceProblem problem(catenary("10"), n);
    for (const double step : {1e-3, 1e-1, 10., statics})
      EXPECT_LE(iterations(problem, step, "Dirichlet", "rigid body modes"), 40);
    EXPECT_GT(iterations(problem, 10., "diagonal", "none"), 200);
  }
}

// Claim: 'automatic' is dense for few constraints, sparse for many that act near by only,
// matrix-free for many that all feel each other.
TEST(Interface, automatic_chooses_by_size_and_decay)
{
  const auto chosen = [](const InterfaceProblem &problem, const double step)
  {
    const std::string text = problem.solve(step, {}, 1e-9).description;
    return text.substr(0, text.find(','));
  };
  const InterfaceProblem small(catenary("5"), 1), large(catenary("40"), 2);
  const InterfaceProblem larger(catenary("120"), 2);
  EXPECT_EQ(chosen(small, 1e-3), "assembled dense");
  EXPECT_EQ(chosen(small, statics), "assembled dense");
  EXPECT_EQ(chosen(large, 1e-3), "assembled sparse");
  EXPECT_EQ(chosen(large, statics), "assembled dense"); // below 4e6 numbers beside F
  EXPECT_EQ(chosen(larger, statics), "matrix-free");
  // Short columns, but a rigid body mode for nearly every constraint.
  const InterfaceProblem pieces(fixed_string(), 512);
  EXPECT_EQ(chosen(pieces, 1e-2), "assembled sparse");
  EXPECT_EQ(chosen(pieces, statics), "assembled dense");
}

// Claim: a product costs one solve a body that has constraints, not one a constraint.
TEST(Interface, a_product_solves_each_body_once)
{
  const InterfaceProblem problem(catenary("6"), 12);
  const auto statistics = problem.solve(1e-1, {"matrix-free", "diagonal", "none"}, 1e-9).statistics;
  const double solves = static_cast<double>(statistics.n_local_solves) / statistics.n_applications;
  EXPECT_LE(solves, problem.structure.size());
  EXPECT_GT(solves, .8 * problem.structure.size());
}

TEST(Interface, unknown_names_are_refused)
{
  const InterfaceProblem problem(catenary("5"), 2);
  using Parameters = taut::InterfaceParameters;
  for (const Parameters &unknown :
       {Parameters{"assembled"}, {"matrix-free", "ILU"}, {"matrix-free", "Dirichlet", "all"}})
    EXPECT_THROW(problem.solve(1e-3, unknown, 1e-9), taut::UserError);
}
