// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_catenary_h
#define taut_catenary_h

#include "catenary_droppers.h"

#include <taut/scene/scene_generator.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * Scene generator `catenary`: a tension length of a railway overhead line with equal spans. A
   * contact wire hangs on droppers under a messenger wire, with pantographs below. x runs from the
   * first mast; the contact wire is at y = 0. In space both wires move along z, too. Stagger holds
   * them in turn on both sides of z = 0, wind blows along z, and droppers hang between the
   * displaced wires.
   */
  class Catenary : public SceneGenerator
  {
  public:
    void declare_names(dealii::ParameterHandler &prm) override;
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void fill(Scene &scene) const override;

  private:
    /// Index of the wires in the scene.
    enum : std::size_t
    {
      messenger_wire,
      contact_wire
    };
    struct WireItem
    {
      std::string model = "beam";
      double mass_per_length, tension, bending_stiffness, element_size;
      double mass_damping = 0.0125, stiffness_damping = 1e-4;
      unsigned int degree = 2;
      double stagger = 0.;
      std::string wind = "0";
      void declare(dealii::ParameterHandler &prm, const std::string &section);
      Wire wire(const std::string &name, double y, double length) const;
      Expression wind_load(const std::string &section) const;
    };
    struct PantographItem
    {
      std::vector<double> masses = {7.2, 15.}, stiffnesses = {4200., 50.}, dampings = {10., 90.};
      double static_force = 120., start = 60., speed = 250.;
      std::string contact_stiffness = "50000", profile = "0";
      double contact_damping = 0.;
      void declare(dealii::ParameterHandler &prm);
    };

    bool is_in_space() const;
    void check_line() const;
    void check_pantographs() const;
    void add_wires(Scene &scene) const;
    void add_lateral(Scene &scene) const;
    void hold_aside(std::size_t wire, const WireItem &item, const std::string &name,
                    Scene &scene) const;
    void add_pantograph(const std::string &name, const PantographItem &item, Scene &scene) const;

    unsigned int n_spans = 10;
    double span_length = 60., encumbrance = 1.2;
    bool lateral = false;
    WireItem contact{"beam", 1.35, 20000., 195., .5, .0125, 1e-4, 2},
        messenger{"beam", 1.07, 16000., 131.7, .5, .0125, 1e-4, 2};
    std::string messenger_support_stiffness = "rigid";
    double arm_mass = 1., arm_stiffness = 0., arm_damping = 0.;
    CatenaryDroppers droppers;
    std::vector<double> uplift_positions;
    std::vector<std::string> pantographs = {"pantograph"};
    std::vector<PantographItem> pantograph_items;
  };
} // namespace taut

#endif
