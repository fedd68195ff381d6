// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_catenary_h
#define taut_catenary_h

#include "scene/catenary_items.h"
#include "scene/line_geometry.h"
#include "scene/own_items.h"
#include "scene/tension_length.h"

#include "scene/travel.h"
#include <taut/scene/scene_generator.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Scene generator `catenary`: a railway overhead line of one or several tension lengths. A
   * contact wire hangs on droppers under a messenger wire, with pantographs below. Where tension
   * lengths overlap, a pantograph is below both of their contact wires. x runs along the line; a
   * level contact wire is at y = 0. In space both wires move along z, too. Stagger holds them
   * aside, wind blows along z, and droppers hang between the displaced wires.
   */
  class Catenary : public SceneGenerator
  {
  public:
    void declare_names(dealii::ParameterHandler &prm) override;
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void fill(Scene &scene) const override;
    std::vector<std::string> warnings() const override;

  private:
    struct PantographItem
    {
      std::vector<double> masses = {7.2, 15.}, stiffnesses = {4200., 50.}, dampings = {10., 90.};
      std::vector<double> lift, stop_gaps, stop_stiffnesses;
      double static_force = 120., start = 60.;
      double strip_distance = 0., head_inertia = 0., pitch_stiffness = 0., pitch_damping = 0.;
      std::string speed = "250", base_motion, stop_laws;
      std::string contact_stiffness = "50000", profile = "0";
      double contact_damping = 0.;
      bool faster_than_waves = false;
      std::set<std::string> given; ///< entries that decide the contact force, of the file
      void declare(dealii::ParameterHandler &prm);
    };
    using Line = std::vector<TensionLength>;

    bool is_in_space(const std::vector<LineItems> &of_parts) const;
    std::vector<LineLayout> layouts() const;

    /// The items of each tension length; whether it is in space is not known yet.
    std::vector<LineItems> items_of_parts() const;
    std::string section_of(std::size_t tension_length) const;
    void check_given(const LineItems &own, const LineLayout &part) const;
    void check_wires(const std::vector<LineItems> &of_parts) const;
    void check_uplift_positions(const std::vector<double> &positions, const Line &line) const;
    void check_pantographs(const Line &line) const;
    void check_cant(const Line &line) const;
    /// The entry Speed of a pantograph in @p section.
    static Speed speed_of(const PantographItem &item, const std::string &section);
    static bool is_as_fast(const PantographItem &a, const PantographItem &b,
                           const std::string &section);
    /// Laws of the bump stops, one for each mass; null where there is none.
    static std::vector<std::shared_ptr<const ForceLaw>> stop_laws(const PantographItem &item,
                                                                  const std::string &section);
    void check_bump_stops(const PantographItem &item, const std::string &section) const;
    void check_lists(const PantographItem &item, const std::string &section) const;
    void add_pantograph(const std::string &name, const PantographItem &item, const Line &line,
                        Scene &scene) const;
    void add_masses(const std::string &name, const PantographItem &item, Scene &scene) const;
    void let_head_pitch(const std::string &name, const PantographItem &item, std::size_t head,
                        Scene &scene) const;
    void check_point_masses(const Line &line) const;
    void add_strip(Link strip, const std::string &profile, double x, bool has_several,
                   const Line &line, Scene &scene) const;
    void add_base(const std::string &name, const PantographItem &item, std::size_t first,
                  Scene &scene) const;
    void add_bump_stops(const std::string &name, const PantographItem &item, std::size_t first,
                        Scene &scene) const;

    std::string kind = "catenary", twin_droppers = "both";
    LineItems items;
    LineGeometry geometry; ///< of the only tension length
    NamedItems<TensionLengthItem> tension_lengths{
        "Catenary", "Tension lengths", "Tension length",
        "parts of the line with wires of their own, which may overlap; empty: one"};
    std::string uplift_positions;
    std::vector<std::string> pantographs = {"pantograph"};
    std::vector<PantographItem> pantograph_items;
  };
} // namespace taut

#endif
