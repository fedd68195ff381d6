// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_network_h
#define taut_network_h

#include <taut/scene/named_items.h>
#include <taut/scene/scene_generator.h>

#include <string>
#include <vector>

namespace taut
{
  /// Scene generator `network`: any named wires, masses, springs, links, loads.
  /// Of the motions of a mass, in their order.
  constexpr const char *motion_names[4] = {"x", "y", "rotation", "z"};

  class Network : public SceneGenerator
  {
  public:
    void declare_names(dealii::ParameterHandler &prm) override;
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void fill(Scene &scene) const override;

    struct WireItem
    {
      std::vector<double> from = {0., 0.}, to = {1., 0.};
      std::vector<std::string> components;
      double mass_per_length = 0., axial_stiffness = 0., tension = 0., bending_stiffness = 0.;
      std::string remaining_mass = "1", remaining_axial = "1", remaining_bending = "1";
      unsigned int degree = 2;
      std::string mass_matrix = "consistent";
      double element_size = 1., mass_damping = 0., stiffness_damping = 0.;
      double foundation_stiffness = 0., foundation_damping = 0.;
      std::string tension_changes;
      bool weight = true;
      std::string axial_displacement = "0", axial_velocity = "0";
      std::string transverse_displacement = "0", transverse_velocity = "0";
      std::string lateral_displacement = "0", lateral_velocity = "0";
      void declare(dealii::ParameterHandler &prm);
    };
    struct SupportItem
    {
      std::string wire, positions = "0", motion = "transverse", kind = "fixed", displacement = "0";
      double stiffness = 0., damping = 0.;
      void declare(dealii::ParameterHandler &prm);
    };
    struct PointMassItem
    {
      std::string wire, positions = "0";
      double mass = 0.;
      bool weight = true;
      void declare(dealii::ParameterHandler &prm);
    };
    struct MassItem
    {
      std::vector<double> position = {0., 0.};
      std::vector<std::string> motions = {"y"};
      double mass = 0., inertia = 0.;
      bool weight = true;
      std::vector<double> displacement = {0., 0., 0.}, velocity = {0., 0., 0.};
      std::string prescribed[4]; ///< x, y, rotation, z
      std::string speed = "0";
      void declare(dealii::ParameterHandler &prm);
    };
    struct SpringItem
    {
      std::string from = "ground", to = "ground";
      std::vector<double> direction;
      bool rotational = false;
      double stiffness = 0., damping = 0.;
      void declare(dealii::ParameterHandler &prm);
    };
    struct LinkItem
    {
      std::string type = "joint", from = "ground", to, through, stiffness = "rigid", profile = "0";
      std::string law = "linear", law_points, law_formula;
      double law_range = 0.;
      std::vector<double> direction, axis, second_axis;
      bool rotational = false, find_length = false, find_direction = false, turns = false,
           straight = false, faster_than_waves = false;
      double damping = 0., gap = 0.;
      std::string length = "0";
      std::string speed = "0", strip;
      double prescribed_displacement = 0., axial_stiffness = 0., mass_per_length = 0., pull = 0.;
      void declare(dealii::ParameterHandler &prm);

    private:
      void declare_places(dealii::ParameterHandler &prm);
      void declare_force(dealii::ParameterHandler &prm);
      void declare_sliding(dealii::ParameterHandler &prm);
      void declare_found_length(dealii::ParameterHandler &prm);
    };
    struct LoadItem
    {
      std::string type = "point", on, magnitude = "0";
      std::vector<double> direction, axis;
      bool rotational = false, acts_while_built = true, faster_than_waves = false;
      std::string speed = "0";
      void declare(dealii::ParameterHandler &prm);
    };

  private:
    void add_wires(Scene &scene) const;
    void add_supports(Scene &scene) const;
    void add_point_masses(Scene &scene) const;
    void add_masses(Scene &scene) const;
    void add_springs(Scene &scene) const;
    void add_links(Scene &scene) const;
    void add_loads(Scene &scene) const;
    void add_probes(Scene &scene) const;

    NamedItems<WireItem> wires{"Network", "Wires", "Wire", "straight wires"};
    NamedItems<SupportItem> supports{"Network", "Supports", "Support", "supports of wires"};
    NamedItems<PointMassItem> point_masses{"Network", "Point masses", "Point mass",
                                           "masses on wires"};
    NamedItems<MassItem> masses{"Network", "Masses", "Mass", "lumped masses"};
    NamedItems<SpringItem> springs{"Network", "Springs", "Spring",
                                   "springs and dampers between masses or a mass and the ground"};
    NamedItems<LinkItem> links{"Network", "Links", "Link",
                               "joints, stops, droppers and sliding contacts"};
    NamedItems<LoadItem> loads{"Network", "Loads", "Load", "forces and moments"};
    NamedItems<ProbeItem> probes{"Network", "Probes", "Probe",
                                 "points of the scene whose motion is recorded, before those of "
                                 "Output"};
  };

  /// The gap of a dropper of a known unstressed length whose direction stays: this length less the
  /// distance of its undeformed ends along the direction [m].
  double gap_of_length(const Link &link, const Scene &scene);
} // namespace taut

#endif
