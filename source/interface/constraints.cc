// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "interface/check_constraint.h"
#include <taut/base/exceptions.h>
#include <taut/interface/constraints.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

namespace taut
{
  ConstraintData geometric_spring(const std::string &name, const ConstraintData &link,
                                  const std::size_t segment, const Coordinates &direction,
                                  const double stiffness, const Coordinates &motion)
  {
    ConstraintData result{name, link.origin};
    result.spring.stiffness = stiffness;
    result.terms = static_cast<const TurningDirection &>(*link.geometry).along(segment, direction);
    result.gap = -dot(direction, motion);
    return result;
  }

  Constraints::Constraints(const Lasting<Structure> bodies, std::vector<ConstraintData> all)
      : structure(bodies), constraints(std::move(all))
  {
    sort();
    number_contacts();
    for (const std::size_t i : sliding_rows())
      place(i).set_course({});
    check({0, first_sliding});
    arrange();
    check(sliding_rows());
  }

  Constraints::Constraints(const Lasting<Structure> bodies, std::vector<ConstraintData> all,
                           RowNumbers numbers)
      : Constraints(bodies, std::move(all))
  {
    n_all_cuts = numbers.n_of_all;
    share(std::move(numbers));
    number_contacts();
  }

  Constraints::Constraints(const Constraints &others, std::vector<ConstraintData> all)
      : Constraints(others.structure, std::move(all))
  {
    n_all_cuts = others.n_all_cuts;
    first_common = others.first_common;
    of_contacts = others.of_contacts;
    if (others.shared_rows)
      share_like(*others.shared_rows);
  }

  void Constraints::check(const Rows &rows) const
  {
    structure.communicator().agree(
        [&]
        {
          for (const std::size_t i : rows)
            check_constraint(constraints[i], structure);
        });
  }

  const TurningDirection &Constraints::turning(const std::size_t i) const
  {
    return static_cast<const TurningDirection &>(*constraints[i].geometry);
  }

  MovingPlace &Constraints::place(const std::size_t i) const
  {
    return static_cast<MovingPlace &>(*constraints[i].geometry);
  }

  double Constraints::distance_beyond(const std::size_t i, const double t) const
  {
    constexpr double out_of_reach = 10.; // [m], above all gaps of lines
    return slides(i) && place(i).is_beyond(t) ? out_of_reach : 0.;
  }

  /// Moves a sliding constraint to its place at time @p t.
  void Constraints::move(const std::size_t i, const double t)
  {
    ConstraintData &constraint = constraints[i];
    constraint.terms.clear();
    place(i).append_terms(t, constraint.terms);
    constraint.gap = place(i).gap(t) + distance_beyond(i, t);
    check_terms(constraint, constraint.terms, structure);
    if (!std::isfinite(constraint.gap))
      throw EntryError(constraint.origin,
                       "constraint '" + constraint.name +
                           "': its place says no finite gap at t = " + std::to_string(t) + " s");
  }

  void Constraints::sort()
  {
    std::stable_sort(constraints.begin(), constraints.end(),
                     [](const ConstraintData &a, const ConstraintData &b)
                     { return a.kind() < b.kind(); });
    const auto n_up_to = [&](const Geometry::Kind last)
    {
      return std::count_if(constraints.begin(), constraints.end(),
                           [&](const ConstraintData &constraint)
                           { return constraint.kind() <= last; });
    };
    first_turning = n_up_to(Geometry::Kind::fixed);
    first_sliding = n_up_to(Geometry::Kind::turning);
    const auto end_of_fixed = constraints.begin() + static_cast<std::ptrdiff_t>(first_turning);
    n_cuts = std::stable_partition(constraints.begin(), end_of_fixed,
                                   [](const ConstraintData &c) { return c.is_cut(); }) -
             constraints.begin();
    if (!shared_rows)
      n_all_cuts = first_common = n_cuts;
    first_segments.assign(1, 0);
    for (const std::size_t i : turning_rows())
      first_segments.push_back(first_segments.back() + turning(i).size());
  }

