// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_list_h
#define taut_observer_list_h

#include <taut/base/archive.h>
#include <taut/output/observer.h>

#include <memory>
#include <vector>

namespace taut
{
  /// The observers of a run in the order of their calls. All ranks have the same list.
  class ObserverList
  {
  public:
    explicit ObserverList(const Communicator &processes) : processes(processes) {}

    /// Kept by reference; nullptr on a rank where it has nothing to do.
    void add(Observer *observer) { observers.push_back(observer); }
    void add(std::unique_ptr<Observer> observer)
    {
      observers.push_back(observer.get());
      owned.push_back(std::move(observer));
    }

    /// Called by all ranks together; an exception of one rank is thrown on all.
    void begin(const RunView &run) const
    {
      for (Observer *observer : observers)
        processes.agree([&] { observer ? observer->begin(run) : void(); });
    }
    void record(const StepView &step) const
    {
      for (Observer *observer : observers)
        processes.agree([&] { observer ? observer->record(step) : void(); });
    }

    /// What each of them stores in a checkpoint, complete on the root.
    std::vector<std::string> save() const
    {
      std::vector<std::string> stored;
      for (Observer *observer : observers)
        processes.agree(
            [&]
            {
              stored.push_back(
                  observer ? archived([&](OutputArchive &archive) { observer->save(archive); })
                           : "");
            });
      return stored;
    }

    /// @p stored is what the root saved of as many observers.
    void resume(const std::vector<std::string> &stored, const StepView &step) const
    {
      for (std::size_t i = 0; i < observers.size(); ++i)
        processes.agree(
            [&]
            {
              if (observers[i])
                unarchive(stored[i],
                          [&](InputArchive &archive) { observers[i]->resume(archive, step); });
            });
    }
    std::size_t size() const { return observers.size(); }

    /// Of this rank alone: others may have ended.
    void finish() const
    {
      for (Observer *observer : observers)
        if (observer)
          observer->finish();
    }

  private:
    const Communicator &processes;
    std::vector<Observer *> observers;
    std::vector<std::unique_ptr<Observer>> owned;
  };
} // namespace taut

#endif
