// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_observer_list_h
#define taut_observer_list_h

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
