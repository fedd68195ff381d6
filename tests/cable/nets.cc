// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: nets of cables that are joined at nodes, with and without masses, are found at rest from
// starts that are far from it, and never with a cable under compression. Expected values: elastic
// catenaries that meet at the nodes, by Newton's method of the test; symmetry; the single cable.
#include "cable/joined_catenaries.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  constexpr double weight = .5 * 9.81; ///< of a cable [N/m]

  struct Net
  {
    JoinedCatenaries system;    ///< with the start of the parameter file as places
    std::vector<double> masses; ///< of the free nodes [kg]; empty: cables alone are joined there
    std::string elements = "bar";
    unsigned int n_elements = 4;
  };

  std::string numbers_of(const Coordinates &a)
  {
    return number(a.x) + ", " + number(a.y) + ", " + number(a.z);
  }

  std::string parameter_file(const Net &net)
  {
    const JoinedCatenaries &system = net.system;
    std::ostringstream out;
    out.precision(17);
    out << "Gravity = 0, -9.81; Start = equilibrium\nTime: End = 0\n";
    const char *const held_ends[] = {"none", "from", "to", "both"};
    std::vector<std::vector<std::string>> ends(system.n_free);
    for (std::size_t k = 0; k < system.cables.size(); ++k)
    {
      const JoinedCatenaries::Cable &cable = system.cables[k];
      const bool holds_from = cable.from >= system.n_free, holds_to = cable.to >= system.n_free;
      out << "Body c" << k << ": Type = cable; From = " << numbers_of(system.places[cable.from])
          << "; To = " << numbers_of(system.places[cable.to])
          << "; Unstressed length = " << cable.length << "; Axial stiffness = " << cable.EA
          << "; Mass per length = " << -cable.load.y / 9.81 << "; Element = " << net.elements
          << "; Elements = " << net.n_elements
          << "; Largest strain = 1; Held ends = " << held_ends[holds_from + 2 * holds_to] << "\n";
      for (const bool last : {false, true})
        if (!(last ? holds_to : holds_from))
          ends[last ? cable.to : cable.from].push_back("c" + std::to_string(k) + " @ " +
                                                       number(last ? cable.length : 0.) + ", 0");
    }
    for (std::size_t i = 0; i < system.n_free; ++i)
    {
      const std::string node = "n" + std::to_string(i);
      if (!net.masses.empty())
      {
        out << "Mass " << node << ": Position = " << numbers_of(system.places[i])
            << "; Motions = x, y, z; Mass = " << net.masses[i] << "\n";
        ends[i].insert(ends[i].begin(), node);
      }
      for (std::size_t e = 1; e < ends[i].size(); ++e)
        out << "Link " << node << " " << e << ": Type = ball joint; From = " << ends[i][0]
            << "; To = " << ends[i][e] << "\n";
      for (const char axis : {'x', 'y', 'z'})
        out << "Probe " << node << " " << axis << ": Point = " << ends[i][0]
            << "; Direction = " << (axis == 'x') << ", " << (axis == 'y') << ", " << (axis == 'z')
            << "\n";
    }
    return out.str();
  }

  /// The free nodes of a net, displaced as the three probes of each say.
  std::vector<Coordinates> displaced(const Net &net, const StepView &step)
  {
    EXPECT_EQ(step.probes.size(), 3 * net.system.n_free);
    std::vector<Coordinates> places;
    for (std::size_t i = 0; i < net.system.n_free; ++i)
    {
      const double *const u = &step.probes[3 * i];
      places.push_back(add_scaled(net.system.places[i], 1., {u[0], u[1], u[2]}));
    }
    return places;
  }

  std::vector<Coordinates> found(const Net &net, const Overrides &overrides = {})
  {
    std::vector<Coordinates> places;
    run_scene(parameter_file(net), overrides,
              [&](const StepView &step) { places = displaced(net, step); });
    return places;
  }

  double largest_distance(const std::vector<Coordinates> &a, const std::vector<Coordinates> &b)
  {
    double distance = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      distance = std::max(distance, norm(a[i] - b[i]));
    return distance;
  }

  /// n x n nodes a metre apart, cables to supports around them, each longer by the part @p slack.
  Net square(const int n, const double EA, const double slack)
  {
    Net net;
    JoinedCatenaries &system = net.system;
    std::vector<Coordinates> held;
    const auto node = [&](const int i, const int k) -> std::size_t
    {
      if (i > 0 && i <= n && k > 0 && k <= n)
        return (i - 1) * n + k - 1;
      held.push_back({double(i), 0., double(k)});
      return n * n + held.size() - 1;
    };
    const auto add = [&](const std::size_t a, const std::size_t b) {
      system.cables.push_back({a, b, 1. + slack, EA, {0., -weight, 0.}});
    };
    for (int i = 1; i <= n; ++i)
      for (int k = 0; k <= n; ++k)
      {
        const std::size_t a = node(i, k), b = node(i, k + 1);
        add(a, b);
        const std::size_t c = node(k, i), d = node(k + 1, i);
        add(c, d);
      }
    system.n_free = n * n;
    for (int i = 1; i <= n; ++i)
      for (int k = 1; k <= n; ++k)
        system.places.push_back({double(i), 0., double(k)});
    system.places.insert(system.places.end(), held.begin(), held.end());
    system.loads.assign(n * n, {});
    return net;
  }

  /// Loads of the masses in the catenaries, too.
  void set_masses(Net &net, const std::vector<double> &masses)
  {
    net.masses = masses;
    for (std::size_t i = 0; i < masses.size(); ++i)
      net.system.loads[i] = {0., -9.81 * masses[i], 0.};
  }

  /// Rounding of the pulls of prestressed catenaries, over the largest one [1]: T / L of a cable
  /// moves a node by less than 1e-8 m under it.
  constexpr double rounding = 1e-10;

  /// The catenaries, from places near those that were found.
  std::vector<Coordinates> by_catenaries(const Net &net, const std::vector<Coordinates> &near)
  {
    JoinedCatenaries exact = net.system;
    std::copy(near.begin(), near.end(), exact.places.begin());
    const double remains = exact.solve();
    double force = 0.;
    for (const JoinedCatenaries::Cable &cable : exact.cables)
      force = std::max(force, norm(exact.pull(cable)));
    EXPECT_LT(remains, std::max(1e-7, rounding * force));
    return {exact.places.begin(), exact.places.begin() + static_cast<std::ptrdiff_t>(exact.n_free)};
  }
} // namespace

