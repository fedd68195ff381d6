// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_unlike_weights_h
#define taut_unlike_weights_h

namespace taut
{
  /// Weights from 0.4 to 1.4, no two of them alike: in a sum with them opposite values do not
  /// cancel.
  class UnlikeWeights
  {
  public:
    double next()
    {
      constexpr double golden = 0.61803398874989485;
      const double result = weight;
      weight = weight > 1. ? weight - golden : weight + 1. - golden;
      return result;
    }

  private:
    double weight = 1.;
  };
} // namespace taut

#endif
