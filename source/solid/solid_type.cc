// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/solid_entries.h"

#include "base/about_entry.h"
#include "solid/divisible_solid.h"
#include "substructure/distributed_mesh.h"
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>

#include <deal.II/base/parameter_handler.h>

#include <utility>

namespace taut
{
  namespace
  {
    /// The body type of a solid of either dimension.
    class SolidOf
    {
    public:
      virtual ~SolidOf() = default;
      virtual std::size_t n_dofs() const = 0;
      virtual std::unique_ptr<Substructure> make(const BodySetting &setting) const = 0;
      virtual ContactSurface surface(const std::vector<unsigned int> &boundaries) const = 0;
      virtual std::shared_ptr<const DivisibleBody> division(const BodySetting &setting) const = 0;

      /// As mesh_of_rank(); null: the mesh stays whole.
      virtual std::unique_ptr<SolidOf> of_rank(const Communicator &processes,
                                               const std::vector<unsigned int> &rank_of_cell,
                                               std::vector<unsigned int> &numbers) const = 0;
    };

    template <int dim>
    class SolidIn : public SolidOf
    {
    public:
      SolidIn(const SolidEntries &entries,
              std::unique_ptr<dealii::Triangulation<dim>> triangulation)
          : entries(entries), cells(*triangulation),
            mesh(std::make_shared<SolidMesh<dim>>(std::move(triangulation), entries.degree))
      {
      }

      /// With the whole mesh on this rank.
      static std::unique_ptr<SolidOf> whole(const SolidEntries &entries, const std::string &origin)
      {
        return std::make_unique<SolidIn>(entries, entries.mesh.template make<dim>(origin));
      }

      /// With a mesh of so many DoFs, or more, that the ranks refine together; null: they do not.
      static std::unique_ptr<SolidOf> distributed(const SolidEntries &entries,
                                                  const std::string &origin,
                                                  const Communicator &processes,
                                                  const double least_dofs)
      {
        auto cells = entries.mesh.template make_distributed<dim>(origin, processes, entries.degree,
                                                                 least_dofs);
        return cells ? std::make_unique<SolidIn>(entries, std::move(cells)) : nullptr;
      }

      std::size_t n_dofs() const override { return mesh->dof_handler().n_dofs(); }

      std::unique_ptr<Substructure> make(const BodySetting &setting) const override
      {
        return std::make_unique<ElasticSolid<dim>>(setting.name, mesh,
                                                   entries.template options<dim>(setting, *mesh));
      }

      ContactSurface surface(const std::vector<unsigned int> &boundaries) const override
      {
        ContactSurface surface = mesh->surface({boundaries.begin(), boundaries.end()}).surface;
        surface.thickness = entries.thickness;
        return surface;
      }

      std::shared_ptr<const DivisibleBody> division(const BodySetting &setting) const override
      {
        typename ElasticSolid<dim>::Options options;
        mesh->processes().agree([&] { options = entries.template options<dim>(setting, *mesh); });
        return std::make_shared<DivisibleSolid<dim>>(mesh, options);
      }

      std::unique_ptr<SolidOf> of_rank(const Communicator &processes,
                                       const std::vector<unsigned int> &rank_of_cell,
                                       std::vector<unsigned int> &numbers) const override
      {
        auto own = mesh_of_rank(cells, processes, rank_of_cell, numbers);
        return own ? std::make_unique<SolidIn>(entries, std::move(own)) : nullptr;
      }

    private:
      const SolidEntries &entries;
      dealii::Triangulation<dim> &cells; ///< of the mesh
      const std::shared_ptr<const SolidMesh<dim>> mesh;
    };

    class SolidType : public BodyType
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override { entries.declare(prm); }

      std::size_t n_dofs() const override
      {
        try
        {
          return solid("").n_dofs();
        }
        catch (const UserError &)
        {
          return 0; // make() reports the error
        }
      }

      std::unique_ptr<Substructure> make(const BodySetting &setting) const override
      {
        return about_entry(setting.origin,
                           [&] { return whole_solid(setting.origin).make(setting); });
      }

      void distribute(const BodySetting &setting, const Communicator &processes,
                      const std::size_t least_dofs) const override
      {
        if (is_distributed) // by an earlier run
          made.reset();
        is_distributed = false;
        if (processes.size() == 1 || !entries.can_be_distributed() ||
            (entries.dimension == 2 && least_dofs > 0))
          return;
        const std::string &origin = setting.origin;
        const auto n = static_cast<double>(least_dofs);
        if (auto solid =
                about_entry(origin,
                            [&]
                            {
                              return entries.dimension == 2
                                         ? SolidIn<2>::distributed(entries, origin, processes, n)
                                         : SolidIn<3>::distributed(entries, origin, processes, n);
                            }))
        {
          made = std::move(solid);
          is_distributed = true;
        }
      }

      OwnCells keep_own_cells(const BodySetting &setting, const Communicator &processes,
                              const std::vector<unsigned int> &rank_of_cell) const override
      {
        OwnCells result;
        if (!entries.can_be_distributed())
          return result;
        if (auto own = made->of_rank(processes, rank_of_cell, result.numbers))
        {
          made = std::move(own);
          is_distributed = true;
          result.body = division(setting);
        }
        return result;
      }

      double largest_turn() const override { return entries.largest_turn; }

      std::shared_ptr<const DivisibleBody> division(const BodySetting &setting) const override
      {
        return about_entry(setting.origin, [&] { return solid(setting.origin).division(setting); });
      }

      ContactSurface surface(const BodySetting &setting,
                             const std::vector<unsigned int> &boundaries) const override
      {
        return solid(setting.origin).surface(boundaries);
      }

    private:
      /// Made at its first use, as the mesh takes time.
      const SolidOf &solid(const std::string &origin) const { return first_use(made, origin); }

      /// The solid for one rank alone, which the lengths of droppers may need.
      const SolidOf &whole_solid(const std::string &origin) const
      {
        return is_distributed ? first_use(on_one_rank, origin) : solid(origin);
      }

      const SolidOf &first_use(std::unique_ptr<SolidOf> &solid, const std::string &origin) const
      {
        if (!solid)
          solid = entries.dimension == 2 ? SolidIn<2>::whole(entries, origin)
                                         : SolidIn<3>::whole(entries, origin);
        return *solid;
      }

      SolidEntries entries;
      mutable std::unique_ptr<SolidOf> made, on_one_rank;
      mutable bool is_distributed = false;
    };

    const Register<BodyType, SolidType> solid("solid",
                                              "a linear elastic solid in the plane or in space");
  } // namespace
} // namespace taut
