// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/patterns.h"
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  using namespace dealii::Patterns;

  void TimeParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Scheme", scheme,
                      "Time integration. 'automatic' follows from the links of the scene, their "
                      "bodies and the step; the log says what and why. " +
                          Registry<TimeIntegrator>::instance().descriptions(),
                      Selection("automatic|" + Registry<TimeIntegrator>::instance().names()));
    prm.add_parameter("Step", step, "[s]", not_negative());
    prm.add_parameter(
        "End", end,
        "A time; 0: the start only, e.g. a static equilibrium. 'until x = 540 m': the "
        "time at which the first sliding contact of the scene comes to this x [s]",
        Anything());
    step_parameters.declare_parameters(prm);
    prm.add_parameter(
        "Check steps", check_steps,
        "At the end of a run, whether its steps are short enough: it is made again with a step "
        "that is 4.24 times shorter, and more where this is in doubt. The log has the error; "
        "beyond 2 % of places and impulses or 5 % of energies a warning names the step that is "
        "needed. 'automatic': where the Scheme is 'automatic', too, each of these runs where it "
        "takes less than about half a second; of a longer one a run with longer steps gives a "
        "rough error. 'yes' takes about five times as long as the run",
        Selection("automatic|yes|no"));
    prm.add_parameter("Allow unsuitable scheme", allow_unsuitable_scheme,
                      "Run a scheme although it is known to fail with the links of the scene");
    prm.add_parameter(
        "Allow energy gain", allow_energy_gain,
        "Let a run succeed whose unilateral links, where they can only take energy, or large "
        "motions gave more than a tenth of the energy that moves");
    prm.add_parameter(
        "Mass redistribution", mass_redistribution,
        "Whether the node of a wire at a rigid stop or dropper gives its mass to its "
        "neighbours; impacts then take no energy and their force stays bounded as the step falls, "
        "with any scheme. 'mass': the total mass stays, the force overshoots least. 'inertia': "
        "the centre of mass and the moment of inertia stay as well. 'automatic': 'mass' at the "
        "stops "
        "of bars and strings where the Scheme is 'automatic', too, and this the best choice; "
        "otherwise 'no'",
        Selection("automatic|no|mass|inertia"));
  }
} // namespace taut
