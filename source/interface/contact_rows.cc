// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/interface/contact_rows.h>

#include <algorithm>
#include <sstream>

namespace taut
{
  ContactRows::ContactRows(const Scene &scene, const Structure &structure)
      : scene(scene), structure(structure), row_index(scene.links.size())
  {
    for (const bool moving : {false, true})
    {
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        if (link.moving() != moving)
          continue;
        Row row;
        row.name = link.name;
        row.link = i;
        row.unilateral = link.unilateral();
        row.moving = moving;
        row.rotational = link.rotational;
        row.stiffness = link.stiffness;
        row.damping = link.damping;
        set_terms(row, 0.);
        row_index[i] = rows.size();
        rows.push_back(std::move(row));
      }
      if (!moving)
      {
        for (const CutRow &cut : structure.cut_rows())
        {
          Row row;
          row.name = cut.name;
          row.rotational = cut.rotational;
          row.stiffness = std::numeric_limits<double>::infinity();
          row.terms = cut.terms;
          rows.push_back(std::move(row));
        }
        fixed = rows.size();
      }
    }
  }

  double ContactRows::position(const std::size_t i, const double t) const
  {
    const Link &link = scene.links[rows[i].link];
    return link.to.position + link.speed * t;
  }

  void ContactRows::set_terms(Row &row, const double t) const
  {
    const Link &link = scene.links[row.link];
    Attachment to = link.to;
    row.gap = link.gap;
    if (row.moving)
    {
      to.position += link.speed * t;
      const double length = scene.wires[to.index].length();
      // A step that ends on the end of the wire up to rounding is on the wire.
      if (to.position < -1e-9 * length || to.position > (1. + 1e-9) * length)
      {
        std::ostringstream out;
        out << "sliding contact '" << link.name << "' leaves wire '" << scene.wires[to.index].name
            << "' at t = " << t << " s, position " << to.position << " m of " << length
            << " m. End the run earlier or lengthen the wire.";
        throw EntryError(link.origin, out.str());
      }
      row.gap += link.profile(to.position, t);
    }
    const double sign = link.kind == LinkKind::dropper ? -1. : 1.;
    row.terms.clear();
    structure.motion(to, link.rotational, link.direction, sign, row.terms);
    structure.motion(link.from, link.rotational, link.direction, -sign, row.terms);
  }

  void ContactRows::update(const double t)
  {
    for (std::size_t i = fixed; i < rows.size(); ++i)
      set_terms(rows[i], t);
  }

  std::vector<double> ContactRows::motions(const BlockVector &U) const
  {
    std::vector<double> result(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      result[i] = evaluate(rows[i].terms, U);
    structure.communicator().sum(result);
    return result;
  }

  void ContactRows::add_forces(const std::vector<double> &N, BlockVector &P) const
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (N[i] != 0.)
        for (const Term &term : rows[i].terms)
          term.form.add_to(N[i], P[term.substructure]);
  }

  std::string ContactRows::names(const std::vector<std::size_t> &indices) const
  {
    std::string text;
    const std::size_t shown = std::min<std::size_t>(indices.size(), 8);
    for (std::size_t k = 0; k < shown; ++k)
      text += (k == 0 ? "'" : ", '") + rows[indices[k]].name + "'";
    if (shown < indices.size())
      text += " and " + std::to_string(indices.size() - shown) + " more";
    return text;
  }
} // namespace taut
