// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: ranks share the mesh of a solid that is cut into a part for each of them or more: each has
// its own cells, and the answers are those of one process with the whole mesh. Source: that run.
#include "nodes.h"

#include "solid/mesh_file.h"
#include "substructure/distributed_mesh.h"
#include <taut/scene/partition.h>
#include <taut/solid/cell_division.h>
#include <taut/solid/elastic_solid.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <array>
#include <memory>
#include <regex>
#include <sstream>

using namespace verification;

namespace
{
  taut::Communicator world()
  {
    return taut::Communicator(MPI_COMM_WORLD);
  }

  /// At least one part for each rank: with fewer a mesh stays whole.
  Overrides in_parts(const unsigned int n)
  {
    return {"Partition/Number of substructures=" +
            std::to_string(std::max<std::size_t>(n, world().size()))};
  }

  /// Compares a run of all ranks, in_parts() if @p overrides say nothing else, with one of one
  /// process and without cuts.
  void expect_same(const std::string &title, const std::string &text, const unsigned int n_parts,
                   const Overrides &overrides = {})
  {
    SCOPED_TRACE(title);
    const NodeRecord one =
        record_nodes_of(text, overrides + Overrides{"Partition/Number of substructures=1"}, {});
    const NodeRecord many = record_nodes_of(text, in_parts(n_parts) + overrides, world());
    ASSERT_FALSE(one.probes.empty());
    ASSERT_FALSE(one.force.empty());
    const auto check = [&](const std::string &what, const std::vector<double> &a,
                           const std::vector<double> &b, const double bound) {
      EXPECT_LT(figure(ranks_and_comma() + title + ", " + what, relative_difference(a, b)), bound);
    };
    check("probes", one.probes, many.probes, 1e-9);
    check("displacement", one.displacement, many.displacement, 1e-9);
    check("force", one.force, many.force, 1e-7);
  }

  /// The message that ends a run; empty: none does.
  std::string error_of(const std::string &text, const Overrides &overrides,
                       const taut::Communicator &processes)
  {
    std::string message;
    try
    {
      record_nodes_of(text, overrides, processes);
    }
    catch (const taut::UserError &e)
    {
      message = e.what();
    }
    const std::size_t place = message.find("scene.prm"); // in a folder of its own
    return place == std::string::npos ? message : message.substr(place);
  }

  /// Iterations of conjugate gradients and systems, of which the log tells.
  std::array<int, 2> iterations(const NodeRecord &record)
  {
    static const std::regex said("(\\d+) iterations? of conjugate gradients in (\\d+) systems?");
    std::smatch parts;
    if (!std::regex_search(record.log, parts, said))
      return {0, 0};
    return {std::stoi(parts.str(1)), std::stoi(parts.str(2))};
  }

  /// The two ways to share a mesh: every rank makes it, or all ranks together.
  Overrides shared_by(const std::string &body, const std::string &distribution)
  {
    return {"Body " + body + "/Mesh/Distribution=" + distribution};
  }
  const std::string distributions[] = {"METIS", "p4est"};

  /// The cells of the ranks are all cells, each on one rank.
  void expect_shared(const std::string &text, const Overrides &overrides)
  {
    SCOPED_TRACE(overrides.back());
    Session session(text, overrides + Overrides{"Output/Field interval=0"}, world());
    const taut::Scene &scene = session.simulation().scene();
    const auto body =
        scene.bodies[0].type->division({scene.bodies[0].name, scene.bodies[0].origin, {}});
    const taut::BodyCells &cells = body->cells();
    double sums[] = {static_cast<double>(cells.size())};
    world().sum(sums, 1);
    EXPECT_EQ(sums[0], static_cast<double>(cells.n_cells()));
    EXPECT_EQ(body->is_distributed(), world().size() > 1);
    EXPECT_GT(cells.size(), 0u);
    // Even shares, but for families of cells that p4est keeps together.
    EXPECT_LT(static_cast<double>(cells.size()),
              1.3 * static_cast<double>(cells.n_cells()) / world().size());
  }

