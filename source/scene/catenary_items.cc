// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/catenary_items.h"

#include "base/patterns.h"
#include "base/text.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <regex>

namespace taut
{
  using namespace dealii::Patterns;

  void LineWireItem::declare(dealii::ParameterHandler &prm, const std::string &section,
                             const bool has_wind)
  {
    prm.enter_subsection(section);
    prm.add_parameter("Model", model, "'beam': tension and bending; 'string': tension only",
                      Selection("beam|string"));
    prm.add_parameter("Mass per length", mass_per_length, "[kg/m]", not_negative());
    prm.add_parameter("Tension", tension, "[N]", not_negative());
    // To add an action runs it, too; later it runs for entries of the file alone.
    prm.add_action("Mass per length", [this](const std::string &) { has_mass = true; });
    prm.add_action("Tension", [this](const std::string &) { has_tension = true; });
    has_mass = has_tension = false;
    prm.add_parameter("Bending stiffness", bending_stiffness, "EI; not used by a string [N m^2]",
                      not_negative());
    prm.add_parameter("Remaining mass", remaining_mass,
                      "Share of Mass per length that a worn wire has left: a number, or a formula "
                      "or table of s (= x) [1]",
                      Anything());
    prm.add_parameter("Remaining bending stiffness", remaining_bending,
                      "Share of Bending stiffness that a worn wire has left, as Remaining mass [1]",
                      Anything());
    prm.add_parameter("Element size", element_size, "Largest length of an element [m]",
                      not_negative());
    prm.add_parameter("Degree", degree, "Polynomial degree of string elements [1]", Integer(1, 4));
    prm.add_parameter("Mass damping", mass_damping, "Rayleigh damping, times the mass [1/s]",
                      not_negative());
    prm.add_parameter("Stiffness damping", stiffness_damping,
                      "Rayleigh damping, times the stiffness [s]", not_negative());
    if (has_wind)
    {
      prm.add_parameter("Vertical load", vertical_load,
                        "Along y beside the weight, as a gust from below or ice that falls: a "
                        "formula in t and in s (= x); lengths of droppers are found without it "
                        "[N/m]",
                        Anything());
      prm.add_parameter(
          "Wind", wind,
          "Load along z, a formula in t and in s (= x); lengths of droppers are found "
          "without it [N/m]",
          Anything());
    }
    prm.leave_subsection();
  }

  void LineWireItem::check_given(const std::string &section, const LineWireItem &usual,
                                 const std::string &known_line) const
  {
    const auto check = [&](const bool is_given, const char *const entry, const double value,
                           const char *const unit)
    {
      if (!is_given)
        throw EntryError("Catenary/" + section + "/" + entry,
                         to_text("it is not given, and decides how the line moves: give it in ",
                                 unit, "; ", known_line, " has ", value));
    };
    check(has_mass, "Mass per length", usual.mass_per_length, "kg/m");
    check(has_tension, "Tension", usual.tension, "N");
  }

  namespace
  {
    /// s with an offset, as tables take it.
    std::string s_plus(const double offset)
    {
      return to_text(std::setprecision(17), offset < 0. ? "s-" : "s+", std::fabs(offset));
    }

