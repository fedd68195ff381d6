// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "time/stored_row_records.h"
#include <taut/output/impact_watch.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace taut
{
  namespace
  {
    /// Part of the largest rate so far below which a constraint rests: rounding of steps.
    constexpr double rest = 1e-9;

    /// Growth of a force in a step that means an impact: weights and resolved motions change forces
    /// by parts of themselves.
    constexpr double growth = 2.;

    /// Part of the largest force of an impact below which other forces are rounding.
    constexpr double rounding = 1e-9;

    /// First DoF of each body in a list over all ranks, and the number of DoFs.
    std::vector<std::size_t> first_dofs(const Structure &structure)
    {
      std::vector<std::size_t> first = {0};
      for (const Structure::Body &body : structure.all_bodies())
        first.push_back(first.back() + body.n_dofs);
      return first;
    }
  } // namespace

  /// Constraints with an impact in a step; none if none of them was closing.
  std::vector<std::size_t> ImpactWatch::struck(const StepView &step) const
  {
    std::vector<std::size_t> result;
    double strongest = 0.;
    for (const std::size_t i : step.constraints.rows_but_cuts())
    {
      const ConstraintData &constraint = step.constraints[i];
      const double N = step.state.multiplier[i];
      if (!constraint.cone.may_open() || !constraint.spring.is_rigid() || !(N > growth * force[i]))
        continue;
      result.push_back(i);
      if (rate[i] < -rest * largest[constraint.rotational])
        strongest = std::max(strongest, N);
    }
    strongest = step.constraints.max(strongest);
    const auto is_none = [&](const std::size_t i)
    { return !(strongest > 0. && step.state.multiplier[i] > rounding * strongest); };
    result.erase(std::remove_if(result.begin(), result.end(), is_none), result.end());
    return result;
  }

  /// Those of @p constraints, of this rank, that share a body with another one of any rank. Called
  /// by all ranks together.
  std::vector<std::size_t> ImpactWatch::sharing(const StepView &step,
                                                const std::vector<std::size_t> &constraints) const
  {
    const SceneBodies &structure = step.structure;
    const std::vector<std::size_t> first = first_dofs(structure);
    const auto visit = [&](const std::size_t i, const auto &act)
    {
      std::vector<std::size_t> met;
      for (const Term &term : step.constraints[i].terms)
      {
        const std::size_t k = term.substructure, begin = first[structure.number(k)];
        for (std::size_t e = 0; e < term.form.index.size(); ++e)
          if (term.form.value[e] != 0.)
            met.push_back(begin + (structure[k].is_lumped() ? term.form.index[e] : 0));
      }
      std::sort(met.begin(), met.end());
      met.erase(std::unique(met.begin(), met.end()), met.end());
      std::for_each(met.begin(), met.end(), act);
    };
    std::vector<double> n(first.back(), 0.), shares(step.constraints.size(), 0.);
    for (const std::size_t i : constraints)
      visit(i, [&](const std::size_t place) { n[place] += 1.; });
    processes.sum(n);
    for (std::size_t j = 0; j < constraints.size(); ++j)
      visit(constraints[j],
            [&](const std::size_t place)
            {
              if (n[place] > 1.)
                shares[constraints[j]] = 1.;
            });
    step.constraints.sum(shares);
    std::vector<std::size_t> result;
    for (const std::size_t i : constraints)
      if (shares[i] > 0.)
        result.push_back(i);
    return result;
  }

  void ImpactWatch::record(const StepView &step)
  {
    const State &state = step.state;
    const bool is_start = !is_running;
    is_running = true;
    rows = &step.constraints;
    if (!is_start && !(step.report.method.c.restitution > 0.))
      return;
    if (!is_start)
    {
      const std::vector<std::size_t> all = struck(step);
      const bool some =
          step.constraints.shared() ? step.constraints.any(!all.empty()) : all.size() > 1;
      const std::vector<std::size_t> together =
          some ? step.constraints.numbers_of(sharing(step, all)) : std::vector<std::size_t>();
      if (!together.empty() && n_steps++ == 0)
      {
        first = state.time;
        names = step.constraints.names(together);
      }
    }
    rate = is_start ? step.constraints.motions(state.V) : state.rate;
    force = state.multiplier;
    for (const std::size_t i : step.constraints.rows_but_cuts())
    {
      double &of_kind = largest[step.constraints[i].rotational];
      of_kind = std::max(of_kind, std::fabs(rate[i]));
    }
    for (double &of_kind : largest)
      of_kind = step.constraints.max(of_kind);
  }

  template <typename Archive>
  void ImpactWatch::store(Archive &archive)
  {
    std::vector<std::pair<double, double>> of_rows(rows->size());
    for (std::size_t i = 0; i < rate.size(); ++i)
      of_rows[i] = {rate[i], force[i]};
    store_of_rows(archive, *rows, of_rows);
    rate.clear();
    force.clear();
    for (const auto &[of_rate, of_force] : of_rows)
    {
      rate.push_back(of_rate);
      force.push_back(of_force);
    }
    archive &is_running &largest[0] & largest[1] & n_steps &first &names;
  }

  void ImpactWatch::save(OutputArchive &archive)
  {
    if (rows != nullptr) // after a step
      store(archive);
  }

  void ImpactWatch::resume(InputArchive &archive, const StepView &step)
  {
    rows = &step.constraints;
    store(archive);
  }

  void ImpactWatch::report(std::ostream &log, bool) const
  {
    if (n_steps == 0)
      return;
    // The text has its own number of digits.
    log << to_text("Impacts: in ", n_steps, n_steps == 1 ? " step" : " steps, first",
                   " at t = ", first, " s at ", names,
                   ", contacts that share a body were struck together: restitution then holds at "
                   "all of them at once, not at one after the other. If their order matters, take "
                   "steps in which bodies move less than the gaps between them\n");
  }
} // namespace taut
