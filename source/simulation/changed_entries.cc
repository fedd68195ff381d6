// SPDX-License-Identifier: LGPL-2.1-or-later
// Parameters that are read once and changed from run to run.
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  bool Parameters::change(const std::vector<std::string> &overrides)
  {
    if (!choice.empty())
      return false;
    for (const std::string &o : overrides)
    {
      const ParameterFile::Entry &entry = file.set(o);
      if (declared.structural.count(entry.name()) > 0 || entry_values.count(entry.name()) == 0)
        return false;
      const std::size_t n_sections = entry.path.size() - 1;
      for (std::size_t i = 0; i < n_sections; ++i)
        declared.entries->enter_subsection(entry.path[i]);
      bool is_allowed = true;
      try
      {
        declared.entries->set(entry.path.back(), entry.value);
        entry_values[entry.name()] = declared.entries->get(entry.path.back());
      }
      catch (const dealii::ExceptionBase &)
      {
        is_allowed = false;
      }
      for (std::size_t i = 0; i < n_sections; ++i)
        declared.entries->leave_subsection();
      if (!is_allowed)
        return false;
    }
    try
    {
      end_time = find_end_time();
      check_values();
    }
    catch (const EntryError &e)
    {
      throw UserError(explain(e));
    }
    return !(study.accuracy > 0.);
  }
} // namespace taut
