// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/entries.h"
#include <taut/base/exceptions.h>
#include <taut/mechanism/rigid_body.h>
#include <taut/scene/body_type.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <cmath>
#include <string>
#include <vector>

namespace taut
{
  namespace
  {
    /// The entries of a rigid body in a parameter file.
    class RigidBodyType : public BodyType
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override;
      std::size_t n_dofs() const override { return 18; }
      std::unique_ptr<Substructure> make(const BodySetting &setting) const override;

    private:
      double mass = 0.;
      std::vector<double> centre = {0., 0.}, moments, first_axis = {1., 0., 0.},
                          second_axis = {0., 1., 0.}, velocity = {0., 0., 0.},
                          angular_velocity = {0., 0., 0.}, outline;
    };

    void RigidBodyType::declare_parameters(dealii::ParameterHandler &prm)
    {
      using namespace dealii::Patterns;
      prm.add_parameter("Mass", mass, "[kg]", Double(0.));
      prm.add_parameter("Centre", centre, "Place of its centre of mass: x, y or x, y, z [m]",
                        List(Double(), 2, 3));
      prm.add_parameter("Moments of inertia", moments,
                        "About its three principal axes through the centre [kg m^2]",
                        List(Double(0.), 0, 3));
      prm.add_parameter("First axis", first_axis,
                        "Direction of the first principal axis: x, y or x, y, z [1]",
                        List(Double(), 2, 3));
      prm.add_parameter("Second axis", second_axis,
                        "Direction of the second one, across the first: x, y or x, y, z [1]",
                        List(Double(), 2, 3));
      prm.add_parameter("Velocity", velocity,
                        "With Start = given, of the centre: x, y or x, y, z [m/s]",
                        List(Double(), 2, 3));
      prm.add_parameter("Angular velocity", angular_velocity,
                        "With Start = given, about x, y, z [rad/s]", List(Double(), 3, 3));
      prm.add_parameter("Outline", outline,
                        "Places that a line joins in ParaView, x, y, z of one after the other; "
                        "empty: its principal axes [m]",
                        List(Double()));
    }

    std::unique_ptr<Substructure> RigidBodyType::make(const BodySetting &setting) const
    {
      /// Largest cosine of an angle that counts as a right angle, as entries are rounded.
      constexpr double right_angle = 1e-5;
      RigidBodyData data;
      data.name = setting.name;
      data.origin = setting.origin;
      data.mass = mass;
      const auto read = [&](const std::vector<double> &list, const std::string &name)
      { return parse_coordinates(list, setting.origin + "/" + name); };
      data.centre = read(centre, "Centre");
      data.gravity = setting.gravity;
      data.velocity = read(velocity, "Velocity");
      data.angular_velocity = read(angular_velocity, "Angular velocity");
      if (outline.size() % 3 != 0 || outline.size() == 3)
        throw EntryError(setting.origin + "/Outline",
                         "a line has two places or more, with x, y and z each");
      for (std::size_t i = 0; i < outline.size(); i += 3)
        data.outline.push_back({outline[i], outline[i + 1], outline[i + 2]});
      if (moments.size() != 3)
        throw EntryError(setting.origin + "/Moments of inertia",
                         "a rigid body needs three, about its principal axes [kg m^2]");
      for (unsigned int i = 0; i < 3; ++i)
        data.moments[i] = moments[i];
      data.axes[0] = parse_direction(first_axis, setting.origin + "/First axis");
      const Coordinates second = parse_direction(second_axis, setting.origin + "/Second axis");
      const double along = dot(data.axes[0], second);
      if (!(std::fabs(along) <= right_angle))
        throw EntryError(setting.origin + "/Second axis",
                         "it is not across the First axis, as principal axes are");
      const Coordinates across = add_scaled(second, -along, data.axes[0]);
      data.axes[1] = add_scaled({}, 1. / norm(across), across);
      data.axes[2] = cross(data.axes[0], data.axes[1]);
      return std::make_unique<RigidBody>(data);
    }

    const Register<BodyType, RigidBodyType> rigid_body("rigid body",
                                                       "a rigid body in space that moves and turns "
                                                       "by any amount");
  } // namespace
} // namespace taut
