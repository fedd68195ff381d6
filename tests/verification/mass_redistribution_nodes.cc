// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: 'Mass redistribution' takes the mass of a node at a rigid stop away without changing the
// total mass, its centre and its moment of inertia (the conditions of H. B. Khenous, P. Laborde,
// Y. Renard, European Journal of Mechanics A 27 (2008)), and leaves a mass matrix that is definite
// elsewhere; the first force of an impact then no longer grows like m v / step, for any scheme.
#include "scene_tests.h"

#include <taut/wire/wire_component.h>

using namespace verification;

namespace
{
  /// A wire of unequal elements with stops at one end and inside, and what moves with it rigidly.
  std::string wire(const std::string &components, const int degree, const std::string &massless)
  {
    const std::string stop = std::string("; Type = stop; From = ground; Gap = 1; Direction = ") +
                             (components == "bar" ? "1, 0" : "0, 1");
    return R"(Gravity = 0, 0; Start = given
Wire wire: From = 0, 0; To = 3, 0; Mass per length = 2; Axial stiffness = 900;
  Tension = 900; Bending stiffness = 5; Element size = 0.3; Degree = )" +
           std::to_string(degree) + "; Components = " + components + "\nLink end: To = wire @ 0" +
           stop + "\nLink middle: To = wire @ 1.3" + stop +
           "\nTime: Scheme = BDF2; Step = 1e-3; End = 1e-3; Mass redistribution = " + massless +
           "\n";
  }

  /// Mass, first and second moment about s = 0, least eigenvalue-like pivot, mass of the stops.
  struct Inertia
  {
    double mass = 0., first = 0., second = 0., largest_at_stops = 0., least_pivot = 0.;
  };

  Inertia inertia(const std::string &components, const int degree, const std::string &massless)
  {
    Inertia result;
    Session session(wire(components, degree, massless));
    const auto &body =
        static_cast<const taut::WireComponent &>(session.simulation().structure()[0]);
    const int n = body.n_dofs();
    const bool beam = components == "beam";

    // Displacement 1 and s: the values of all DoFs from the shape functions at many points would
    // need a solve; the DoFs of these two are known.
    std::vector<double> one(n, 0.), s(n, 0.);
    taut::LinearForm constraint;
    std::vector<char> at_stop(n, 0);
    for (const double stop : {0., 1.3})
    {
      body.value_at(stop, constraint);
      for (std::size_t i = 0; i < constraint.index.size(); ++i)
        at_stop[constraint.index[i]] |= std::fabs(constraint.value[i]) > .5;
    }
    // Nodes: 0 .. 1.3 in 5 elements, 1.3 .. 3 in 6.
    const unsigned int per_node = beam ? 2 : degree;
    for (int node = 0; node <= 11; ++node)
    {
      const double left = node < 5 ? node * .26 : 1.3 + (node - 5) * 1.7 / 6.,
                   h = node < 5 ? .26 : 1.7 / 6.;
      one[per_node * node] = 1.;
      s[per_node * node] = left;
      if (beam)
        s[2 * node + 1] = 1.;
      else if (node < 11)
        for (int k = 1; k < degree; ++k)
        {
          one[degree * node + k] = 1.;
          // Gauss-Lobatto points: the middle, or (1 -+ 1/sqrt(5))/2.
          const double xi = degree == 2 ? .5 : .5 * (1. + (k == 1 ? -1. : 1.) / std::sqrt(5.));
          s[degree * node + k] = left + xi * h;
        }
    }
    const auto product = [&](const std::vector<double> &x, const std::vector<double> &y)
    { return std::inner_product(x.begin(), x.end(), matrix_times(body.mass(), y).begin(), 0.); };
    result.mass = product(one, one);
    result.first = product(one, s);
    result.second = product(s, s);

    // Cholesky on the DoFs away from the stops.
    std::vector<double> a(n * n, 0.), diagonal(n);
    body.mass().visit([&](unsigned int i, unsigned int j, double value)
                      { a[i * n + j] = a[j * n + i] = value; });
    for (int i = 0; i < n; ++i)
      diagonal[i] = a[i * n + i];
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (at_stop[i])
          raise(result.largest_at_stops, a[i * n + j]);
    result.least_pivot = 1e300;
    for (int c = 0; c < n; ++c)
    {
      if (at_stop[c] || (!beam && c > static_cast<int>(degree) * 11))
        continue;
      result.least_pivot = std::min(result.least_pivot, a[c * n + c] / diagonal[c]);
      for (int r = c + 1; r < n; ++r)
        for (int k = c + 1; k < n; ++k)
          a[r * n + k] -= a[r * n + c] * a[c * n + k] / a[c * n + c];
    }
    return result;
  }

  struct Impact
  {
    double largest_force = 0., impulse = 0.;
  };

  Impact bar_on_wall(const Overrides &overrides)
  {
    Impact result;
    double before = 0.;
    run_scene(scene_file("bar_on_wall"), overrides,
              [&](const taut::StepView &view)
              {
                const double N = view.state.multiplier[0];
                result.largest_force = std::max(result.largest_force, N);
                result.impulse += N * (view.state.time - before);
                before = view.state.time;
              });
    return result;
  }
} // namespace

