// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/scene/named_items.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace taut
{
  void check_item_names(const std::vector<std::string> &names, const std::string &list_entry)
  {
    for (const std::string &name : names)
    {
      if (name.empty() || name.find_first_of("/@=#:") != std::string::npos)
        throw EntryError(list_entry,
                         "'" + name +
                             "' cannot be a name: a name is not empty and has none of / @ = # :");
      if (std::count(names.begin(), names.end(), name) > 1)
        throw EntryError(list_entry, "the name '" + name + "' comes twice");
    }
  }

  void declare_item_names(dealii::ParameterHandler &prm, const std::string &list,
                          const std::string &section, const std::string &help,
                          std::vector<std::string> &names)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(list, names,
                      "Names of the " + help + ", separated by commas; each has a section '" +
                          section + " <name>'",
                      List(Anything()));
  }

  void enter_item(dealii::ParameterHandler &prm, const std::string &section,
                  const std::vector<std::string> &names, const std::size_t i)
  {
    prm.enter_subsection(section + " " + names[i]);
  }

  void leave_item(dealii::ParameterHandler &prm)
  {
    prm.leave_subsection();
  }
} // namespace taut
