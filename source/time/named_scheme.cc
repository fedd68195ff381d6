// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/named_scheme.h"
#include "base/nearest_name.h"
#include "base/text.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace taut
{
  namespace
  {
    /// Paths of all entries, as "Moreau-Jean/Theta".
    std::vector<std::string> entries_of(const dealii::ParameterHandler &prm)
    {
      std::stringstream listing;
      prm.print_parameters(listing, dealii::ParameterHandler::ShortText);
      std::vector<std::string> result, sections;
      for (std::string line; std::getline(listing, line);)
      {
        std::istringstream words(line);
        std::string first, rest;
        words >> first >> std::ws;
        std::getline(words, rest);
        if (first == "subsection")
          sections.push_back(rest + "/");
        else if (first == "end" && !sections.empty())
          sections.pop_back();
        else if (first == "set")
        {
          std::string path;
          for (const std::string &section : sections)
            path += section;
          const std::size_t end = rest.find_last_not_of(' ', rest.find('=') - 1);
          result.push_back(path + rest.substr(0, end + 1));
        }
      }
      return result;
    }

    /// Sets a known entry.
    void set_entry(const std::string &path, const std::string &value, dealii::ParameterHandler &prm)
    {
      std::string pattern;
      try
      {
        set_declared_entry(path, value, prm);
      }
      catch (const dealii::ExceptionBase &e)
      {
        std::ostringstream out;
        e.print_info(out);
        const std::size_t begin = out.str().find('['), end = out.str().rfind(']');
        pattern = end == std::string::npos ? "[]" : out.str().substr(begin, end - begin + 1);
      }
      if (!pattern.empty())
        throw UserError("'" + path + "' cannot be '" + value + "'; it takes " + pattern);
    }
  } // namespace

  bool set_declared_entry(const std::string &path, const std::string &value,
                          dealii::ParameterHandler &prm)
  {
    const std::vector<std::string> known = entries_of(prm);
    if (std::find(known.begin(), known.end(), path) == known.end())
      return false;
    std::size_t begin = 0, end = 0;
    for (; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
      prm.enter_subsection(path.substr(begin, end - begin));
    prm.set(path.substr(begin), value);
    for (std::size_t n = std::count(path.begin(), path.end(), '/'); n > 0; --n)
      prm.leave_subsection();
    return true;
  }

  std::unique_ptr<TimeIntegrator>
  make_named_scheme(const std::string &name, const std::map<std::string, std::string> &entries)
  {
    const auto &registry = Registry<TimeIntegrator>::instance();
    if (!registry.knows(name))
    {
      std::vector<std::string> known = registry.list();
      known.push_back("automatic");
      throw UserError("there is no scheme '" + name + "'" + suggestion(name, known));
    }
    const std::unique_ptr<TimeIntegrator> scheme = registry.create(name);
    dealii::ParameterHandler prm;
    scheme->declare_parameters(prm);
    const std::vector<std::string> known = entries_of(prm);
    for (const auto &[path, value] : entries)
    {
      if (std::find(known.begin(), known.end(), path) == known.end())
        throw UserError("scheme '" + name + "' has no entry '" + path + "'" +
                        suggestion(path, known));
      set_entry(path, value, prm);
    }
    return make_integrator(name, entries);
  }

  void check_solver_names(const SolverParameters &parameters)
  {
    const std::string tolerance = to_text(
        std::setprecision(std::numeric_limits<double>::max_digits10), parameters.contact_tolerance);
    SolverParameters defaults;
    dealii::ParameterHandler prm;
    defaults.declare_parameters(prm);
    const std::pair<const char *, std::string> values[] = {
        {"Solver/Local solver", parameters.local_solver},
        {"Solver/Interface operator", parameters.interface.form},
        {"Solver/Preconditioner", parameters.interface.preconditioner},
        {"Solver/Coarse space", parameters.interface.coarse_space},
        {"Solver/Complementarity", parameters.complementarity},
        {"Solver/Contact tolerance", tolerance}};
    for (const auto &[path, value] : values)
      set_entry(path, value, prm);
  }
} // namespace taut
