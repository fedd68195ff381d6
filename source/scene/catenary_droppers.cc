// SPDX-License-Identifier: LGPL-2.1-or-later
#include "catenary_droppers.h"

#include <taut/base/exceptions.h>
#include <taut/base/patterns.h>
#include <taut/base/text.h>
#include <taut/scene/entries.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>

namespace taut
{
  void CatenaryDroppers::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Droppers");
    prm.add_parameter("Positions", positions, "In each span, from its first mast [m]",
                      List(not_negative(), 0));
    prm.add_parameter("Stiffness", stiffness,
                      "In tension; none in compression; a number or 'rigid' [N/m]", Anything());
    prm.add_parameter("Axial stiffness", axial_stiffness,
                      "EA; if not 0, the stiffness is EA / length [N]", not_negative());
    prm.add_parameter("Damping", damping, "[N s/m]", not_negative());
    prm.add_parameter("Mass per length", mass_per_length,
                      "Half of a dropper's mass goes to each wire [kg/m]", not_negative());
    prm.add_parameter("Messenger clamp mass", messenger_clamp_mass, "[kg]", not_negative());
    prm.add_parameter("Contact clamp mass", contact_clamp_mass, "[kg]", not_negative());
    prm.add_parameter(
        "Pre-sag", pre_sag,
        "Depth of the contact wire below its supports at each dropper of a span in the "
        "static state; empty: level [m]",
        List(Double(), 0));
    prm.add_parameter("Lengths", lengths,
                      "Unstressed length of each dropper of a span; empty: found from the pre-sag "
                      "[m]",
                      List(not_negative(), 0));
    prm.leave_subsection();
  }

  void CatenaryDroppers::check(const double span_length, const double same,
                               const bool is_in_space) const
  {
    std::vector<double> sorted = positions;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      if (!(sorted[i] > 0. && sorted[i] < span_length))
        throw EntryError("Catenary/Droppers/Positions", to_text(sorted[i]) +
                                                            " m is not inside its span of " +
                                                            to_text(span_length) + " m");
      if (i > 0 && sorted[i] - sorted[i - 1] <= same)
        throw EntryError("Catenary/Droppers/Positions",
                         "two droppers hang at " + to_text(sorted[i]) +
                             " m; remove one, or give one the stiffness of both");
    }
    const auto require = [&](const std::vector<double> &list, const std::string &name)
    {
      if (!list.empty() && list.size() != positions.size())
        throw EntryError("Catenary/Droppers/" + name, std::to_string(list.size()) + " values for " +
                                                          std::to_string(positions.size()) +
                                                          " Positions");
    };
    require(pre_sag, "Pre-sag");
    require(lengths, "Lengths");
    if (axial_stiffness > 0. && !lengths.empty())
      throw EntryError("Catenary/Droppers/Axial stiffness", "with given Lengths use Stiffness");
    if (is_in_space && !lengths.empty())
      throw EntryError("Catenary/Droppers/Lengths",
                       "they are for a line in the plane. With Stagger, Wind or Lateral component "
                       "the directions of the droppers are found with their lengths; give the "
                       "Pre-sag instead");
  }

  void CatenaryDroppers::add(const std::size_t messenger_wire, const std::size_t contact_wire,
                             const unsigned int n_spans, const double span_length,
                             Scene &scene) const
  {
    const double height = scene.wires[messenger_wire].a.y - scene.wires[contact_wire].a.y;
    std::vector<double> places;
    for (unsigned int span = 0; span < n_spans; ++span)
      for (std::size_t i = 0; i < positions.size(); ++i)
      {
        Link link;
        link.kind = LinkKind::dropper;
        link.origin = "Catenary/Droppers";
        const double x = span * span_length + positions[i];
        // All names have the same number of digits: 1.11 and 11.1 are one name to programs that
        // drop the point.
        std::string index = std::to_string(i + 1);
        index.insert(0, std::to_string(positions.size()).size() - index.size(), '0');
        link.name = "dropper " + std::to_string(span + 1) + "." + index;
        link.from = {Attachment::Kind::wire, messenger_wire, x};
        link.to = {Attachment::Kind::wire, contact_wire, x};
        link.direction = {0., -1.};
        link.stiffness = parse_stiffness(stiffness, "Catenary/Droppers/Stiffness");
        link.damping = damping;
        if (lengths.empty())
        {
          link.form.find_length = true;
          link.form.prescribed_displacement = pre_sag.empty() ? 0. : -pre_sag[i];
          link.form.axial_stiffness = axial_stiffness;
          link.form.mass_per_length = mass_per_length;
          link.form.find_direction = scene.wires[contact_wire].has_lateral;
        }
        else
        {
          link.length = link.unstressed_length = lengths[i];
          link.gap = lengths[i] - height;
        }
        scene.links.push_back(link);
        places.push_back(x);
      }
    const auto add_clamps = [&](const std::string &name, const std::size_t wire, const double mass)
    {
      if (mass > 0. && !places.empty())
        scene.point_masses.push_back({name, "Catenary/Droppers", wire, places, mass, true});
    };
    add_clamps("messenger clamp", messenger_wire, messenger_clamp_mass);
    add_clamps("contact clamp", contact_wire, contact_clamp_mass);
  }
} // namespace taut
