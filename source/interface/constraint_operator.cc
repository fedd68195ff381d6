// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/constraint_operator.h>

namespace taut
{
  BodyConstraints::BodyConstraints(const Structure &structure, const Lasting<Constraints> lasting)
      : constraints(lasting), entries(structure.size())
  {
    for (std::size_t i = 0; i < constraints.size(); ++i)
      add(i);
  }

  void BodyConstraints::update()
  {
    if (constraints.varying_rows().empty())
      return;
    for (std::vector<Entry> &of_body : entries)
      while (!of_body.empty() && of_body.back().varies)
        of_body.pop_back();
    for (const std::size_t i : constraints.varying_rows())
      add(i);
  }

  std::vector<std::size_t> BodyConstraints::rows() const
  {
    std::vector<char> is_held(constraints.size(), 0);
    for (const std::vector<Entry> &of_body : entries)
      for (const Entry &entry : of_body)
        is_held[entry.constraint] = 1;
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < is_held.size(); ++i)
      if (is_held[i])
        result.push_back(constraints.number(i));
    return result;
  }

  void BodyConstraints::add(const std::size_t constraint)
  {
    for (const auto &[k, form, of] : constraints[constraint].terms)
    {
      if (entries[k].empty() || entries[k].back().constraint != constraint)
        entries[k].push_back({constraint, !constraints.is_fixed(constraint), {}});
      for (std::size_t j = 0; j < form.index.size(); ++j)
        entries[k].back().form.add(form.index[j], form.value[j]);
    }
  }
} // namespace taut
