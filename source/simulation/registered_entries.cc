// SPDX-License-Identifier: LGPL-2.1-or-later
// Schemes and observers of a parameter file, also of plugins, each with its own entries.
#include "simulation/file_text.h"

#include <taut/base/exceptions.h>
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <dlfcn.h>

#include <algorithm>

namespace taut
{
  void Parameters::load_registered()
  {
    for (const std::string &name : shared_libraries)
      // Registered objects live as long as the process, so that it is never closed.
      if (dlopen(name.c_str(), RTLD_NOW | RTLD_GLOBAL) == nullptr)
      {
        const char *reason = dlerror();
        throw EntryError("Additional shared libraries",
                         "cannot load '" + name + "': " + (reason ? reason : "no reason is given") +
                             ". Give the path of the library, as seen from the folder where "
                             "the program runs; a name without '/' is sought beside "
                             "libtaut.so and where the system keeps libraries");
      }
    for (const std::string &name : Registry<TimeIntegrator>::instance().list())
      integrators[name] = Registry<TimeIntegrator>::instance().create(name);
    for (const std::string &name : Registry<Observer>::instance().list())
      observers[name] = Registry<Observer>::instance().create(name);
  }

  double Parameters::restitution() const
  {
    double largest = 0.;
    for (const auto &[name, integrator] : integrators)
      largest = std::max(largest, integrator->restitution());
    return largest;
  }

  std::map<std::string, std::string> Parameters::entries_below(const std::string &section) const
  {
    std::map<std::string, std::string> values;
    for (const auto &[path, value] : entry_values)
      if (path.compare(0, section.size(), section) == 0)
        values[path.substr(section.size())] = value;
    return values;
  }

  void Parameters::write_nothing()
  {
    output.writes = false;
    output.field_interval = 0.;
    output.checkpoint_interval = 0.;
    std::vector<std::string> measuring;
    for (const std::string &name : output.observers)
    {
      const std::unique_ptr<Observer> observer = make_observer(name);
      if (observer->files().empty() && !observer->quantities().empty())
        measuring.push_back(name);
    }
    output.observers = measuring;
  }

  std::unique_ptr<Observer> Parameters::make_observer(const std::string &name) const
  {
    std::unique_ptr<Observer> result = Registry<Observer>::instance().create(name);
    dealii::ParameterHandler prm;
    result->declare_parameters(prm);
    for (const auto &[path, value] : entries_below("Output/" + name + "/"))
    {
      std::vector<std::string> sections = split(path, '/');
      const std::string entry = sections.back();
      sections.pop_back();
      for (const std::string &section : sections)
        prm.enter_subsection(section);
      prm.set(entry, value);
      for (std::size_t i = 0; i < sections.size(); ++i)
        prm.leave_subsection();
    }
    return result;
  }
} // namespace taut
