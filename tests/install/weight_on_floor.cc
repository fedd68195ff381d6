// SPDX-License-Identifier: LGPL-2.1-or-later
// A program outside of Taut with a scene generator, in weight.cc, and an observer: a weight is put
// on an elastic floor. The floor's force is m g (1 - cos(omega t)), omega^2 = k/m: 31.732 N at 0.1
// s for 2 kg, 9.81 m/s^2, 1000 N/m.
#include <taut/simulation/simulation.h>

#include <cmath>
#include <iostream>

namespace
{
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
