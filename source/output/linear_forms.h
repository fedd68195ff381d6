// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_linear_forms_h
#define taut_linear_forms_h

#include <taut/substructure/structure.h>

#include <cstddef>
#include <vector>

namespace taut
{
  /// A list of linear forms on the displacements of this rank.
  class LinearForms
  {
  public:
    std::size_t size() const { return ends.size(); }

    void add(const std::vector<Term> &terms)
    {
      for (const auto &[k, form, of] : terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
          if (form.value[j] != 0.)
            entries.push_back({form.value[j], static_cast<unsigned int>(k), form.index[j]});
      ends.push_back(entries.size());
    }

    /// Adds the part of this rank in the values to @p result, of length size().
    void evaluate(const BodyVectors &U, double *const result) const
    {
      std::size_t e = 0;
      for (std::size_t i = 0; i < ends.size(); ++i)
        for (; e < ends[i]; ++e)
          result[i] += entries[e].value * U[entries[e].body][entries[e].dof];
    }

  private:
    struct Entry
    {
      double value;
      unsigned int body, dof;
    };
    std::vector<Entry> entries;
    std::vector<std::size_t> ends;
  };
} // namespace taut

#endif
