// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>
#include <taut/substructure/structure.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  std::vector<std::size_t> Structure::add(const std::vector<NewBody> &made)
  {
    std::vector<std::shared_ptr<Substructure>> own(made.size());
    std::vector<double> n_dofs(made.size(), 0.);
    processes.agree(
        [&]
        {
          for (std::size_t i = 0; i < made.size(); ++i)
          {
            const auto &[name, owner, make] = made[i];
            if (owner != processes.rank())
              continue;
            own[i] = make ? make() : nullptr;
            if (!own[i])
              throw UserError("body '" + name + "': the function that makes it returns none");
            own[i]->check_consistency();
            n_dofs[i] = own[i]->n_dofs();
          }
        });
    processes.sum(n_dofs);
    std::vector<std::size_t> index(made.size(), elsewhere);
    for (std::size_t i = 0; i < made.size(); ++i)
    {
      if (own[i])
      {
        index[i] = substructures.size();
        substructures.push_back(std::move(own[i]));
        numbers.push_back(bodies.size());
      }
      bodies.push_back({made[i].name, static_cast<std::size_t>(n_dofs[i])});
    }
    return index;
  }

  std::vector<char> Structure::linearise(const BodyVectors &U)
  {
    std::vector<double> replaced(bodies.size(), 0.);
    processes.agree(
        [&]
        {
          for (std::size_t k = 0; k < substructures.size(); ++k)
          {
            const auto *const slender = dynamic_cast<const SlenderBody *>(substructures[k].get());
            std::shared_ptr<Substructure> linear = slender ? slender->linearised(U[k]) : nullptr;
            if (!linear)
              continue;
            substructures[k] = std::move(linear);
            replaced[numbers[k]] = 1.;
          }
        });
    processes.sum(replaced);
    return std::vector<char>(replaced.begin(), replaced.end());
  }

  double Structure::largest_axial_stiffness() const
  {
    double largest = 0.;
    for (const auto &body : substructures)
      if (const auto *const slender = dynamic_cast<const SlenderBody *>(body.get()))
        if (!body->is_linear())
          largest = std::max(largest, slender->axial_stiffness());
    return largest;
  }

  void Structure::limit_axial_stiffness(const double EA)
  {
    for (auto &body : substructures)
      if (const auto *const slender = dynamic_cast<const SlenderBody *>(body.get()))
        if (!body->is_linear() && slender->axial_stiffness() > EA)
          body = slender->with_axial_stiffness(EA);
  }

  std::size_t Structure::n_dofs() const
  {
    std::size_t n = 0;
    for (const auto &substructure : substructures)
      n += substructure->n_dofs();
    return n;
  }

  BodyVectors Structure::zero() const
  {
    BodyVectors U;
    for (const auto &substructure : substructures)
      U.emplace_back(substructure->n_dofs(), 0.);
    return U;
  }

  double magnitude(const std::vector<Term> &terms, const BodyVectors &U)
  {
    double sum = 0.;
    for (const auto &[k, form, of] : terms)
      for (std::size_t j = 0; j < form.index.size(); ++j)
        sum += std::fabs(form.value[j] * U[k][form.index[j]]);
    return sum;
  }

  double evaluate(const std::vector<Term> &terms, const BodyVectors &U)
  {
    double sum = 0.;
    for (const Term &term : terms)
      sum += term.form.dot(U[term.substructure]);
    return sum;
  }
} // namespace taut