  void Constraints::arrange()
  {
    entries.clear();
    sizes.clear();
    std::fill(row_index.begin(), row_index.end(), no_link);
    for (const std::size_t i : turning_rows())
      constraints[i].gap = turning(i).gap(turning(i).start.data());
    for (const std::size_t i : sliding_rows())
      move(i, 0.);
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (constraints[i].link == no_link)
        continue;
      row_index.resize(std::max(row_index.size(), constraints[i].link + 1), no_link);
      row_index[constraints[i].link] = i;
    }
    begin.assign(1, 0);
    for (const std::size_t i : fixed_rows())
      append(i);
    std::sort(sizes.begin(), sizes.end(),
              [](const Size &a, const Size &b) {
                return std::tie(a.body, a.kind, a.constraint) <
                       std::tie(b.body, b.kind, b.constraint);
              });
    n_fixed_sizes = sizes.size();
    turn_to(structure.zero(), structure.zero());
    append_varying();
  }

  /// Appends entries and sizes of a constraint. At a node most entries are zero; their sizes count,
  /// as a multiplier may be not-a-number.
  void Constraints::append(const std::size_t i)
  {
    const std::size_t first_size = sizes.size();
    for (const auto &[k, form, of] : constraints[i].terms)
      for (std::size_t j = 0; j < form.index.size(); ++j)
      {
        const unsigned int body = static_cast<unsigned int>(k), dof = form.index[j],
                           kind = structure[k].kind(dof);
        if (form.value[j] != 0.)
          entries.push_back({form.value[j], body, dof});
        const auto known =
            std::find_if(sizes.begin() + first_size, sizes.end(),
                         [&](const Size &s) { return s.body == body && s.kind == kind; });
        if (known == sizes.end())
          sizes.push_back({std::fabs(form.value[j]), body, kind, static_cast<unsigned int>(i)});
        else
          known->value = std::max(known->value, std::fabs(form.value[j]));
      }
    begin.push_back(entries.size());
  }

  void Constraints::append_varying()
  {
    begin.resize(first_turning + 1);
    entries.resize(begin.back());
    sizes.resize(n_fixed_sizes);
    for (const std::size_t i : varying_rows())
      append(i);
  }

  void Constraints::set_conserving(const std::vector<char> &conserving)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      constraints[i].spring.conserving = conserving[i];
  }

  void Constraints::update(const double t)
  {
    for (const std::size_t i : sliding_rows())
      move(i, t);
    append_varying();
  }

  void Constraints::follow(const BodyVectors &reference, const BodyVectors &U, const BodyVectors &V,
                           const double start, const double end)
  {
    const auto motion = [&](const std::vector<Term> &form, const double t)
    {
      double sum = evaluate(form, reference) + evaluate(form, U) + (t - start) * evaluate(form, V);
      structure.communicator().sum(&sum, 1);
      return sum;
    };
    for (const std::size_t i : sliding_rows())
      place(i).follow(std::ref(motion), start, end); // a reference allocates nothing
  }

  std::vector<std::vector<double>> Constraints::courses() const
  {
    std::vector<std::vector<double>> result;
    copy_courses(result);
    return result;
  }

  void Constraints::copy_courses(std::vector<std::vector<double>> &to) const
  {
    to.resize(size() - first_sliding);
    for (const std::size_t i : sliding_rows())
    {
      to[i - first_sliding].clear();
      place(i).append_course(to[i - first_sliding]);
    }
  }

  void Constraints::set_courses(const std::vector<std::vector<double>> &courses)
  {
    for (std::size_t k = 0; k < courses.size(); ++k)
      place(first_sliding + k).set_course(courses[k]);
  }

  double Constraints::share_of_convection(const std::size_t i, const double t,
                                          const BodyVectors &reference, const BodyVectors &U) const
  {
    slope.clear();
    place(i).append_rates(t, slope);
    check_terms(constraints[i], slope, structure);
    return evaluate(slope, reference) + evaluate(slope, U);
  }

  double Constraints::profile_rate(const std::size_t i, const double t, const double step) const
  {
    const MovingPlace &moving = place(i);
    // Central differences of fourth order: the error is below the rounding of resolved motions.
    const double delta = 1e-2 * step;
    return (8. * (moving.gap(t + delta) - moving.gap(t - delta)) -
            (moving.gap(t + 2. * delta) - moving.gap(t - 2. * delta))) /
           (12. * delta);
  }

  std::vector<char> Constraints::acts_on(std::vector<unsigned int> (Substructure::*wanted)()
                                             const) const
  {
    std::vector<double> count(constraints.size(), 0.);
    std::vector<std::vector<unsigned int>> dofs;
    for (std::size_t k = 0; k < structure.size(); ++k)
      dofs.push_back((structure[k].*wanted)());
    const auto is_wanted = [&](const std::size_t k, const unsigned int dof)
    { return std::binary_search(dofs[k].begin(), dofs[k].end(), dof); };
    for (const std::size_t i : fixed_rows())
      for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
        count[i] += is_wanted(entries[e].body, entries[e].dof);
    // A sliding constraint changes its DoFs along a body, but not those of lumped masses.
    for (const std::size_t i : sliding_rows())
      for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
        if (structure[entries[e].body].is_lumped())
          count[i] += is_wanted(entries[e].body, entries[e].dof);
    for (const std::size_t i : turning_rows())
      for (const std::vector<Term> *const motion : turning(i).forms())
        for (const Term &term : *motion)
          for (const unsigned int dof : term.form.index)
            count[i] += is_wanted(term.substructure, dof);
    sum(count);
    std::vector<char> result;
    for (const double n_dofs : count)
      result.push_back(n_dofs > 0.);
    return result;
  }

  std::vector<double> Constraints::motions(const BodyVectors &U) const
  {
    std::vector<double> result(constraints.size());
    share_of_motions(U, result);
    sum(result);
    return result;
  }

  void Constraints::share_of_motions(const BodyVectors &U, std::vector<double> &motion) const
  {
    const Entry *e = entries.data();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      double sum = 0.;
      for (const Entry *const end = entries.data() + begin[i + 1]; e != end; ++e)
        sum += e->value * U[e->body][e->dof];
      motion[i] = sum;
    }
  }

  void Constraints::share_of_motions(const BodyVectors &U, std::vector<double> &motion,
                                     std::vector<double> &terms_size) const
  {
    const Entry *e = entries.data();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      double sum = 0., size = 0.;
      for (const Entry *const end = entries.data() + begin[i + 1]; e != end; ++e)
      {
        const double term = e->value * U[e->body][e->dof];
        sum += term;
        size += std::fabs(term);
      }
      motion[i] = sum;
      terms_size[i] = size;
    }
  }

  void Constraints::add_force(const std::size_t i, const double N, BodyVectors &P) const
  {
    const Entry *const end = entries.data() + begin[i + 1];
    for (const Entry *e = entries.data() + begin[i]; e != end; ++e)
      P[e->body][e->dof] += N * e->value;
  }

  void Constraints::add_forces(const std::vector<double> &N, BodyVectors &P) const
  {
    const Entry *e = entries.data();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      const Entry *const end = entries.data() + begin[i + 1];
      for (const double force = N[i]; force != 0. && e != end; ++e)
        P[e->body][e->dof] += force * e->value;
      e = end;
    }
  }

  void Constraints::largest_forces(const std::vector<double> &N,
                                   std::vector<std::array<double, 2>> &result) const
  {
    result.assign(structure.size(), {0., 0.});
    for (auto size = sizes.begin(); size != sizes.end();)
    {
      const unsigned int body = size->body, kind = size->kind;
      double largest = result[body][kind];
      for (; size != sizes.end() && size->body == body && size->kind == kind; ++size)
      {
        const double force = size->value * std::fabs(N[size->constraint]);
        largest = force > largest || std::isnan(force) ? force : largest;
      }
      result[body][kind] = largest;
    }
  }

  double ConstraintSpring::force(const double u) const
  {
    return law ? law->force(u) : u * stiffness;
  }

  double ConstraintSpring::compression(const double N) const
  {
    return law ? law->elongation(N) : N / stiffness;
  }

  double ConstraintSpring::energy(const double u) const
  {
    return law ? law->energy(u) : is_rigid() ? 0. : .5 * stiffness * u * u;
  }

  std::string ConstraintSpring::fault() const
  {
    if (!(stiffness > 0.))
      return "its stiffness is " + to_text(stiffness) +
             " N/m; take a positive one, or none for a rigid constraint";
    if (law && stiffness != law->largest_stiffness())
      return "it has a law and a stiffness, " + to_text(stiffness) +
             " N/m; the law is that of the spring, so leave the stiffness out";
    if (law && is_rigid())
      return "the largest stiffness of its law is infinite; take a finite one";
    if (!(damping >= 0.) || std::isinf(damping))
      return "its damping is " + to_text(damping) +
             " N s/m; take a finite one that is not negative";
    if (damping > 0. && is_rigid())
      return "its damping, " + to_text(damping) +
             " N s/m, is beside a spring, and it is rigid; give it a stiffness, or no damping";
    return "";
  }
} // namespace taut
