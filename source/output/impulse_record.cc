// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/distance_to_range.h"

#include "output/impulse_of_step.h"
#include "output/impulse_record.h"
#include "time/stored_row_records.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace taut
{
  namespace
  {
    /// Ends of steps with impulses, fewest and most, and numbers at these ends; of more steps every
    /// second one is kept, or fourth, and so on. Even, so that the last one is kept.
    constexpr std::size_t fewest_ends = 1000, most_ends_of_few = 16000, most_numbers = 1000000;

    /// What a rigid unilateral constraint that does not slide acts on.
    struct Ends
    {
      std::vector<std::size_t> dofs; ///< of lumped bodies, by number; empty: others, too
      std::vector<double> values;    ///< of its linear form at the start
    };

    /// Constraints between the same bodies that may share an impulse. Two act on opposite sides, as
    /// floor and ceiling, or are one.
    constexpr std::size_t least_shared = 3;

    std::vector<Ends> lumped_ends(const Structure &structure, const Constraints &constraints,
                                  const std::vector<std::size_t> &rows)
    {
      double most_dofs = 1.;
      for (std::size_t k = 0; k < structure.size(); ++k)
        if (structure[k].is_lumped())
          most_dofs = std::max<double>(most_dofs, structure[k].n_dofs());
      const auto stride = static_cast<std::size_t>(structure.communicator().max(most_dofs));
      constexpr double on_elements = std::numeric_limits<double>::infinity();
      MatrixEntries acts_on;
      const auto add = [&](const std::size_t i, const Term &term, const double part)
      {
        const bool is_lumped = structure[term.substructure].is_lumped();
        for (std::size_t e = 0; e < term.form.index.size(); ++e)
          acts_on.add(constraints.number(rows[i]),
                      structure.number(term.substructure) * stride +
                          (is_lumped ? term.form.index[e] : 0),
                      is_lumped ? part * term.form.value[e] : on_elements);
      };
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        for (const std::vector<Term> *const form : constraints[rows[i]].forms())
          for (const Term &term : *form)
            add(i, term, 0.); // where it acts at other positions
        for (const Term &term : constraints[rows[i]].terms)
          add(i, term, 1.);
      }
      constraints.sum_entries(acts_on, structure.all_bodies().size() * stride);
      std::vector<std::map<std::size_t, double>> forms(rows.size());
      const std::size_t first = rows.empty() ? 0 : rows.front();
      for (std::size_t e = 0; e < acts_on.size(); ++e)
        forms[constraints.index(acts_on.row[e]) - first][acts_on.column[e]] += acts_on.value[e];
      std::vector<Ends> ends(rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        bool may_share = constraints[rows[i]].cone.may_open() &&
                         constraints[rows[i]].spring.is_rigid() && !constraints.slides(rows[i]);
        for (const auto &[dof, value] : forms[i])
          may_share = may_share && std::isfinite(value);
        for (const auto &[dof, value] : forms[i])
          if (may_share)
          {
            ends[i].dofs.push_back(dof);
            ends[i].values.push_back(value);
          }
      }
      return ends;
    }

    /// Whether linear forms on the same DoFs depend on each other.
    bool are_dependent(const std::vector<const Ends *> &forms)
    {
      constexpr double rounding = 1e-12;
      const std::size_t n_dofs = forms.front()->dofs.size();
      if (forms.size() > n_dofs)
        return true;
      dealii::LAPACKFullMatrix<double> matrix(forms.size(), n_dofs);
      for (std::size_t i = 0; i < forms.size(); ++i)
        for (std::size_t j = 0; j < n_dofs; ++j)
          matrix(i, j) = forms[i]->values[j];
      matrix.compute_svd();
      return !(matrix.singular_value(forms.size() - 1) > rounding * matrix.singular_value(0));
    }

    /// A rank may lack rows that act where a common row acts: the lowest number is that of the rank
    /// with all of them.
    void agree_on_common_rows(const Constraints &constraints, std::vector<std::size_t> &first)
    {
      if (!constraints.shared())
        return;
      const std::size_t n = constraints.common_rows().size();
      std::vector<double> opposites;
      for (std::size_t k = first.size() - n; k < first.size(); ++k)
        opposites.push_back(-static_cast<double>(first[k]));
      constraints.communicator().max(opposites);
      std::transform(opposites.begin(), opposites.end(), first.end() - n,
                     [](const double number) { return static_cast<std::size_t>(-number); });
    }
  } // namespace

  ImpulseRecord::ImpulseRecord(const Structure &structure, const Constraints &constraints,
                               const ConnectedBodies &groups, const State &start)
      : constraints(constraints), n_groups(groups.n_groups()), times(1, start.time)
  {
    for (const std::size_t i : constraints.rows_but_cuts())
    {
      rows.push_back(i);
      multiplier.push_back(start.multiplier[i]);
    }
    const std::vector<Ends> ends = lumped_ends(structure, constraints, rows);
    std::map<std::pair<std::vector<std::size_t>, bool>, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < ends.size(); ++i)
      if (!ends[i].dofs.empty())
        alike[{ends[i].dofs, constraints[rows[i]].rotational}].push_back(i);
    std::vector<std::size_t> first(rows.size()); // numbers
    for (std::size_t i = 0; i < rows.size(); ++i)
      first[i] = constraints.number(rows[i]);
    for (const auto &[key, same] : alike)
    {
      std::vector<const Ends *> forms;
      for (const std::size_t i : same)
        forms.push_back(&ends[i]);
      if (same.size() >= least_shared && are_dependent(forms))
        for (const std::size_t i : same)
          first[i] = constraints.number(rows[same.front()]);
    }
    agree_on_common_rows(constraints, first);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const std::size_t own = constraints.index(first[i]);
      const bool counts = own < constraints.size() && constraints.counts(own);
      if (own != rows[i])
      {
        item_of.push_back(counts ? item_of[own - rows.front()] : no_link);
        continue;
      }
      item_of.push_back(counts ? items.size() : no_link);
      if (!counts)
        continue;
      items.push_back({rows[i], 2 * groups.of_constraint(rows[i]) + constraints[rows[i]].rotational,
                       constraints[rows[i]].cone.may_open()});
    }
    const auto n_of_all =
        static_cast<std::size_t>(constraints.added_up(static_cast<double>(items.size())));
    most_ends = std::clamp(most_numbers / std::max<std::size_t>(1, n_of_all), fewest_ends,
                           most_ends_of_few) /
                2 * 2;
    impulse.assign(items.size(), 0.);
    impulses.reserve(std::min((most_ends + 1) * items.size(), most_numbers));
    impulses = impulse;
  }

  void ImpulseRecord::record(const State &state, const StepReport &report)
  {
    for (std::size_t i = 0; i < multiplier.size(); ++i)
    {
      if (item_of[i] == no_link)
        continue;
      const double N = state.multiplier[rows[i]];
      impulse[item_of[i]] +=
          impulse_of_step(constraints, report, rows[i], multiplier[i], N, state.last_step);
      multiplier[i] = N;
    }
    if (n_steps++ % stride != 0) // the last end is none of those to be kept
    {
      times.pop_back();
      impulses.resize(impulses.size() - impulse.size());
    }
    times.push_back(state.time);
    impulses.insert(impulses.end(), impulse.begin(), impulse.end());
    if (times.size() > most_ends && n_steps % stride == 0)
      keep_every_second_end();
  }

  std::vector<double> ImpulseRecord::sizes() const
  {
    std::vector<double> result(2 * n_groups, 0.);
    for (std::size_t i = 0; i < items.size(); ++i)
      result[items[i].group] += std::fabs(impulse[i]);
    constraints.add_up(result);
    return result;
  }

  void ImpulseRecord::keep_every_second_end()
  {
    const std::size_t n_kept = (times.size() + 1) / 2, n = impulse.size();
    for (std::size_t k = 1; k < n_kept; ++k)
    {
      times[k] = times[2 * k];
      std::copy_n(impulses.begin() + static_cast<std::ptrdiff_t>(2 * k * n), n,
                  impulses.begin() + static_cast<std::ptrdiff_t>(k * n));
    }
    times.resize(n_kept);
    impulses.resize(n_kept * n);
    stride *= 2;
  }

  std::vector<ImpulseRecord::Instant>
  ImpulseRecord::instants(const std::vector<double> &of_times) const
  {
    std::vector<Instant> result;
    std::size_t next = 1;
    for (const double t : of_times)
    {
      while (next + 1 < times.size() && times[next] < t)
        ++next;
      result.push_back(
          {next, std::min(1., (t - times[next - 1]) / (times[next] - times[next - 1]))});
    }
    return result;
  }

  double ImpulseRecord::at(const Instant &instant, const std::size_t item) const
  {
    const double *const behind = impulses.data() + instant.next * items.size() + item;
    const double before = *(behind - items.size());
    return before + instant.part * (*behind - before);
  }

  ImpulseRecord::Difference ImpulseRecord::difference(const ImpulseRecord &other,
                                                      std::vector<double> largest,
                                                      const std::vector<double> &late,
                                                      const double shift,
                                                      const double rounding) const
  {
    if (other.times.size() < 2)
      return {};
    double most = 0., most_at_end = 0.;
    std::size_t row = no_link, row_at_end = no_link;
    const std::size_t n = items.size(), n_times = times.size();
    // The ends of steps, and the times that are a bit earlier and later than each of them.
    std::vector<double> shifted[2] = {times, times};
    for (std::size_t k = 1; k < n_times; ++k)
    {
      const double time = shift * (times[k] - times[k - 1]);
      shifted[0][k] -= time;
      shifted[1][k - 1] += time;
    }
    const std::vector<Instant> same = other.instants(times), earlier = other.instants(shifted[0]),
                               later = other.instants(shifted[1]);
    std::vector<double> own = largest;
    for (std::size_t k = 0; k < n_times; ++k)
      for (std::size_t i = 0; i < n; ++i)
      {
        double &of_others = largest[items[i].group], &of_own = own[items[i].group];
        of_others = std::max(of_others, std::fabs(other.at(same[k], i)));
        of_own = std::max(of_own, std::fabs(impulses[k * n + i]));
      }
    if (constraints.shared())
      for (std::vector<double> *const of_all : {&largest, &own})
        constraints.communicator().max(*of_all);
    for (std::size_t q = 0; q < own.size(); ++q)
      if (own[q] > much_smaller * largest[q])
        largest[q] = own[q];
    std::size_t n_both = 0;
    for (; n_both < n_times && times[n_both] <= other.times.back() + rounding; ++n_both)
      ;
    for (std::size_t k = 0; k < n_both; ++k)
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t q = items[i].group;
        std::size_t first = k, last = k;
        while (first > 0 && times[k] - times[first - 1] <= shift * late[q])
          --first;
        while (last + 1 < n_both && times[last + 1] - times[k] <= shift * late[q])
          ++last;
        const auto of_own = [&](const std::size_t j) { return impulses[j * n + i]; };
        const auto of_others = [&](const std::size_t j) {
          return other.at(j <= last ? same[j] : j == last + 1 ? earlier[k] : later[k], i);
        };
        double off = distance_to_range(of_own(k), first, last + 2, of_others);
        // Near the end an impact that is early here would follow there.
        if (last + 1 == n_both && k > 0)
          off = std::min(
              off, distance_to_range(other.at(same[k], i), std::min(first, k - 1), k, of_own));
        if (const double d = ratio(off, largest[q]); d > most || d != d)
          std::tie(most, row) = std::pair(d, items[i].row);
        const double at_end = ratio(std::fabs(of_own(k) - other.at(same[k], i)), largest[q]);
        if (k + 1 == n_both && items[i].may_open && at_end > most_at_end)
          std::tie(most_at_end, row_at_end) = std::pair(at_end, items[i].row);
      }
    return named(most, row, most_at_end, row_at_end);
  }

  /// The differences of all ranks.
  ImpulseRecord::Difference ImpulseRecord::named(const double largest, const std::size_t row,
                                                 const double at_end,
                                                 const std::size_t row_at_end) const
  {
    std::vector<double> differences;
    for (const double own : {largest, at_end}) // what is no number is largest of all
      differences.push_back(own == own ? own : std::numeric_limits<double>::infinity());
    std::vector<std::size_t> numbers = {row, row_at_end};
    constraints.take_largest(differences, numbers);
    return {differences[0], differences[1], constraints.name(numbers[0]),
            constraints.name(numbers[1])};
  }

  /// What a row has: its multiplier, and the impulses of the item of which it is the first.
  struct ImpulseRecord::Stored
  {
    double multiplier = 0., impulse = 0.;
    std::vector<double> impulses = {};

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &multiplier &impulse &impulses;
    }
  };

  template <typename Archive>
  void ImpulseRecord::store(Archive &archive)
  {
    const std::size_t n = items.size();
    std::vector<Stored> of_rows(constraints.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      of_rows[rows[r]].multiplier = multiplier[r];
    for (std::size_t i = 0; i < n; ++i)
    {
      Stored &first = of_rows[items[i].row];
      first.impulse = impulse[i];
      for (std::size_t at = i; at < impulses.size(); at += n)
        first.impulses.push_back(impulses[at]);
    }
    store_of_rows(archive, constraints, of_rows);
    archive &times &stride &n_steps;
    impulses.resize(n * times.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      multiplier[r] = of_rows[rows[r]].multiplier;
    for (std::size_t i = 0; i < n; ++i)
    {
      const Stored &first = of_rows[items[i].row];
      impulse[i] = first.impulse;
      for (std::size_t k = 0; k < first.impulses.size(); ++k)
        impulses[k * n + i] = first.impulses[k];
    }
  }

  template void ImpulseRecord::store(OutputArchive &);
  template void ImpulseRecord::store(InputArchive &);
} // namespace taut
