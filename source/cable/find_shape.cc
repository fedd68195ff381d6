// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/dot.h>
#include <taut/base/exceptions.h>
#include <taut/cable/find_shape.h>
#include <taut/substructure/local_solver.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace taut
{
  namespace
  {
    constexpr double eps = std::numeric_limits<double>::epsilon();

    std::string text_of(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    /// Newton's method for one cable and load.
    class Search
    {
    public:
      Search(const CableElements &cable, const std::vector<unsigned int> &held,
             const std::vector<double> &load)
          : held(held), load(load),
            solver(make_block_tridiagonal_solver(CableElements::dofs_per_node))
      {
        const std::vector<unsigned int> unused = cable.unused_dofs();
        this->held.insert(this->held.end(), unused.begin(), unused.end());
        std::sort(this->held.begin(), this->held.end());
        M = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
        CableSection one;
        one.mass_per_length = 1.;
        CableElements(cable.element(), cable.length(), cable.n_elements(), one).add_mass(1., *M);
      }

      /// From @p q on; false, and q as it was, if there is no stable equilibrium within reach.
      bool solve(const CableElements &cable, const double relative_tolerance,
                 std::vector<double> &q)
      {
        const std::vector<double> start = q;
        for (const bool downhill : {false, true})
        {
          q = start;
          if (iterate(cable, relative_tolerance, downhill, q))
            return true;
        }
        q = start;
        return false;
      }

      unsigned int iterations() const { return n_iterations; }
      double residual() const { return last_residual; }

      /// True if the last equilibrium was one, stable or not.
      bool is_balanced() const { return balanced; }

      /// True if the tangent is positive definite.
      bool is_stable(const CableElements &cable, const std::vector<double> &q)
      {
        return factor(cable, q, false, 0.);
      }

    private:
      /// The forces that are not balanced, and their largest: moments over the length of an
      /// element.
      double find_residual(const CableElements &cable, const std::vector<double> &q)
      {
        cable.internal_force(q, {}, r);
        for (std::size_t i = 0; i < r.size(); ++i)
          r[i] = load[i] - r[i];
        for (const unsigned int i : held)
          r[i] = 0.;
        return largest(cable, r);
      }

      static bool is_slope(const CableElements &cable, const std::size_t dof)
      {
        return cable.element() == CableElement::ancf && dof % 6 > 2;
      }

      static double largest(const CableElements &cable, const std::vector<double> &forces)
      {
        double result = 0.;
        for (std::size_t i = 0; i < forces.size(); ++i)
        {
          const double size =
              std::fabs(forces[i]) / (is_slope(cable, i) ? cable.element_length() : 1.);
          if (!(size <= result)) // NaN stays
            result = size;
        }
        return result;
      }

      double energy(const CableElements &cable, const std::vector<double> &q) const
      {
        return cable.strain_energy(q) - dot(load, q);
      }

      /// What rounding leaves of forces that are in balance.
      static double rounding(const CableElements &cable, const std::vector<double> &q)
      {
        double size = 0.;
        for (std::size_t i = 0; i < q.size(); ++i)
          if (!is_slope(cable, i))
            size = std::max(size, std::fabs(q[i]));
        const CableSection &section = cable.section();
        const double h = cable.element_length();
        return 8. * eps * (section.axial_stiffness + section.bending_stiffness / (h * h)) *
               (1. + size / h);
      }

      bool factor(const CableElements &cable, const std::vector<double> &q, const bool definite,
                  const double mu)
      {
        const auto K = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
        cable.add_tangent(q, definite, *K);
        try
        {
          solver->factor({{1., K.get()}, {mu, M.get()}}, held);
        }
        catch (const BodyNotHeld &)
        {
          return false;
        }
        return true;
      }

      bool iterate(const CableElements &cable, double relative_tolerance, bool downhill,
                   std::vector<double> &q);
      bool step(const CableElements &cable, bool downhill, double &size, std::vector<double> &q);
      void polish(const CableElements &cable, double size, std::vector<double> &q);

      static constexpr unsigned int most_iterations = 60;
      static constexpr int most_polishing = 4;
      static constexpr double enough = 1e-4; ///< of the expected decrease of the energy (Armijo)

      std::vector<unsigned int> held;
      const std::vector<double> &load;
      std::unique_ptr<LocalSolver> solver;
      std::unique_ptr<SymmetricMatrix> M; ///< of 1 kg/m
      std::vector<double> r;
      unsigned int n_iterations = 0;
      double last_residual = 0.;
      bool balanced = false;
    };

    bool Search::iterate(const CableElements &cable, const double relative_tolerance,
                         const bool downhill, std::vector<double> &q)
    {
      double scale = largest(cable, load);
      double size = find_residual(cable, q);
      if (scale == 0.)
        scale = size;
      for (unsigned int k = 0; k < most_iterations; ++k)
      {
        last_residual = size;
        balanced = size <= std::max(relative_tolerance * scale, rounding(cable, q));
        if (balanced)
        {
          polish(cable, size, q);
          return is_stable(cable, q);
        }
        ++n_iterations;
        if (!step(cable, downhill, size, q))
          return false;
      }
      return false;
    }

    /// One step; false if there is none.
    bool Search::step(const CableElements &cable, const bool downhill, double &size,
                      std::vector<double> &q)
    {
      if (!factor(cable, q, false, 0.))
      {
        double mu = 1e-8 * cable.section().axial_stiffness / std::pow(cable.element_length(), 2);
        int trials = 0;
        for (; trials < 30 && !factor(cable, q, true, mu); ++trials)
          mu *= 10.;
        if (trials == 30)
          return false;
      }
      std::vector<double> direction = r;
      solver->solve(direction);
      const std::vector<double> start = q;
      const double slope = dot(r, direction), start_energy = downhill ? energy(cable, q) : 0.,
                   start_size = size;
      for (double length = 1.; length > 1e-9; length *= .5)
      {
        for (std::size_t i = 0; i < q.size(); ++i)
          q[i] = start[i] + length * direction[i];
        size = find_residual(cable, q);
        if (!std::isfinite(size))
          continue;
        if (!downhill || energy(cable, q) <= start_energy - enough * length * slope)
          return true;
        // Beside the equilibrium the energy is level to rounding.
        if (length == 1. && slope < 1e-9 * std::fabs(start_energy) && size < start_size)
          return true;
      }
      return false;
    }

    /// Steps that only rounding ends.
    void Search::polish(const CableElements &cable, double size, std::vector<double> &q)
    {
      std::vector<double> best = q;
      double least = size;
      for (int k = 0; k < most_polishing && step(cable, false, size, q) && size < .5 * least; ++k)
      {
        best = q;
        least = size;
      }
      q = best;
      last_residual = find_residual(cable, q);
    }

    /// Of the softest cable of a search, 2 to 20 times the tension unless EA is less.
    double first_stiffness(const double EA, const double tension)
    {
      double stiffness = EA;
      for (int decades = 0; decades < 15 && stiffness > 20. * tension; ++decades)
        stiffness *= .1;
      return stiffness;
    }

    /// A unit vector along @p a, or zero.
    Coordinates unit(const Coordinates &a)
    {
      const double size = norm(a);
      return size == 0. ? a : Coordinates{a.x / size, a.y / size, a.z / size};
    }

    /// A parabola from its first point on: chord and depth.
    struct Parabola
    {
      Coordinates chord, down;
      double depth;

      Coordinates at(const double t) const
      {
        return add_scaled(add_scaled({}, t, chord), 4. * depth * t * (1. - t), down);
      }
      Coordinates derivative(const double t) const
      {
        return add_scaled(chord, 4. * depth * (1. - 2. * t), down);
      }

      /// Arc length at n + 1 values of t.
      std::vector<double> arc_lengths(const unsigned int n) const
      {
        std::vector<double> s = {0.};
        for (unsigned int i = 0; i < n; ++i)
          s.push_back(s.back() + norm(derivative((i + .5) / n)) / n);
        return s;
      }
    };

    constexpr unsigned int parabola_points = 1000;

    /// The parabola of this length between two points, or the line if that is longer.
    Parabola parabola(const Coordinates &chord, const Coordinates &down, const double length)
    {
      if (length <= norm(chord))
        return {chord, down, 0.};
      double low = 0., high = length;
      for (int k = 0; k < 50; ++k)
      {
        const double depth = .5 * (low + high);
        const bool is_short =
            Parabola{chord, down, depth}.arc_lengths(parabola_points).back() < length;
        (is_short ? low : high) = depth;
      }
      return {chord, down, high};
    }

    std::vector<double> positions(const CableElements &cable, const Coordinates &from,
                                  const Parabola &shape)
    {
      const std::vector<double> arc = shape.arc_lengths(parabola_points);
      const double scale = arc.back() / cable.length();
      const auto parameter = [&](const double s)
      {
        const auto next = std::clamp<std::ptrdiff_t>(
            std::upper_bound(arc.begin(), arc.end(), s * scale) - arc.begin(), 1, parabola_points);
        return (next - 1 + (s * scale - arc[next - 1]) / (arc[next] - arc[next - 1])) /
               parabola_points;
      };
      return cable.interpolate(
          [&](const double s) { return add_scaled(from, 1., shape.at(parameter(s))); },
          [&](const double s)
          { return add_scaled({}, scale, unit(shape.derivative(parameter(s)))); });
    }
  } // namespace

  CableShape find_shape(const CableElements &cable, const std::vector<double> &start,
                        const std::vector<unsigned int> &held, const std::vector<double> &load,
                        const double tension)
  {
    Search search(cable, held, load);
    CableShape result;
    result.positions = start;
    const double EA = cable.section().axial_stiffness;
    // A stage that fails is left out: the next one may be within reach.
    for (double stiffness = tension > 0. ? first_stiffness(EA, tension) : EA; stiffness < .9 * EA;
         stiffness *= 10.)
      search.solve(cable.with_axial_stiffness(stiffness), 1e-3, result.positions);
    if (search.solve(cable, 1e-10, result.positions))
    {
      result.n_iterations = search.iterations();
      result.residual = search.residual();
      return result;
    }
    if (!std::isfinite(search.residual()))
      throw UserError("its length, stiffness or load is beyond the range of numbers; take less "
                      "extreme values");
    throw UserError("no stable equilibrium of the cable was found: after " +
                    std::to_string(search.iterations()) + " iterations a force of " +
                    text_of(search.residual()) +
                    (search.is_balanced() ? " N is not balanced, which is good enough, but the "
                                            "least push would move the cable away"
                                          : " N is not balanced") +
                    "; take more elements, a little bending stiffness, or ends that are further "
                    "apart across the load");
  }

  CableShape hang(const CableElements &cable, const Coordinates &from, const Coordinates &to,
                  const Coordinates &force)
  {
    std::vector<unsigned int> held;
    for (const bool last : {false, true})
      for (const unsigned int i : cable.end_dofs(last))
        held.push_back(i);
    std::vector<double> load(cable.n_dofs(), 0.);
    cable.add_load(force, load);

    const Coordinates chord = to - from, down = unit(force);
    const double distance = norm(chord), length = cable.length(), w = norm(force),
                 span = norm(add_scaled(chord, -dot(chord, down), down));
    // Tension of a line without slack that its own stretch lets down.
    const double EA = cable.section().axial_stiffness,
                 of_stretch = std::cbrt(EA * std::pow(w * span, 2) / 24.);
    if (EA * (distance / length - 1.) > of_stretch)
      return find_shape(cable, positions(cable, from, {chord, down, 0.}), held, load);
    if (w == 0.)
      throw UserError("a cable of " + text_of(length) + " m between ends " + text_of(distance) +
                      " m apart has no shape of its own without weight or wind; make it shorter or "
                      "give it a load");
    const double of_slack = w * span * span / (8. * parabola(chord, down, length).depth);
    if (of_stretch < of_slack)
      return find_shape(
          cable, positions(cable, from, parabola(chord, down, length * (1. + of_stretch / EA))),
          held, load);
    // Stretched by its tension: without any, nothing would hold the first step.
    const double tension = .5 * w * length + of_slack,
                 stretched = length * (1. + tension / first_stiffness(EA, tension));
    return find_shape(cable, positions(cable, from, parabola(chord, down, stretched)), held, load,
                      tension);
  }

  double horizontal_tension(const CableElements &cable, const CableShape &shape,
                            const Coordinates &force)
  {
    const std::vector<double> &q = shape.positions;
    const Coordinates chord = cable.position(q, cable.length()) - cable.position(q, 0.),
                      down = unit(force), across = unit(add_scaled(chord, -dot(chord, down), down));
    std::vector<double> f;
    cable.internal_force(q, {}, f);
    return -cable.position(0., across).dot(f);
  }

  double sag(const CableElements &cable, const CableShape &shape, const Coordinates &force)
  {
    const std::vector<double> &q = shape.positions;
    const Coordinates from = cable.position(q, 0.),
                      chord = cable.position(q, cable.length()) - from, down = unit(force),
                      across = add_scaled(chord, -dot(chord, down), down);
    const double span_squared = dot(across, across);
    const auto height = [&](const double s)
    {
      const Coordinates r = cable.position(q, s) - from;
      const double t = span_squared == 0. ? 0. : dot(r, across) / span_squared;
      return -dot(add_scaled(r, -t, chord), down);
    };
    const double h = cable.element_length();
    unsigned int lowest = 0;
    for (unsigned int i = 1; i <= cable.n_elements(); ++i)
      if (height(i * h) < height(lowest * h))
        lowest = i;
    return -boost::math::tools::brent_find_minima(height, std::max(0., (lowest - 1.) * h),
                                                  std::min(cable.length(), (lowest + 1.) * h), 40)
                .second;
  }

  namespace
  {
    /// The length at which @p quantity, which falls with it or rises, is zero; @p guess is near.
    template <typename Quantity>
    double find_length(const Quantity &quantity, const double guess, const std::string &name)
    {
      double low = guess, high = guess, at_low = quantity(guess), at_high = at_low;
      for (double width = 1e-4; at_low * at_high > 0.; width *= 4.)
      {
        if (width > .8)
          throw UserError("no unstressed length near " + text_of(guess) + " m gives the " + name +
                          "; give the length itself");
        low = guess * (1. - width);
        high = guess * (1. + width);
        at_low = quantity(low);
        at_high = quantity(high);
      }
      if (!std::isfinite(at_low * at_high))
        throw UserError("the " + name +
                        " is beyond the range of numbers; take less extreme values");
      if (at_low == 0.)
        return low;
      if (at_high == 0.)
        return high;
      std::uintmax_t n = 100;
      const auto found = boost::math::tools::toms748_solve(
          quantity, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(46), n);
      return .5 * (found.first + found.second);
    }

    /// The unstressed length of a parabola of this horizontal tension, or without @p depth.
    double length_of_parabola(const CableElements &cable, const Coordinates &chord,
                              const Coordinates &force, const double depth, const double tension)
    {
      const Parabola shape{chord, unit(force), depth};
      const double length = shape.arc_lengths(parabola_points).back(),
                   span = norm(add_scaled(chord, -dot(chord, shape.down), shape.down)),
                   mean = tension * length / span;
      return length / (1. + mean / cable.section().axial_stiffness);
    }

    double span_of(const Coordinates &from, const Coordinates &to, const Coordinates &force)
    {
      const Coordinates chord = to - from, down = unit(force);
      const double span = norm(add_scaled(chord, -dot(chord, down), down));
      if (!(span > 1e-9 * norm(chord)) || span == 0.)
        throw UserError("the ends are not apart across the load: give the unstressed length");
      return span;
    }
  } // namespace

  double length_for_tension(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                            const Coordinates &force, const double tension)
  {
    const double span = span_of(from, to, force),
                 depth = norm(force) * span * span / (8. * tension);
    const Coordinates chord = to - from;
    if (norm(force) == 0.) // a straight line
      return length_of_parabola(make(span), chord, force, 0., tension);
    return find_length(
        [&](const double length)
        {
          const CableElements cable = make(length);
          // Compressed: less than any tension.
          const double H = horizontal_tension(cable, hang(cable, from, to, force), force);
          return std::log(std::max(H / tension, 1e-300));
        },
        length_of_parabola(make(norm(chord)), chord, force, depth, tension), "horizontal tension");
  }

  double length_for_sag(const MakeCable &make, const Coordinates &from, const Coordinates &to,
                        const Coordinates &force, const double depth)
  {
    const double span = span_of(from, to, force),
                 tension = norm(force) * span * span / (8. * depth);
    const Coordinates chord = to - from;
    return find_length(
        [&](const double length)
        {
          const CableElements cable = make(length);
          return sag(cable, hang(cable, from, to, force), force) / depth - 1.;
        },
        length_of_parabola(make(norm(chord)), chord, force, depth, tension), "sag");
  }
} // namespace taut
