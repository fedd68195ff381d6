// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: with conditions on gaps, then velocities, fixed rigid unilateral links never give energy,
// whatever bodies, links and steps, and BDF2 does. Source: kinetic and strain energy, measured here
// by M and K, of random problems without loads: contacts, joints and dampers can only take it.
#include "scene_tests.h"

#include "model/scene_constraints.h"
#include <taut/time/motion.h>

using namespace verification;

namespace
{
  using Scheme = std::shared_ptr<const taut::TimeIntegrator>;

  Scheme gaps_then_velocities(const double restitution = 0.)
  {
    return taut::make_integrator("Moreau-Jean", {{"Moreau-Jean/Restitution", number(restitution)}});
  }

  /// Masses on springs of random size and direction in one or two bodies, 2 to 40 DoFs, and 1 to 20
  /// links, some of them twice, that are closed or nearly so.
  class RandomProblem
  {
  public:
    explicit RandomProblem(const unsigned int seed, const bool has_elastic_links = false)
        : random(seed)
    {
      add_bodies();
      add_links(has_elastic_links);
    }

    taut::Scene scene;
    std::mt19937 random;

    double uniform(const double a, const double b)
    {
      return std::uniform_real_distribution<double>(a, b)(random);
    }
    double logarithmic(const double a, const double b)
    {
      return std::exp(uniform(std::log(a), std::log(b)));
    }
    std::size_t index(const std::size_t n)
    {
      return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    }

  private:
    taut::Coordinates direction()
    {
      const double angle = uniform(0., 6.3);
      return {std::cos(angle), std::sin(angle)};
    }

    void add_spring(const std::size_t from, const std::size_t to)
    {
      taut::Spring spring;
      spring.name = "spring " + std::to_string(scene.springs.size());
      spring.from = from;
      spring.to = to;
      spring.direction = direction();
      spring.stiffness = logarithmic(1., 1e4);
      if (index(4) == 0)
        spring.damping = logarithmic(1e-3, 1.);
      scene.springs.push_back(spring);
    }

    void add_bodies()
    {
      scene.gravity = {0., 0.};
      scene.start = taut::Start::given;
      const std::size_t n = 1 + index(20), first_of_second = index(2) == 0 ? n : 1 + index(n);
      for (std::size_t i = 0; i < n; ++i)
      {
        taut::Mass mass;
        mass.name = "mass " + std::to_string(i);
        mass.position = {double(i), 0.};
        mass.mass = logarithmic(.1, 10.);
        mass.moves[0] = true;
        for (int c = 0; c < 2; ++c)
          mass.velocity[c] = std::normal_distribution<double>()(random);
        scene.masses.push_back(mass);
        for (int c = 0; c < 2 && i > 0 && i != first_of_second; ++c)
        {
          const std::size_t first = i > first_of_second ? first_of_second : 0;
          add_spring(first + index(i - first), i);
        }
        if (index(3) == 0)
          add_spring(taut::ground, i);
      }
    }

    taut::Attachment attachment(const std::size_t i) const
    {
      return i < scene.masses.size() ? taut::Attachment{taut::Attachment::Kind::mass, i, 0.}
                                     : taut::Attachment();
    }

    void add_links(const bool has_elastic_links)
    {
      const std::size_t n = 1 + index(20);
      while (scene.links.size() < n)
      {
        taut::Link link;
        if (!scene.links.empty() && index(5) == 0)
          link = scene.links[index(scene.links.size())];
        else
        {
          const std::size_t to = index(scene.masses.size()), other = index(2 * scene.masses.size());
          link.from = attachment(other == to ? scene.masses.size() : other);
          link.to = attachment(to);
          link.direction = direction();
          const std::size_t kind = index(5);
          link.kind = kind == 0   ? taut::LinkKind::joint
                      : kind == 1 ? taut::LinkKind::dropper
                                  : taut::LinkKind::stop;
          if (link.unilateral() && index(3) > 0)
            link.gap = logarithmic(1e-4, 1.);
          if (has_elastic_links && link.unilateral() && index(2) == 0)
            link.stiffness = logarithmic(1., 1e8);
        }
        link.name = "link " + std::to_string(scene.links.size());
        scene.links.push_back(link);
      }
    }
  };

  /// The state of a scene at its start.
  taut::State start_of(const taut::Structure &structure, const taut::Constraints &constraints)
  {
    taut::State state;
    state.U = state.V = state.A = state.dU = state.V_old = state.KU = state.balance =
        structure.zero();
    state.multiplier.assign(constraints.size(), 0.);
    state.springs.resize(constraints.size());
    for (std::size_t k = 0; k < structure.size(); ++k)
      structure[k].initial_state(state.U[k], state.V[k]);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      state.distance.push_back(constraints[i].gap);
    state.complementarity_gap = state.distance;
    return state;
  }

  /// Kinetic and strain energy of the bodies, and what springs of links hold [J].
  double energy(const taut::Structure &structure, const taut::Constraints &constraints,
                const taut::State &state)
  {
    double sum = energy_of_bodies(structure, state);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (!constraints[i].spring.is_rigid())
        sum += .5 * constraints[i].spring.stiffness * std::pow(std::min(0., state.distance[i]), 2);
    return sum;
  }