    /// What stands in the brackets of a table of s or s + a, as one of s + a + @p begin. With
    /// @p is_of_s it is of s where it does not say of what.
    std::string table_along_wire(const std::string &arguments, const double begin,
                                 const bool is_of_s)
    {
      static const std::regex variable("s\\s*([+-]\\s*[0-9.]+(?:[eE][+-]?[0-9]+)?)?");
      std::vector<std::string> words = split(arguments, ',');
      bool is_shifted = false;
      std::smatch parts;
      for (std::size_t i = 2; i < words.size(); ++i)
        if (std::regex_match(words[i], parts, variable))
        {
          std::string offset = parts.str(1);
          offset.erase(std::remove(offset.begin(), offset.end(), ' '), offset.end());
          words[i] = s_plus(begin + (offset.empty() ? 0. : std::strtod(offset.c_str(), nullptr)));
          is_shifted = true;
        }
      if (!is_shifted && is_of_s && words.size() >= 2)
        words.insert(words.begin() + 2, s_plus(begin));
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : ", ") + word;
      return text;
    }
  } // namespace

  std::string along_wire(const std::string &formula, const double begin, const bool is_of_s)
  {
    if (begin == 0.)
      return formula;
    static const std::regex opening("\\btable\\s*\\("), s("\\bs\\b");
    const std::string shifted = "(" + s_plus(begin) + ")";
    std::string result;
    std::size_t at = 0;
    for (std::smatch match; std::regex_search(formula.begin() + static_cast<std::ptrdiff_t>(at),
                                              formula.end(), match, opening);)
    {
      const std::size_t found = at + match.position(), first = found + match.length();
      std::size_t end = first;
      for (int depth = 1; end < formula.size(); ++end)
        if ((depth += formula[end] == '(' ? 1 : formula[end] == ')' ? -1 : 0) == 0)
          break;
      result += std::regex_replace(formula.substr(at, found - at), s, shifted) + match.str() +
                table_along_wire(formula.substr(first, end - first), begin, is_of_s);
      at = end;
    }
    return result + std::regex_replace(formula.substr(at), s, shifted);
  }

  Wire LineWireItem::wire(const std::string &name, const std::string &section, const Coordinates &a,
                          const Coordinates &b) const
  {
    Wire wire;
    wire.name = name;
    wire.origin = "Catenary/" + section;
    wire.a = a;
    wire.b = b;
    wire.mass_per_length = mass_per_length;
    wire.transverse = model == "beam" ? TransverseKind::beam : TransverseKind::string;
    wire.tension = tension;
    wire.bending_stiffness = model == "beam" ? bending_stiffness : 0.;
    const auto remaining = [&](const std::string &formula, const char *const entry)
    { return remaining_share(along_wire(formula, a.x, true), wire.origin + entry); };
    wire.remaining.mass = remaining(remaining_mass, "/Remaining mass");
    wire.remaining.bending_stiffness = remaining(remaining_bending, "/Remaining bending stiffness");
    wire.degree = degree;
    wire.element_size = element_size;
    wire.damping = {mass_damping, stiffness_damping};
    return wire;
  }

  Expression LineWireItem::wind_load(const std::string &section, const double begin) const
  {
    return Expression(along_wire(wind, begin), "Catenary/" + section + "/Wind");
  }

  Expression LineWireItem::load_along_y(const std::string &section, const double begin) const
  {
    return Expression(along_wire(vertical_load, begin), "Catenary/" + section + "/Vertical load");
  }

  Expression LineItems::track_curvature(const double begin) const
  {
    return Expression(along_wire(curvature, begin), "Catenary/Curvature");
  }

  Expression LineItems::track_cant(const double begin) const
  {
    return Expression(along_wire(cant, begin), "Catenary/Cant");
  }

  void LineSupportsItem::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Supports");
    prm.add_parameter("Messenger stiffness", messenger_stiffness,
                      "Of the messenger's supports at the inner masts; a number or 'rigid' [N/m]",
                      Anything());
    prm.add_parameter("Messenger damping", messenger_damping,
                      "Beside a stiffness that is a number [N s/m]", not_negative());
    prm.add_parameter(
        "Arm kind", arm_kind,
        "Steady arm at each inner mast. 'point mass': a mass on the contact wire, whose weight the "
        "arm carries. 'hinged': a uniform bar on a hinge at the mast and clamped to the wire; it "
        "moves as a lever, so that a third of its mass moves with the wire, and the wire carries "
        "half of its weight. 'rigid body': this bar in space, which turns about an axis along the "
        "line and holds the wire aside by its tension",
        Selection("point mass|hinged|rigid body"));
    prm.add_parameter("Arm mass", arm_mass, "[kg]", not_negative());
    prm.add_parameter("Arm reach", arm_reach,
                      "Of a rigid body: distance of its hinge from the clamp, aside to where it "
                      "pulls the wire [m]",
                      not_negative());
    prm.add_parameter("Arm rise", arm_rise,
                      "Of a rigid body: height of its hinge over the clamp [m]", Double());
    prm.add_parameter("Arm stiffness", arm_stiffness, "Vertical [N/m]", not_negative());
    prm.add_parameter("Arm damping", arm_damping, "Vertical [N s/m]", not_negative());
    prm.leave_subsection();
  }

  void LineDropperItem::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Droppers");
    prm.add_parameter("Stiffness", stiffness,
                      "In tension; none in compression; a number or 'rigid' [N/m]", Anything());
    prm.add_parameter("Axial stiffness", axial_stiffness,
                      "EA; if not 0, the stiffness is EA / length [N]", not_negative());
    prm.add_parameter("Damping", damping, "[N s/m]", not_negative());
    prm.add_parameter("Mass per length", mass_per_length,
                      "Half of a dropper's mass goes to each wire [kg/m]", not_negative());
    prm.add_parameter("Messenger clamp mass", messenger_clamp_mass, "[kg]", not_negative());
    prm.add_parameter("Contact clamp mass", contact_clamp_mass, "[kg]", not_negative());
    prm.leave_subsection();
  }

  void LineMidPointItem::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Mid-point ropes");
    prm.add_parameter("Pull", pull,
                      "Horizontal part of the tension of each rope at rest; the contact wire has "
                      "that much less tension between their clamps [N]",
                      not_negative());
    prm.add_parameter("Axial stiffness", axial_stiffness, "EA of each rope [N]", not_negative());
    prm.add_parameter("Mass per length", mass_per_length,
                      "Half of the mass of a rope goes to each wire [kg/m]", not_negative());
    prm.add_parameter("Messenger distance", messenger_distance,
                      "Between the clamps of the two ropes on the messenger wire, with the mast in "
                      "the middle; 0: both at the mast [m]",
                      not_negative());
    prm.leave_subsection();
  }

  void LineMassItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Wire", wire,
        "'contact' or 'messenger', of all tension lengths that reach the positions, or "
        "the name of one wire",
        Anything());
    prm.add_parameter("Positions", positions, "x: numbers and ranges first:step:last [m]",
                      Anything());
    prm.add_parameter("Mass", mass, "Of each; it hangs on the wire with its weight [kg]",
                      not_negative());
  }
} // namespace taut
