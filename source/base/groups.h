// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_groups_h
#define taut_groups_h

#include <boost/pending/disjoint_sets.hpp>

#include <cstddef>
#include <vector>

namespace taut
{
  /// Groups of items that are joined, directly or through others. Groups count in the order of
  /// their first items.
  class Groups
  {
  public:
    /// @p n items, each alone.
    explicit Groups(const std::size_t n) : n(n), sets(n) {}

    void join(const std::size_t a, const std::size_t b) { sets.union_set(a, b); }
    bool are_joined(const std::size_t a, const std::size_t b)
    {
      return sets.find_set(a) == sets.find_set(b);
    }

    /// Items of each group, in ascending order.
    std::vector<std::vector<std::size_t>> members()
    {
      std::vector<std::vector<std::size_t>> result;
      std::vector<std::size_t> number(n, n); // of each representative
      for (std::size_t i = 0; i < n; ++i)
      {
        std::size_t &own = number[sets.find_set(i)];
        if (own == n)
        {
          own = result.size();
          result.emplace_back();
        }
        result[own].push_back(i);
      }
      return result;
    }

    /// Number of the group of each item.
    std::vector<std::size_t> numbers()
    {
      std::vector<std::size_t> result(n);
      const std::vector<std::vector<std::size_t>> groups = members();
      for (std::size_t g = 0; g < groups.size(); ++g)
        for (const std::size_t i : groups[g])
          result[i] = g;
      return result;
    }

  private:
    std::size_t n;
    boost::disjoint_sets_with_storage<> sets;
  };
} // namespace taut

#endif