  /// 2 pi over the largest frequency of M^-1 K, by power iteration; 1 without springs [s].
  double shortest_period(const taut::Structure &structure)
  {
    double largest = 0.;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::size_t n = structure[k].n_dofs();
      std::vector<double> diagonal(n), x(n);
      structure[k].mass().visit(
          [&](unsigned int i, unsigned int j, double value)
          {
            if (i == j)
              diagonal[i] = value;
          });
      for (std::size_t i = 0; i < n; ++i)
        x[i] = 1. + .1 * i;
      double size = 1.;
      for (int iteration = 0; iteration < 50 && size > 0.; ++iteration)
      {
        std::vector<double> y = matrix_times(structure[k].stiffness(), x);
        size = 0.;
        for (std::size_t i = 0; i < n; ++i)
          raise(size, y[i] /= diagonal[i]);
        for (std::size_t i = 0; i < n && size > 0.; ++i)
          x[i] = y[i] / size;
      }
      largest = std::max(largest, size);
    }
    return largest > 0. ? 2. * std::acos(-1.) / std::sqrt(largest) : 1.;
  }

  struct Gain
  {
    double largest = 0.;   ///< rise of the energy in a step over the energy at the start
    double projected = 0.; ///< largest D' of a rigid joint after a step [m/s]
  };

  /// Forty steps, one in eight of another length: 0.01 to 10 of the shortest period.
  Gain run(RandomProblem &problem, const Scheme &scheme)
  {
    taut::SceneBodies structure(problem.scene);
    taut::Constraints constraints = taut::scene_constraints(problem.scene, structure);
    const double period = shortest_period(structure);
    const auto new_step = [&] { return period * problem.logarithmic(.01, 10.); };
    taut::InitialState start;
    start.reference.displacement = start.reference.force = structure.zero();
    start.state = start_of(structure, constraints);
    taut::StepperOptions options;
    double step = options.step = new_step();
    options.start = taut::Start::undeformed;
    options.allow_unsuitable_scheme = true;
    taut::Motion motion(structure, constraints, options, start, scheme);
    const double first = energy(structure, constraints, motion.state());
    Gain gain;
    double before = first;
    for (int i = 0; i < 40; ++i)
    {
      if (i > 0 && problem.index(8) == 0)
        step = new_step();
      motion.try_step(step);
      const double now = energy(structure, constraints, motion.state());
      gain.largest = std::max(gain.largest, (now - before) / first);
      before = now;
      const std::vector<double> rates = constraints.motions(motion.state().V);
      for (std::size_t r = 0; r < constraints.size(); ++r)
        if (constraints[r].cone.is_free())
          raise(gain.projected, rates[r]);
    }
    return gain;
  }

  /// Runs @p n problems, and counts those that gain more than @p rounding of their energy.
  struct Result
  {
    int n_gained = 0, n_failed = 0;
    double largest = 0., joints = 0.;
  };
  Result run_many(const int n, const double rounding, const std::function<Scheme(unsigned int)> &of,
                  const bool has_elastic_links = false)
  {
    Result result;
    for (int seed = 1; seed <= n; ++seed)
    {
      RandomProblem problem(seed, has_elastic_links);
      try
      {
        const Gain gain = run(problem, of(seed));
        raise(result.largest, gain.largest);
        raise(result.joints, gain.projected);
        result.n_gained += gain.largest > rounding;
        if (gain.largest > rounding && rounding < 1e-9)
          std::printf("problem %d gains %g\n", seed, gain.largest);
      }
      catch (const std::exception &e)
      {
        ++result.n_failed;
        std::printf("problem %d: %s\n", seed, e.what());
      }
    }
    return result;
  }
} // namespace

TEST(ContactEnergy, no_rigid_problem_gains_with_gaps_then_velocities)
{
  const Result result = run_many(1000, 1e-10, [](unsigned int) { return gaps_then_velocities(); });
  const std::string name = "1000 rigid problems, gaps, then velocities: largest ";
  figure(name + "gain in a step over the first energy", result.largest);
  EXPECT_EQ(result.n_gained + result.n_failed, 0);
  EXPECT_LT(figure(name + "velocity of a joint", result.joints, "m/s"), 1e-9);
}

// The same problems: the test can fail.
TEST(ContactEnergy, many_rigid_problems_gain_with_bdf2)
{
  const Result result =
      run_many(1000, 1e-6, [](unsigned int) { return taut::make_integrator("BDF2"); });
  EXPECT_GT(figure("1000 rigid problems, BDF2: problems that gain energy", result.n_gained), 300);
  EXPECT_GT(figure("1000 rigid problems, BDF2: largest gain in a step over the first energy",
                   result.largest),
            .05);
}

// A spring's compression holds energy, too.
TEST(ContactEnergy, no_problem_with_elastic_links_gains)
{
  const Result result = run_many(
      300, 1e-10, [](unsigned int) { return gaps_then_velocities(); }, true);
  figure("300 problems with rigid and elastic links: largest gain in a step", result.largest);
  EXPECT_EQ(result.n_gained + result.n_failed, 0);
}

// Newton's law alone gives energy where several links are hit: the part of it that does not.
TEST(ContactEnergy, no_rigid_problem_gains_with_restitution)
{
  for (const bool elastic : {true, false})
  {
    const Result result =
        run_many(100, 1e-10,
                 [&](const unsigned int seed)
                 { return gaps_then_velocities(elastic ? 1. : ((seed * 37) % 100 + 1) / 100.); });
    figure(std::string("100 rigid problems, restitution ") + (elastic ? "1" : "0.01 to 1") +
               ": largest gain in a step",
           result.largest);
    EXPECT_EQ(result.n_gained + result.n_failed, 0);
  }
}
