// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/output/reactions.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace taut
{
  namespace
  {
    /// Rows of a symmetric matrix, by number.
    std::map<unsigned int, LinearForm> rows_of(const SymmetricMatrix &matrix,
                                               const std::vector<unsigned int> &wanted)
    {
      std::map<unsigned int, LinearForm> constraints;
      for (const unsigned int i : wanted)
        constraints[i];
      matrix.visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            for (const auto &[constraint, column] : {std::make_pair(i, j), std::make_pair(j, i)})
            {
              const auto found = constraints.find(constraint);
              if (found != constraints.end() &&
                  (i != j || found->second.index.empty() || found->second.index.back() != column))
                found->second.add(column, value);
            }
          });
      return constraints;
    }
  } // namespace

  std::vector<SupportPoint> support_points(const Scene &scene)
  {
    std::vector<SupportPoint> points;
    for (std::size_t i = 0; i < scene.supports.size(); ++i)
    {
      const Support &support = scene.supports[i];
      const bool several = support.positions.size() > 1;
      for (std::size_t k = 0; k < support.positions.size(); ++k)
        points.push_back({support.name + (several ? " " + std::to_string(k + 1) : ""), i,
                          support.positions[k], support.motion == WireMotion::slope});
    }
    return points;
  }

  Reactions::Reactions(const Scene &scene, const SceneBodies &structure) : structure(structure)
  {
    std::map<std::size_t, std::vector<unsigned int>> fixed;
    for (const SupportPoint &point : support_points(scene))
    {
      const Support &support = scene.supports[point.support];
      const Wire &wire = scene.wires[support.wire];
      std::vector<Term> terms;
      structure.motion({Attachment::Kind::wire, support.wire, point.position}, point.is_moment,
                       support.motion == WireMotion::axial ? wire.tangent() : wire.normal(), 1.,
                       terms);
      Place place;
      place.is_here = !terms.empty();
      place.fixed = support.fixed;
      place.stiffness = support.stiffness;
      place.damping = support.damping;
      if (place.is_here)
      {
        // Supports are at nodes, where one shape function is 1 and all others are 0.
        const LinearForm &form = terms[0].form;
        const auto one = std::max_element(form.value.begin(), form.value.end(),
                                          [](const double a, const double b)
                                          { return std::fabs(a) < std::fabs(b); });
        place.body = terms[0].substructure;
        place.dof = form.index[one - form.value.begin()];
        if (place.fixed)
          fixed[place.body].push_back(place.dof);
      }
      places.push_back(std::move(place));
    }
    for (const auto &[body, dofs] : fixed)
    {
      const auto constraints = rows_of(structure[body].mass(), dofs);
      for (Place &place : places)
        if (place.is_here && place.fixed && place.body == body)
          place.mass = constraints.at(place.dof);
    }
    values.assign(places.size(), 0.);
  }

  void Reactions::update(const Reference &reference, const State &state)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const Place &place = places[i];
      values[i] = 0.;
      if (!place.is_here)
        continue;
      const std::size_t k = place.body;
      const unsigned int dof = place.dof;
      if (place.fixed)
        values[i] = place.mass.dot(state.A[k]) - state.balance[k][dof];
      else
        values[i] = -place.stiffness * (reference.displacement[k][dof] + state.U[k][dof]) -
                    place.damping * state.V[k][dof];
    }
    structure.communicator().sum(values);
  }

  void Reactions::update_start(const Reference &reference, State state,
                               const Constraints &constraints)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      std::vector<double> &r = state.balance[k];
      body.external_force(state.time, r);
      body.damping().vmult_add(-1., state.V[k].data(), r.data());
      body.stiffness().vmult_add(-1., state.U[k].data(), r.data());
      body.stiffness().vmult_add(-1., reference.displacement[k].data(), r.data());
    }
    constraints.add_forces(state.multiplier, state.balance);
    update(reference, state);
  }
} // namespace taut
