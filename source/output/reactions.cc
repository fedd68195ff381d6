// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/reactions.h"

#include <map>
#include <unordered_map>
#include <utility>

namespace taut
{
  namespace
  {
    /// Forces of a matrix along forms, form . (M x), as forms on x: into @p products, by one visit.
    void add_products(const SymmetricMatrix &matrix, const std::vector<const LinearForm *> &forms,
                      const std::vector<LinearForm *> &products)
    {
      std::unordered_multimap<unsigned int, std::pair<std::size_t, double>> weights;
      for (std::size_t p = 0; p < forms.size(); ++p)
        for (std::size_t i = 0; i < forms[p]->index.size(); ++i)
          weights.emplace(forms[p]->index[i], std::make_pair(p, forms[p]->value[i]));
      std::vector<std::map<unsigned int, double>> results(forms.size());
      const auto add = [&](const unsigned int i, const unsigned int j, const double value)
      {
        const auto [begin, end] = weights.equal_range(i);
        for (auto w = begin; w != end; ++w)
          results[w->second.first][j] += w->second.second * value;
      };
      matrix.visit(
          [&](const unsigned int i, const unsigned int j, const double value)
          {
            add(i, j, value);
            if (i != j)
              add(j, i, value);
          });
      for (std::size_t p = 0; p < forms.size(); ++p)
        for (const auto &[dof, value] : results[p])
          products[p]->add(dof, value);
    }

    /// Removes zero shape functions: at a node, all but one.
    LinearForm without_zeros(const LinearForm &form)
    {
      LinearForm result;
      for (std::size_t i = 0; i < form.index.size(); ++i)
        if (form.value[i] != 0.)
          result.add(form.index[i], form.value[i]);
      return result;
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
                          support.positions[k], is_slope(support.motion)});
    }
    return points;
  }

  Reactions::Reactions(const Scene &scene, const SceneBodies &structure) : structure(structure)
  {
    for (std::size_t k = 0; k < structure.size(); ++k)
      is_held.emplace_back(structure[k].n_dofs(), 0);
    for (const SupportPoint &point : support_points(scene))
    {
      const Support &support = scene.supports[point.support];
      std::vector<Term> terms;
      structure.motion(support.wire, point.position, support.motion, terms);
      Place place;
      place.is_here = !terms.empty();
      place.fixed = support.fixed;
      place.stiffness = support.stiffness;
      place.damping = support.damping;
      place.free_of_force = support.fixed ? 0. : support.prescribed(0., 0.);
      if (place.is_here)
      {
        place.body = terms[0].substructure;
        place.form = without_zeros(terms[0].form);
        for (const unsigned int dof : place.form.index)
          if (place.fixed)
            is_held[place.body][dof] = 1;
      }
      places.push_back(std::move(place));
    }
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<const LinearForm *> forms;
      std::vector<LinearForm *> products;
      for (Place &place : places)
        if (place.is_here && place.fixed && place.body == k)
        {
          forms.push_back(&place.form);
          products.push_back(&place.mass);
        }
      if (!forms.empty())
        add_products(structure[k].mass(), forms, products);
    }
    values.assign(places.size(), 0.);
  }

  /// The balance of a state has all forces of constraints but mean forces. With a velocity
  /// projection it has mean forces of sliding constraints, too.
  void Reactions::update(const Reference &reference, const State &state,
                         const Constraints &constraints, const StepReport &report)
  {
    set_forces(reference, state);
    for (std::size_t i = 0; i < report.method.rules.size(); ++i)
      if (const RowRule &rule = report.method.rules[i];
          rule.is_mean() && !(rule.corrected && constraints.slides(i)))
        subtract(constraints[i], state.multiplier[i]);
    structure.communicator().sum(values);
  }

  /// Subtracts form . B N for the places of a constraint.
  void Reactions::subtract(const ConstraintData &constraint, const double N)
  {
    if (N == 0.)
      return;
    for (const Term &term : constraint.terms)
      for (std::size_t t = 0; t < term.form.index.size(); ++t)
      {
        const unsigned int dof = term.form.index[t];
        if (!is_held[term.substructure][dof])
          continue;
        for (std::size_t p = 0; p < places.size(); ++p)
          if (places[p].fixed && places[p].is_here && places[p].body == term.substructure)
            for (std::size_t e = 0; e < places[p].form.index.size(); ++e)
              if (places[p].form.index[e] == dof)
                values[p] -= places[p].form.value[e] * term.form.value[t] * N;
      }
  }

  void Reactions::set_forces(const Reference &reference, const State &state)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const Place &place = places[i];
      values[i] = 0.;
      if (!place.is_here)
        continue;
      const std::size_t k = place.body;
      const LinearForm &form = place.form;
      if (place.fixed)
        values[i] = place.mass.dot(state.A[k]) - form.dot(state.balance[k]);
      else
        values[i] = -place.stiffness * (form.dot(reference.displacement[k]) + form.dot(state.U[k]) -
                                        place.free_of_force) -
                    place.damping * form.dot(state.V[k]);
    }
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
      std::vector<double> f;
      body.internal_force(displacement(reference, state, k), {}, f);
      for (std::size_t i = 0; i < f.size(); ++i)
        r[i] -= f[i];
    }
    constraints.add_forces(state.multiplier, state.balance);
    set_forces(reference, state);
    structure.communicator().sum(values);
  }
} // namespace taut
