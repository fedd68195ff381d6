// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/own_items.h"

#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  namespace
  {
    constexpr const char *rail = "conductor rail";

    /// An entry that a tension length may have, and where its number goes.
    struct OwnEntry
    {
      const char *section, *name, *unit;
      double &(*of)(LineItems &);
    };

    const OwnEntry entries[] = {
        {"Contact wire", "Mass per length", "[kg/m]",
         [](LineItems &i) -> double & { return i.contact.mass_per_length; }},
        {"Contact wire", "Tension", "[N]",
         [](LineItems &i) -> double & { return i.contact.tension; }},
        {"Contact wire", "Bending stiffness", "[N m^2]",
         [](LineItems &i) -> double & { return i.contact.bending_stiffness; }},
        {"Messenger wire", "Mass per length", "[kg/m]",
         [](LineItems &i) -> double & { return i.messenger.mass_per_length; }},
        {"Messenger wire", "Tension", "[N]",
         [](LineItems &i) -> double & { return i.messenger.tension; }},
        {"Messenger wire", "Bending stiffness", "[N m^2]",
         [](LineItems &i) -> double & { return i.messenger.bending_stiffness; }},
        {"Supports", "Arm mass", "[kg]",
         [](LineItems &i) -> double & { return i.supports.arm_mass; }},
        {"Supports", "Arm stiffness", "[N/m]",
         [](LineItems &i) -> double & { return i.supports.arm_stiffness; }},
        {"Supports", "Arm damping", "[N s/m]",
         [](LineItems &i) -> double & { return i.supports.arm_damping; }},
        {"Droppers", "Axial stiffness", "[N]",
         [](LineItems &i) -> double & { return i.droppers.axial_stiffness; }},
        {"Droppers", "Mass per length", "[kg/m]",
         [](LineItems &i) -> double & { return i.droppers.mass_per_length; }},
        {"Droppers", "Damping", "[N s/m]",
         [](LineItems &i) -> double & { return i.droppers.damping; }}};

    std::string path_of(const OwnEntry &entry)
    {
      return std::string(entry.section) + "/" + entry.name;
    }

    constexpr const char *dropper_stiffness = "Droppers/Stiffness";
  } // namespace

  void OwnItems::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Kind", kind,
                      "'catenary' or 'conductor rail', as Kind of the line; empty: that",
                      Selection("|catenary|conductor rail"));
    const std::string help = "Of this tension length; empty: that of the line ";
    for (const OwnEntry &entry : entries)
    {
      prm.enter_subsection(entry.section);
      prm.add_parameter(entry.name, texts[path_of(entry)], help + entry.unit, Anything());
      prm.leave_subsection();
    }
    prm.enter_subsection("Droppers");
    prm.add_parameter("Stiffness", texts[dropper_stiffness],
                      "Of this tension length, a number or 'rigid'; empty: that of the line [N/m]",
                      Anything());
    prm.leave_subsection();
  }

  LineItems OwnItems::with(const LineItems &of_line, const std::string &section) const
  {
    LineItems result = of_line;
    if (!kind.empty())
      result.is_rail = kind == rail;
    const bool is_other_kind = result.is_rail != of_line.is_rail;
    for (const OwnEntry &entry : entries)
    {
      const std::string &text = texts.at(path_of(entry)), path = section + "/" + path_of(entry);
      if (text.empty() && is_other_kind && std::string(entry.section) == "Contact wire")
        throw EntryError(path, std::string(result.is_rail
                                               ? "a conductor rail beside wires has its own"
                                               : "a wire beside a conductor rail has its own") +
                                   "; give it in " + entry.unit);
      if (text.empty())
        continue;
      const double value = parse_number(text, path);
      if (!(value >= 0.))
        throw EntryError(path, "it must not be negative");
      const std::string name = entry.name;
      if (value == 0. && (name == "Mass per length" || (name == "Tension" && !result.is_rail)))
        throw EntryError(path, "it must be positive");
      entry.of(result) = value;
    }
    if (is_other_kind)
    {
      // What is worn, and bends or not, is the other kind.
      result.contact.remaining_mass = result.contact.remaining_bending = "1";
      result.contact.model = "beam";
    }
    const auto is_given = [&](const char *const path) { return !texts.at(path).empty(); };
    result.contact.has_mass |= is_given("Contact wire/Mass per length");
    result.contact.has_tension |= is_given("Contact wire/Tension");
    result.messenger.has_mass |= is_given("Messenger wire/Mass per length");
    result.messenger.has_tension |= is_given("Messenger wire/Tension");
    if (is_given(dropper_stiffness))
      result.droppers.stiffness = texts.at(dropper_stiffness);
    return result;
  }
} // namespace taut
