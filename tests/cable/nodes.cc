// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: loads, and links that do not slide, are at nodes of a cable, wherever its equal elements
// end, and a cable of ANCF that does not bend has a kink there. Expected values: two straight bars;
// elastic catenaries that meet at the load, by Newton's method of the test.
#include "cable/joined_catenaries.h"
#include "cable/one_cable.h"
#include "cable/places_in_steps.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  /// Places that are nodes of a cable of 10 m in 10 elements.
  std::vector<double> nodes_with(const std::vector<double> &places,
                                 const CableElement kind = CableElement::bar, const double EI = 0.)
  {
    CableData data = cable_to({9., 0., 0.}, 10., {1e6, EI, 1., 0.}, 10);
    data.element = kind;
    data.places = places;
    const CableElements cable = make_elements(data, data.length);
    std::vector<double> nodes;
    for (unsigned int i = 0; i <= cable.n_elements(); ++i)
      nodes.push_back(cable.place(i));
    return nodes;
  }
} // namespace

// A weightless cable of 9.99 m over 10 m, pulled down by 100 N in the middle of its third element.
TEST(CableNodes, load_between_cable_nodes)
{
  const double EA = 1e6, half = .5 * 9.99;
  const double sag = end_of(1e-3, 1.,
                            [&](const double y)
                            {
                              const double l = std::hypot(5., y);
                              return 2. * EA * (l / half - 1.) * y / l < 100.;
                            });
  EXPECT_NEAR(sag, .163112, 5e-7);
  const std::string scene = R"(Generator = network; Gravity = 0, 0
Body rope: Type = cable; From = 0, 0; To = 10, 0; Unstressed length = 9.99; Axial stiffness = 1e6
Body rope: Mass per length = 0.1; Element = bar; Elements = 5
Load P: On = rope @ 4.995, 0; Direction = 0, -1; Magnitude = 100
Probe y: Point = rope @ 4.995, 0; Direction = 0, -1
Time: End = 0
)";
  const auto found = [&](const Overrides &overrides)
  {
    return history_of(scene, overrides, [](const StepView &step) { return step.probes[0]; }).back();
  };
  for (const char *n : {"1", "2", "5", "10"})
    EXPECT_NEAR(found({std::string("Body rope/Elements=") + n}), sag, 1e-9) << n;
  // A node is at the load, and the elements beside it are smooth there.
  const double ancf = found({"Body rope/Element=ANCF", "Body rope/Elements=10"});
  figure("sag under a load on ten ANCF elements without bending, relative error", ancf / sag - 1.);
  EXPECT_NEAR(ancf, sag, 1e-3 * sag);
}

// An inclined cable with weight, a load across at one place and a mass at another one.
TEST(CableNodes, load_and_mass_in_space)
{
  const double first = 3.3, second = 7.11, length = 12.;
  const Coordinates to = {9., 3., 2.}, force = {20., -30., 60.};
  JoinedCatenaries exact;
  const auto add = [&](const std::size_t from, const std::size_t end, const double L) {
    exact.cables.push_back({from, end, L, 2e5, {0., -.8 * 9.81, 0.}});
  };
  exact.n_free = 2;
  exact.places = {{3., -2., 1.}, {5., -2., 1.5}, {}, to};
  exact.loads = {force, {0., -4. * 9.81, 0.}};
  add(2, 0, first);
  add(0, 1, second - first);
  add(1, 3, length - second);
  ASSERT_LT(exact.solve(), 1e-7);

  const std::string scene = R"(Generator = network; Gravity = 0, -9.81; Start = equilibrium
Body rope: Type = cable; From = 0, 0, 0; To = 9, 3, 2; Unstressed length = 12
Body rope: Axial stiffness = 2e5; Mass per length = 0.8; Elements = 8
Mass lamp: Position = 6.164, -0.882, 1.37; Motions = x, y, z; Mass = 4
Link tie: Type = ball joint; From = lamp; To = rope @ 7.11, 0
Load P: On = rope @ 3.3, 0; Direction = 20, -30, 60; Magnitude = 70
Time: End = 0
)";
  for (const char *element : {"bar", "ANCF"})
  {
    double error = 0.;
    Session session(scene, {std::string("Body rope/Element=") + element});
    session.run(
        [&](const StepView &step)
        {
          for (const auto &[s, i] : {std::pair(first, 0), {second, 1}})
          {
            Attachment at;
            at.kind = Attachment::Kind::body;
            at.place = {s};
            Coordinates place = step.structure.position(step.scene, at);
            place = add_scaled(place, moved(step, at, {1., 0., 0.}), {1., 0., 0.});
            place = add_scaled(place, moved(step, at, {0., 1., 0.}), {0., 1., 0.});
            place = add_scaled(place, moved(step, at, {0., 0., 1.}), {0., 0., 1.});
            error = std::max(error, norm(place - exact.places[i]));
          }
        });
    figure(std::string("load and mass on a cable in space, error of their places, ") + element,
           error, "m");
    EXPECT_LT(error, 2e-3 * length) << element;
  }
}

