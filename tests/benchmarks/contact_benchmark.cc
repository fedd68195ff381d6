// SPDX-License-Identifier: LGPL-2.1-or-later
// An elastic slab that is pressed on a wavy floor, at rest and in steps of backward Euler, by Taut
// and beside it by an active set whose every change is a factorisation of the whole
// (monolithic_contact.h): processor time of both, which take turns step by step, and how far their
// answers are apart. Usage: contact_benchmark [umfpack|cholmod|none] [STEPS] [ELEMENTS ALONG x]
// [Section.Entry=value]...; the default is cholmod 1000 1000, with 102 102 DoFs and 1001 nodes that
// may touch.
#include "monolithic_contact.h"
#include "solid/wavy_floor.h"
#include "verification/run.h"

#include "model/surface_constraints.h"
#include <taut/base/exceptions.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace
{
  using wavy_floor::length;

  constexpr double step = 2e-4;

  double seconds(const std::clock_t clocks)
  {
    return static_cast<double>(clocks) / CLOCKS_PER_SEC;
  }

  monolithic_contact::Slab slab(const unsigned int n_x)
  {
    using namespace wavy_floor;
    return {n_x, n_x / 20, length, 1., E, nu, density, top, wavy_floor::floor, slope};
  }

  /// Largest differences, over the largest values.
  struct Differences
  {
    double force = 0., displacement = 0.;
    long nodes = 0; ///< closed in one and open in the other, of all steps
  };

  /// Constraints by x: the bottom node of each.
  std::vector<std::size_t> order(const taut::StepView &view)
  {
    const auto found = taut::contact_geometry(view.scene, 0).constraints;
    std::vector<std::size_t> result(found.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      result[i] = std::lround(found[i].point.x / length * (found.size() - 1));
    return result;
  }

  /// A displacement that is compared, of node (i, j) along x or y. Points are found once: that
  /// takes a search of all cells.
  struct Probe
  {
    unsigned int i, j, d;
    taut::LinearForm form;
  };

  std::vector<Probe> probes(const taut::StepView &view, const unsigned int n_x)
  {
    std::vector<Probe> result;
    for (unsigned int i = 0; i <= n_x; i += 7)
      for (unsigned int j = 0; j <= n_x / 20; j += 5)
        for (const unsigned int d : {0u, 1u})
          result.push_back({i, j, d,
                            view.structure[0].displacement({i * length / n_x, j * length / n_x},
                                                           {d == 0 ? 1. : 0., d == 1 ? 1. : 0.})});
    return result;
  }

  void compare(const taut::StepView &view, const std::vector<std::size_t> &node,
               const std::vector<Probe> &probe, const monolithic_contact::Newton &newton,
               Differences &worst)
  {
    double largest = 0., difference = 0.;
    for (std::size_t i = 0; i < node.size(); ++i)
    {
      const double N = view.state.multiplier[i];
      largest = std::max(largest, N);
      difference = std::max(difference, std::fabs(N - newton.force[node[i]]));
      worst.nodes += (N > 0.) != (newton.closed[node[i]] != 0);
    }
    worst.force = std::max(worst.force, difference / largest);
    largest = difference = 0.;
    for (const Probe &at : probe)
    {
      const double u = newton.displacement(at.i, at.j)[at.d],
                   own = at.form.dot(view.state.U[0]) + at.form.dot(view.reference.displacement[0]);
      largest = std::max(largest, std::fabs(u));
      difference = std::max(difference, std::fabs(own - u));
    }
    worst.displacement = std::max(worst.displacement, difference / largest);
  }

  std::size_t n_closed(const taut::StepView &view)
  {
    std::size_t n = 0;
    for (const double N : view.state.multiplier)
      n += N > 0.;
    return n;
  }

  void run(const std::string &peer, const int n_steps, const unsigned int n_x,
           const verification::Overrides &overrides)
  {
    const std::clock_t begin = std::clock();
    std::clock_t of_peer = 0, not_taut = 0, statics = 0, statics_of_peer = 0, first = 0, end = 0;
    std::unique_ptr<monolithic_contact::Newton> newton;
    std::vector<std::size_t> node;
    std::vector<Probe> probe;
    Differences worst;
    int n = -1;
    long n_sets = 0, sets_at_rest = 0, sets_of_peer_at_rest = 0;
    std::size_t least = -1, most = 0;
    verification::Session session(wavy_floor::scene(n_x, n_steps, step), overrides);
    session.run(
        [&](const taut::StepView &view)
        {
          const std::clock_t from = std::clock();
          if (++n == 0)
          {
            statics = from - begin;
            sets_at_rest = view.residuals.iterations;
            std::printf("%u DoFs, %zu constraints, %zu closed at rest\n",
                        view.structure[0].n_dofs(), view.state.multiplier.size(), n_closed(view));
          }
          else
            n_sets += view.residuals.iterations;
          if (n == 1)
            first = from - begin - not_taut;
          end = from - begin - not_taut;
          least = std::min(least, n_closed(view));
          most = std::max(most, n_closed(view));
          if (peer != "none")
          {
            if (n == 0)
            {
              newton = std::make_unique<monolithic_contact::Newton>(slab(n_x), peer == "umfpack");
              newton->find_equilibrium(0.);
              statics_of_peer = std::clock() - from;
              sets_of_peer_at_rest = newton->n_sets;
              node = order(view);
              probe = probes(view, n_x);
            }
            else
              newton->advance(view.state.time, step);
            of_peer += std::clock() - from;
            compare(view, node, probe, *newton, worst);
          }
          not_taut += std::clock() - from;
        });
    std::printf("closed in the steps: %zu to %zu\n", least, most);
    std::printf("| | equilibrium [s] | active sets | %d steps [s] | active sets |\n", n);
    std::printf("|---|---|---|---|---|\n");
    std::printf("| Taut | %.3g | %ld | %.4g (the first one, with the factor, %.3g) | %ld |\n",
                seconds(statics), sets_at_rest, seconds(end - statics), seconds(first - statics),
                n_sets);
    if (!newton)
      return;
    std::printf("| %s | %.3g | %ld | %.4g | %ld, %ld factorisations |\n", peer.c_str(),
                seconds(statics_of_peer), sets_of_peer_at_rest, seconds(of_peer - statics_of_peer),
                newton->n_sets - sets_of_peer_at_rest, newton->n_factorisations);
    std::printf("| ratio | %.3g | | %.3g | |\n",
                static_cast<double>(statics_of_peer) / static_cast<double>(statics),
                static_cast<double>(of_peer - statics_of_peer) /
                    static_cast<double>(end - statics));
    std::printf("largest differences: forces %.2g, displacements %.2g; %ld nodes of %ld\n",
                worst.force, worst.displacement, worst.nodes,
                static_cast<long>(node.size()) * (n + 1));
  }
} // namespace

int main(int argc, char **argv)
{
  try
  {
    const std::string peer = argc > 1 ? argv[1] : "cholmod";
    const int n_steps = argc > 2 ? std::atoi(argv[2]) : 1000,
              n_x = argc > 3 ? std::atoi(argv[3]) : 1000;
    if ((peer != "umfpack" && peer != "cholmod" && peer != "none") || n_steps < 0 || n_x < 20)
      throw taut::UserError("usage: contact_benchmark [umfpack|cholmod|none] [STEPS] [ELEMENTS "
                            "ALONG x] [Section.Entry=value]...");
    run(peer, n_steps, n_x, {argv + std::min(argc, 4), argv + argc});
    return 0;
  }
  catch (const std::exception &e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
