// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: answers do not depend on the number of ranks and parts. Source: the run of one process
// without cuts.
#include "nodes.h"

#include <taut/substructure/factored_structure.h>

#include <regex>

using namespace verification;

namespace
{
  taut::Communicator world()
  {
    return taut::Communicator(MPI_COMM_WORLD);
  }

  /// What must not depend on ranks and parts, at rest or in motion: of the links and of points
  /// along the wires.
  struct Record
  {
    std::vector<double> force, gap, displacement;
    bool is_distributed = false; ///< its links
  };
  struct Records
  {
    Record rest, motion; ///< displacements of the motion count from the rest
  };

  /// Displacements of points along the wires, summed over the ranks [m].
  void add_displacements(const taut::StepView &view, const taut::BodyVectors &U,
                         std::vector<double> &result)
  {
    std::vector<double> shares;
    for (std::size_t w = 0; w < view.scene.wires.size(); ++w)
      for (unsigned int i = 0; i <= 200; ++i)
        shares.push_back(
            evaluate(point_on_wire(view, w, view.scene.wires[w].length() * i / 200), U));
    view.structure.communicator().sum(shares);
    result.insert(result.end(), shares.begin(), shares.end());
  }

  Records record(const std::string &scene, const Overrides &overrides,
                 const taut::Communicator &processes)
  {
    Records result;
    bool is_start = true;
    Session session(scene, overrides, processes);
    session.run(
        [&](const taut::StepView &view)
        {
          Record &now = is_start ? result.rest : result.motion;
          for (const auto &[values, all] : {std::pair(&view.state.multiplier, &now.force),
                                            std::pair(&view.state.distance, &now.gap)})
          {
            const std::vector<double> more =
                view.constraints.of_links(*values, view.scene.links.size());
            all->insert(all->end(), more.begin(), more.end());
          }
          now.is_distributed = view.constraints.shared() != nullptr;
          add_displacements(view, is_start ? view.reference.displacement : view.state.U,
                            now.displacement);
          is_start = false;
        });
    return result;
  }

