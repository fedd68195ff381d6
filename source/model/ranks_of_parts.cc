// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/ranks_of_parts.h"
#include "mechanism/mechanism.h"
#include "scene/entries.h"
#include <taut/scene/body_type.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace taut
{
  namespace
  {
    /// What the fullest rank may have above the mean for parts to be dealt in their order. A
    /// choice: a tenth of the time for fewer neighbours.
    constexpr double most_excess = .1;
  } // namespace

  bool is_divided(const Partition &partition, const std::size_t body)
  {
    return body < partition.bodies.size() && partition.bodies[body].body;
  }

  std::vector<unsigned int> ranks_of_parts(const Scene &scene, const Partition &partition,
                                           const std::vector<std::vector<std::size_t>> &mechanisms,
                                           const unsigned int n_ranks)
  {
    std::vector<std::size_t> n_dofs(partition.n_parts, 0), load(n_ranks, 0);
    for (std::size_t i = 0; n_ranks > 1 && i < scene.wires.size(); ++i)
    {
      const std::vector<Partition::Piece> &pieces = partition.wires[i];
      const std::size_t n_nodes = grid(scene, i).size();
      for (std::size_t p = 0; p < pieces.size(); ++p)
        n_dofs[pieces[p].part] +=
            scene.wires[i].n_dofs_per_node() *
            ((p + 1 < pieces.size() ? pieces[p + 1].first + 1 : n_nodes) - pieces[p].first);
    }
    for (const std::vector<std::size_t> &members : mechanisms)
      n_dofs.push_back(members.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (!is_divided(partition, i))
        n_dofs.push_back(scene.bodies[i].type->n_dofs());
      else
      {
        n_dofs.push_back(0);
        const Partition::Division &division = partition.bodies[i];
        const BodyCells &cells = division.body->cells();
        for (unsigned int r = 0; !division.parts.empty() && r < n_ranks; ++r)
          load[r] += cells.n_dofs() / n_ranks;
        for (std::size_t c = 0; n_ranks > 1 && division.parts.empty() && c < cells.size(); ++c)
          n_dofs[division.part[c]] += cells.n_dofs() / cells.size() + 1;
      }

    std::vector<unsigned int> rank(n_dofs.size(), 0);
    const double mean = std::accumulate(n_dofs.begin(), n_dofs.end(), 0.) / n_ranks;
    if (partition.rank_of_part.empty())
    {
      double before = 0.;
      for (std::size_t part = 0; mean > 0. && part < rank.size(); before += n_dofs[part++])
      {
        rank[part] =
            std::min(n_ranks - 1, static_cast<unsigned int>((before + .5 * n_dofs[part]) / mean));
        load[rank[part]] += n_dofs[part];
      }
      if (*std::max_element(load.begin(), load.end()) <= (1. + most_excess) * mean)
        return rank;
      std::fill(load.begin(), load.end(), 0);
    }
    for (const auto &[part, settled] : partition.rank_of_part)
    {
      rank[part] = settled;
      load[settled] += n_dofs[part];
    }
    std::vector<std::size_t> order(n_dofs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](const std::size_t a, const std::size_t b)
                     { return n_dofs[a] > n_dofs[b]; });
    for (const std::size_t part : order)
    {
      if (partition.rank_of_part.count(part) != 0)
        continue;
      rank[part] = std::min_element(load.begin(), load.end()) - load.begin();
      load[rank[part]] += n_dofs[part];
    }
    return rank;
  }

  Partition with_own_cells(const Scene &scene, Partition partition, const Communicator &processes)
  {
    if (processes.size() == 1)
      return partition;
    const std::vector<unsigned int> rank =
        ranks_of_parts(scene, partition, connected_masses(scene), processes.size());
    bool any = false;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
      if (!is_divided(partition, b) || partition.bodies[b].body->is_distributed())
        continue;
      Partition::Division &whole = partition.bodies[b];
      std::vector<unsigned int> rank_of_cell;
      for (const unsigned int part : whole.part)
        rank_of_cell.push_back(rank[part]);
      if (std::set<unsigned int>(rank_of_cell.begin(), rank_of_cell.end()).size() <
          processes.size())
        continue;
      const CustomBody &body = scene.bodies[b];
      const BodyType::OwnCells own = body.type->keep_own_cells(
          {body.name, body.origin, scene.gravity}, processes, rank_of_cell);
      if (!own.body)
        continue;
      any = true;
      Partition::Division division = {own.body, {}};
      for (const unsigned int cell : own.numbers)
        division.part.push_back(whole.part[cell]);
      const std::set<unsigned int> parts(whole.part.begin(), whole.part.end());
      division.parts.assign(parts.begin(), parts.end());
      whole = std::move(division);
    }
    for (unsigned int part = 0; any && part < partition.n_parts; ++part)
      partition.rank_of_part[part] = rank[part];
    return partition;
  }
} // namespace taut
