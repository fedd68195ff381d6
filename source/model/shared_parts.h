// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_parts_h
#define taut_shared_parts_h

#include <taut/substructure/substructure.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

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

  /// Droppers in the static state, in their order.
  struct DropperForm
  {
    std::vector<double> tension;  ///< [N]
    std::vector<double> length;   ///< [m]
    std::vector<double> sideways; ///< extent across a dropper whose direction is found [m]
  };

  /**
   * Parts of models that consecutive runs have in common, such as the cases of a sweep, so that
   * they are made once. The caller of the runs hands the object from run to run. Each part is made
   * from a ScenePart and nothing else, and found again by all values of this ScenePart. So a run
   * has the same bits with shared parts and without.
   */
  struct SharedParts
  {
    ReusedValues<DropperForm> forms;
    /// Wires keep no state (Substructure::save), so that runs can share them.
    ReusedValues<std::shared_ptr<Substructure>> wires;

    /// Call it when a run begins.
    void begin()
    {
      forms.begin();
      wires.begin();
    }
  };
} // namespace taut

#endif
