// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/substructure/structure.h>

namespace taut
{
  Structure::Structure(const Scene &scene)
      : wires(scene.wires.size()), mechanism_of_mass(scene.masses.size())
  {
    for (std::size_t i = 0; i < scene.wires.size(); ++i)
    {
      const Wire &wire = scene.wires[i];
      tangents.push_back(wire.tangent());
      normals.push_back(wire.normal());
      if (wire.has_axial)
      {
        wires[i].axial = substructures.size();
        substructures.push_back(std::make_unique<WireComponent>(scene, i, WireMotion::axial));
      }
      if (wire.transverse != TransverseKind::none)
      {
        wires[i].transverse = substructures.size();
        substructures.push_back(std::make_unique<WireComponent>(scene, i, WireMotion::transverse));
      }
    }
    for (const std::vector<std::size_t> &members : connected_masses(scene))
    {
      for (const std::size_t mass : members)
        mechanism_of_mass[mass] = substructures.size();
      substructures.push_back(std::make_unique<Mechanism>(scene, members));
    }
  }

  std::size_t Structure::n_dofs() const
  {
    std::size_t n = 0;
    for (const auto &substructure : substructures)
      n += substructure->n_dofs();
    return n;
  }

  BlockVector Structure::zero() const
  {
    BlockVector U;
    for (const auto &substructure : substructures)
      U.emplace_back(substructure->n_dofs(), 0.);
    return U;
  }

  void Structure::motion(const Attachment &point, const bool rotational, const Point &direction,
                         const double factor, std::vector<Term> &terms) const
  {
    const auto append = [&](const std::size_t k, const double f, SparseVector form)
    {
      for (double &v : form.value)
        v *= f;
      if (!form.index.empty())
        terms.push_back({k, std::move(form)});
    };
    SparseVector form;
    if (point.kind == Attachment::Kind::mass)
    {
      const std::size_t k = mechanism_of_mass[point.index];
      static_cast<const Mechanism &>(*substructures[k])
          .motion(point.index, rotational, direction, form);
      append(k, factor, form);
    }
    else if (point.kind == Attachment::Kind::wire)
    {
      const WireParts &parts = wires[point.index];
      const Point &t = tangents[point.index], &n = normals[point.index];
      const double along = direction.x * t.x + direction.y * t.y,
                   across = direction.x * n.x + direction.y * n.y;
      const auto wire = [&](const std::size_t k) -> const WireComponent &
      { return static_cast<const WireComponent &>(*substructures[k]); };
      if (rotational)
      {
        wire(parts.transverse).slope_at(point.position, form);
        append(parts.transverse, factor, form);
        return;
      }
      if (parts.axial != ground && along != 0.)
      {
        wire(parts.axial).value_at(point.position, form);
        append(parts.axial, factor * along, form);
      }
      if (parts.transverse != ground && across != 0.)
      {
        wire(parts.transverse).value_at(point.position, form);
        append(parts.transverse, factor * across, form);
      }
    }
  }

  double evaluate(const std::vector<Term> &terms, const BlockVector &U)
  {
    double sum = 0.;
    for (const Term &term : terms)
      sum += term.form.dot(U[term.substructure]);
    return sum;
  }
} // namespace taut
