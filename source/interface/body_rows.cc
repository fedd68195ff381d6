// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/interface/body_rows.h>

namespace taut
{
  BodyRows::BodyRows(const Structure &structure, const ContactRows &rows)
      : rows(rows), entries(structure.size())
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
      add(i);
  }

  void BodyRows::update()
  {
    if (rows.n_fixed() == rows.size())
      return;
    for (std::vector<Entry> &of_body : entries)
      while (!of_body.empty() && of_body.back().moving)
        of_body.pop_back();
    for (std::size_t i = rows.n_fixed(); i < rows.size(); ++i)
      add(i);
  }

  void BodyRows::add(const std::size_t row)
  {
    for (const auto &[k, form] : rows[row].terms)
    {
      if (entries[k].empty() || entries[k].back().row != row)
        entries[k].push_back({row, rows[row].moving, {}});
      for (std::size_t j = 0; j < form.index.size(); ++j)
        entries[k].back().form.add(form.index[j], form.value[j]);
    }
  }
} // namespace taut
