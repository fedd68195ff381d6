// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/nearest_name.h"
#include <taut/base/exceptions.h>
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>
#include <taut/scene/named_items.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  ContactSurface BodyType::surface(const BodySetting &setting,
                                   const std::vector<unsigned int> &) const
  {
    throw EntryError(setting.origin, "a body of this type shows no surface to contacts");
  }

  CustomBody make_body(const std::string &name, const std::string &origin,
                       const std::string &type_name,
                       const std::vector<std::pair<std::string, std::string>> &entries)
  {
    const std::shared_ptr<BodyType> type = Registry<BodyType>::instance().create(type_name);
    dealii::ParameterHandler prm;
    type->declare_parameters(prm);
    for (const auto &[entry, value] : entries)
      prm.set(entry, value);
    return {name, origin, type_name, type, entries};
  }

  void BodyParameters::declare_names(dealii::ParameterHandler &prm)
  {
    check_item_names(names, "Bodies");
    declare_item_names(
        prm, "Bodies", "Body",
        "bodies other than wires and lumped masses: solids, cables, rigid bodies, and "
        "types of Additional shared libraries",
        names);
  }

  void BodyParameters::declare_types(dealii::ParameterHandler &prm)
  {
    check_item_names(names, "Bodies");
    type_names.assign(names.size(), "");
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      prm.enter_subsection(title(i));
      prm.add_parameter("Type", type_names[i]);
      prm.leave_subsection();
    }
  }

  void BodyParameters::create_types()
  {
    const auto &registry = Registry<BodyType>::instance();
    const std::vector<std::string> known = registry.list();
    types.clear();
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      if (!registry.knows(type_names[i]))
        throw EntryError(title(i) + "/Type",
                         (type_names[i].empty() ? "it is missing" : "there is no such type") +
                             ("; known are: " + registry.names(", ")) +
                             "; one of a plugin needs its library in 'Additional shared "
                             "libraries'" +
                             suggestion(type_names[i], known));
      types.push_back(registry.create(type_names[i]));
    }
  }

  void BodyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      prm.enter_subsection(title(i));
      prm.add_parameter("Type", type_names[i],
                        "Of the body. " + Registry<BodyType>::instance().descriptions());
      types[i]->declare_parameters(prm);
      prm.leave_subsection();
    }
  }

  std::vector<CustomBody> BodyParameters::bodies() const
  {
    std::vector<CustomBody> result;
    for (std::size_t i = 0; i < names.size(); ++i)
      result.push_back({names[i], title(i), type_names[i], types[i], {}});
    return result;
  }
} // namespace taut