  /// Links whose state differs although they are clearly open or closed in one of the runs.
  std::size_t n_other_states(const Record &a, const Record &b)
  {
    const double band = 1e-9 * largest(a.force);
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.force.size(); ++i)
      n += (a.force[i] == 0.) != (b.force[i] == 0.) &&
           std::max(std::fabs(a.force[i]), std::fabs(b.force[i])) > band;
    return n;
  }

  /// The railway line of EN 50318 with a number of spans, and with a speed that keeps the contact
  /// on the wire for some steps.
  Overrides line(const unsigned int n_spans, const double step, const unsigned int n_steps,
                 const double element_size)
  {
    const double room = 60. * n_spans - 120., time = step * n_steps,
                 speed = std::min(250., 3.6 * .9 * room / time);
    return {"Catenary/Number of spans=" + std::to_string(n_spans),
            "Catenary/Contact wire/Element size=" + std::to_string(element_size),
            "Catenary/Messenger wire/Element size=" + std::to_string(element_size),
            "Catenary/Pantograph pantograph/Speed=" + std::to_string(speed),
            "Catenary/Uplift positions=120",
            "Statistics/Window=",
            "Time/Step=" + std::to_string(step),
            "Time/End=" + std::to_string(time),
            "Output/Field interval=0"};
  }

  /// Largest eigenvalue of a symmetric positive operator, from below, by the power method.
  double largest_eigenvalue(taut::BodyVectors x,
                            const std::function<void(taut::BodyVectors &)> &apply)
  {
    double value = 0.;
    for (int iteration = 0; iteration < 60; ++iteration)
    {
      double squares = 0.;
      for (const auto &block : x)
        squares += std::inner_product(block.begin(), block.end(), block.begin(), 0.);
      for (auto &block : x)
        for (double &v : block)
          v /= std::sqrt(squares);
      apply(x);
      value = std::sqrt(squares);
    }
    return value;
  }

  /**
   * Condition of A = mass M + damping C + K of the whole scene, with unit diagonal: times the
   * rounding unit, the error that displacements may have.
   */
  double condition(const Overrides &overrides, const double step)
  {
    Session session(scene_file("en50318_2002_250"), overrides);
    const taut::Structure &bodies = session.simulation().structure();
    const double velocity = step > 0. ? 1. / step : 0., mass = velocity * velocity;
    taut::FactoredStructure solvers(bodies, "block tridiagonal");
    solvers.factor(mass, velocity);
    taut::BodyVectors root = bodies.zero(), start = bodies.zero();
    for (std::size_t k = 0; k < bodies.size(); ++k)
    {
      const auto add = [&](const double factor, const taut::SymmetricMatrix &matrix)
      {
        matrix.visit(
            [&](const unsigned int i, const unsigned int j, const double value)
            {
              if (i == j)
                root[k][i] += factor * value;
            });
      };
      add(mass, bodies[k].mass());
      add(velocity, bodies[k].damping());
      add(1., bodies[k].stiffness());
      // Neither smooth nor rough, so that no mode is missed.
      for (std::size_t i = 0; i < start[k].size(); ++i)
      {
        root[k][i] = std::sqrt(root[k][i]);
        start[k][i] = 1. + std::sin(double(i * i));
      }
      for (const taut::ConstrainedDof &constraint : bodies[k].constraints())
        start[k][constraint.dof] = 0.;
    }
    const auto scale = [&](taut::BodyVectors &x, const bool divide)
    {
      for (std::size_t k = 0; k < x.size(); ++k)
        for (std::size_t i = 0; i < x[k].size(); ++i)
          x[k][i] = root[k][i] == 0. ? 0. : divide ? x[k][i] / root[k][i] : x[k][i] * root[k][i];
    };
    const auto apply = [&](taut::BodyVectors &x)
    {
      scale(x, true);
      taut::BodyVectors y = bodies.zero();
      for (std::size_t k = 0; k < x.size(); ++k)
      {
        bodies[k].mass().vmult_add(mass, x[k].data(), y[k].data());
        bodies[k].damping().vmult_add(velocity, x[k].data(), y[k].data());
        bodies[k].stiffness().vmult_add(1., x[k].data(), y[k].data());
        for (const auto &c : bodies[k].constraints())
          y[k][c.dof] = 0.;
      }
      x = std::move(y);
      scale(x, true);
    };
    const auto apply_inverse = [&](taut::BodyVectors &x)
    {
      scale(x, false);
      solvers.solve(x);
      scale(x, false);
    };
    return largest_eigenvalue(start, apply) * largest_eigenvalue(start, apply_inverse);
  }

  /// @p bound is the error that rounding can make, which only steps towards statics come near.
  void expect_same(const std::string &where, const Record &one, const Record &many,
                   const double bound)
  {
    const double tolerance = std::max(1e-9, bound), way = largest(one.displacement);
    EXPECT_LT(
        figure(where + "displacement", relative_difference(one.displacement, many.displacement)),
        tolerance);
    EXPECT_LT(figure(where + "gap",
                     largest_difference(one.gap, many.gap) / std::max(way, largest(one.gap))),
              tolerance);
    EXPECT_LT(figure(where + "force", relative_difference(one.force, many.force)),
              100. * tolerance);
    EXPECT_EQ(n_other_states(one, many), 0u);
    figure(where + "rounding unit times condition", bound);
  }

  const std::string matrix_free = "Solver/Interface operator=matrix-free";

  /// Links live with their bodies where F is matrix-free.
  void expect_same(const std::string &title, const double step, const Overrides &overrides,
                   const std::vector<unsigned int> &numbers, const Overrides &for_cut_runs = {})
  {
    const double unit = std::numeric_limits<double>::epsilon(),
                 static_bound = unit * condition(overrides, 0.),
                 bound = unit * condition(overrides, step);
    const std::string scene = scene_file("en50318_2002_250");
    const Records one = record(scene, overrides, taut::Communicator());
    for (const unsigned int n : numbers)
    {
      const Overrides cut = overrides + for_cut_runs +
                            Overrides{"Partition/Number of substructures=" + std::to_string(n)};
      const std::string where = title + ", " + std::to_string(n) + " parts, " + ranks_and_comma();
      SCOPED_TRACE(where);
      const Records many = record(scene, cut, world());
      EXPECT_EQ(many.motion.is_distributed,
                world().size() > 1 && std::find(cut.begin(), cut.end(), matrix_free) != cut.end());
      expect_same(where + "rest, ", one.rest, many.rest, static_bound);
      expect_same(where + "motion, ", one.motion, many.motion, bound);
    }
  }
} // namespace

