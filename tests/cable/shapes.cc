// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables have the shape of the elastic catenary, whatever their slack. Source: closed forms.
#include "cable/elastic_catenary.h"

#include "verification/scene_tests.h"

#include <taut/cable/find_shape.h>

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr double EA = 1.3e7, mass = 1.07, gravity = 9.81;
  const Coordinates weight = {0., -mass *gravity, 0.};

  CableElements make(const CableElement element, const double length, const unsigned int n,
                     const double EI = 0.)
  {
    return {element, length, n, {EA, EI, mass, 0.}};
  }

  double end_force(const CableElements &cable, const CableShape &shape, const Coordinates &load)
  {
    std::vector<double> f, p(cable.n_dofs(), 0.);
    cable.internal_force(shape.positions, {}, f);
    cable.add_load(load, p);
    return std::hypot(std::hypot(f[0] - p[0], f[1] - p[1]), f[2] - p[2]);
  }

  double largest_error(const CableElements &cable, const CableShape &shape,
                       const ElasticCatenary &exact)
  {
    double error = 0.;
    for (unsigned int i = 0; i <= cable.n_elements(); ++i)
    {
      const double s = i * cable.element_length();
      error = std::fmax(error, norm(cable.position(shape.positions, s) - exact.position(s)));
    }
    return error;
  }

  TEST(CableShapes, FewIterationsWhateverTheSlack)
  {
    unsigned int most = 0, n_cables = 0;
    for (const double length : {59.93, 60., 63., 78., 120.})
    {
      const Coordinates to = {60., length == 63. ? -6. : 0., 0.};
      const ElasticCatenary exact({}, to, weight, EA, length);
      ASSERT_LT(exact.error, 1e-9);
      for (const unsigned int n : {8, 16, 32, 64})
        for (const double EI : {0., 1., -1.})
        {
          const CableElements cable =
              make(EI < 0. ? CableElement::bar : CableElement::ancf, length, n, std::fmax(EI, 0.));
          const CableShape shape = hang(cable, {}, to, weight);
          EXPECT_LE(shape.n_iterations, 25u) << length << " m, " << n << " elements";
          EXPECT_LT(shape.residual, 1e-6);
          EXPECT_LT(largest_error(cable, shape, exact), .03);
          most = std::max(most, shape.n_iterations);
          ++n_cables;
        }
    }
    EXPECT_EQ(n_cables, 60u);
    figure("iterations of a cable's shape, the most of 60", most);
  }

  struct Row
  {
    CableElement element;
    unsigned int n;
    double sag, force; ///< errors: [m], relative
  };

  void expect_catenary(const std::string &name, const double length, const std::vector<Row> &rows)
  {
    const Coordinates to = {60., 0., 0.};
    const ElasticCatenary exact({}, to, weight, EA, length);
    const double middle = .5 * length, depth = -exact.position(middle).y;
    for (const Row &row : rows)
    {
      const CableElements cable = make(row.element, length, row.n);
      const CableShape shape = hang(cable, {}, to, weight);
      const double sag_error = std::fabs(cable.position(shape.positions, middle).y + depth),
                   force_error =
                       std::fabs(end_force(cable, shape, weight) / exact.end_force() - 1.);
      const std::string what = name + ", " + std::to_string(row.n) +
                               (row.element == CableElement::bar ? " bars" : " ANCF elements");
      figure("sag error of " + what, sag_error, "m");
      figure("end force error of " + what, force_error);
      EXPECT_LT(sag_error, 1.5 * row.sag) << what;
      EXPECT_LT(force_error, 1.5 * row.force) << what;
      // The largest distance from the chord is that of the middle.
      EXPECT_NEAR(sag(cable, shape, weight), depth, 2. * row.sag + 1e-12);
      EXPECT_NEAR(horizontal_tension(cable, shape, weight) / exact.horizontal(), 1.,
                  20. * row.force);
      // Continued from points inside of bars.
      EXPECT_NEAR(cable.tension(shape.positions, 0.) / exact.end_force(), 1., 2e-3);
    }
  }

  TEST(CableShapes, SlackCatenary)
  {
    const ElasticCatenary exact({}, {60., 0., 0.}, weight, EA, 78.);
    EXPECT_NEAR(-exact.position(39.).y, 22.1293, 5e-5);
    EXPECT_NEAR(exact.end_force(), 476.88, 5e-3);
    expect_catenary("a slack catenary", 78.,
                    {{CableElement::ancf, 8, 8.5e-4, 9e-7},
                     {CableElement::ancf, 32, 3.1e-6, 3e-9},
                     {CableElement::bar, 8, 6e-4, 6e-7},
                     {CableElement::bar, 32, 2e-6, 2e-9}});
  }

  /// The length with a horizontal tension H between level ends 60 m apart; V = w L / 2.
  double length_of(const double H)
  {
    const double w = mass * gravity;
    return end_of(30., 300.,
                  [&](const double L)
                  { return H * L / EA + 2. * H / w * std::asinh(.5 * w * L / H) < 60.; });
  }

  TEST(CableShapes, TautCatenary)
  {
    const double length = length_of(16e3);
    const ElasticCatenary exact({}, {60., 0., 0.}, weight, EA, length);
    EXPECT_NEAR(exact.horizontal(), 16e3, 1e-4);
    EXPECT_NEAR(-exact.position(.5 * length).y, .294866, 1e-6);
    expect_catenary("a taut catenary", length,
                    {{CableElement::ancf, 4, 6e-9, 2e-8}, {CableElement::bar, 4, 4e-9, 1e-8}});
  }

  TEST(CableShapes, WindInSpace)
  {
    const Coordinates to = {60., -6., 0.}, load = {0., -10.5, 8.};
    const ElasticCatenary exact({}, to, load, EA, 63.);
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      std::vector<double> sizes, errors;
      for (const auto &[n, limit] :
           {std::pair<unsigned int, double>{4, 1.6e-3}, {16, 6.5e-6}, {64, 1e-8}})
      {
        const CableElements cable = make(element, 63., n);
        const CableShape shape = hang(cable, {}, to, load);
        sizes.push_back(cable.element_length());
        errors.push_back(largest_error(cable, shape, exact));
        EXPECT_LT(errors.back(), 1.5 * limit) << n;
        EXPECT_LE(shape.n_iterations, 25u);
      }
      const double order = fitted_order(sizes, errors);
      figure(std::string("order of a cable in the wind, ") +
                 (element == CableElement::bar ? "bars" : "ANCF"),
             order);
      EXPECT_NEAR(order, 4., .15);
    }
  }

  TEST(CableShapes, FarFromTheParabola)
  {
    // One end above the other, wind along the line: any direction is as good as down.
    const Coordinates to = {2., -30., 5.}, load = {9., -5., 1.};
    for (const double length : {31., 45.})
    {
      const ElasticCatenary exact({}, to, load, EA, length);
      ASSERT_LT(exact.error, 1e-9);
      const CableElements cable = make(CableElement::ancf, length, 64);
      const CableShape shape = hang(cable, {}, to, load);
      EXPECT_LE(shape.n_iterations, 25u);
      EXPECT_LT(largest_error(cable, shape, exact), 1e-4);
    }
  }

  TEST(CableShapes, LengthFromTensionOrSag)
  {
    const Coordinates to = {60., 0., 0.};
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      const MakeCable of_length = [&](const double length) { return make(element, length, 32); };
      for (const double H : {150., 1e3, 16e3, 1e6})
        EXPECT_NEAR(length_for_tension(of_length, {}, to, weight, H), length_of(H), 2e-5) << H;
      for (const double H : {400., 16e3})
      {
        const double length = length_of(H);
        const ElasticCatenary exact({}, to, weight, EA, length);
        EXPECT_NEAR(length_for_sag(of_length, {}, to, weight, -exact.position(.5 * length).y),
                    length, 1e-6)
            << H;
      }
    }
    // Without load a tension is a matter of strain.
    const MakeCable of_length = [&](const double L) { return make(CableElement::ancf, L, 4); };
    EXPECT_NEAR(length_for_tension(of_length, {}, to, {}, 1300.), 60. / 1.0001, 1e-9);
  }

  TEST(CableShapes, LengthThroughAPlace)
  {
    const Coordinates to = {60., -6., 5.}, load = {0., -10.5, 8.};
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      const MakeCable of_length = [&](const double length) { return make(element, length, 32); };
      for (const double length : {61., 63., 90.})
      {
        const ElasticCatenary exact({}, to, load, EA, length);
        ASSERT_LT(exact.error, 1e-9);
        for (const double part : {.5, .15, .9})
          EXPECT_NEAR(length_through(of_length, {}, to, load, exact.position(part * length)),
                      length, 2e-5 * length)
              << part;
      }
    }
    // The middle of a level cable: its sag.
    const Coordinates level = {60., 0., 0.};
    const MakeCable of_length = [&](const double L) { return make(CableElement::bar, L, 32); };
    EXPECT_NEAR(length_through(of_length, {}, level, weight, {30., -5., 0.}),
                length_for_sag(of_length, {}, level, weight, 5.), 1e-9);
    const auto message = [&](const Coordinates &place, const Coordinates &force) -> std::string
    { return error_of([&] { length_through(of_length, {}, level, force, place); }); };
    EXPECT_TRUE(has(message({30., 1., 0.}, weight), "1 m above the straight line"));
    EXPECT_TRUE(has(message({30., -1., .5}, weight), "0.5 m beside it"));
    EXPECT_TRUE(has(message({61., -1., 0.}, weight), "not between the ends"));
    EXPECT_TRUE(has(message({30., -1., 0.}, {}), "straight line; give the unstressed length"));
  }

  TEST(CableShapes, CompressedLineIsNoAnswer)
  {
    // Dead loads push a straight line together: its equilibrium is not stable, that found is aside.
    const CableElements cable(CableElement::ancf, 10., 16, {1e5, 1., 0., 0.});
    const auto place = [](const double s) { return Coordinates{.95 * s, 0., 0.}; };
    const std::vector<double> start = cable.interpolate(place, [&](double) { return place(1.); });
    std::vector<unsigned int> held;
    for (const bool last : {false, true})
      for (const unsigned int i : cable.end_dofs(last))
        held.push_back(i);
    std::vector<double> load(cable.n_dofs(), 0.);
    cable.add_load({0., -1e-3, 0.}, load);
    const CableShape shape = find_shape(cable, start, held, load);
    EXPECT_LT(cable.position(shape.positions, 5.).y, -.5);
    EXPECT_GT(cable.smallest_strain(shape.positions), -1e-4);
    // Exactly straight, nothing says where to.
    const std::vector<double> none(cable.n_dofs(), 0.);
    const std::string refusal = error_of([&] { find_shape(cable, start, held, none); });
    EXPECT_TRUE(has(refusal, "no stable equilibrium"));
    EXPECT_THROW(hang(cable, {}, {9., 0., 0.}, {}), UserError); // slack without load
  }
} // namespace
