// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_reused_values_h
#define taut_reused_values_h

#include <map>
#include <string>
#include <utility>

namespace taut
{
  /**
   * Values that one run made and the next run may use again. The key of a value holds all data that
   * define it. A value that a run did not ask for is forgotten when the next run begins, so that
   * memory is bounded by two runs.
   */
  template <typename Value>
  class ReusedValues
  {
  public:
    /// Call it when a run begins.
    void begin()
    {
      for (auto entry = entries.begin(); entry != entries.end();)
        if (entry->second.is_used)
          (entry++)->second.is_used = false;
        else
          entry = entries.erase(entry);
    }

    /// The value of @p key; @p make makes it if it is not known. Nothing is kept if @p make throws.
    template <typename Make>
    const Value &find(const std::string &key, const Make &make)
    {
      auto known = entries.find(key);
      if (known == entries.end())
        known = entries.emplace(key, Entry{make()}).first;
      known->second.is_used = true;
      return known->second.value;
    }

    std::size_t size() const { return entries.size(); }

  private:
    struct Entry
    {
      Value value;
      bool is_used = true;
    };
    std::map<std::string, Entry> entries;
  };
} // namespace taut

#endif