TEST(CableNets, hanging_square_without_masses)
{
  for (const double EA : {1e4, 1e7})
    for (const double slack : {.02, .4})
    {
      SCOPED_TRACE(std::to_string(EA) + " N, slack " + std::to_string(slack));
      const int n = 3;
      const Net net = square(n, EA, slack);
      const std::vector<Coordinates> places = found(net);
      ASSERT_EQ(places.size(), 9u);
      const double error = largest_distance(places, by_catenaries(net, places));
      figure("net of 24 cables, EA " + std::to_string(EA) + " N, slack " + std::to_string(slack) +
                 ": error of the nodes",
             error, "m");
      EXPECT_LT(error, 1e-5);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
        {
          const Coordinates &a = places[i * n + k], &b = places[k * n + i],
                            &c = places[(n - 1 - i) * n + k];
          EXPECT_NEAR(a.y, b.y, 1e-8);
          EXPECT_NEAR(a.y, c.y, 1e-8);
          EXPECT_NEAR(a.x + c.x, n + 1., 1e-8);
          EXPECT_NEAR(a.x, b.z, 1e-8);
        }
      EXPECT_LT(places[4].y, places[0].y); // the middle hangs lowest
    }
}

TEST(CableNets, unequal_masses)
{
  for (const double EA : {1e5, 1e7})
    for (const std::string element : {"bar", "ANCF"})
    {
      Net net = square(2, EA, .15);
      net.elements = element;
      set_masses(net, {5., 0., 20., 60.});
      const std::vector<Coordinates> places = found(net);
      ASSERT_EQ(places.size(), 4u);
      const double error = largest_distance(places, by_catenaries(net, places));
      figure("net of 12 cables with masses, EA " + std::to_string(EA) + " N, " + element, error,
             "m");
      EXPECT_LT(error, 1e-6);
    }
}

