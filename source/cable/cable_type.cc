// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/about_entry.h"
#include "base/text.h"
#include "scene/places_by_x.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>
#include <taut/cable/find_shape.h>
#include <taut/scene/body_type.h>
#include <taut/scene/contact_surface.h>

#include <boost/math/tools/roots.hpp>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace taut
{
  namespace
  {
    /// The entries of a cable in a parameter file.
    class CableType : public BodyType, public PlacesByX
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override;
      std::size_t n_dofs() const override
      {
        return CableElements::dofs_per_node * (n_elements + 1 + places.size());
      }
      std::unique_ptr<Substructure> make(const BodySetting &setting) const override;
      ContactSurface surface(const BodySetting &setting,
                             const std::vector<unsigned int> &boundaries) const override;
      std::vector<double> places_at(const std::vector<double> &x,
                                    const BodySetting &setting) const override;
      std::shared_ptr<const BodyType> divided(const std::vector<double> &at) const override
      {
        auto result = std::make_shared<CableType>(*this);
        result->places = at;
        return result;
      }

    private:
      CableData data(const BodySetting &setting) const;
      double find_length(const CableData &data) const;

      std::vector<double> from = {0., 0.}, to = {1., 0.}, through, force, start_direction;
      double length = 0., tension = 0., sag = 0.;
      double axial_stiffness = 0., bending_stiffness = 0., mass = 0., axial_damping = 0.,
             mass_damping = 0., largest_strain = .02, disturbance = CableData().disturbance;
      unsigned int n_elements = 16;
      std::string element = "ANCF", held = "both", geometry = "nonlinear";
      bool clamped = false;
      std::vector<double> places; ///< that are nodes
    };

    void CableType::declare_parameters(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      prm.add_parameter("From", from, "Place of its first end: x, y or x, y, z [m]",
                        List(Double(), 2, 3));
      prm.add_parameter("To", to, "Place of its last end: x, y or x, y, z [m]",
                        List(Double(), 2, 3));
      prm.add_parameter("Unstressed length", length,
                        "This, or Horizontal tension, or Sag, or Through; places on the cable are "
                        "counted along it [m]");
      prm.add_parameter("Horizontal tension", tension,
                        "Of the cable at rest, its component across weight and wind along the "
                        "chord: the unstressed length follows [N]");
      prm.add_parameter("Sag", sag,
                        "Of the cable at rest, its largest distance from the chord, measured along "
                        "weight and wind: the unstressed length follows [m]");
      prm.add_parameter("Through", through,
                        "Place that the cable at rest passes through, in the plane of its ends, "
                        "weight and wind: the unstressed length follows; x, y or x, y, z; empty: "
                        "none [m]",
                        List(Double(), 0, 3));
      prm.add_parameter("Axial stiffness", axial_stiffness, "EA [N]");
      prm.add_parameter("Bending stiffness", bending_stiffness, "EI, of ANCF elements [N m^2]",
                        Double(0.));
      prm.add_parameter("Mass per length", mass, "Of unstressed length [kg/m]", Double(0.));
      prm.add_parameter("Axial damping", axial_damping,
                        "eta in the axial force EA eps + eta eps' [N s]", Double(0.));
      prm.add_parameter("Mass damping", mass_damping, "a in C = a M [1/s]", Double(0.));
      prm.add_parameter("Elements", n_elements, "Number of elements [1]", Integer(1));
      prm.add_parameter("Element", element,
                        "ANCF: cubic, with bending; bar: quadratic, with axial force only",
                        Selection("ANCF|bar"));
      prm.add_parameter("Held ends", held,
                        "Ends that do not move; the shape at rest is found with both held",
                        Selection("both|from|to|none"));
      prm.add_parameter("Clamped", clamped, "Held ends keep their direction, too");
      prm.add_parameter("Force per length", force,
                        "Per unstressed length, beside the weight, as of wind: x, y, z; empty: "
                        "none [N/m]",
                        List(Double(), 0, 3));
      prm.add_parameter("Largest strain", largest_strain,
                        "A cable at rest with more is an error [1]", Double(0.));
      prm.add_parameter("Disturbance", disturbance,
                        "By how much a straight piece that is compressed by more than it bears "
                        "is moved across its line, over the length of the cable: without that it "
                        "would push. 0: it pushes [1]",
                        Double(0.));
      prm.add_parameter("Geometry", geometry,
                        "nonlinear: motions of any size; linearised: small ones about where the "
                        "run starts; linear: small ones of a straight wire of the same tension",
                        Selection("nonlinear|linearised|linear"));
      prm.add_parameter("Start direction", start_direction,
                        "With Start = given, unstressed in a straight line from From along x, y, "
                        "z; empty: in the shape at rest",
                        List(Double(), 0, 3));
    }

    Coordinates coordinates(const std::vector<double> &list)
    {
      Coordinates result;
      result.x = list.empty() ? 0. : list[0];
      result.y = list.size() < 2 ? 0. : list[1];
      result.z = list.size() < 3 ? 0. : list[2];
      return result;
    }

    CableData CableType::data(const BodySetting &setting) const
    {
      const auto require_coordinates = [&](const std::vector<double> &list, const std::string &name)
      {
        if (list.size() == 1)
          throw EntryError(setting.origin + "/" + name, "it has one component; give x, y, z");
      };
      require_coordinates(force, "Force per length");
      require_coordinates(start_direction, "Start direction");
      CableData result;
      result.name = setting.name;
      result.origin = setting.origin;
      result.from = coordinates(from);
      result.to = coordinates(to);
      result.section = {axial_stiffness, bending_stiffness, mass, axial_damping};
      result.mass_damping = mass_damping;
      result.gravity = setting.gravity;
      result.force = coordinates(force);
      result.n_elements = n_elements;
      result.element = element == "bar" ? CableElement::bar : CableElement::ancf;
      result.holds_from = held == "both" || held == "from";
      result.holds_to = held == "both" || held == "to";
      result.clamped = clamped;
      result.starts_straight = !start_direction.empty();
      result.start_direction = coordinates(start_direction);
      result.geometry = geometry == "linear"       ? CableGeometry::linear
                        : geometry == "linearised" ? CableGeometry::linearised
                                                   : CableGeometry::nonlinear;
      result.largest_strain = largest_strain;
      result.disturbance = disturbance;
      result.places = places;
      return result;
    }

    double CableType::find_length(const CableData &data) const
    {
      const std::string origin = data.origin + "/";
      for (const auto &[value, name] :
           {std::pair<double, const char *>{length, "Unstressed length"},
            {tension, "Horizontal tension"},
            {sag, "Sag"}})
        if (value < 0.)
          throw EntryError(origin + name, "it is negative; give a positive one");
      if ((length != 0.) + (tension != 0.) + (sag != 0.) + !through.empty() != 1)
        throw EntryError(origin + "Unstressed length",
                         "a cable has exactly one of Unstressed length, Horizontal tension and "
                         "Sag, more than zero, or a place that it passes Through");
      if (length != 0.)
        return length;
      if (data.from == data.to)
        throw EntryError(origin + "To", "the ends are at one place; move one, or give the "
                                        "Unstressed length");
      if (!(axial_stiffness > 0.))
        throw EntryError(origin + "Axial stiffness", "a cable needs a positive one [N]");
      // The length, from which places are counted, does not depend on them.
      CableData undivided = data;
      undivided.places.clear();
      const auto make = [&](const double L) { return make_elements(undivided, L); };
      const Coordinates load = force_per_length(data), span = data.to - data.from;
      if (tension != 0.)
        return about_entry(origin + "Horizontal tension",
                           [&] { return length_for_tension(make, {}, span, load, tension); });
      if (!through.empty())
      {
        if (through.size() == 1)
          throw EntryError(origin + "Through", "it has one component; give x, y, z");
        const Coordinates place = coordinates(through) - data.from;
        return about_entry(origin + "Through",
                           [&] { return length_through(make, {}, span, load, place); });
      }
      if (norm(load) == 0.)
        throw EntryError(origin + "Sag", "without weight or wind a cable has none; give the "
                                         "Unstressed length");
      return about_entry(origin + "Sag", [&] { return length_for_sag(make, {}, span, load, sag); });
    }

    std::unique_ptr<Substructure> CableType::make(const BodySetting &setting) const
    {
      CableData result = data(setting);
      result.length = find_length(result);
      return std::make_unique<Cable>(result);
    }

    /// The nodes of the cable, with edges. In the plane the outer side of an edge is the side that
    /// weight and wind point to, on which the cable comes to rest.
    ContactSurface CableType::surface(const BodySetting &setting,
                                      const std::vector<unsigned int> &boundaries) const
    {
      if (!boundaries.empty())
        throw EntryError(setting.origin, "a cable has one boundary, the whole of it; name none");
      CableData result = data(setting);
      result.length = find_length(result);
      const Cable cable(result);
      ContactSurface surface;
      surface.dim = 1;
      for (unsigned int i = 0; i <= cable.elements().n_elements(); ++i)
        surface.points.push_back(add_scaled(
            result.from, 1.,
            cable.elements().position(cable.shape().positions,
                                      std::min(cable.elements().place(i), result.length))));
      for (unsigned int i = 0; i < cable.elements().n_elements(); ++i)
      {
        surface.faces.push_back({i, i + 1});
        surface.outward.push_back(force_per_length(result));
      }
      return surface;
    }

    std::vector<double> CableType::places_at(const std::vector<double> &x,
                                             const BodySetting &setting) const
    {
      constexpr unsigned int samples_per_element = 16;
      CableData result = data(setting);
      result.length = find_length(result);
      const Cable cable(result);
      const unsigned int n = samples_per_element * result.n_elements;
      const auto place = [&](const unsigned int i) { return result.length * i / n; };
      std::vector<double> samples;
      for (unsigned int i = 0; i <= n; ++i)
        samples.push_back(cable.position({place(i)}).x);
      const double same = 1e-9 * result.length;
      std::vector<double> places;
      for (const double wanted : x)
      {
        std::vector<double> found;
        for (unsigned int i = 0; i <= n; ++i)
          if (std::fabs(samples[i] - wanted) <= same)
            found.push_back(place(i));
          else if (i < n && std::fabs(samples[i + 1] - wanted) > same &&
                   (samples[i] < wanted) != (samples[i + 1] < wanted))
          {
            const auto ends = boost::math::tools::bisect(
                [&](const double s) { return cable.position({s}).x - wanted; }, place(i),
                place(i + 1), boost::math::tools::eps_tolerance<double>());
            found.push_back(.5 * (ends.first + ends.second));
          }
        if (found.size() != 1)
          throw UserError(to_text(
              "cable '", result.name, "' is ", found.empty() ? "nowhere" : "more than once",
              " at x = ", wanted,
              " m; at rest it reaches from x = ", *std::min_element(samples.begin(), samples.end()),
              " to ", *std::max_element(samples.begin(), samples.end()),
              " m. Write another x, or the unstressed arc length, 's, 0'"));
        places.push_back(found[0]);
      }
      return places;
    }

    const Register<BodyType, CableType> cable("cable",
                                              "a cable in space that moves by large amounts");
  } // namespace
} // namespace taut
