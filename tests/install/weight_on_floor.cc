// SPDX-License-Identifier: LGPL-2.1-or-later
// A program outside of Taut adds a scene generator and an observer: a weight is put on an elastic
// floor. The floor's force is m g (1 - cos(omega t)), omega^2 = k/m: 31.732 N at 0.1 s for 2
// kg, 9.81 m/s^2, 1000 N/m.
#include <taut/simulation/simulation.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <iostream>

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

    taut::Scene generate() const override
    {
      taut::Scene scene;
      scene.masses.resize(1);
      scene.masses[0].name = "weight";
      scene.masses[0].mass = mass;
      taut::Link floor;
      floor.name = "floor";
      floor.kind = taut::LinkKind::stop;
      floor.to = {taut::Attachment::Kind::mass, 0, 0.};
      floor.stiffness = 1000.;
      scene.links.push_back(floor);
      return scene;
    }

  private:
    double mass = 1.;
  };

  const taut::Register<taut::SceneGenerator, WeightOnFloor> entry("weight on floor",
                                                                  "a weight on an elastic floor");

  struct LastForce : taut::Observer
  {
    void record(const taut::StepView &step) override
    {
      time = step.state.time;
      force = step.state.multiplier.at(0);
    }
    double time = -1., force = 0.;
  };
} // namespace

int main(int argc, char **argv)
try
{
  taut::Parameters parameters;
  parameters.read(argc > 1 ? argv[1] : "", {"Weight on floor.Mass=2"});
  taut::Simulation simulation(parameters, std::cout);
  LastForce last;
  simulation.observe(last);
  simulation.run();
  std::cout << "t = " << last.time << " s: the floor carries " << last.force << " N\n";
  return std::abs(last.time - 0.1) < 1e-9 && std::abs(last.force - 31.732) < 0.01 ? 0 : 1;
}
catch (const std::exception &e)
{
  std::cerr << e.what() << '\n';
  return 1;
}