// Claim: forces, gaps and displacements do not depend on the number of ranks and parts. Expected:
// the run of one process without cuts, U and gaps to 1e-9 of the largest, forces to 1e-7; at rest
// and for steps so large that this is more, to the rounding unit times the condition of A.
TEST(Ranks, the_reference_line_is_the_same)
{
  expect_same("5 spans, 2 ms", 2e-3, line(5, 2e-3, 200, .75), {1, 7, 64});
}

// Claim: so are probes and forces of supports, each of which one rank knows. Expected: as above.
TEST(Ranks, probes_and_forces_of_supports_are_the_same)
{
  const auto record = [](const unsigned int n_parts, const taut::Communicator &processes)
  {
    std::array<std::vector<double>, 2> result;
    Session session(scene_file("en50318_2002_250"),
                    line(5, 2e-3, 50, .75) +
                        Overrides{"Partition/Number of substructures=" + std::to_string(n_parts)},
                    processes);
    session.run(
        [&](const taut::StepView &view)
        {
          result[0].insert(result[0].end(), view.probes.begin(), view.probes.end());
          result[1].insert(result[1].end(), view.supports.begin(), view.supports.end());
        });
    return result;
  };
  const auto one = record(1, taut::Communicator()), many = record(7, world());
  for (const int i : {0, 1})
  {
    ASSERT_GT(largest(one[i]), 0.);
    EXPECT_LT(figure(ranks_and_comma() + (i == 0 ? "probes" : "forces of supports"),
                     relative_difference(one[i], many[i])),
              i == 0 ? 1e-9 : 1e-7);
  }
}

// Claim: the ranks have equally much to do. Expected: shares of DoFs that differ by less than a
// part, of which there are 64.
TEST(Ranks, degrees_of_freedom_are_shared_evenly)
{
  Session session(scene_file("en50318_2002_250"),
                  line(5, 2e-3, 50, .75) + Overrides{"Partition/Number of substructures=64"},
                  world());
  std::vector<std::size_t> shares;
  world().gather(session.simulation().structure().n_dofs(), shares);
  const double all = std::accumulate(shares.begin(), shares.end(), 0.);
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  // Parts differ in size themselves.
  EXPECT_LT(*most - *least, 1.5 * all / 64);
  figure(ranks_and_comma() + "largest share of the DoFs over the mean",
         *most * shares.size() / all);
}

// Claim: so with each form of the interface operator, whose parts from the bodies are summed over
// the ranks in their own ways. Expected: as above, one process with the dense form.
TEST(Ranks, all_interface_operators_answer_the_same)
{
  for (const std::string form : {"assembled sparse", "matrix-free"})
    expect_same("5 spans, " + form, 1e-1, line(5, 1e-1, 10, .75), {7, 64},
                {"Solver/Interface operator=" + form});
}

// Claim: so where the ranks share the factors of the preconditioner and of the coarse space.
// Expected: as above.
TEST(Ranks, shared_factors_answer_the_same)
{
  expect_same("5 spans, shared factors", 1e-1, line(5, 1e-1, 2, 1.5), {7},
              {"Solver/Interface operator=matrix-free", "Solver/Largest whole factor=0"});
}

// Claim: the springs of links between ranks are in the preconditioner. Expected: the iterations of
// one process with the same parts.
TEST(Ranks, springs_between_ranks_precondition)
{
  const auto iterations = [](const taut::Communicator &processes)
  {
    Session session(scene_file("en50318_2002_250"),
                    line(8, 1e-1, 3, 1.5) + Overrides{"Solver/Interface operator=matrix-free",
                                                      "Partition/Method=wires"},
                    processes);
    session.run();
    static const std::regex said("Conjugate gradients: ([0-9.]+) iterations a system");
    std::smatch found;
    const std::string log = session.log();
    return std::regex_search(log, found, said) ? std::stod(found[1]) : 0.;
  };
  const double one = iterations({}), here = iterations(world());
  if (!world().is_root())
    return;
  EXPECT_GT(one, 0.);
  EXPECT_NEAR(here, one, .1 * one);
}

