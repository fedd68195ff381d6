// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_turning_direction_h
#define taut_turning_direction_h

#include <taut/base/coordinates.h>
#include <taut/interface/geometry.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /// An end of a turning constraint: a place of a body, or of the ground if it has no motion.
  struct LinkEnd
  {
    Coordinates position;                         ///< at U = 0, the same on all ranks [m]
    std::array<std::vector<Term>, 3> motion = {}; ///< along x, y, z, on bodies of this rank [m]
  };

  /**
   * The geometry of a constraint that turns with its ends and acts along the line between them:
   *
   *     D = sign (|Delta| - length),    Delta = start + motion . U.
   *
   * B_i is sign times d . motion along a direction d; d = Delta / |Delta| for forces at one state.
   */
  class TurningDirection : public Geometry
  {
  public:
    /// From end to end; the length is their distance at U = 0. @p push: see @ref sign.
    TurningDirection(const LinkEnd &first, const LinkEnd &second, double push);

    LinkEnd first;

    /// Motion along x, y, z of the second end, then minus that of the first, on this rank [m].
    std::array<std::vector<Term>, 3> motion;
    Coordinates start;  ///< Delta at U = 0, the same on all ranks [m]
    double length = 1.; ///< |Delta| at D = 0, positive [m]
    double sign = 1.;   ///< 1: N > 0 pushes the ends apart; -1: it pulls them together

    Kind kind() const override { return Kind::turning; }
    std::string fault() const override;
    std::vector<const std::vector<Term> *> forms() const override;

    /// D without a spring, at the difference of the ends [m].
    double gap(const Coordinates &difference) const { return sign * (norm(difference) - length); }

    /// True if the ends are closer than a millionth of the length: they have no direction.
    bool vanishes(const Coordinates &difference) const
    {
      constexpr double least_part = 1e-6;
      return !(norm(difference) > least_part * length);
    }

    /// Delta / |Delta|; where it vanishes, the direction at U = 0.
    Coordinates at(const Coordinates &difference) const;

    /// The constraint, linearised at a state: D = terms . U + gap.
    struct Linear
    {
      Coordinates direction; ///< of the link at the state
      double distance;       ///< |Delta| at the state [m]
      std::vector<Term> terms;
      double gap; ///< [m]
    };

    /// Linearises at the state Delta = start + @p motion [m].
    Linear linearised(const Coordinates &motion) const;

    /// Motion along a direction, with one term for each body of each end.
    std::vector<Term> along(const Coordinates &direction) const;
  };

  /// Two unit vectors normal to the unit vector @p d and to each other.
  std::array<Coordinates, 2> across(const Coordinates &d);
} // namespace taut

#endif
