// SPDX-License-Identifier: LGPL-2.1-or-later
// A scene generator outside of Taut: a weight is put on an elastic floor.
#include <taut/scene/scene_generator.h>

#include <taut/base/registry.h>

#include <deal.II/base/parameter_handler.h>

namespace
{
  class WeightOnFloor : public taut::SceneGenerator
  {
  public:
    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.enter_subsection("Weight on floor");
      prm.add_parameter("Mass", mass, "[kg]");
      prm.leave_subsection();
    }

    void fill(taut::Scene &scene) const override
    {
      scene.masses.resize(1);
      scene.masses[0].name = "weight";
      scene.masses[0].mass = mass;
      taut::Link floor;
      floor.name = "floor";
      floor.kind = taut::LinkKind::stop;
      floor.to = {taut::Attachment::Kind::mass, 0, 0.};
      floor.stiffness = 1000.;
      scene.links.push_back(floor);
    }

  private:
    double mass = 1.;
  };

  const taut::Register<taut::SceneGenerator, WeightOnFloor> entry("weight on floor",
                                                                  "a weight on an elastic floor");
} // namespace