// Claim: so with steps that the local error chooses, which is the largest of all ranks. Expected:
// as above, the same number of steps.
TEST(Ranks, adaptive_steps_are_the_same)
{
  expect_same("5 spans, adaptive", 2e-3,
              line(5, 2e-3, 100, .75) + Overrides{"Time/Step control=adaptive", "Time/Scheme=BDF2",
                                                  "Time/Adaptive step/Tolerance=1e-5"},
              {7});
}

// Claim: so with a rigid moving contact, whose velocities are projected in every step, with both
// forms of the interface operator. Expected: as above.
TEST(Ranks, gaps_then_velocities_are_the_same)
{
  for (const std::string form : {"assembled dense", "matrix-free"})
    expect_same("5 spans, rigid contact, " + form, 2e-3,
                line(5, 2e-3, 50, .75) +
                    Overrides{"Catenary/Pantograph pantograph/Contact stiffness=rigid",
                              "Time/Scheme=Moreau-Jean"},
                {7}, {"Solver/Interface operator=" + form});
}

// Claim: so with links that follow laws. Expected: as above.
TEST(Ranks, laws_of_links_are_the_same)
{
  const std::string end = "Time/End=0.1";
  for (const std::string form : {"assembled dense", "assembled sparse", "matrix-free"})
  {
    const std::string where = "laws, " + form + ", " + ranks_and_comma();
    const Records one = record(beam_under_laws, {end}, taut::Communicator()),
                  many = record(beam_under_laws,
                                {end, "Partition/Number of substructures=5",
                                 "Solver/Interface operator=" + form},
                                world());
    EXPECT_EQ(many.motion.is_distributed, world().size() > 1 && form == "matrix-free");
    expect_same(where + "rest, ", one.rest, many.rest, 0.);
    expect_same(where + "motion, ", one.motion, many.motion, 0.);
  }
}

// Claim: so at rest, where droppers, and stops with laws, live with their bodies, on ranks without
// a row, too, and by each search for the closed ones. Expected: as above.
TEST(Ranks, links_that_live_with_their_bodies_are_the_same)
{
  const Overrides rest = {"Time/End=0", "Output/Field interval=0"},
                  spans = line(12, 2e-3, 1, .75) + rest,
                  lifted = spans + Overrides{"Catenary/Pantograph pantograph/Static force=900"};
  const std::string reference_line = scene_file("en50318_2002_250");
  const double bound = std::numeric_limits<double>::epsilon() * condition(spans, 0.);
  for (const auto &[scene, overrides, tolerance] :
       {std::tuple(reference_line, spans, bound), std::tuple(reference_line, lifted, bound),
        std::tuple(std::string(beam_under_laws), rest, 0.)})
  {
    const Record one = record(scene, overrides, taut::Communicator()).rest;
    for (const std::string search : {"semismooth Newton", "MPRGP", "energy-ordered"})
      for (const unsigned int n : {1u, 5u, 24u})
      {
        if (search != "semismooth Newton" && n == 24)
          continue; // as with 5
        const std::string where =
            search + " at rest, " + std::to_string(n) + " parts, " + ranks_and_comma();
        SCOPED_TRACE(where);
        const Record many =
            record(scene,
                   overrides + Overrides{"Partition/Number of substructures=" + std::to_string(n),
                                         "Solver/Interface operator=matrix-free",
                                         "Solver/Complementarity=" + search},
                   world())
                .rest;
        EXPECT_EQ(many.is_distributed, world().size() > 1);
        expect_same(where, one, many, tolerance);
      }
  }
}