  /// A block in the plane that hangs at its left side and lies on a floor, with a spring, a stop
  /// and a load at points, one of them where four cells meet.
  std::string block(const std::string &more)
  {
    return R"(
set Generator = network
set Start     = equilibrium
set Bodies    = block
set Contacts  = floor
set Gravity   = 0, -9.81
subsection Body block
  set Type                = solid
  set Young's modulus     = 1e7
  set Poisson's ratio     = 0.3
  set Density             = 2000
  set Mass damping        = 1
  set Displacement        = 0: 0, 1e-3*(1-y)
  set Traction            = 1: 2e3*y, 0
  subsection Mesh
    set Generator         = subdivided_hyper_rectangle
    set Arguments         = 2, 2 : 0, 0 : 1, 1
    set Refinements       = 3
  end
end
subsection Contact floor
  set Slave     = block: 2
  set Obstacle  = plane
  set Point     = 0, -0.0005
  set Direction = 0, 1
end
subsection Network
  set Links = spring, stop
  set Loads = pull
  subsection Link spring
    set Type      = dropper
    set From      = ground
    set To        = block @ 0.5, 0.5
    set Direction = 0, 1
    set Stiffness = 1e5
  end
  subsection Link stop
    set Type      = stop
    set From      = ground
    set To        = block @ 1, 0.3
    set Direction = 1, 0
    set Gap       = -1e-4
  end
  subsection Load pull
    set Type      = point
    set On        = block @ 0.75, 1
    set Direction = 1, 0
    set Magnitude = 1e3*(1+sin(20*t))
  end
end
subsection Output
  set Probes = corner, middle
  subsection Probe corner
    set Point     = block @ 1, 1
    set Direction = 1, 0
  end
  subsection Probe middle
    set Point = block @ 0.5, 0.5
  end
end
)" + more;
  }

  /// A cube of tetrahedra in a file, held at x = 0, with its weight on a spring.
  std::string cube_of_tetrahedra(const std::string &path)
  {
    return R"(
set Generator = network
set Bodies    = cube
set Gravity   = 0, -9.81, 0
subsection Body cube
  set Type             = solid
  set Dimension        = 3
  set Young's modulus  = 1e7
  set Poisson's ratio  = 0.3
  set Density          = 7850
  set Fixed boundaries = 1
  subsection Mesh
    set File = )" +
           path + R"(
  end
end
subsection Network
  set Links = rod
  subsection Link rod
    set Type      = stop
    set From      = ground
    set To        = cube @ 1, 0.5, 0.5
    set Direction = 0, 1, 0
    set Stiffness = 1e6
  end
end
)" + cube_at_rest;
  }

  /// A square in a file under its weight, with a spring.
  std::string square_of_file(const std::string &path)
  {
    return R"(
set Generator = network
set Bodies    = square
set Gravity   = 3, -9.81
subsection Body square
  set Type             = solid
  set Young's modulus  = 1e7
  set Poisson's ratio  = 0.3
  set Density          = 2000
  set Fixed boundaries = 1
  subsection Mesh
    set File = )" +
           path + R"(
  end
end
subsection Network
  set Links = spring
  subsection Link spring
    set Type      = stop
    set From      = ground
    set To        = square @ 1, 0
    set Direction = 0, 1
    set Stiffness = 1e6
  end
end
subsection Output
  set Probes = corner
  subsection Probe corner
    set Point     = square @ 1, 1
    set Direction = 0, 1
  end
end
subsection Time
  set End = 0
