// SPDX-License-Identifier: LGPL-2.1-or-later
// The observers of a parameter file, each with its own entries.
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  void Parameters::create_observers()
  {
    for (const std::string &name : Registry<Observer>::instance().list())
      observers[name] = Registry<Observer>::instance().create(name);
  }

  void Parameters::declare_observers(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    for (auto &[name, observer] : observers)
    {
      prm.enter_subsection(name);
      observer->declare_parameters(prm);
      prm.leave_subsection();
    }
    prm.leave_subsection();
  }

  std::unique_ptr<Observer> Parameters::make_observer(const std::string &name) const
  {
    std::unique_ptr<Observer> result = Registry<Observer>::instance().create(name);
    dealii::ParameterHandler prm;
    result->declare_parameters(prm);
    const std::string section = "Output/" + name + "/";
    for (const auto &[path, value] : entry_values)
      if (path.compare(0, section.size(), section) == 0)
      {
        // Sections of its own are the path before the last '/'.
        std::string rest = path.substr(section.size());
        unsigned int depth = 0;
        for (std::size_t end = rest.find('/'); end != std::string::npos; end = rest.find('/'))
        {
          prm.enter_subsection(rest.substr(0, end));
          rest = rest.substr(end + 1);
          ++depth;
        }
        prm.set(rest, value);
        for (; depth > 0; --depth)
          prm.leave_subsection();
      }
    return result;
  }
} // namespace taut
