// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/row_flexibilities.h"

#include "time/contact_resolution.h"
#include "time/matrix_norms.h"
#include <taut/base/exceptions.h>
#include <taut/interface/connected_bodies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace taut
{
  namespace
  {
    /// Bound of ratio times share for an energy error of a percent in generalised-alpha: a mass on
    /// a stop with twelve steps in a contact. The ratio of n steps in a contact is pi^2 / (3.9
    /// n^2).
    constexpr double resolved = .018;

    /// Energy loss of a body in an impact, as a share, below which a smooth force is preferred. A
    /// choice: below, an impact may lose its share; above, a conserving force keeps it, but the
    /// phase may be off by the motion of a step.
    constexpr double small_share = .02;

    /// Share above which an impact is more than waves: adaptive steps, too, keep its energy. A
    /// choice: below it, an impact that meets a step longer than Step may lose up to this part of
    /// the energy.
    constexpr double large_share = .1;

    /// Part of the critical damping above which nothing rebounds, as e^2 leaves 4 % of the energy
    /// at most, and steps that resolve a contact without damper, those of the bound above.
    constexpr double no_rebound = .7, steps_of_a_contact = 12.;

    /// Part of the step that is so short that F is that of the mass alone: a frequency omega adds
    /// (1e-3 omega step)^2 / 3.9 to it, 0.3 % at omega step = 100.
    constexpr double short_step = 1e-3;

    /// Part of the flexibility of a massless node that remains with its joined bodies held; below,
    /// a mass stands behind the node. At a half, what joins it is as stiff as its own elements.
    constexpr double own_part = .5;

    /// Number of constraints of connected bodies up to which couplings are entries of F, in a dense
    /// matrix of at most 18 MB; beyond, they are bounds.
    constexpr std::size_t most_columns = 1500;

    /// Samples along the way of a moving constraint. A choice: each costs two columns of F, and
    /// what lies between is judged in the run.
    constexpr int n_places = 400;

    /// Signed part of a translation in a linear form.
    double part_of_translation(const Structure &structure, const Term &term)
    {
      double size = 0., sum = 0.;
      for (std::size_t e = 0; e < term.form.index.size(); ++e)
        if (structure[term.substructure].kind(term.form.index[e]) == 0)
        {
          size += std::fabs(term.form.value[e]);
          sum += term.form.value[e];
        }
      return std::copysign(size, sum);
    }

    /// Rigid and elastic bilateral constraints, and on request unilateral ones between two bodies.
    std::vector<std::size_t> joins(const Constraints &constraints, const bool unilateral,
                                   const std::size_t but)
    {
      std::vector<double> n_bodies(constraints.size(), 0.);
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        std::vector<std::size_t> bodies;
        for (const Term &term : constraints[i].terms)
          if (std::find(bodies.begin(), bodies.end(), term.substructure) == bodies.end())
            bodies.push_back(term.substructure);
        n_bodies[i] = static_cast<double>(bodies.size());
      }
      constraints.sum(n_bodies);
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (i != but && (constraints[i].cone.is_free() || (unilateral && n_bodies[i] > 1.)))
          result.push_back(i);
      return result;
    }
  } // namespace

  /// Finds ratio, share and contact time of the constraints of a system. Elastic constraints are
  /// judged together, as a step closes them together. Rigid constraints are checked only for
  /// massless nodes.
  class ContactResolution::Search
  {
  public:
    Search(const Structure &structure, const Constraints &constraints,
           const SolverParameters &parameters, const double step, std::vector<Row> &of)
        : structure(structure), constraints(constraints), of(of), step(step),
          in_step(structure, constraints, parameters, step),
          at_once(structure, constraints, parameters, short_step * step),
          wholes(structure, constraints,
                 [&](const std::size_t i)
                 { return constraints[i].cone.is_free() && constraints[i].spring.is_rigid(); }),
          closed(joins(constraints, false, no_link))
    {
      const std::vector<double> of_bodies = total_masses(structure);
      mass.assign(wholes.n_groups(), 0.);
      for (std::size_t k = 0; k < structure.size(); ++k)
        mass[wholes.of_body(k)] += of_bodies[k];
      structure.communicator().sum(mass);
    }

    void judge_rigid(const std::vector<char> &without_mass)
    {
      std::vector<std::size_t> massless;
      for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i].unilateral && !of[i].elastic)
        {
          of[i].ratio = std::numeric_limits<double>::infinity();
          if (without_mass[i])
            massless.push_back(i);
        }
      std::vector<double> alone, joined;
      for (const std::size_t number : constraints.numbers_of(massless))
      {
        const std::size_t i = constraints.index(number);
        at_once.column(i, {}, alone);
        at_once.column(i, joins(constraints, true, i), joined);
        if (i < of.size() && joined[i] >= own_part * alone[i])
          of[i].ratio = 0.;
      }
    }

    /// Judges elastic constraints, by their numbers, in each group of connected bodies.
    void judge_elastic(const std::vector<std::size_t> &numbers)
    {
      find_shares(numbers);
      const ConnectedBodies connected(structure, constraints);
      std::vector<double> groups(constraints.size());
      for (std::size_t i = 0; i < groups.size(); ++i)
        groups[i] = static_cast<double>(connected.of_constraint(i));
      groups = constraints.of_rows(groups, numbers);
      std::vector<std::vector<std::size_t>> of_group(connected.n_groups());
      for (std::size_t k = 0; k < numbers.size(); ++k)
        of_group[static_cast<std::size_t>(groups[k])].push_back(numbers[k]);
      for (const std::vector<std::size_t> &group : of_group)
        if (group.size() > most_columns)
          judge_by_bounds(group);
        else
          judge_together(group);
    }

    /// Judges sliding constraints from now until a time [s]; @p moved are those of this search.
    void judge_way(Constraints &moved, const std::vector<std::size_t> &rows, const double until)
    {
      for (int place = 0; place <= (until > 0. ? n_places : 0); ++place)
      {
        if (place > 0 && !move(moved, until * place / n_places))
          return;
        for (const std::size_t i : rows)
          judge_moving(i);
      }
    }

  private:
    /// Judges by entries of F.
    void judge_together(const std::vector<std::size_t> &numbers)
    {
      const std::size_t n = numbers.size();
      const std::vector<double> S = constraints.of_rows(in_step.compliances(), numbers);
      std::vector<std::vector<double>> G(n, std::vector<double>(n, 0.));
      std::vector<double> column;
      for (std::size_t a = 0; a < n; ++a)
      {
        in_step.column(constraints.index(numbers[a]), closed, column);
        const std::vector<double> of_group = constraints.of_rows(column, numbers);
        for (std::size_t b = 0; b < n; ++b)
          G[b][a] = std::max(0., of_group[b]) / std::sqrt(S[a] * S[b]);
      }
      for (const std::vector<std::size_t> &group : coupled_rows(G))
      {
        const double ratio = largest_eigenvalue(G, group);
        for (const std::size_t a : group)
          set_ratio(numbers[a], ratio);
      }
    }

    void set_ratio(const std::size_t number, const double ratio)
    {
      if (const std::size_t i = constraints.index(number); i < of.size())
        of[i].ratio = ratio;
    }

    /// False if a constraint leaves its body; the run reports this when it gets there.
    bool move(Constraints &moved, const double t)
    {
      bool has_left = false;
      try
      {
        moved.update(t);
      }
      catch (const UserError &)
      {
        has_left = true;
      }
      if (structure.communicator().any(has_left))
        return false;
      in_step.update_moving();
      at_once.update_moving();
      return true;
    }

    /// Judges an elastic sliding constraint in its present place.
    void judge_moving(const std::size_t i)
    {
      std::vector<double> column;
      in_step.column(i, closed, column);
      of[i].ratio = std::max(of[i].ratio, column[i] / in_step.compliances()[i]);
      at_once.column(i, closed, column);
      find_share(i, column[i]);
    }

    /// Judges by |F_ij| <= sqrt(F_ii F_jj): the sum of the ratios.
    void judge_by_bounds(const std::vector<std::size_t> &numbers)
    {
      double sum = 0.;
      std::vector<double> column;
      for (const std::size_t number : numbers)
      {
        const std::size_t i = constraints.index(number);
        in_step.column(i, {}, column);
        if (i < of.size() && constraints.counts(i))
          sum += column[i] / in_step.compliances()[i];
      }
      sum = constraints.added_up(sum);
      for (const std::size_t number : numbers)
        set_ratio(number, sum);
    }

    /// Share of a single constraint of this rank, or of none, with F of a short step for f_ii / m
    /// of its joined bodies.
    void find_share(const std::size_t i, const double flexibility)
    {
      double share = 0.;
      const bool is_here = i < of.size();
      for (const Term &term : is_here ? constraints[i].terms : no_terms)
      {
        const double own = structure[term.substructure].is_lumped()
                               ? at_once.of_body(term) / flexibility
                               : std::pow(part_of_translation(structure, term), 2) /
                                     (flexibility * at_once.mass_factor() *
                                      mass[wholes.of_body(term.substructure)]);
        share = std::max(share, own);
      }
      share = structure.communicator().max(share);
      if (is_here)
        of[i].share = std::min(1., share);
    }

    /// Shares on elastic bodies: constraints that push a body to the same side act together. Bodies
    /// joined by rigid bilateral constraints count as one, so that cuts of a wire have no effect.
    void find_shares(const std::vector<std::size_t> &numbers)
    {
      std::vector<double> column, of_whole(2 * wholes.n_groups(), 0.);
      const auto side = [&](const Term &term) {
        return 2 * wholes.of_body(term.substructure) + (part_of_translation(structure, term) < 0.);
      };
      for (const std::size_t number : numbers)
      {
        const std::size_t i = constraints.index(number);
        at_once.column(i, closed, column);
        find_share(i, i < of.size() ? column[i] : 0.);
        if (i >= of.size())
          continue;
        const double flexibility = column[i] * at_once.mass_factor();
        of[i].contact_time =
            std::acos(-1.) / std::sqrt(constraints[i].spring.stiffness * std::max(flexibility, 0.));
        const double critical =
            2. * std::sqrt(constraints[i].spring.stiffness / std::max(flexibility, 0.));
        of[i].damping_ratio = constraints[i].spring.damping / critical;
        of[i].comes_back_slowly =
            of[i].damping_ratio >= no_rebound && of[i].contact_time >= steps_of_a_contact * step;
        for (const Term &term : constraints[i].terms)
        {
          const double part = part_of_translation(structure, term);
          of_whole[side(term)] += part * part / (flexibility * mass[side(term) / 2]);
        }
      }
      structure.communicator().sum(of_whole);
      std::vector<double> shares(numbers.size(), 0.);
      for (std::size_t k = 0; k < numbers.size(); ++k)
      {
        const std::size_t i = constraints.index(numbers[k]);
        if (i >= of.size())
          continue;
        shares[k] = of[i].share;
        for (const Term &term : constraints[i].terms)
          if (!structure[term.substructure].is_lumped())
            shares[k] = std::max(shares[k], of_whole[side(term)]);
      }
      structure.communicator().max(shares);
      for (std::size_t k = 0; k < numbers.size(); ++k)
        if (const std::size_t i = constraints.index(numbers[k]); i < of.size())
          of[i].share = std::min(1., shares[k]);
    }

    const Structure &structure;
    const Constraints &constraints;
    std::vector<Row> &of;
    const double step; ///< [s]
    RowFlexibilities in_step, at_once;
    const ConnectedBodies wholes; ///< bodies joined by rigid bilateral constraints
    std::vector<double> mass;     ///< of each group in wholes [kg]
    const std::vector<std::size_t> closed;
    const std::vector<Term> no_terms;
  };

  ContactResolution::ContactResolution(const Structure &structure, const Constraints &all,
                                       const SolverParameters &parameters, const double step,
                                       const double longest, const double until)
      : adaptive(longest > step), of(all.size())
  {
    judge(structure, all, parameters, step, longest, until);
    find_first(all);
  }

  void ContactResolution::judge(const Structure &structure, const Constraints &all,
                                const SolverParameters &parameters, const double step,
                                const double longest, const double until)
  {
    Constraints constraints = all; // slides along its way
    const std::vector<char> without_mass = constraints.without_mass();
    std::vector<std::size_t> elastic, moving;
    bool is_needed = false;
    for (std::size_t i = 0; i < of.size(); ++i)
    {
      const ConstraintData &constraint = constraints[i];
      of[i].unilateral = constraint.cone.may_open();
      of[i].elastic = !constraint.spring.is_rigid();
      of[i].may_conserve = constraint.cone.may_open() && of[i].elastic && constraints.is_fixed(i) &&
                           !without_mass[i];
      if (constraint.cone.may_open() && of[i].elastic)
        (constraints.slides(i) ? moving : elastic).push_back(i);
      is_needed = is_needed || (constraint.cone.may_open() && (of[i].elastic || without_mass[i]));
    }
    if (!constraints.any(is_needed))
    {
      for (Row &row : of)
        row.ratio = row.unilateral ? std::numeric_limits<double>::infinity() : 0.;
      return;
    }
    Search search(structure, constraints, parameters, step, of);
    search.judge_rigid(without_mass);
    search.judge_elastic(constraints.numbers_of(elastic));
    if (moving.empty())
      return;
    if (longest > step)
      Search(structure, constraints, parameters, longest, of).judge_way(constraints, moving, until);
    else
      search.judge_way(constraints, moving, until);
  }

  bool ContactResolution::is_resolved(const std::size_t i) const
  {
    const Row &row = of[i];
    return !row.unilateral || (row.ratio <= 1. && row.ratio * row.share <= resolved &&
                               !(adaptive && row.may_conserve && row.share > large_share));
  }

  void ContactResolution::find_first(const Constraints &constraints)
  {
    std::size_t first_rigid = no_link, first_unresolved = no_link;
    std::vector<double> are_rigid(of.size(), 0.);
    for (std::size_t i = of.size(); i-- > 0;)
    {
      if (acts_as_rigid(i))
        first_rigid = i;
      if (!is_resolved(i))
        first_unresolved = i;
      are_rigid[i] = acts_as_rigid(i);
    }
    rigid = constraints.number_of_first(first_rigid);
    unresolved = constraints.number_of_first(first_unresolved);
    if (unresolved != no_link)
      unresolved_is_rigid = constraints.of_rows(are_rigid, {unresolved}).front() > 0.;
  }

  std::vector<char> ContactResolution::conserving() const
  {
    std::vector<char> result;
    for (const Row &row : of)
      result.push_back(row.may_conserve && row.share > small_share && !row.comes_back_slowly);
    return result;
  }

  std::vector<LongestStep> ContactResolution::longest_steps(const Constraints &constraints) const
  {
    std::vector<LongestStep> result(of.size());
    for (std::size_t i = 0; i < of.size(); ++i)
      if (of[i].may_conserve && of[i].share > small_share && of[i].damping_ratio > 0.)
        result[i] = {of[i].contact_time, of[i].damping_ratio, constraints[i].spring.law.get()};
    return result;
  }
} // namespace taut
