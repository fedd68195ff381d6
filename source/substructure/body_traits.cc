// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/substructure/body_traits.h>

namespace taut
{
  std::vector<double> SlenderBody::softer_axial_stiffnesses(const double EA, const double load)
  {
    std::vector<double> result;
    if (!(load > 0.))
      return result;
    double softest = EA;
    for (int decades = 0; decades < 15 && softest > 20. * load; ++decades)
      softest *= .1;
    for (double stiffness = softest; stiffness < .9 * EA; stiffness *= 10.)
      result.push_back(stiffness);
    return result;
  }
} // namespace taut