end
)";
  }

  /// A membrane of bilinear elements on the unit square, held on its rim: a user's body with a
  /// user's triangulation, which is distributed if the ranks may share it.
  class MembraneType : public taut::BodyType
  {
  public:
    void distribute(const taut::BodySetting &, const taut::Communicator &processes,
                    std::size_t) const override
    {
      if (processes.size() > 1)
        make_mesh(
            std::make_unique<dealii::parallel::distributed::Triangulation<2>>(processes.of_mpi()));
    }

    std::unique_ptr<taut::Substructure> make(const taut::BodySetting &setting) const override
    {
      if (!mesh)
        make_mesh(std::make_unique<dealii::Triangulation<2>>());
      return part({}, setting.name);
    }

    std::shared_ptr<const taut::DivisibleBody> division(const taut::BodySetting &) const override
    {
      if (!mesh)
        make_mesh(std::make_unique<dealii::Triangulation<2>>());
      return std::make_shared<Division>(*this);
    }

    taut::ContactSurface surface(const taut::BodySetting &,
                                 const std::vector<unsigned int> &) const override
    {
      return {};
    }

  private:
    using Cell = taut::FEBody<2>::Cell;

    class Division : public taut::DivisibleBody
    {
    public:
      explicit Division(const MembraneType &type)
          : type(type), cells_of_rank(type.handler, type.mapping, type.rim)
      {
      }
      const taut::BodyCells &cells() const override { return cells_of_rank.cells(); }
      taut::Communicator processes() const override { return cells_of_rank.processes(); }
      std::size_t cell_at(const taut::Coordinates &x) const override
      {
        return cells_of_rank.cell_at(x);
      }
      std::size_t cell_at_node(unsigned int) const override { return 0; }
      std::unique_ptr<taut::Substructure>
      make_part(const taut::BodySetting &setting,
                const std::vector<unsigned int> &part) const override
      {
        std::vector<Cell> own;
        for (const unsigned int c : part)
          own.push_back(cells_of_rank.cell_iterators()[c]);
        return type.part(own, setting.name);
      }

    private:
      const MembraneType &type;
      const taut::CellDivision<2> cells_of_rank;
    };

    void make_mesh(std::unique_ptr<dealii::Triangulation<2>> empty) const
    {
      mesh = std::move(empty);
      dealii::GridGenerator::hyper_cube(*mesh);
      mesh->refine_global(4);
      for (const auto &cell : mesh->active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[0] < .4)
          cell->set_refine_flag();
      mesh->execute_coarsening_and_refinement();
      handler.reinit(*mesh);
      handler.distribute_dofs(element);
      taut::restrict_to_rank(rim, handler);
      dealii::DoFTools::make_hanging_node_constraints(handler, rim);
      dealii::DoFTools::make_zero_boundary_constraints(handler, rim);
      rim.close();
    }

    /// -div(T grad u) = p with T = 100 N/m, p = 1 Pa, on some cells, or on all of this rank.
    std::unique_ptr<taut::Substructure> part(std::vector<Cell> cells, const std::string &name) const
    {
      taut::FEBody<2>::Options options;
      options.cells = cells;
      if (cells.empty())
        for (const auto &cell : handler.active_cell_iterators())
          if (cell->is_locally_owned())
            cells.push_back(cell);
      const auto all = taut::FEBody<2>::part_dofs(cells, rim);
      const dealii::QGauss<2> points(2);
      dealii::FEValues<2> values(element, points,
                                 dealii::update_values | dealii::update_gradients |
                                     dealii::update_JxW_values);
      dealii::DynamicSparsityPattern entries(all.size());
      std::vector<std::vector<dealii::types::global_dof_index>> rows;
      for (const Cell &cell : cells)
      {
        rows.emplace_back(4);
        cell->get_dof_indices(rows.back());
        for (auto &dof : rows.back())
          dof = std::lower_bound(all.begin(), all.end(), dof) - all.begin();
        for (const auto row : rows.back())
          entries.add_entries(row, rows.back().begin(), rows.back().end());
      }
      dealii::SparsityPattern pattern;
      pattern.copy_from(entries);
      dealii::SparseMatrix<double> mass(pattern), stiffness(pattern);
      dealii::Vector<double> load(all.size());
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        values.reinit(cells[c]);
        for (unsigned int i = 0; i < 4; ++i)
          for (const unsigned int q : values.quadrature_point_indices())
          {
            load[rows[c][i]] += values.shape_value(i, q) * values.JxW(q);
            for (unsigned int j = 0; j < 4; ++j)
            {
              mass.add(rows[c][i], rows[c][j],
                       values.shape_value(i, q) * values.shape_value(j, q) * values.JxW(q));
              stiffness.add(rows[c][i], rows[c][j],
                            100. * (values.shape_grad(i, q) * values.shape_grad(j, q)) *
                                values.JxW(q));
            }
          }
      }
      return std::make_unique<taut::FEBody<2>>(name, handler, mass, dealii::SparseMatrix<double>(),
                                               stiffness, rim, load, options);
    }

    const dealii::FE_Q<2> element{1};
    const dealii::MappingQ<2> mapping{1};
    mutable std::unique_ptr<dealii::Triangulation<2>> mesh;
    mutable dealii::DoFHandler<2> handler;
    mutable dealii::AffineConstraints<double> rim;
  };

  const taut::Register<taut::BodyType, MembraneType> membrane("membrane on ranks", "for a test");

  const char *const membrane_over_stop = R"(
