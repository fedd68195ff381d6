// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/substructure/structure.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace taut
{
  Structure::Structure(const Scene &scene, const Partition &partition)
      : wires(scene.wires.size()), mechanism_of_mass(scene.masses.size())
  {
    for (std::size_t i = 0; i < scene.wires.size(); ++i)
    {
      const Wire &wire = scene.wires[i];
      tangents.push_back(wire.tangent());
      normals.push_back(wire.normal());
      lengths.push_back(wire.length());
      const std::vector<double> nodes = grid(scene, i);
      for (const Partition::Piece &piece : partition.wires[i])
      {
        wires[i].begins.push_back(nodes[piece.first]);
        wires[i].part.push_back(piece.part);
      }
      if (wire.has_axial)
        add_pieces(scene, i, WireMotion::axial, partition.wires[i], wires[i].axial);
      if (wire.transverse != TransverseKind::none)
        add_pieces(scene, i, WireMotion::transverse, partition.wires[i], wires[i].transverse);
    }
    for (const std::vector<std::size_t> &members : connected_masses(scene))
    {
      for (const std::size_t mass : members)
        mechanism_of_mass[mass] = substructures.size();
      substructures.push_back(std::make_unique<Mechanism>(scene, members));
    }
  }

  void Structure::add_pieces(const Scene &scene, const std::size_t wire, const WireMotion motion,
                             const std::vector<Partition::Piece> &pieces,
                             std::vector<std::size_t> &indices)
  {
    const std::vector<double> nodes = grid(scene, wire);
    const WireComponent *left = nullptr;
    for (std::size_t p = 0; p < pieces.size(); ++p)
    {
      const std::size_t last = p + 1 < pieces.size() ? pieces[p + 1].first : nodes.size() - 1;
      auto right = std::make_unique<WireComponent>(scene, wire, motion, pieces[p].first, last);
      if (left)
        for (unsigned int k = 0; k < (left->has_slopes() ? 2u : 1u); ++k)
        {
          std::ostringstream name;
          name << right->name() << (k == 1 ? " slope" : "") << " cut at " << nodes[pieces[p].first]
               << " m";
          CutRow row{name.str(), {{indices.back(), {}}, {substructures.size(), {}}}};
          row.terms[0].form.add(left->last_dof() + k, 1.);
          row.terms[1].form.add(right->first_dof() + k, -1.);
          cuts.push_back(std::move(row));
        }
      left = right.get();
      indices.push_back(substructures.size());
      substructures.push_back(std::move(right));
    }
  }

  std::size_t Structure::piece(const WireParts &parts, const double s) const
  {
    const double same = 1e-12 * lengths[&parts - wires.data()];
    const auto after = std::upper_bound(parts.begins.begin() + 1, parts.begins.end(), s + same);
    return after - parts.begins.begin() - 1;
  }

  unsigned int Structure::part(const std::size_t wire, const double s) const
  {
    return wires[wire].part[piece(wires[wire], s)];
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
      const std::size_t p = piece(parts, point.position);
      if (rotational)
      {
        wire(parts.transverse[p]).slope_at(point.position, form);
        append(parts.transverse[p], factor, form);
        return;
      }
      if (!parts.axial.empty() && along != 0.)
      {
        wire(parts.axial[p]).value_at(point.position, form);
        append(parts.axial[p], factor * along, form);
      }
      if (!parts.transverse.empty() && across != 0.)
      {
        wire(parts.transverse[p]).value_at(point.position, form);
        append(parts.transverse[p], factor * across, form);
      }
    }
  }

  double magnitude(const std::vector<Term> &terms, const BlockVector &U)
  {
    double sum = 0.;
    for (const Term &term : terms)
      sum += std::fabs(term.form.dot(U[term.substructure]));
    return sum;
  }

  double evaluate(const std::vector<Term> &terms, const BlockVector &U)
  {
    double sum = 0.;
    for (const Term &term : terms)
      sum += term.form.dot(U[term.substructure]);
    return sum;
  }
} // namespace taut