// The prestressed net of A. S. Saafan (J. Struct. Div. ASCE 96 (1970)), with the data of H. B.
// Jayaraman and W. C. Knudson (Computers & Structures 14 (1981)): 100 ft between neighbours in
// plan, supports 30 ft above the free nodes, 12000 kip/in^2, 0.227 in^2, 0.1 lb/ft, 5459 lb in
// horizontal and 5325 lb in inclined cables before 8 kip act on each free node. Published
// displacements of a free node: -0.1328, -0.1328, -1.4745 ft.
TEST(CableNets, twelve_prestressed_cables)
{
  constexpr double ft = .3048, lb = 4.4482216152605, EA = 12e6 * .227 * lb;
  Net net = square(2, EA, 0.);
  for (std::size_t i = 0; i < net.system.places.size(); ++i)
  {
    Coordinates &place = net.system.places[i];
    place = {100. * ft * place.x, i < net.system.n_free ? 0. : 30. * ft, 100. * ft * place.z};
  }
  for (JoinedCatenaries::Cable &cable : net.system.cables)
  {
    const bool is_horizontal = cable.from < net.system.n_free && cable.to < net.system.n_free;
    cable.length = norm(net.system.places[cable.to] - net.system.places[cable.from]) /
                   (1. + (is_horizontal ? 5459. : 5325.) * lb / EA);
    cable.load = {0., -.1 * lb / ft, 0.};
  }
  set_masses(net, std::vector<double>(4, 8000. * lb / 9.81));
  for (const std::string element : {"bar", "ANCF"})
  {
    net.elements = element;
    const std::vector<Coordinates> places = found(net);
    ASSERT_EQ(places.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Coordinates u = places[i] - net.system.places[i];
      const bool is_far[] = {i > 1, i % 2 == 1}; // along x, along z
      EXPECT_NEAR(u.x / ft, is_far[0] ? .1328 : -.1328, 5e-5) << element << " " << i;
      EXPECT_NEAR(u.z / ft, is_far[1] ? .1328 : -.1328, 5e-5) << element << " " << i;
      EXPECT_NEAR(u.y / ft, -1.4745, 5e-5) << element << " " << i;
    }
    EXPECT_LT(largest_distance(places, by_catenaries(net, places)), 1e-6) << element;
  }
}

// The same in a net of 24 cables, of which the middle ones are pulled more and one node is loaded.
TEST(CableNets, prestressed_cables_under_one_load)
{
  Net net = square(3, 4e6, 0.);
  for (std::size_t i = net.system.n_free; i < net.system.places.size(); ++i)
    net.system.places[i].y = i % 2 == 0 ? .4 : -.1;
  for (std::size_t k = 0; k < net.system.cables.size(); ++k)
  {
    JoinedCatenaries::Cable &cable = net.system.cables[k];
    cable.length = norm(net.system.places[cable.to] - net.system.places[cable.from]) /
                   (1. + (k % 3 == 0 ? 9e3 : 5e3) / cable.EA);
  }
  set_masses(net, {0., 0., 0., 0., 0., 0., 0., 300., 0.});
  const std::vector<Coordinates> places = found(net);
  ASSERT_EQ(places.size(), 9u);
  EXPECT_GT(norm(places[7] - net.system.places[7]), .04);
  EXPECT_LT(largest_distance(places, by_catenaries(net, places)), 1e-6);
}

// A row of cables is one cable: nodes without masses change nothing.
TEST(CableNets, a_row_is_one_cable)
{
  Net net;
  net.n_elements = 8;
  const int n = 5;
  for (int i = 1; i < n; ++i)
    net.system.places.push_back({2. * i, 0., 0.});
  net.system.places.push_back({});
  net.system.places.push_back({2. * n, 0., 0.});
  net.system.n_free = n - 1;
  for (int i = 0; i < n; ++i)
    net.system.cables.push_back(
        {std::size_t(i == 0 ? n - 1 : i - 1), std::size_t(i), 2.4, 1e6, {0., -weight, 0.}});
  net.system.cables.back().to = n;
  const std::vector<Coordinates> places = found(net);
  ASSERT_EQ(places.size(), n - 1u);
  const ElasticCatenary exact({}, {2. * n, 0., 0.}, {0., -weight, 0.}, 1e6, 2.4 * n);
  for (int i = 1; i < n; ++i)
    EXPECT_LT(norm(places[i - 1] - exact.position(2.4 * i)), 1e-4) << i;
}

