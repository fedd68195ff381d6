// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of constraints on several ranks: which ones a rank has, and what is made of all of them.
#include "base/gather_entries.h"
#include "interface/distributed_rows.h"
#include <taut/base/archive.h>
#include <taut/interface/constraints.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace taut
{
  void Constraints::share(RowNumbers numbers)
  {
    shared_rows = std::make_shared<const DistributedRows>(
        structure.communicator(), std::move(numbers.here), numbers.n_of_all, common_rows().size());
  }

  /// The same rows on the same ranks, with other common ones.
  void Constraints::share_like(const SharedRows &others)
  {
    shared_rows = std::make_shared<const DistributedRows>(
        static_cast<const DistributedRows &>(others), common_rows().size());
  }

  /// Other rows, cuts first, in place of the first @p n ones.
  void Constraints::replace_first(const std::size_t n, std::vector<ConstraintData> rows)
  {
    const std::size_t n_new = rows.size();
    n_cuts = std::count_if(rows.begin(), rows.end(),
                           [](const ConstraintData &row) { return row.is_cut(); });
    first_common = n_new;
    first_turning = first_turning - n + n_new;
    first_sliding = first_sliding - n + n_new;
    rows.insert(rows.end(),
                std::make_move_iterator(constraints.begin() + static_cast<std::ptrdiff_t>(n)),
                std::make_move_iterator(constraints.end()));
    constraints = std::move(rows);
  }

  void Constraints::distribute(const bool are_distributed)
  {
    if (is_chosen)
      throw std::logic_error("constraints are distributed once");
    is_chosen = true;
    if (!are_distributed)
    {
      if (shared_rows)
        gather_cuts();
      return;
    }
    const std::size_t n = first_turning;
    // A row that all ranks have, and none has terms of, is that of the root.
    std::vector<double> n_holders;
    for (std::size_t i = n_cuts; i < n; ++i)
      n_holders.push_back(constraints[i].terms.empty() ? 0. : 1.);
    structure.communicator().sum(n_holders);
    RowNumbers numbers = {n_of_all() - (size() - n)};
    std::vector<ConstraintData> rows;
    for (std::size_t i = 0; i < n; ++i)
    {
      const bool is_of_root =
          i >= n_cuts && n_holders[i - n_cuts] == 0. && structure.communicator().is_root();
      if (constraints[i].terms.empty() && !is_of_root)
        continue;
      numbers.here.push_back(number(i));
      rows.push_back(std::move(constraints[i]));
    }
    replace_first(n, std::move(rows));
    share(std::move(numbers));
    arrange();
  }

  void Constraints::gather_cuts()
  {
    std::vector<std::size_t> numbers(n_of_all() - common_rows().size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const std::vector<Label> known = labels(numbers);
    std::vector<ConstraintData> cuts(numbers.size());
    for (const std::size_t number : numbers)
      if (const std::size_t i = index(number); i < n_cuts)
        cuts[number] = std::move(constraints[i]);
      else
        cuts[number].name = known[number].name;
    replace_first(n_cuts, std::move(cuts));
    shared_rows = nullptr;
    number_contacts();
    arrange();
  }

  void Constraints::number_contacts()
  {
    of_contacts.clear();
    for (const std::size_t i : rows_but_cuts())
    {
      const std::size_t contact = constraints[i].contact;
      if (contact == no_contact)
        continue;
      of_contacts.resize(std::max(of_contacts.size(), contact + 1));
      if (of_contacts[contact].n++ == 0)
        of_contacts[contact].first = number(i);
    }
  }

  void Constraints::add_up(std::vector<double> &values) const
  {
    if (shared_rows)
      shared_rows->sum(values);
  }

  double Constraints::added_up(double value) const
  {
    if (shared_rows)
      structure.communicator().sum(&value, 1);
    return value;
  }

  namespace
  {
    /// Values of the rows that are no cuts, at their places, on all ranks.
    template <typename Place>
    void collect(const Constraints &constraints, const std::vector<double> &values,
                 const Place &place, std::vector<double> &to)
    {
      for (const std::size_t i : constraints.rows_but_cuts())
        if (const std::size_t at = place(i); at < to.size() && constraints.counts(i))
          to[at] = values[i];
      constraints.add_up(to);
    }
  } // namespace

  std::vector<double> Constraints::of_links(const std::vector<double> &values, const std::size_t n,
                                            std::vector<double> to) const
  {
    to.assign(n, 0.);
    collect(
        *this, values, [&](const std::size_t i) { return constraints[i].link; }, to);
    return to;
  }

  std::vector<double> Constraints::of_contact(const std::vector<double> &values,
                                              const std::size_t contact,
                                              std::vector<double> to) const
  {
    const auto [first, n] = contact < of_contacts.size() ? of_contacts[contact] : RowsOfContact();
    const auto place = [&, first = first](const std::size_t i)
    { return constraints[i].contact == contact ? number(i) - first : no_link; };
    to.assign(n, 0.);
    collect(*this, values, place, to);
    return to;
  }

  std::size_t Constraints::n_of_all() const
  {
    return shared_rows ? shared_rows->n_of_all() : size();
  }

  bool Constraints::is_own(const std::size_t i) const
  {
    return shared_rows ? shared_rows->is_own(i) : structure.communicator().is_root();
  }

  std::size_t Constraints::number(const std::size_t i) const
  {
    return shared_rows ? shared_rows->number(i) : i;
  }

  std::size_t Constraints::index(const std::size_t number) const
  {
    return shared_rows ? shared_rows->index(number) : number;
  }

  void Constraints::sum(const std::initializer_list<std::vector<double> *> vectors) const
  {
    if (shared_rows)
      return shared_rows->sum_rows(vectors);
    sum_together(structure.communicator(), vectors);
  }

  void Constraints::sum_entries(MatrixEntries &entries, const std::size_t n_columns) const
  {
    if (shared_rows)
      return shared_rows->sum_entries(entries, n_columns);
    taut::gather(structure.communicator(), entries);
    entries.compress();
  }

  double Constraints::max(const double value) const
  {
    return shared_rows ? shared_rows->max(value) : value;
  }

  double Constraints::total(const std::vector<double> &values) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (counts(i))
        sum += values[i];
    return added_up(sum);
  }

  void Constraints::pick(std::vector<double> &values) const
  {
    if (!shared_rows)
      return;
    const std::vector<double> all = values;
    shared_rows->pick(all, values);
  }

  void Constraints::gather(const std::vector<double> &values, std::vector<double> &all) const
  {
    if (shared_rows)
      shared_rows->gather(values, all);
    else
      all = values;
  }

  std::vector<Constraints::Label> Constraints::labels(const std::vector<std::size_t> &numbers) const
  {
    std::map<std::size_t, Label> found;
    for (const std::size_t number : numbers)
      if (const std::size_t i = index(number); i < size())
        found[number] = {constraints[i].name, constraints[i].origin};
    if (shared_rows)
    {
      std::map<std::size_t, std::pair<std::string, std::string>> own;
      for (const auto &[number, label] : found)
        if (is_own(index(number)))
          own[number] = {label.name, label.origin};
      for (const std::string &text : structure.communicator().gather(
               archived([&](OutputArchive &archive) { archive << own; })))
      {
        unarchive(text, [&](InputArchive &archive) { archive >> own; });
        for (const auto &[number, label] : own)
          found[number] = {label.first, label.second};
      }
    }
    std::vector<Label> result;
    for (const auto &[number, label] : found)
      result.push_back(label);
    return result;
  }

  std::string Constraints::names(const std::vector<Label> &labels)
  {
    std::string text;
    const std::size_t shown = std::min<std::size_t>(labels.size(), 8);
    for (std::size_t k = 0; k < shown; ++k)
      text += (k == 0 ? "'" : ", '") + labels[k].name + "'";
    if (shown < labels.size())
      text += " and " + std::to_string(labels.size() - shown) + " more";
    return text;
  }

  std::string Constraints::name(const std::size_t number) const
  {
    const std::vector<Label> found = labels({number});
    return found.empty() ? "" : found.front().name;
  }

  namespace
  {
    constexpr double none = -std::numeric_limits<double>::infinity();

    /// The lowest of the numbers is the largest of their opposites.
    std::size_t lowest(const double opposite)
    {
      return opposite == none ? no_link : static_cast<std::size_t>(-opposite);
    }
  } // namespace

  std::size_t Constraints::number_of_first(const std::size_t i) const
  {
    if (!shared_rows)
      return i < size() ? i : no_link;
    return lowest(shared_rows->max(i < size() ? -static_cast<double>(number(i)) : none));
  }

  std::vector<std::size_t> Constraints::numbers_of(const std::vector<std::size_t> &rows) const
  {
    if (!shared_rows)
      return rows;
    MatrixEntries own;
    for (const std::size_t i : rows)
      if (is_own(i))
        own.add(number(i), 0, 1.);
    taut::gather(structure.communicator(), own);
    std::vector<std::size_t> result(own.row.begin(), own.row.end());
    std::sort(result.begin(), result.end());
    return result;
  }

  void Constraints::take_largest(std::vector<double> &values, std::vector<std::size_t> &rows) const
  {
    if (!shared_rows)
      return;
    const std::vector<double> own = values;
    shared_rows->max(values);
    std::vector<double> opposites(rows.size(), none);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k] < size() && !(own[k] < values[k]))
        opposites[k] = -static_cast<double>(number(rows[k]));
    shared_rows->max(opposites);
    std::transform(opposites.begin(), opposites.end(), rows.begin(), lowest);
  }

  std::vector<double> Constraints::of_rows(const std::vector<double> &values,
                                           const std::vector<std::size_t> &numbers) const
  {
    std::vector<double> result(numbers.size(), 0.);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (const std::size_t i = index(numbers[k]); i < size() && counts(i))
        result[k] = values[i];
    add_up(result);
    return result;
  }
} // namespace taut