set Generator = network
set Bodies    = membrane
subsection Body membrane
  set Type = membrane on ranks
end
subsection Network
  set Links = stop
  subsection Link stop
    set Type      = stop
    set From      = ground
    set To        = membrane @ 0.5, 0.5
    set Direction = 0, 0, -1
    set Gap       = 1e-4
  end
end
subsection Output
  set Probes = centre
  subsection Probe centre
    set Point     = membrane @ 0.3, 0.5
    set Direction = 0, 0, 1
  end
end
subsection Time
  set End = 0
end
)";
} // namespace

// Claim: a rank has its own cells of the mesh and no others. Expected: all cells, each on one rank,
// shared evenly.
TEST(Ranks, cells_of_a_solid_are_on_one_rank_each)
{
  const Overrides parts = in_parts(8);
  for (const std::string &distribution : distributions)
  {
    expect_shared(block(""), parts + shared_by("block", distribution));
    expect_shared(cube_on_floor(2, 2), parts + shared_by("cube", distribution));
  }
}

// Claim: a run of a process by itself has the whole mesh, after a run of all ranks with the same
// parameters. Expected: all cells.
TEST(Ranks, cells_are_on_each_rank_again_for_a_run_of_its_own)
{
  for (const std::string &distribution : distributions)
  {
    Session session(block(""),
                    in_parts(8) + Overrides{"Output/Field interval=0"} +
                        shared_by("block", distribution),
                    world());
    const taut::CustomBody &body = session.simulation().scene().bodies[0];
    const auto is_distributed = [&] {
      return body.type->division({body.name, body.origin, {}})->is_distributed();
    };
    EXPECT_EQ(is_distributed(), world().size() > 1);
    std::ostringstream log;
    const taut::Simulation alone(session.parameters(), log, taut::Communicator());
    EXPECT_FALSE(is_distributed());
  }
}

// Claim: answers are those of the whole mesh, with held and moved boundaries, loads,
// contacts, links and probes at places where several ranks meet. Expected: one process without
// cuts, U to 1e-9 of the largest, forces to 1e-7; at rest and in motion, F matrix-free and not.
TEST(Ranks, distributed_meshes_give_the_answers_of_whole_ones)
{
  const std::string at_rest = "subsection Time\n  set End = 0\nend\n",
                    in_motion = "subsection Time\n  set Step = 1e-3\n  set End = 0.03\nend\n";
  const Overrides matrix_free = {"Solver/Interface operator=matrix-free"};
  for (const std::string &distribution : distributions)
  {
    for (const unsigned int degree : {1u, 2u})
    {
      const Overrides of_degree = Overrides{"Body block/Degree=" + std::to_string(degree)} +
                                  shared_by("block", distribution);
      const std::string title = distribution + ", degree " + std::to_string(degree);
      expect_same(title + " at rest", block(at_rest), 5, of_degree);
      expect_same(title + " at rest, matrix-free", block(at_rest), 12, of_degree + matrix_free);
      expect_same(title + " in motion", block(in_motion), 4, of_degree);
      expect_same(title + " in motion, matrix-free", block(in_motion), 9, of_degree + matrix_free);
    }
    const Overrides of_cube = shared_by("cube", distribution);
    expect_same(distribution + ", cube", cube_on_floor(2, 2), 8, of_cube);
    expect_same(distribution + ", cube, degree 2", cube_on_floor(2, 1), 6,
                of_cube + Overrides{"Body cube/Degree=2"});
  }
}

