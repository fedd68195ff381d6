// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/simulation/elasticity_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  void ElasticityParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const double most = Double::max_double_value;
    prm.enter_subsection("Elasticity");
    prm.add_parameter("Force", force,
                      "'taut --elasticity': static force on the contact wire, upwards [N]",
                      Double(1e-6, most));
    prm.add_parameter("Spacing", spacing, "Of the places along the wire [m]", Double(1e-6, most));
    prm.add_parameter("Range", range, "First and last x; empty: all of each wire [m]",
                      List(Double(), 0, 2));
    prm.add_parameter("Slackening", slackening,
                      "Whether links open and close under the force; otherwise those that carry a "
                      "force at rest stay closed, and the elasticity is linear");
    prm.leave_subsection();
  }
} // namespace taut
