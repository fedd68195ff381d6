// SPDX-License-Identifier: LGPL-2.1-or-later

#include "simulation/free_bodies.h"
#include "base/gather_entries.h"
#include "base/groups.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace taut
{
  namespace
  {
    using Vector = std::vector<double>;

    /// Removes the part of @p v in a basis of orthogonal unit vectors, and adds the rest to the
    /// basis unless it is rounding.
    void extend(std::vector<Vector> &basis, Vector v)
    {
      const auto dot = [](const Vector &a, const Vector &b)
      { return std::inner_product(a.begin(), a.end(), b.begin(), 0.); };
      const double size = std::sqrt(dot(v, v));
      // Two passes, as one leaves the rounding of the removed part.
      for (int pass = 0; pass < 2; ++pass)
        for (const Vector &b : basis)
        {
          const double part = dot(v, b);
          for (std::size_t i = 0; i < v.size(); ++i)
            v[i] -= part * b[i];
        }
      const double rest = std::sqrt(dot(v, v));
      if (!(rest > 1e-9 * size))
        return;
      for (double &x : v)
        x /= rest;
      basis.push_back(std::move(v));
    }

    /// Work of the force of a linear form on the rigid body modes of a body.
    Vector work(const std::vector<Term> &terms, const std::size_t body,
                const Substructure::NullSpace &null_space)
    {
      Vector result(null_space.vectors.size(), 0.);
      for (const Term &term : terms)
        if (term.substructure == body)
          for (std::size_t j = 0; j < result.size(); ++j)
            result[j] += term.form.dot(null_space.vectors[j]);
      return result;
    }

    /// Whether a place of each turning link is no place of a body of any rank.
    std::vector<char> held_links(const Structure &structure, const Constraints &constraints)
    {
      std::vector<double> n_forms; // of each place
      for (const std::size_t i : constraints.turning_rows())
        for (const LinkEnd &place : constraints.turning(i).places)
          n_forms.push_back(static_cast<double>(
              std::count_if(place.motion.begin(), place.motion.end(),
                            [](const std::vector<Term> &terms) { return !terms.empty(); })));
      structure.communicator().sum(n_forms);
      std::vector<char> result;
      std::size_t next = 0;
      for (const std::size_t i : constraints.turning_rows())
      {
        result.push_back(0);
        for (std::size_t p = 0; p < constraints.turning(i).places.size(); ++p)
          result.back() |= n_forms[next++] == 0.;
      }
      return result;
    }

    /// What a turning link holds: its segments also across themselves, like a pendulum.
    std::vector<std::vector<Term>> motions_of(const TurningDirection &link)
    {
      std::vector<std::vector<Term>> result;
      for (std::size_t k = 0; k < link.size(); ++k)
        for (const Coordinates &axis :
             {Coordinates{1., 0., 0.}, Coordinates{0., 1., 0.}, Coordinates{0., 0., 1.}})
          result.push_back(link.along(k, axis));
      return result;
    }
  } // namespace

  std::vector<char> free_bodies(const Structure &structure,
                                const std::vector<Substructure::NullSpace> &null_spaces,
                                const Constraints &constraints, const Vector &multiplier)
  {
    const std::size_t n = null_spaces.size(), ground = structure.all_bodies().size();
    std::vector<std::vector<Vector>> opposed(n);
    MatrixEntries ends, joins; // of closed rows; of bodies by number, and the ground
    for (std::size_t k = 0; k < n; ++k)
      if (null_spaces[k].vectors.empty())
        joins.add(structure.number(k), ground, 1.);
    const std::vector<char> is_held = held_links(structure, constraints);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (!constraints[i].cone.is_closed(multiplier[i]))
        continue;
      const std::vector<std::vector<Term>> forms =
          constraints.turns(i) ? motions_of(constraints.turning(i))
                               : std::vector<std::vector<Term>>{constraints[i].terms};
      std::set<std::size_t> own;
      for (const Term &term : constraints[i].terms)
        own.insert(term.substructure);
      for (const std::size_t k : own)
      {
        ends.add(constraints.number(i), structure.number(k), 1.);
        for (const std::vector<Term> &form : forms)
          if (!null_spaces[k].vectors.empty())
            extend(opposed[k], work(form, k, null_spaces[k]));
      }
      if (constraints.turns(i) && is_held[constraints.turning_index(i)])
        ends.add(constraints.number(i), ground, 1.);
    }
    // A row with one body is between it and the ground, unless it turns.
    constraints.sum_entries(ends, ground + 1);
    for (std::size_t e = 0, last = 0; e < ends.size(); e = last)
    {
      while (last < ends.size() && ends.row[last] == ends.row[e])
        joins.add(ends.column[e], ends.column[last++], 1.);
      if (last == e + 1 && !constraints.turns(constraints.index(ends.row[e])))
        joins.add(ends.column[e], ground, 1.);
    }
    gather(structure.communicator(), joins);
    Groups bodies(ground + 1);
    for (std::size_t e = 0; e < joins.size(); ++e)
      bodies.join(joins.row[e], joins.column[e]);
    std::vector<char> result(n);
    for (std::size_t k = 0; k < n; ++k)
      result[k] = !bodies.are_joined(structure.number(k), ground) ||
                  opposed[k].size() < null_spaces[k].vectors.size();
    return result;
  }

  std::vector<std::string> warnings_of_unheld_wires(const Scene &scene)
  {
    std::vector<std::string> result;
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const Wire &wire = scene.wires[w];
      if (!(wire.tension > 0.) || wire.transverse == TransverseKind::none ||
          wire.foundation_stiffness > 0.)
        continue;
      const bool has_support = std::any_of(
          scene.supports.begin(), scene.supports.end(),
          [&](const Support &support)
          { return support.wire == w && component_of(support.motion) != WireMotion::axial; });
      const auto is_here = [&](const Attachment &end)
      { return end.kind == Attachment::Kind::wire && end.index == w; };
      const bool has_link =
          std::any_of(scene.links.begin(), scene.links.end(),
                      [&](const Link &link) { return !link.moving() && link.any_place(is_here); });
      if (!has_support && !has_link)
        result.push_back(to_text("wire '", wire.name, "' has a tension of ", wire.tension,
                                 " N and neither a support nor a link across it: it falls as a "
                                 "whole. Hold its ends, with a support at 0, ",
                                 wire.length(), " m"));
    }
    return result;
  }
} // namespace taut