// Claim: so they are on meshes that are refined locally, where hanging nodes are on borders between
// ranks, and cells that differ by several levels at a corner are refined alike on any number of
// ranks. Expected: as above.
TEST(Ranks, distributed_meshes_have_hanging_nodes)
{
  const std::string at_rest = "subsection Time\n  set End = 0\nend\n";
  for (const std::string &distribution : distributions)
    for (const unsigned int degree : {1u, 2u})
    {
      const auto refined = [&](const std::string &body, const std::string &where)
      {
        return shared_by(body, distribution) +
               Overrides{"Body " + body + "/Degree=" + std::to_string(degree),
                         "Body " + body + "/Mesh/Refine where=" + where};
      };
      const std::string title = distribution + ", degree " + std::to_string(degree) + ", ";
      for (const unsigned int n_parts : {4u, 9u})
        expect_same(
            title + "block, " + std::to_string(n_parts), block(at_rest), n_parts,
            refined("block", "min(0.5-x, 0.5-y, 0.8/2^t-sqrt((x-0.5)^2+(y-0.5)^2))") +
                Overrides{"Body block/Mesh/Refinements=1", "Body block/Mesh/Local refinements=3"});
      expect_same(
          title + "cube", cube_on_floor(2, 1), 7,
          refined("cube", "min(0.5-x, 0.5-y, z-0.5, 0.9/2^t-sqrt((x-0.5)^2+(y-0.5)^2+(z-0.5)^2))") +
              Overrides{"Body cube/Mesh/Local refinements=2"});
    }
}

// Claim: the parts of a mesh that every rank makes are those of one process, and so are the
// iterations but for rounding. Of a mesh that ranks refine they depend on the number of ranks, and
// few coarse cells keep the iterations within a tenth. Expected: the run of one process.
TEST(Ranks, parts_of_a_mesh_need_no_more_iterations)
{
  const auto compare = [&](const std::string &title, const std::string &text,
                           const unsigned int n_parts, const std::string &distribution,
                           const double bound)
  {
    SCOPED_TRACE(title);
    const Overrides overrides = in_parts(n_parts) +
                                Overrides{"Solver/Interface operator=matrix-free"} +
                                shared_by("cube", distribution);
    const std::array<int, 2> here = iterations(record_nodes_of(text, overrides, world())),
                             one = iterations(record_nodes_of(text, overrides, {}));
    EXPECT_GT(one[0], 0);
    EXPECT_EQ(here[1], one[1]);
    EXPECT_LE(here[0], bound * one[0]);
    figure(ranks_and_comma() + title, double(here[0]) / one[0]);
  };
  compare("METIS", cube_on_floor(10), 27, "METIS", 1.03);
  compare("METIS, refined", cube_on_floor(2, 2), 27, "METIS", 1.03);
  compare("p4est", cube_on_floor(2, 3), 64, "p4est", 1.1);
}

// Claim: a mesh whose new nodes depend on all coarse cells stays whole, unless the ranks refine it
// together. Expected: as above.
TEST(Ranks, meshes_that_cannot_be_cut_stay_whole)
{
  const Overrides plate = {"Body block/Mesh/Generator=plate_with_a_hole",
                           "Body block/Mesh/Arguments=0.1 : 0.5 : 0, 0, 0, 0 : 0.5, 0.5",
                           "Body block/Mesh/Refinements=1",
                           "Body block/Degree=2",
                           "Network/Link spring/To=block @ 0.5, 0.8",
                           "Output/Probe middle/Point=block @ 0.5, 0.9"};
  for (const std::string &distribution : distributions)
  {
    const std::string at_rest = "subsection Time\n  set End = 0\nend\n";
    expect_same(distribution, block(at_rest), 6,
                plate + Overrides{"Body block/Displacement=0: 0, 0"} +
                    shared_by("block", distribution));
    const Overrides few = {"Partition/Number of substructures=3"}; // on four ranks and more
    expect_same(distribution + ", few parts", block(at_rest), 3,
                few + shared_by("block", distribution));
  }
}

