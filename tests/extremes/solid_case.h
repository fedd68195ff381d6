// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_solid_case_h
#define taut_extremes_solid_case_h

#include "scene_numbers.h"

#include <taut/scene/contact_surface.h>

namespace extremes
{
  /// A solid of rectangular cells, linear, from `from` to `from + size`.
  struct Box
  {
    std::array<unsigned int, 3> n = {1, 1, 1};                      ///< cells along the axes
    std::array<double, 3> from = {0., 0., 0.}, size = {1., 1., 1.}; ///< [m]
    std::array<double, 3> first = {0., 0., 0.}; ///< of its length: the first cell; 0: as the others

    std::vector<double> nodes(unsigned int axis) const; ///< coordinates of the planes of nodes [m]
  };

  enum class Touching
  {
    plane, ///< the lower side on a rigid plane
    mortar,
    nodes_to_faces
  };

  /// A box pressed on what is below it, a rigid plane or a second box that is held at its bottom. A
  /// traction acts on its top, downwards, load (1 - slope x / length) (1 + growth t), and a pull to
  /// the right on its right side. Two materials, left and right.
  struct SolidCase
  {
    std::string name;
    unsigned int dim = 2;
    Box upper, lower; ///< below the upper one; not used on a plane
    Touching touching = Touching::plane;
    bool held = true; ///< at its left side in all directions; else only across left and back sides
    double E[2] = {1., 1.}, nu[2] = {.3, .3}, density[2] = {1., 1.}; ///< [Pa, 1, kg/m^3]
    bool plane_stress = false;
    std::string mass = "consistent";
    double thickness = 1.;                                ///< [m]
    double load = 0., slope = 0., growth = 0., pull = 0.; ///< [Pa, 1, 1/s, Pa]
    double gap = 0., compliance = 0.;                     ///< [m, m/Pa]
    double velocity = 0.; ///< at t = 0, downwards, of the upper box [m/s]
    std::string start = "equilibrium", scheme = "backward Euler";
    double step = 1.; ///< [s]
    unsigned int n_steps = 3;
    std::string interface_operator = "assembled dense", complementarity = "semismooth Newton";
    std::vector<char> conserving; ///< of each constraint, for the copy; as of a Case
  };

  SolidCase in_units(const SolidCase &c, const Units &units);

  SolidCase in_last_digits(const SolidCase &c, unsigned int seed);

  /// Constraints of a contact as the library made them, and where the nodes of its sides are.
  struct ContactRows
  {
    std::vector<taut::Coordinates> slave_points, master_points;
    std::vector<taut::SurfaceConstraint> rows;
  };

  /// What the program says: displacements of the nodes of all boundaries, forces and gaps.
  Answer program_answer(const SolidCase &c, ContactRows &rows);

  /// What the copy in extended precision says with these constraints.
  Answer extended_answer(const SolidCase &c, const ContactRows &rows, bool as_double = false);
} // namespace extremes

#endif
