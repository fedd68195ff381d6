// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/interface/check_constraint.h>
#include <taut/interface/constraints.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace taut
{
  double ConstraintData::compression(const double N) const
  {
    return law ? law->elongation(N) : N / stiffness;
  }

  double ConstraintData::stored_energy(const double u) const
  {
    return law ? law->energy(u) : std::isinf(stiffness) ? 0. : .5 * stiffness * u * u;
  }

  Constraints::Constraints(const Structure &structure, std::vector<ConstraintData> all)
      : structure(structure), constraints(std::move(all))
  {
    for (const ConstraintData &constraint : constraints)
      if (constraint.place)
        constraint.place->set_course({});
    const auto check = [&](const bool moving)
    {
      structure.communicator().agree(
          [&]
          {
            for (const ConstraintData &constraint : constraints)
              if ((constraint.place != nullptr) == moving)
                check_constraint(constraint, structure);
          });
    };
    check(false);
    arrange();
    check(true);
  }

  /// Puts a constraint that moves where it is at time @p t.
  void Constraints::place(const std::size_t i, const double t)
  {
    ConstraintData &constraint = constraints[i];
    constraint.terms = constraint.place->terms(t);
    constraint.gap = constraint.place->gap(t);
    check_terms(constraint, constraint.terms, structure);
    if (!std::isfinite(constraint.gap))
      throw EntryError(constraint.origin,
                       "constraint '" + constraint.name +
                           "': its place says no finite gap at t = " + std::to_string(t) + " s");
  }

  void Constraints::arrange()
  {
    entries.clear();
    sizes.clear();
    for (ConstraintData &constraint : constraints)
      constraint.moving = constraint.place != nullptr;
    const auto stay =
        std::stable_partition(constraints.begin(), constraints.end(),
                              [](const ConstraintData &constraint) { return !constraint.moving; });
    first_with_place = stay - constraints.begin();
    fixed = std::stable_partition(constraints.begin(), stay,
                                  [](const ConstraintData &constraint)
                                  { return constraint.direction == nullptr; }) -
            constraints.begin();
    for (std::size_t i = 0; i < constraints.size(); ++i)
    {
      if (const TurningDirection *const turning = constraints[i].direction.get())
        constraints[i].gap = turning->gap(turning->start);
      if (i >= first_with_place)
        place(i, 0.);
      if (constraints[i].link == no_link)
        continue;
      row_index.resize(std::max(row_index.size(), constraints[i].link + 1), no_link);
      row_index[constraints[i].link] = i;
    }
    begin.assign(1, 0);
    for (std::size_t i = 0; i < fixed; ++i)
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

  /// Entries and sizes of a constraint, behind those that are known. At a node most entries are
  /// zero; their sizes count, where a multiplier may be not-a-number.
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
    begin.resize(fixed + 1);
    entries.resize(begin.back());
    sizes.resize(n_fixed_sizes);
    for (std::size_t i = fixed; i < constraints.size(); ++i)
      append(i);
  }

  void Constraints::set_conserving(const std::vector<char> &conserving)
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      constraints[i].conserving = conserving[i];
  }

  void Constraints::update(const double t)
  {
    for (std::size_t i = first_with_place; i < constraints.size(); ++i)
      place(i, t);
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
    for (std::size_t i = first_with_place; i < constraints.size(); ++i)
      constraints[i].place->follow(motion, start, end);
  }

  std::vector<std::vector<double>> Constraints::courses() const
  {
    std::vector<std::vector<double>> result;
    for (std::size_t i = first_with_place; i < constraints.size(); ++i)
      result.push_back(constraints[i].place->course());
    return result;
  }

  void Constraints::set_courses(const std::vector<std::vector<double>> &courses)
  {
    for (std::size_t k = 0; k < courses.size(); ++k)
      constraints[first_with_place + k].place->set_course(courses[k]);
  }

  std::vector<Coordinates> Constraints::differences(const BodyVectors &U) const
  {
    std::vector<double> sums;
    for (std::size_t i = fixed; i < first_with_place; ++i)
      for (const std::vector<Term> &motion : constraints[i].direction->motion)
        sums.push_back(evaluate(motion, U));
    structure.communicator().sum(sums);
    std::vector<Coordinates> result;
    for (std::size_t k = 0; k < sums.size(); k += 3)
      result.push_back({sums[k], sums[k + 1], sums[k + 2]});
    return result;
  }

  std::vector<Coordinates> Constraints::differences(const BodyVectors &reference,
                                                    const BodyVectors &U) const
  {
    if (!has_turning())
      return {};
    std::vector<Coordinates> result = differences(reference);
    const std::vector<Coordinates> motion = differences(U);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = add_scaled(add_scaled(constraints[fixed + i].direction->start, 1., result[i]), 1.,
                             motion[i]);
    return result;
  }

  std::array<Coordinates, 2> Constraints::ends(const std::size_t i, const BodyVectors &reference,
                                               const BodyVectors &U) const
  {
    const LinkEnd &first = constraints[i].direction->first;
    double motion[3];
    for (unsigned int c = 0; c < 3; ++c)
      motion[c] = evaluate(first.motion[c], reference) + evaluate(first.motion[c], U);
    structure.communicator().sum(motion, 3);
    const Coordinates place = add_scaled(first.position, 1., {motion[0], motion[1], motion[2]});
    return {place, add_scaled(place, 1., differences(reference, U)[i - fixed])};
  }

  void Constraints::turn(const std::vector<Coordinates> &directions)
  {
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const TurningDirection &turning = *constraints[fixed + i].direction;
      const Coordinates &d = directions[i];
      constraints[fixed + i].terms =
          turning.along({turning.sign * d.x, turning.sign * d.y, turning.sign * d.z});
    }
    append_varying();
  }

  void Constraints::turn_to(const BodyVectors &reference, const BodyVectors &U)
  {
    if (!has_turning())
      return;
    std::vector<Coordinates> d = differences(reference, U);
    for (std::size_t i = 0; i < d.size(); ++i)
      d[i] = constraints[fixed + i].direction->at(d[i]);
    turn(d);
  }

  void Constraints::keep_directions(const BodyVectors &reference, const std::vector<double> &N)
  {
    const std::vector<Coordinates> motions = differences(reference);
    std::vector<ConstraintData> springs;
    for (std::size_t k = 0; k < motions.size(); ++k)
    {
      ConstraintData &link = constraints[fixed + k];
      const std::shared_ptr<const TurningDirection> turning = std::move(link.direction);
      link.direction = nullptr;
      const Coordinates ends = add_scaled(turning->start, 1., motions[k]), d = turning->at(ends);
      link.terms = turning->along(add_scaled({}, turning->sign, d));
      link.gap = turning->gap(ends) - turning->sign * dot(d, motions[k]);
      if (!(turning->sign * N[fixed + k] < 0.))
        continue;
      for (const Coordinates &direction : across(d))
      {
        ConstraintData spring{link.name + " across", link.origin};
        spring.stiffness = std::fabs(N[fixed + k]) / norm(ends);
        spring.terms = turning->along(direction);
        spring.gap = -dot(direction, motions[k]);
        springs.push_back(std::move(spring));
      }
    }
    constraints.insert(constraints.begin() + first_with_place, springs.begin(), springs.end());
    arrange();
  }

  double Constraints::share_of_convection(const std::size_t i, const double t,
                                          const BodyVectors &reference, const BodyVectors &U) const
  {
    const std::vector<Term> slope = constraints[i].place->rates(t);
    check_terms(constraints[i], slope, structure);
    return evaluate(slope, reference) + evaluate(slope, U);
  }

  double Constraints::profile_rate(const std::size_t i, const double t, const double step) const
  {
    const MovingPlace &place = *constraints[i].place;
    // Central differences of fourth order: their error is below rounding of what a step resolves.
    const double delta = 1e-2 * step;
    return (8. * (place.gap(t + delta) - place.gap(t - delta)) -
            (place.gap(t + 2. * delta) - place.gap(t - 2. * delta))) /
           (12. * delta);
  }

  std::vector<char> Constraints::acts_on(std::vector<unsigned int> (Substructure::*wanted)()
                                             const) const
  {
    std::vector<double> count(constraints.size(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const std::vector<unsigned int> dofs = (structure[k].*wanted)();
      for (std::size_t e = 0, i = 0; e < begin[fixed]; ++e)
      {
        while (e >= begin[i + 1])
          ++i;
        if (entries[e].body == k)
          count[i] += std::binary_search(dofs.begin(), dofs.end(), entries[e].dof);
      }
      // Of what moves along a body, DoFs change; lumped masses at the other end stay.
      for (std::size_t i = first_with_place; i < constraints.size() && structure[k].is_lumped();
           ++i)
        for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
          if (entries[e].body == k)
            count[i] += std::binary_search(dofs.begin(), dofs.end(), entries[e].dof);
      for (std::size_t i = fixed; i < first_with_place; ++i)
        for (const std::vector<Term> &motion : constraints[i].direction->motion)
          for (const Term &term : motion)
            if (term.substructure == k)
              for (const unsigned int dof : term.form.index)
                count[i] += std::binary_search(dofs.begin(), dofs.end(), dof);
    }
    structure.communicator().sum(count);
    std::vector<char> result;
    for (const double n_dofs : count)
      result.push_back(n_dofs > 0.);
    return result;
  }

  std::vector<double> Constraints::motions(const BodyVectors &U) const
  {
    std::vector<double> result(constraints.size());
    share_of_motions(U, result);
    structure.communicator().sum(result);
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

  void Constraints::add_forces(const std::vector<double> &N, BodyVectors &P) const
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (N[i] != 0.)
        for (std::size_t e = begin[i]; e < begin[i + 1]; ++e)
          P[entries[e].body][entries[e].dof] += N[i] * entries[e].value;
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

  std::string Constraints::names(const std::vector<std::size_t> &indices) const
  {
    std::string text;
    const std::size_t shown = std::min<std::size_t>(indices.size(), 8);
    for (std::size_t k = 0; k < shown; ++k)
      text += (k == 0 ? "'" : ", '") + constraints[indices[k]].name + "'";
    if (shown < indices.size())
      text += " and " + std::to_string(indices.size() - shown) + " more";
    return text;
  }
} // namespace taut