// Claim: so do tetrahedra of a file, which METIS shares out, and a user's body on a distributed
// triangulation with hanging nodes. Expected: as above.
TEST(Ranks, distributed_meshes_of_files_and_of_users)
{
  dealii::Triangulation<3> tetrahedra;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(tetrahedra, 3);
  for (const auto &cell : tetrahedra.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->at_boundary(f))
        cell->face(f)->set_boundary_id(cell->face(f)->center()[0] < 1e-9 ? 1 : 2);
  const MeshFile file(tetrahedra);
  for (const unsigned int degree : {1u, 2u})
  {
    const Overrides of_degree = {"Body cube/Degree=" + std::to_string(degree)};
    expect_same("tetrahedra of degree " + std::to_string(degree), cube_of_tetrahedra(file.path()),
                6, of_degree);
  }
  expect_shared(cube_of_tetrahedra(file.path()), in_parts(8));
  for (const std::string form : {"assembled dense", "matrix-free"})
    expect_same("membrane, " + form, membrane_over_stop, 7, {"Solver/Interface operator=" + form});
}

// Claim: a DoF that is held on the cells of one rank alone is held on those of others, too.
// Expected: a square that is held along half of two of its sides, up to where ranks meet; as above.
TEST(Ranks, distributed_meshes_are_held_where_another_rank_has_the_boundary)
{
  dealii::Triangulation<2> square;
  dealii::GridGenerator::hyper_cube(square);
  square.refine_global(3);
  for (const auto &cell : square.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (const dealii::Point<2> x = cell->face(f)->center(); cell->at_boundary(f))
        cell->face(f)->set_boundary_id(std::min(x[0], x[1]) < 1e-9 && x[0] + x[1] < .5 ? 1 : 2);
  for (const unsigned int n_parts : {4u, 7u})
    expect_same(std::to_string(n_parts) + " parts of a square",
                square_of_file(MeshFile(square).path()), n_parts);
}

// Claim: meshes that p4est does not take are an error that says so.
TEST(Ranks, p4est_takes_no_tetrahedra)
{
  dealii::Triangulation<3> tetrahedra;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(tetrahedra, 2);
  const MeshFile file(tetrahedra);
  const std::string message =
      error_of(cube_of_tetrahedra(file.path()), in_parts(6) + shared_by("cube", "p4est"), world());
  // One process shares no mesh.
  EXPECT_EQ(has(message, "p4est takes quadrilaterals and hexahedra; take METIS"),
            world().size() > 1)
      << message;
}

// Claim: mistakes that one rank sees alone end on all ranks with the message of one process.
TEST(Ranks, mistakes_on_distributed_meshes_are_those_of_whole_ones)
{
  const std::string at_rest = "subsection Time\n  set End = 0\nend\n";
  const Overrides mistakes[] = {
      {"Network/Link stop/To=block @ 1.5, 0.3"},
      {"Body block/Displacement=0: 0, 1e-3*(1-y); 3: 0, 1"},
      {"Body block/Displacement=7: 0, 0"},
      {"Body block/Materials=1: 1e7, 0.3, 2000"},
  };
  const Overrides parts = in_parts(6);
  for (const Overrides &mistake : mistakes)
  {
    SCOPED_TRACE(mistake.front());
    const std::string expected = error_of(block(at_rest), mistake + parts, {}),
                      found = error_of(block(at_rest), mistake + parts, world());
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(found, expected);
  }
}
