// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_smooth_load_h
#define taut_smooth_load_h

#include <taut/base/linear_form.h>
#include <taut/scene/expression.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace taut
{
  /// An element of a wire under a load: the forces of unit values at its Gauss points.
  struct LoadedElement
  {
    static constexpr unsigned int n_points = 4;

    std::array<LinearForm, n_points> shapes; ///< weighted
    std::array<double, n_points> places;     ///< [m]
    double begin, length;                    ///< [m]
    unsigned int n_pieces;                   ///< see LoadIntegral
  };

  /**
   * The forces of a smooth force per length q(s, t) by polynomials over panels of many elements: a
   * gust is evaluated at some hundred places, not at four in each element. A panel has the
   * polynomial of degree 8 through nine Gauss points, and one matrix from these values to the
   * forces of its elements.
   *
   * Formulas count as smooth that are made of analytic functions of (s - v t) alone, written so:
   * their shape travels and does not change. The length of panels is
   * found at set-up, at some times. A panel that is not resolved shows in the last coefficients of
   * its Legendre series, at each time; what is narrower than the distance of its points shows in
   * values at five places of each element, four times a second. In either case apply() returns
   * false, and the load is integrated element by element.
   */
  class SmoothLoad
  {
  public:
    /// The error of a polynomial, over the largest value of the load at the time, or a thousandth
    /// of that at set-up.
    static constexpr double tolerance = 1e-7;

    /// Elements one after the other; they are used here alone.
    SmoothLoad(const Expression &magnitude, const std::vector<LoadedElement> &elements);

    /// Adds the forces at time t [s]. False, with @p P as it is: the panels do not resolve the
    /// load. What it returns depends on t alone, not on earlier calls.
    bool apply(double t, std::vector<double> &P) const;

  private:
    static constexpr unsigned int n_points = 9, n_checks = 5;

    struct Panel
    {
      std::size_t begin, end;              ///< elements
      std::array<double, n_points> places; ///< [m]
      unsigned int first_dof = 0;
      std::vector<double> forces; ///< of each point in turn, one number a DoF
    };

    void make_panels(const std::vector<LoadedElement> &elements, std::size_t n_in_panel);
    void add_forces(const std::vector<LoadedElement> &elements, Panel &panel) const;
    void set_values(double t) const;
    bool look(double t) const;
    double scale(double largest) const;
    bool is_seen(double t) const;

    Expression magnitude;
    double size = 0.; ///< largest value at set-up
    std::vector<Panel> panels;
    std::vector<double> check_places; ///< in all elements [m]

    // What the last call found, kept for its memory and for the next call at a time near it.
    mutable std::vector<double> values, checks, some_places, some_values;
    mutable std::vector<char> is_active; ///< panels under the load
    mutable long quarter = -1;
    mutable bool quarter_is_seen = false;
    mutable std::optional<bool> next_is_seen; ///< at its end
  };
} // namespace taut

#endif
