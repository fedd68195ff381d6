// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid/solid_entries.h"

#include "base/about_entry.h"
#include "solid/divisible_solid.h"
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>

#include <deal.II/base/parameter_handler.h>

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
    };

    template <int dim>
    class SolidIn : public SolidOf
    {
    public:
      SolidIn(const SolidEntries &entries, const std::string &origin)
          : entries(entries), mesh(std::make_shared<SolidMesh<dim>>(
                                  entries.mesh.template make<dim>(origin), entries.degree))
      {
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
        return std::make_shared<DivisibleSolid<dim>>(mesh,
                                                     entries.template options<dim>(setting, *mesh));
      }

    private:
      const SolidEntries &entries;
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
        return about_entry(setting.origin, [&] { return solid(setting.origin).make(setting); });
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
      const SolidOf &solid(const std::string &origin) const
      {
        if (!made && entries.dimension == 2)
          made = std::make_unique<SolidIn<2>>(entries, origin);
        else if (!made)
          made = std::make_unique<SolidIn<3>>(entries, origin);
        return *made;
      }

      SolidEntries entries;
      mutable std::unique_ptr<SolidOf> made;
    };

    const Register<BodyType, SolidType> solid("solid",
                                              "a linear elastic solid in the plane or in space");
  } // namespace
} // namespace taut