TEST(CableNets, one_error_for_what_nothing_holds)
{
  Net net = square(1, 1e6, .1);
  JoinedCatenaries &system = net.system;
  system.places.insert(system.places.begin() + 1, {{5., 0., 5.}, {6., 0., 5.}});
  for (JoinedCatenaries::Cable &cable : system.cables)
    for (std::size_t *end : {&cable.from, &cable.to})
      *end += *end > 0 ? 2 : 0;
  system.n_free = 3;
  system.loads.assign(3, {});
  system.cables.push_back({1, 2, 1.1, 1e6, {0., -weight, 0.}});
  const std::string refusal = error_of([&] { found(net); });
  EXPECT_TRUE(has(refusal, "'c4' is not held")) << refusal;
}

// Without weight nothing says where a node is whose cables are longer than the way.
TEST(CableNets, one_error_without_stable_equilibrium)
{
  Net net;
  net.system.places = {{1., 1., 0.}, {0., 0., 0.}, {2., 0., 0.}};
  net.system.n_free = 1;
  net.system.cables = {{1, 0, 1.1, 1e4, {0., -weight, 0.}}, {0, 2, 1.1, 1e4, {0., -weight, 0.}}};
  const std::string refusal = error_of([&] { found(net, {"Gravity=0, 0"}); });
  EXPECT_TRUE(has(refusal, "none that is stable was found")) << refusal;
  EXPECT_EQ(found(net).size(), 1u); // with weight it hangs
}

// prm/net_of_cables.prm: the lamps a, b, c, d between eight supports of unequal height.
TEST(CableNets, scene)
{
  Net net;
  JoinedCatenaries &system = net.system;
  system.places = {{3., 0., 3.}, {6., 0., 3.}, {3., 0., 6.},  {6., 0., 6.},
                   {0., 0., 3.}, {0., .6, 6.}, {9., 1.2, 3.}, {9., .3, 6.},
                   {3., .9, 0.}, {6., 0., 0.}, {3., .5, 9.},  {6., 1.5, 9.}};
  system.n_free = 4;
  system.loads.assign(4, {});
  set_masses(net, {20., 20., 40., 20.});
  const std::size_t ends[][2] = {{4, 0}, {0, 1}, {1, 6},  {5, 2}, {2, 3}, {3, 7},
                                 {8, 0}, {0, 2}, {2, 10}, {9, 1}, {1, 3}, {3, 11}};
  for (const auto &[from, to] : ends)
    system.cables.push_back({from, to, from < 4 && to < 4 ? 3.4 : 3.6, 1e6, {0., -.3 * 9.81, 0.}});
  std::vector<Coordinates> places;
  std::vector<double> table;
  Session session(scene_file("net_of_cables"));
  session.run(
      [&](const StepView &step)
      {
        places = displaced(net, step);
        table = step.probes;
      });
  const std::vector<Coordinates> exact = by_catenaries(net, places);
  for (const Coordinates &place : exact)
    figure("height of a lamp in a net", place.y, "m");
  EXPECT_LT(largest_distance(places, exact), 1e-5);
  // A run at rest has a table of one line, with the same numbers.
  std::istringstream lines(file_text(session.folder() + "/probes.csv"));
  std::string head, line, more;
  ASSERT_TRUE(std::getline(lines, head) && std::getline(lines, line));
  EXPECT_FALSE(std::getline(lines, more));
  const std::vector<std::string> values = cells_of(line);
  ASSERT_GT(values.size(), table.size());
  EXPECT_EQ(std::stod(values[0]), 0.);
  for (std::size_t i = 0; i < table.size(); ++i)
    EXPECT_DOUBLE_EQ(std::stod(values[i + 1]), table[i]);
}
