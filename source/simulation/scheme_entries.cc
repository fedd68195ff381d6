// SPDX-License-Identifier: LGPL-2.1-or-later
// The time integration schemes of a parameter file, each with its own entries.
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Equal as numbers, if both are.
    bool is_same(const std::string &a, const std::string &b)
    {
      const dealii::Patterns::Double number;
      return a == b ||
             (number.match(a) && number.match(b) &&
              dealii::Utilities::string_to_double(a) == dealii::Utilities::string_to_double(b));
    }
  } // namespace

  void Parameters::create_integrators()
  {
    for (const std::string &name : Registry<TimeIntegrator>::instance().list())
      integrators[name] = Registry<TimeIntegrator>::instance().create(name);
  }

  double Parameters::restitution() const
  {
    double largest = 0.;
    for (const auto &[name, integrator] : integrators)
      largest = std::max(largest, integrator->restitution());
    return largest;
  }

  std::map<std::string, std::string> Parameters::time_entries() const
  {
    const std::string time = "Time/";
    std::map<std::string, std::string> values;
    for (const auto &[path, value] : entry_values)
      if (path.compare(0, time.size(), time) == 0)
        values[path.substr(time.size())] = value;
    return values;
  }

  std::vector<std::string>
  Parameters::unused_scheme_entries(const std::string &name,
                                    const std::map<std::string, std::string> &entries) const
  {
    std::vector<std::string> unused;
    for (const std::string &scheme : Registry<TimeIntegrator>::instance().list())
    {
      dealii::ParameterHandler prm;
      const auto integrator = Registry<TimeIntegrator>::instance().create(scheme);
      integrator->declare_parameters(prm);
      std::ostringstream json;
      prm.print_parameters(json, dealii::ParameterHandler::JSON);
      const nlohmann::json sections = nlohmann::json::parse(json.str());
      for (const auto &[section, own] : sections.items())
        for (const auto &[entry, described] : own.items())
        {
          if (!described.is_object())
            continue; // no section
          const std::string path = "Time/" + section + "/" + entry, &value = entry_values.at(path);
          const auto other = entries.find(section + "/" + entry);
          const bool has_part =
              scheme == name && (other == entries.end() || is_same(other->second, value));
          if (!has_part && !is_same(value, described.at("default_value").get<std::string>()))
            unused.push_back(path + " = " + value);
        }
    }
    return unused;
  }
} // namespace taut