TEST(CableNodes, are_at_places)
{
  const auto has_node = [](const std::vector<double> &nodes, const double s)
  { return std::any_of(nodes.begin(), nodes.end(), [&](double x) { return x == s; }); };
  // Equal elements remain as they are if they end there, up to digits that were not written.
  EXPECT_EQ(nodes_with({3., 7., 0., 10.}), nodes_with({}));
  EXPECT_EQ(nodes_with({2.9999999}), nodes_with({}));
  const std::vector<double> nodes = nodes_with({7.3, 2.45, 7.3});
  for (const double s : {0., 2.45, 7.3, 10.})
    EXPECT_TRUE(has_node(nodes, s)) << s;
  EXPECT_EQ(nodes.size(), 12u); // 3, 5 and 3 elements
  for (std::size_t i = 1; i < nodes.size(); ++i)
    EXPECT_LE(nodes[i] - nodes[i - 1], 1.);
  // ANCF has short elements beside a kink, unless it bends over more than half an element.
  EXPECT_EQ(nodes_with({5.}, CableElement::ancf).size(), 13u);
  EXPECT_EQ(nodes_with({5.}, CableElement::ancf, 1e4), nodes_with({}));
  EXPECT_EQ(nodes_with({5., 5.01}, CableElement::ancf).size(), 14u);
}

// Forces of elements of unequal length are the derivatives of their energy, and a mean force does
// its work.
TEST(CableNodes, forces_of_unequal_elements)
{
  for (const CableElement kind : {CableElement::ancf, CableElement::bar})
  {
    const CableElements cable(kind, {0., .7, 1., 2.3, 2.4, 3.1, 4., 4.2, 5.5, 5.7, 6.},
                              {100., kind == CableElement::ancf ? 3. : 0., 2., 0.});
    std::vector<double> q = cable.interpolate(
        [](const double s) {
          return Coordinates{.9 * s, .2 * std::sin(s), .1 * s * s};
        },
        [](const double s) {
          return Coordinates{.9, .2 * std::cos(s), .2 * s};
        });
    std::vector<double> f, q1 = q, mean;
    cable.internal_force(q, {}, f);
    for (std::size_t i = 0; i < q.size(); ++i)
    {
      const double h = 1e-6, x = q[i]; // truncation goes with h^2 / (0.1 m)^2
      q[i] = x + h;
      const double after = cable.strain_energy(q);
      q[i] = x - h;
      const double before = cable.strain_energy(q);
      q[i] = x;
      EXPECT_NEAR(f[i], (after - before) / (2. * h), 1e-6) << i;
      q1[i] = x + .03 * std::sin(7. * i);
    }
    cable.mean_force(q, q1, 1., mean);
    double work = 0.;
    for (std::size_t i = 0; i < q.size(); ++i)
      work += mean[i] * (q1[i] - q[i]);
    EXPECT_NEAR(work, cable.strain_energy(q1) - cable.strain_energy(q), 1e-11);

    // The tangent, applied to a small change.
    const auto K = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
    cable.add_tangent(q, false, *K);
    std::vector<double> way(q.size()), Kw(q.size(), 0.), f1, f0;
    for (std::size_t i = 0; i < q.size(); ++i)
      way[i] = 1e-6 * std::cos(5. * i);
    K->vmult_add(1., way.data(), Kw.data());
    q1 = q;
    std::vector<double> q0 = q;
    for (std::size_t i = 0; i < q.size(); ++i)
    {
      q1[i] += way[i];
      q0[i] -= way[i];
    }
    cable.internal_force(q1, {}, f1);
    cable.internal_force(q0, {}, f0);
    for (std::size_t i = 0; i < q.size(); ++i)
      EXPECT_NEAR(Kw[i], .5 * (f1[i] - f0[i]), 1e-10) << i;

    // The mass of the cable, and a load on it, as a whole.
    const auto M = make_block_tridiagonal(CableElements::dofs_per_node, cable.n_dofs());
    cable.add_mass(1., *M);
    const std::vector<double> line = cable.interpolate(
        [](const double s) {
          return Coordinates{s, 0., 0.};
        },
        [](const double) {
          return Coordinates{1., 0., 0.};
        });
    std::vector<double> Mx(line.size(), 0.), load(line.size(), 0.);
    M->vmult_add(1., line.data(), Mx.data());
    cable.add_load({1.5, 0., 0.}, load);
    double moment = 0., of_load = 0.;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      moment += line[i] * Mx[i];
      of_load += line[i] * load[i];
    }
    EXPECT_NEAR(moment, 2. * 6. * 6. * 6. / 3., 1e-11);
    EXPECT_NEAR(of_load, 1.5 * 6. * 6. / 2., 1e-12);
  }
}
