// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/wires_at_rest.h"
#include "model/scene_constraints.h"

#include <algorithm>

namespace taut
{
  namespace
  {
    Partition in_pieces(const Scene &scene)
    {
      constexpr std::size_t most_elements = 500;
      Partition result = whole(scene);
      for (std::size_t w = 0; w < scene.wires.size(); ++w)
      {
        const std::size_t n_elements = grid(scene, w).size() - 1,
                          n_pieces = (n_elements + most_elements - 1) / most_elements;
        result.wires[w].clear();
        for (std::size_t p = 0; p < n_pieces; ++p)
          result.wires[w].push_back({p * n_elements / n_pieces, static_cast<unsigned int>(p)});
        result.n_parts = std::max(result.n_parts, static_cast<unsigned int>(n_pieces));
      }
      return result;
    }

    /// One piece for each rank is the least that is worth their messages.
    SceneBodies bodies_of(const Scene &scene, const Communicator &processes)
    {
      const Partition partition = in_pieces(scene);
      return SceneBodies(scene, partition,
                         partition.n_parts < processes.size() ? Communicator() : processes);
    }

    Constraints constraints_of(const Scene &scene, const SceneBodies &structure,
                               const SolverParameters &parameters)
    {
      Constraints result = scene_constraints(scene, structure);
      choose_rows(result, parameters.interface, structure, true);
      return result;
    }
  } // namespace

  WiresAtRest::WiresAtRest(const Scene &scene, const SolverParameters &parameters,
                           const Communicator &processes)
      : structure(bodies_of(scene, processes)),
        constraints(constraints_of(scene, structure, parameters)),
        state(static_equilibrium(structure, constraints, parameters, 0.)),
        forces(constraints.of_links(state.multiplier, scene.links.size()))
  {
  }

  std::vector<double> WiresAtRest::distances(const std::vector<FoundDropper> &droppers,
                                             const std::vector<Coordinates> &directions) const
  {
    std::vector<double> result(droppers.size());
    for (std::size_t i = 0; i < droppers.size(); ++i)
    {
      std::vector<Term> terms;
      structure.motion(droppers[i].link.to, false, directions[i], 1., terms);
      structure.motion(droppers[i].link.from, false, directions[i], -1., terms);
      result[i] = evaluate(terms, state.displacement);
    }
    structure.communicator().sum(result);
    for (std::size_t i = 0; i < droppers.size(); ++i)
      result[i] += dot(droppers[i].between, directions[i]);
    return result;
  }
} // namespace taut
