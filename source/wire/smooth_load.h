// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_smooth_load_h
#define taut_smooth_load_h

#include "wire/element_load.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * A smooth force per length q(s, t) as polynomials on panels of 4 to 192 elements. In each step
   * the formula is evaluated at the Chebyshev points of the panels, and compared with the
   * polynomials at some further places, which change from step to step. A panel where they differ
   * is left to the caller.
   *
   * Panels are chosen for windows of time, each as long as all before it. At a few times of the
   * window the load is looked at in each element. A load that is not smooth on four elements at one
   * of them is not smooth in this window. What a time gets depends on it alone, not on earlier
   * calls. A wire that is cut has other panels, and forces that differ by what polynomials miss. As
   * long as a window lasts nothing is allocated.
   */
  class SmoothLoad
  {
  public:
    using Elements = std::vector<LoadedElement>;

    /// @p forces: on the @p n_dofs DoFs of each element by unit values at each of its Gauss points;
    /// from one element to the next it is @p dofs_between DoFs. All are kept by reference.
    SmoothLoad(const Expression &magnitude, const Elements &elements,
               const std::vector<double> &forces, unsigned int n_dofs, unsigned int dofs_between);

    /// Whether the load is smooth at the time t [s] and those near it.
    bool covers(double t) const;

    /// Adds the forces of the panels that are resolved at the time t, for which covers() holds;
    /// calls @p other for each element of the others.
    void add(double t, std::vector<double> &P,
             const std::function<void(std::size_t element)> &other) const;

  private:
    struct Panel;
    class Look;

    void choose(double t) const;
    bool split(std::size_t first, std::size_t last, const std::vector<Look> &looks) const;
    std::shared_ptr<const std::vector<double>> shared(std::vector<double> &&matrix,
                                                      unsigned int n_points) const;
    bool add_panel(std::size_t first, std::size_t last, unsigned int n_points,
                   const std::vector<Look> &looks) const;

    Expression magnitude;
    const Elements &elements;
    const std::vector<double> &forces;
    unsigned int n_dofs, dofs_between;

    mutable int window;
    mutable bool is_smooth = false;
    mutable std::vector<Panel> panels;
    mutable std::size_t n_nodes = 0;            ///< Chebyshev points of all panels
    mutable std::vector<double> places, values; ///< at these, then at their other places
  };

  struct SmoothLoad::Panel
  {
    std::size_t first, last; ///< its elements, the last one excluded
    unsigned int n_points;   ///< Chebyshev points
    double begin, length;    ///< [m]
    /// Forces on the DoFs by unit values at each point; panels of elements alike share it.
    std::shared_ptr<const std::vector<double>> matrix;
  };
} // namespace taut

#endif