TEST(MasslessContact, mass_its_centre_and_its_inertia_stay)
{
  const std::vector<std::pair<std::string, int>> wires = {
      {"bar", 1}, {"bar", 2}, {"bar", 3}, {"string", 1}, {"string", 2}, {"beam", 3}};
  for (const auto &[components, degree] : wires)
  {
    const Inertia with = inertia(components, degree, "no"),
                  without = inertia(components, degree, "inertia"),
                  total = inertia(components, degree, "mass");
    const std::string name = components + " of degree " + std::to_string(degree);
    for (const Inertia *i : {&with, &without})
    {
      // rho L, rho L^2/2, rho L^3/3
      EXPECT_NEAR(i->mass, 6., 1e-12) << name;
      EXPECT_NEAR(i->first, 9., 1e-12) << name;
      EXPECT_NEAR(i->second, 18., 1e-12) << name;
    }
    EXPECT_GT(with.largest_at_stops, .05) << name;
    EXPECT_EQ(without.largest_at_stops, 0.) << name;
    EXPECT_GT(without.least_pivot, 1e-3) << name;
    EXPECT_NEAR(total.mass, 6., 1e-12) << name;
    EXPECT_EQ(total.largest_at_stops, 0.) << name;
    EXPECT_GT(total.least_pivot, 1e-3) << name;
  }
}

// Exact: 300 N. With mass at the node the first force is m v / step.
TEST(MasslessContact, an_impact_makes_no_peak_that_grows_as_the_step_falls)
{
  for (const std::string scheme : {"BDF2", "Newmark", "HHT", "generalised-alpha"})
  {
    const Overrides common = {"Time.Scheme=" + scheme, "Time.End=0.6"};
    const auto with = [&](const Overrides &more) { return bar_on_wall(more + common); };
    const Impact coarse = with({"Time.Step=1e-4", "Time.Mass redistribution=mass"}),
                 fine = with({"Time.Step=1e-5", "Time.Mass redistribution=mass"});
    figure("bar on wall without mass at the node, largest force, 1e-5 s, " + scheme,
           fine.largest_force, "N");
    EXPECT_LT(fine.largest_force, 1.05 * coarse.largest_force) << scheme;
    EXPECT_LT(fine.largest_force, 600.) << scheme;
    EXPECT_NEAR(fine.impulse, 300. * .1, .01 * 300. * .1) << scheme;
  }
  const Impact spike = bar_on_wall({"Time.Scheme=BDF2", "Time.End=0.6", "Time.Step=1e-5"});
  figure("bar on wall with mass at the node, largest force, 1e-5 s, BDF2", spike.largest_force,
         "N");
  EXPECT_GT(spike.largest_force, 5000.);
}

TEST(MasslessContact, stops_that_leave_no_node_to_take_the_mass_are_named)
{
  EXPECT_THROW(Session(wire("bar", 1, "mass") + "Wire wire: Element size = 3\n"), taut::EntryError);
}
