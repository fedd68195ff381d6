// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mpi_nodes_h
#define taut_mpi_nodes_h

#include "verification/scene_tests.h"

#include <taut/scene/contact_surface.h>

namespace verification
{
  /// Adds the displacements from the undeformed bodies of all nodes that these show to contacts,
  /// x, y and z of each, summed over the ranks [m]. @p n_nodes of each body is found if empty.
  inline void add_displacements(const taut::StepView &view, std::vector<std::size_t> &n_nodes,
                                std::vector<double> &result)
  {
    if (n_nodes.empty())
      for (const taut::CustomBody &body : view.scene.bodies)
        n_nodes.push_back(
            body.type->surface({body.name, body.origin, view.scene.gravity}, {}).points.size());
    std::vector<double> own;
    for (std::size_t b = 0; b < n_nodes.size(); ++b)
      for (unsigned int node = 0; node < n_nodes[b]; ++node)
      {
        const std::size_t k = view.structure.index_at_node(b, node);
        for (const taut::Coordinates &axis :
             {taut::Coordinates{1., 0., 0.}, taut::Coordinates{0., 1., 0.},
              taut::Coordinates{0., 0., 1.}})
        {
          own.push_back(0.);
          if (k == taut::Structure::elsewhere)
            continue;
          const taut::LinearForm form = view.structure[k].node_displacement(node, axis);
          own.back() = form.dot(view.reference.displacement[k]) + form.dot(view.state.U[k]);
        }
      }
    view.structure.communicator().sum(own);
    result.insert(result.end(), own.begin(), own.end());
  }

  /// What must not depend on ranks and parts, in each step: of links and contacts, of the nodes of
  /// all bodies, and of probes.
  struct NodeRecord
  {
    std::vector<double> force, gap, displacement, probes;
    bool is_distributed = false; ///< links and contacts live with their bodies
    std::string log;
  };

  /// Of the text of a scene.
  inline NodeRecord record_nodes_of(const std::string &text, const Overrides &overrides,
                                    const taut::Communicator &processes)
  {
    NodeRecord result;
    // Each rank has a folder of its own here.
    Session session(text, overrides + Overrides{"Output/Field interval=0"}, processes);
    std::vector<std::size_t> n_nodes;
    session.run(
        [&](const taut::StepView &view)
        {
          for (const auto &[values, all] : {std::pair(&view.state.multiplier, &result.force),
                                            std::pair(&view.state.distance, &result.gap)})
          {
            const auto add = [all = all](const std::vector<double> &more)
            { all->insert(all->end(), more.begin(), more.end()); };
            add(view.constraints.of_links(*values, view.scene.links.size()));
            for (std::size_t c = 0; c < view.scene.contacts.size(); ++c)
              add(view.constraints.of_contact(*values, c));
          }
          result.is_distributed = view.constraints.shared() != nullptr;
          result.probes.insert(result.probes.end(), view.probes.begin(), view.probes.end());
          add_displacements(view, n_nodes, result.displacement);
        });
    result.log = session.log();
    return result;
  }

  /// Of a scene of prm/.
  inline NodeRecord record_nodes(const std::string &scene, const Overrides &overrides,
                                 const taut::Communicator &processes)
  {
    return record_nodes_of(scene_file(scene), overrides, processes);
  }

  /// A probe of the cube of a scene, at rest.
  inline const std::string cube_at_rest = R"(
subsection Output
  set Probes = corner
  subsection Probe corner
    set Point     = cube @ 1, 1, 1
    set Direction = 0, 0, 1
  end
end
subsection Time
  set End = 0
end
)";

  /// A cube of so many coarse elements along an edge, each halved so many times, which a pressure
  /// at one edge lifts from a rigid floor elsewhere.
  inline std::string cube_on_floor(const unsigned int n, const unsigned int refinements = 0)
  {
    const std::string number = std::to_string(n);
    return R"(
set Generator = network
set Bodies    = cube
set Contacts  = floor
set Gravity   = 0, 0
subsection Body cube
  set Type                = solid
  set Dimension           = 3
  set Young's modulus     = 1e9
  set Poisson's ratio     = 0.3
  set Density             = 7850
  set Symmetry boundaries = 0, 2
  set Pressure            = 5: 1e6*exp(-(x^2+y^2)/0.02)
  subsection Mesh
    set Generator   = subdivided_hyper_rectangle
    set Arguments   = )" +
           number + ", " + number + ", " + number + R"( : 0, 0, 0 : 1, 1, 1
    set Refinements = )" +
           std::to_string(refinements) + R"(
  end
end
subsection Contact floor
  set Slave           = cube: 4
  set Obstacle        = plane
  set Point           = 0, 0, 0
  set Direction       = 0, 0, 1
  set Search distance = 0.1
end
)" + cube_at_rest;
  }

  inline std::string ranks_and_comma()
  {
    return std::to_string(taut::Communicator(MPI_COMM_WORLD).size()) + " ranks, ";
  }

  /// Largest difference over the largest number.
  inline double relative_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    const double size = largest(a), error = largest_difference(a, b);
    return size > 0. ? error / size : error;
  }
} // namespace verification

#endif