namespace
{
  /// Two strings, one under the other, that rigid droppers join; the upper one is lifted, and
  /// catches the lower one.
  const std::string caught_string = R"(Gravity = 0, -9.81; Start = equilibrium
Wire upper: From = 0, 1; To = 20, 1; Components = string; Mass per length = 1; Tension = 1e4;
  Element size = 0.5
Wire lower: To = 20, 0; Components = string; Mass per length = 1; Tension = 2e3; Element size = 0.5
Support of upper: Wire = upper; Positions = 0, 20
Support of lower: Wire = lower; Positions = 0, 20
Link dropper: Type = dropper; From = upper @ 2:3:17; To = lower @ 2:3:17; Direction = 0, -1
Load blow: On = lower @ 11; Direction = 0, 1; Magnitude = 400*sin(60*t)
Time: Step = 1e-3; End = 0.15; Scheme = generalised-alpha; Allow unsuitable scheme = true
)";

  struct Measures
  {
    std::vector<double> values;
    std::string worst; ///< name of the constraint with most energy
    std::string steps; ///< what the log says of the error of the steps
  };

  Measures measures_of(const Overrides &overrides, const taut::Communicator &processes)
  {
    Measures result;
    Session session(caught_string,
                    overrides + Overrides{"Time/Check steps=yes", "Time/Allow energy gain=true",
                                          "Solver/Interface operator=matrix-free"},
                    processes);
    session.run(
        [&](const taut::StepView &view)
        {
          const taut::ContactMeasures::Summary found = view.measures.summary();
          result.values = {found.relative_energy,
                           found.taken,
                           found.scale,
                           found.energy_begin,
                           found.energy_end,
                           found.contact_time,
                           found.relative_momentum,
                           found.momentum,
                           found.resolution,
                           found.peak,
                           found.mean_peak,
                           found.mean_time};
          result.worst = view.measures.label(found.energy_constraint).name + ", " +
                         view.measures.label(found.momentum_constraint).name;
          EXPECT_EQ(view.constraints.shared() != nullptr, processes.size() > 1);
        });
    std::smatch line;
    const std::string log = session.log();
    if (std::regex_search(log, line, std::regex("Steps: .*")))
      result.steps = line.str();
    return result;
  }
} // namespace

// Claim: energy, momentum and peaks of contacts, whose rows are on one or two ranks each, and the
// error of steps are those of all ranks. Expected: those of one process, of a scheme that gives
// energy to droppers that catch.
TEST(Ranks, measures_of_contacts_are_the_same)
{
  for (const unsigned int n : {2u, 5u})
  {
    const Overrides parts = {"Partition/Number of substructures=" + std::to_string(n)};
    const Measures one = measures_of(parts, taut::Communicator()),
                   many = measures_of(parts, world());
    ASSERT_GT(one.values.front(), taut::ContactMeasures::suspicious_energy);
    for (std::size_t i = 0; i < one.values.size(); ++i)
      EXPECT_NEAR(many.values[i], one.values[i], 1e-6 * std::fabs(one.values[i])) << i;
    EXPECT_EQ(many.worst, one.worst);
    EXPECT_EQ(many.steps, one.steps);
    EXPECT_FALSE(one.steps.empty());
  }
}

// Claim: so for steps from 10 us to 10 s, on the reference line and on one of 100 spans. Expected:
// as above.
TEST(Ranks, every_step_size_on_the_reference_line_is_the_same)
{
  for (const double step : {1e-5, 1e-3, 1e-1, 1., 10.})
    expect_same("10 spans, step " + std::to_string(step), step,
                line(10, step, step < 1e-4 ? 400 : 20, .5), {1, 2, 7, 64, 256});
}

TEST(Ranks, every_one_of_a_thousand_spans_is_the_same)
{
  const std::string scene = scene_file("en50318_2002_250");
  const Overrides at_rest = line(1000, 1e-3, 1, 1.);
  const Record one = record(scene, at_rest, taut::Communicator()).rest;
  for (const unsigned int n : {64u, 1000u})
  {
    const std::string parts = std::to_string(n);
    expect_same(
        "1000 spans at rest, " + parts + " parts, " + ranks_and_comma(), one,
        record(scene, at_rest + Overrides{"Partition/Number of substructures=" + parts}, world())
            .rest,
        0.);
  }
}

TEST(Ranks, every_step_size_on_a_hundred_spans_is_the_same)
{
  for (const double step : {1e-5, 1e-3, 1e-1, 10.})
    expect_same("100 spans, step " + std::to_string(step), step,
                line(100, step, step < 1e-4 ? 100 : 5, 1.), {1, 2, 7, 64, 256});
}
