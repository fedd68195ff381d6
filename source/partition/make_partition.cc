// SPDX-License-Identifier: LGPL-2.1-or-later
#include "partition/cell_parts.h"

#include "partition/make_partition.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <metis.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Smallest number of DoFs of a solid in space for which parts cost less than the uncut solid,
    /// with the reference BLAS and with a tuned BLAS; largest number of solutions; DoFs of a part
    /// (doc/results/decomposition.md).
    constexpr std::size_t least_cut_dofs = 10000, least_with_tuned_blas = 100000,
                          dofs_per_part = 500;
    constexpr double most_solves = 3.;

    std::size_t least_dofs_to_cut(const bool tuned_blas)
    {
      return tuned_blas ? least_with_tuned_blas : least_cut_dofs;
    }

    std::size_t nearest_node(const std::vector<double> &nodes, const double s)
    {
      const auto after = std::lower_bound(nodes.begin(), nodes.end(), s);
      if (after == nodes.begin())
        return 0;
      if (after == nodes.end())
        return nodes.size() - 1;
      return (*after - s < s - *(after - 1) ? after : after - 1) - nodes.begin();
    }

    /// Elements hold their ends together more than links do.
    constexpr idx_t element_weight = 10, link_weight = 1;

    /// A graph that METIS parts.
    class Graph
    {
    public:
      std::size_t size() const { return work.size(); }

      void add_vertices(const std::size_t n, const idx_t work_of_each)
      {
        work.resize(size() + n, work_of_each);
      }

      /// Weights of the same two vertices add.
      void connect(const std::size_t a, const std::size_t b, const idx_t weight)
      {
        if (a != b)
          edges.push_back({static_cast<idx_t>(a), static_cast<idx_t>(b), weight});
      }

      double total_work() const { return std::accumulate(work.begin(), work.end(), 0.); }

      /// Part of every vertex.
      std::vector<idx_t> parts(idx_t n_parts) const;

    private:
      struct Edge
      {
        idx_t a, b, weight;
      };
      std::vector<Edge> edges;
      std::vector<idx_t> work; ///< of a vertex: its DoFs
    };

    void add_cells(const BodyCells &cells, Graph &graph)
    {
      const std::size_t begin = graph.size();
      graph.add_vertices(cells.size(), std::max<idx_t>(1, cells.n_dofs() / cells.n_cells()));
      visit_neighbours(cells, [&](const unsigned int a, const unsigned int b, const unsigned int n)
                       { graph.connect(begin + a, begin + b, element_weight * n); });
    }

    /// The grid nodes of all wires, and the cells of all bodies that can be cut, as vertices of one
    /// graph. Distributed bodies have graphs of their own.
    class NodeGraph
    {
    public:
      explicit NodeGraph(const Scene &scene);

      /// Part of every node.
      std::vector<idx_t> parts(const idx_t n_parts) const { return graph.parts(n_parts); }

      /// DoFs of all vertices.
      double work() const { return graph.total_work(); }

      std::vector<std::vector<double>> nodes; ///< of each wire
      std::vector<std::size_t> first;         ///< vertex of the first node of each wire
      std::vector<std::vector<char>>
          is_attachment; ///< a link, support, mass or load is on the node
      std::vector<std::shared_ptr<const DivisibleBody>> bodies; ///< none: not cut
      std::vector<std::size_t> first_cell; ///< vertex of the first cell of each body

    private:
      void add_cells(const DivisibleBody &body) { taut::add_cells(body.cells(), graph); }
      void connect(const Link &link);
      void note(const Attachment &end);

      Graph graph;
    };

    NodeGraph::NodeGraph(const Scene &scene)
    {
      for (std::size_t w = 0; w < scene.wires.size(); ++w)
      {
        const Wire &wire = scene.wires[w];
        nodes.push_back(grid(scene, w));
        first.push_back(graph.size());
        is_attachment.emplace_back(nodes[w].size(), 0);
        graph.add_vertices(nodes[w].size(), wire.n_dofs_per_node());
        for (std::size_t i = 0; i + 1 < nodes[w].size(); ++i)
          graph.connect(first[w] + i, first[w] + i + 1, element_weight);
      }
      for (const CustomBody &body : scene.bodies)
      {
        bodies.push_back(body.type->division({body.name, body.origin, scene.gravity}));
        first_cell.push_back(graph.size());
        if (bodies.back() && !bodies.back()->is_distributed())
          add_cells(*bodies.back());
      }
      for (const Link &link : scene.links)
      {
        if (link.moving())
          continue;
        Link::visit_places(link, [&](const Attachment &at) { note(at); });
        connect(link);
      }
      const auto note_all = [&](const std::size_t wire, const std::vector<double> &positions)
      {
        for (const double s : positions)
          note({Attachment::Kind::wire, wire, s});
      };
      for (const Support &support : scene.supports)
        note_all(support.wire, support.positions);
      for (const PointMass &mass : scene.point_masses)
        note_all(mass.wire, mass.positions);
      for (const Load &load : scene.loads)
        if (load.kind == Load::Kind::point)
          note(load.target);
    }

    void NodeGraph::connect(const Link &link)
    {
      std::vector<std::size_t> ends;
      const auto add = [&](const Attachment &end)
      {
        if (end.kind == Attachment::Kind::wire)
          ends.push_back(first[end.index] + nearest_node(nodes[end.index], end.position));
        else if (end.kind == Attachment::Kind::body && bodies[end.index] &&
                 !bodies[end.index]->is_distributed())
          try
          {
            ends.push_back(first_cell[end.index] + bodies[end.index]->cell_at(end.place));
          }
          catch (const UserError &)
          {
            // The error that names the link comes when the bodies are made.
          }
      };
      Link::visit_places(link, add);
      for (std::size_t k = 1; k < ends.size(); ++k)
        graph.connect(ends[k - 1], ends[k], link_weight);
    }

    void NodeGraph::note(const Attachment &end)
    {
      if (end.kind == Attachment::Kind::wire)
        is_attachment[end.index][nearest_node(nodes[end.index], end.position)] = 1;
    }

    std::vector<idx_t> Graph::parts(idx_t n_parts) const
    {
      idx_t n = size();
      std::vector<idx_t> part(n, 0);
      if (n_parts <= 1)
        return part;
      std::vector<std::size_t> end(n + 1, 0);
      for (const Edge &edge : edges)
      {
        ++end[edge.a + 1];
        ++end[edge.b + 1];
      }
      std::partial_sum(end.begin(), end.end(), end.begin());
      std::vector<std::pair<idx_t, idx_t>> neighbours(end.back()); // and weights, by vertices
      for (const Edge &edge : edges)
      {
        neighbours[end[edge.a]++] = {edge.b, edge.weight};
        neighbours[end[edge.b]++] = {edge.a, edge.weight};
      }
      std::vector<idx_t> offset = {0}, adjacent, weight, vertex_weight = work;
      auto next = neighbours.begin();
      for (idx_t vertex = 0; vertex < n; ++vertex)
      {
        const auto first = next;
        next = neighbours.begin() + static_cast<std::ptrdiff_t>(end[vertex]);
        std::sort(first, next);
        for (auto neighbour = first; neighbour != next; ++neighbour)
          if (neighbour != first && neighbour->first == adjacent.back())
            weight.back() += neighbour->second;
          else
          {
            adjacent.push_back(neighbour->first);
            weight.push_back(neighbour->second);
          }
        offset.push_back(static_cast<idx_t>(adjacent.size()));
      }
      idx_t options[METIS_NOPTIONS], n_constraints = 1, cut = 0;
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED] = 1;
      const int status = METIS_PartGraphRecursive(
          &n, &n_constraints, offset.data(), adjacent.data(), vertex_weight.data(), nullptr,
          weight.data(), &n_parts, nullptr, nullptr, options, &cut, part.data());
      if (status != METIS_OK)
        throw std::runtime_error("METIS failed to partition the scene");
      return part;
    }

    /// The node nearest to `wanted` without a link, support, mass or load, between `low` and
    /// `high`, both excluded.
    std::size_t free_node(const std::vector<char> &is_attachment, const std::size_t wanted,
                          const std::size_t low, const std::size_t high)
    {
      constexpr std::size_t farthest = 4;
      for (std::size_t distance = 0; distance <= farthest; ++distance)
        for (const std::size_t node : {wanted - std::min(distance, wanted), wanted + distance})
          if (node > low && node < high && !is_attachment[node])
            return node;
      return wanted;
    }

    unsigned int share_of(const double n_parts, const double share)
    {
      return static_cast<unsigned int>(std::max(1., std::round(n_parts * share)));
    }

    /// Each rank parts its own cells of a distributed body, into its share of @p n_wanted parts.
    void part_own_cells(const double n_wanted, Partition::Division &division, Partition &partition)
    {
      const BodyCells &cells = division.body->cells();
      const auto n_own = static_cast<double>(cells.size());
      unsigned int n = std::min(static_cast<unsigned int>(cells.size()),
                                share_of(n_wanted, n_own / static_cast<double>(cells.n_cells())));
      Graph graph;
      add_cells(cells, graph);
      const std::vector<idx_t> part = graph.parts(static_cast<idx_t>(n));
      division.part.assign(part.begin(), part.end());
      connect_parts(cells, division.part, n);
      // Without the numbers of empty parts, which METIS may leave.
      std::map<unsigned int, unsigned int> number;
      for (const unsigned int p : division.part)
        number.emplace(p, 0);
      n = 0;
      for (auto &[old, anew] : number)
        anew = n++;
      std::vector<std::size_t> n_of_rank;
      const Communicator processes = division.body->processes();
      processes.gather(n, n_of_rank);
      for (unsigned int rank = 0; rank < n_of_rank.size(); ++rank)
      {
        if (rank == processes.rank())
          for (unsigned int &p : division.part)
            p = partition.n_parts + number.at(p);
        for (std::size_t p = 0; p < n_of_rank[rank]; ++p)
        {
          division.parts.push_back(partition.n_parts);
          partition.rank_of_part[partition.n_parts++] = rank;
        }
      }
    }

    Partition by_metis(const Scene &scene, const unsigned int n_parts)
    {
      if (n_parts == 1)
        return whole(scene);
      const NodeGraph graph(scene);
      std::size_t n_elements = 0;
      double work = graph.work();
      for (const auto &nodes : graph.nodes)
        n_elements += nodes.size() - 1;
      for (const auto &body : graph.bodies)
      {
        n_elements += body ? body->cells().n_cells() : 0;
        work += body && body->is_distributed() ? static_cast<double>(body->cells().n_dofs()) : 0.;
      }
      if (n_parts > std::max<std::size_t>(1, n_elements))
        throw EntryError("Partition/Number of substructures",
                         "wires and solids have only " + std::to_string(n_elements) +
                             " elements to share; take fewer substructures or smaller elements");
      Partition partition;
      partition.n_parts = graph.work() > 0. ? share_of(n_parts, graph.work() / work) : 0;
      const std::vector<idx_t> part = graph.parts(static_cast<idx_t>(partition.n_parts));
      for (std::size_t w = 0; w < graph.nodes.size(); ++w)
      {
        const std::size_t n = graph.nodes[w].size();
        const idx_t *p = part.data() + graph.first[w];
        std::vector<Partition::Piece> pieces = {{0, static_cast<unsigned int>(p[0])}};
        for (std::size_t i = 1; i < n; ++i)
          if (p[i] != p[i - 1])
          {
            // No piece may lack an element or begin beyond the end.
            const std::size_t node =
                free_node(graph.is_attachment[w], i, pieces.back().first, n - 1);
            if (node > pieces.back().first && node < n - 1)
              pieces.push_back({node, static_cast<unsigned int>(p[i])});
          }
        partition.wires.push_back(std::move(pieces));
      }
      for (std::size_t b = 0; b < graph.bodies.size(); ++b)
      {
        partition.bodies.push_back({graph.bodies[b], {}});
        if (!graph.bodies[b] || graph.bodies[b]->is_distributed())
          continue;
        const auto begin = part.begin() + graph.first_cell[b];
        partition.bodies[b].part.assign(begin, begin + graph.bodies[b]->cells().size());
        connect_parts(graph.bodies[b]->cells(), partition.bodies[b].part, partition.n_parts);
      }
      for (Partition::Division &division : partition.bodies)
        if (division.body && division.body->is_distributed())
          part_own_cells(n_parts * static_cast<double>(division.body->cells().n_dofs()) / work,
                         division, partition);
      return partition;
    }

    unsigned int number_of_parts(const std::string &text)
    {
      constexpr int most = 1000000;
      const char *const end = text.data() + text.size();
      int n = 0;
      const auto [stop, error] = std::from_chars(text.data(), end, n);
      if (error != std::errc() || stop != end || n < 1 || n > most)
        throw EntryError("Partition/Number of substructures",
                         "'" + text + "' is not a number n of parts, 1 <= n <= " +
                             std::to_string(most) + ", nor 'automatic'");
      return n;
    }

    Partition by_wires(const Scene &scene)
    {
      Partition partition = whole(scene);
      for (std::size_t w = 0; w < partition.wires.size(); ++w)
        partition.wires[w].front().part = w;
      partition.n_parts = std::max<std::size_t>(1, scene.wires.size());
      return partition;
    }

    Partition by_list(const Scene &scene, const std::string &text)
    {
      const std::string entry = "Partition/Cuts";
      std::vector<std::vector<std::size_t>> cuts(scene.wires.size());
      std::istringstream list(text);
      for (std::string one; std::getline(list, one, ';');)
        for (const Attachment &cut : parse_attachments(one, scene, entry))
        {
          if (cut.kind != Attachment::Kind::wire)
            throw EntryError(entry,
                             "'" + one + "' is not on a wire; write 'wire @ 10, 20; other @ 5'");
          const std::vector<double> nodes = grid(scene, cut.index);
          const std::size_t node = nearest_node(nodes, cut.position);
          if (!(cut.position > 0. && cut.position < nodes.back()) || node == 0 ||
              node + 1 == nodes.size())
            throw EntryError(entry,
                             "a cut of '" + scene.wires[cut.index].name +
                                 "' is not inside the wire, or in its first or last element");
          cuts[cut.index].push_back(node);
        }
      Partition partition;
      partition.n_parts = 0;
      for (std::vector<std::size_t> &nodes : cuts)
      {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        std::vector<Partition::Piece> pieces = {{0, partition.n_parts++}};
        for (const std::size_t node : nodes)
          pieces.push_back({node, partition.n_parts++});
        partition.wires.push_back(std::move(pieces));
      }
      return partition;
    }
  } // namespace

  void PartitionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Partition");
    prm.add_parameter(
        "Method", method,
        "'METIS': parts of about equal work. 'wires': every wire is a part. 'given': wires at "
        "the positions of Cuts",
        Selection("METIS|wires|given"));
    prm.add_parameter(
        "Number of substructures", n_substructures,
        "Parts that METIS cuts wires and solids into, 1: no cuts. 'automatic': no cuts, "
        "but large solids in space are cut for statics and a few steps [1]",
        Anything());
    prm.add_parameter("Cuts", cuts,
                      "For 'given': 'wire @ positions; other wire @ positions', numbers and ranges "
                      "first:step:last [m]",
                      Anything());
    prm.leave_subsection();
  }

  void distribute_bodies(const Scene &scene, const PartitionParameters &parameters,
                         const double n_steps, const Communicator &processes, const bool tuned_blas)
  {
    const bool is_automatic = parameters.n_substructures == "automatic",
               is_shared =
                   processes.size() > 1 && parameters.method == "METIS" &&
                   (is_automatic ? n_steps <= most_solves
                                 : number_of_parts(parameters.n_substructures) >= processes.size());
    for (const CustomBody &body : scene.bodies)
      body.type->distribute({body.name, body.origin, scene.gravity},
                            is_shared ? processes : Communicator(),
                            is_automatic ? least_dofs_to_cut(tuned_blas) : 0);
  }

  NumberOfParts automatic_number_of_parts(const Scene &scene, const double n_steps,
                                          const bool tuned_blas)
  {
    std::ostringstream reason;
    if (n_steps > most_solves)
    {
      reason << "more than " << most_solves << " steps use one factor of the whole";
      return {1, reason.str()};
    }
    const std::size_t least = least_dofs_to_cut(tuned_blas);
    std::size_t n_dofs = 0;
    for (const CustomBody &body : scene.bodies)
      if (const auto division = body.type->division({body.name, body.origin, scene.gravity}))
        if (division->cells().dim == 3 && division->cells().n_dofs() >= least)
          n_dofs += division->cells().n_dofs();
    if (n_dofs == 0)
    {
      reason << "no solid in space has " << least << " DoFs: with "
             << (tuned_blas ? "a tuned BLAS" : "the reference BLAS")
             << " a factor of the whole costs little";
      return {1, reason.str()};
    }
    reason << n_dofs << " DoFs of solids in space: iterations of a few solutions cost less than a "
           << "factor of the whole";
    return {static_cast<unsigned int>(std::max<std::size_t>(2, n_dofs / dofs_per_part)),
            reason.str()};
  }

  Partition make_partition(const Scene &scene, const PartitionParameters &parameters)
  {
    if (parameters.method == "METIS")
      return by_metis(scene, number_of_parts(parameters.n_substructures));
    if (parameters.method == "wires")
      return by_wires(scene);
    return by_list(scene, parameters.cuts);
  }
} // namespace taut
