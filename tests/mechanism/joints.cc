// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: joints that repeat each other move like the joints that suffice, with the forces of least
// norm, and hinges and universal joints hold however far bodies turn. Source: equilibrium, least
// squares by hand, Cardan's formula, and Lagrange's equations by Runge and Kutta's method.
#include "verification/scene_tests.h"

#include <deal.II/lac/full_matrix.h>

namespace
{
  using namespace verification;
  using taut::Coordinates;

  /// Where a place of a body is.
  Coordinates place(const taut::StepView &view, const std::size_t k, const Coordinates &undeformed)
  {
    const taut::Attachment at = {taut::Attachment::Kind::body, k, 0., undeformed};
    double u[3];
    for (unsigned int c = 0; c < 3; ++c)
    {
      std::vector<taut::Term> terms;
      view.structure.motion(at, false, {c == 0 ? 1. : 0., c == 1 ? 1. : 0., c == 2 ? 1. : 0.}, 1.,
                            terms);
      u[c] = displacement(view, terms);
    }
    return add_scaled(undeformed, 1., {u[0], u[1], u[2]});
  }

  double force(const taut::StepView &view, const std::string &name)
  {
    for (std::size_t i = 0; i < view.constraints.size(); ++i)
      if (view.constraints[i].name == name)
        return view.state.multiplier[i];
    ADD_FAILURE() << "no link " << name;
    return 0.;
  }

  std::string text(const Coordinates &c)
  {
    return number(c.x) + ", " + number(c.y) + ", " + number(c.z);
  }

  using Angles = std::array<double, 4>; ///< two angles and their rates

  /// Runge and Kutta's method of order 4.
  template <typename Rates>
  Angles integrated(Angles y, const Rates &rates, const double end, const int n)
  {
    const double h = end / n;
    const auto moved = [](const Angles &a, const double s, const Angles &b)
    {
      Angles result;
      for (std::size_t i = 0; i < 4; ++i)
        result[i] = a[i] + s * b[i];
      return result;
    };
    for (int i = 0; i < n; ++i)
    {
      const Angles a = rates(y), b = rates(moved(y, .5 * h, a)), c = rates(moved(y, .5 * h, b)),
                   d = rates(moved(y, h, c));
      for (std::size_t k = 0; k < 4; ++k)
        y[k] += h / 6. * (a[k] + 2. * b[k] + 2. * c[k] + d[k]);
    }
    return y;
  }

  const std::string door = "Gravity = 0, -9.81, 0; Start = given\n"
                           "Body a: Type = rigid body; Mass = 1; Centre = 0.5, 0, 0; "
                           "Moments of inertia = 0.1, 0.2, 0.25\n"
                           "Time: End = 1; Step = 2e-3\n"
                           "Link g: Type = ball joint; From = a @ 0, 0, 0.5; To = ground\n";
} // namespace

// The joints along the axis of the door repeat each other. Expected: the place of the same door on
// five joints, each joint has half of the force, and none along the axis.
TEST(RigidJoints, door_on_two_ball_joints)
{
  std::vector<Coordinates> places[2];
  for (const bool repeats : {false, true})
  {
    const std::string second =
        repeats ? "Link h: Type = ball joint; From = a @ 0, 0, -0.5; To = ground\n"
                : "Link h x: From = a @ 0, 0, -0.5; To = ground; Direction = 1, 0, 0\n"
                  "Link h y: From = a @ 0, 0, -0.5; To = ground; Direction = 0, 1, 0\n";
    const std::string log =
        log_of(door + second, {},
               [&](const taut::StepView &view)
               {
                 places[repeats].push_back(place(view, 0, {1., 0., .3}));
                 EXPECT_LE(view.residuals.max(), 1e-10);
                 if (!repeats || view.state.time == 0.)
                   return;
                 const double size = std::hypot(force(view, "g x"), force(view, "g y"));
                 EXPECT_NEAR(force(view, "g z"), 0., 1e-9 * size);
                 EXPECT_NEAR(force(view, "h z"), 0., 1e-9 * size);
                 EXPECT_NEAR(force(view, "g y"), force(view, "h y"), 1e-8 * size);
               });
    const std::string said = "Joints repeat each other: 'g z', 'h z'";
    EXPECT_EQ(has(log, said), repeats) << log;
    EXPECT_FALSE(repeats && has(log, "Joints repeat", log.find(said) + 1)) << log;
  }
  ASSERT_EQ(places[0].size(), places[1].size());
  ASSERT_GT(places[0].size(), 400u);
  for (std::size_t i = 0; i < places[0].size(); ++i)
    EXPECT_LT(norm(places[0][i] - places[1][i]), 1e-9);
}

namespace
{
  /// A force on a body along a direction at a place.
  struct Row
  {
    std::string name;
    Coordinates place, direction;
  };

  /// The magnitudes of least norm that hold a weight at @p centre, by rows A N = b of equilibrium:
  /// N = A^T (A A^T)^-1 b. No row and no weight turns the body about @p axis through the origin.
  std::vector<double> least_norm(const std::vector<Row> &rows, const Coordinates &weight,
                                 const Coordinates &centre, const Coordinates &axis)
  {
    const Coordinates x = {1., 0., 0.}, y = {0., 1., 0.}, z = {0., 0., 1.}, t = cross(axis, x),
                      n = cross(axis, t);
    dealii::FullMatrix<double> A(5, rows.size()), square(5), result(rows.size(), 1), b(5, 1),
        w(5, 1);
    const auto set = [](const Coordinates &forces, const Coordinates &moments,
                        const std::vector<Coordinates> &along, const auto &entry)
    {
      for (unsigned int i = 0; i < 5; ++i)
        entry(i) = dot(i < 3 ? forces : moments, along[i]);
    };
    const std::vector<Coordinates> along = {x, y, z, t, n};
    for (unsigned int j = 0; j < rows.size(); ++j)
      set(rows[j].direction, cross(rows[j].place, rows[j].direction), along,
          [&](const unsigned int i) -> double & { return A(i, j); });
    set(add_scaled({}, -1., weight), cross(weight, centre), along,
        [&](const unsigned int i) -> double & { return b(i, 0); });
    A.mTmult(square, A);
    square.gauss_jordan();
    square.mmult(w, b);
    A.Tmmult(result, w);
    std::vector<double> N;
    for (unsigned int j = 0; j < rows.size(); ++j)
      N.push_back(result(j, 0));
    return N;
  }
} // namespace

// A door on two hinges 0.4 m beside its middle, whose axis is vertical or inclined by 30 degrees: a
// hinge has three forces at its place, and those of two rods between arms of sqrt(2) m. Expected:
// of all that balance the weight, the forces of least norm. In motion from this rest they are the
// same.
TEST(RigidJoints, door_on_two_hinges_at_rest_and_in_motion)
{
  const double h = .4, mass = 3., r = .7;
  for (const double angle : {0., pi / 6.})
  {
    // A vertical door rests where it is. The other one starts turned by 17 degrees about the axis.
    const Coordinates weight = angle > 0. ? Coordinates{0., -mass * g, 0.}
                                          : Coordinates{0., 0., -mass * g},
                      axis = {0., std::sin(angle), std::cos(angle)},
                      down = {0., -std::cos(angle), std::sin(angle)}; // across the axis
    const double start = angle > 0. ? .3 : 0.;
    const Coordinates centre =
        add_scaled(add_scaled({}, r * std::cos(start), down), r * std::sin(start), {1., 0., 0.});
    const Coordinates up = add_scaled({}, h, axis), low = add_scaled({}, -h, axis);
    const std::string scene =
        "Gravity = " + text(add_scaled({}, 1. / mass, weight)) +
        "; Start = " + (angle > 0. ? "equilibrium" : "given") +
        "\nBody a: Type = rigid body; Mass = 3; Centre = " + text(centre) +
        "; Moments of inertia = 0.3, 0.2, 0.4\nLink p: Type = hinge; From = a @ " + text(up) +
        "; To = ground; Axis = " + text(axis) + "\nLink q: Type = hinge; From = ground; To = a @ " +
        text(low) + "; Axis = " + text(axis) + "\nTime: End = 0.01; Step = 1e-3\n";
    const Coordinates first = {1., 0., 0.};
    const Coordinates normal = cross(axis, first);
    const Coordinates across[] = {add_scaled({}, 1. / norm(normal), normal),
                                  add_scaled({}, 1. / norm(normal), cross(axis, normal))};
    int n = 0;
    const std::string log = log_of(
        scene, {},
        [&](const taut::StepView &view)
        {
          ++n;
          const Coordinates now = place(view, 0, centre);
          EXPECT_LT(norm(now - add_scaled({}, r, down)), 1e-7);
          if (angle == 0. && view.state.time == 0.)
            return; // it has no forces yet
          std::vector<Row> rows;
          // N pushes To along the direction: on the body, minus at From.
          for (const auto &[name, e] :
               {std::pair("x", Coordinates{1., 0., 0.}), {"y", {0., 1., 0.}}, {"z", {0., 0., 1.}}})
          {
            rows.push_back({std::string("p ") + name, up, add_scaled({}, -1., e)});
            rows.push_back({std::string("q ") + name, low, e});
          }
          for (int k = 0; k < 2; ++k)
          {
            const std::string name = " across " + std::to_string(k + 1);
            const Coordinates from = add_scaled(up, std::sqrt(2.), axis),
                              to = add_scaled(up, std::sqrt(2.), across[k]),
                              on_body = place(view, 0, add_scaled(low, std::sqrt(2.), across[k])),
                              on_ground = add_scaled(low, std::sqrt(2.), axis);
            rows.push_back({"p" + name, from, add_scaled({}, -.5, to - from)});
            rows.push_back({"q" + name, on_body, add_scaled({}, .5, on_body - on_ground)});
          }
          const std::vector<double> expected = least_norm(rows, weight, now, axis);
          double worst = 0.;
          for (std::size_t i = 0; i < rows.size(); ++i)
            raise(worst, force(view, rows[i].name) - expected[i]);
          EXPECT_LT(worst, 1e-6 * mass * g) << angle << ", t = " << view.state.time;
        });
    EXPECT_EQ(n, 11);
    EXPECT_TRUE(has(log, "Joints repeat each other")) << log;
  }
}

// Two bodies that fly and turn about a common axis in space, on one hinge and on two. Expected: the
// same motion, and places of the axis that do not part.
TEST(RigidJoints, two_bodies_on_two_hinges)
{
  const Coordinates axis = {.48, .6, .64}, a = {.1, .2, -.3}, b = add_scaled(a, .8, axis);
  const Coordinates spin = {1., -2., .7};
  std::vector<Coordinates> ends[2];
  for (const bool repeats : {false, true})
  {
    const Coordinates centres[] = {{.6, -.1, 0.}, {-.3, .5, .2}};
    std::string scene = "Gravity = 0, 0, 0; Start = given\nTime: End = 2; Step = 2e-3\n";
    for (int k = 0; k < 2; ++k)
    {
      // Turned as one body, and the second about the axis by 3 rad/s beside that.
      const Coordinates turn = add_scaled(spin, k * 3., axis),
                        v = add_scaled(cross(spin, centres[k] - Coordinates{}), k * 3.,
                                       cross(axis, centres[k] - a));
      scene += std::string("Body ") + (k == 0 ? "one" : "two") +
               ": Type = rigid body; Mass = " + (k == 0 ? "2" : "0.7") +
               "; Moments of inertia = 0.3, 0.25, 0.4; First axis = 0.6, 0.8, 0; "
               "Second axis = -0.8, 0.6, 0; Centre = " +
               text(centres[k]) + "; Velocity = " + text(v) + "; Angular velocity = " + text(turn) +
               "\n";
    }
    scene += "Link p: Type = hinge; From = one @ " + text(a) + "; To = two @ " + text(a) +
             "; Axis = " + text(axis) + "\n";
    if (repeats)
      scene += "Link q: Type = hinge; From = one @ " + text(b) + "; To = two @ " + text(b) +
               "; Axis = " + text(axis) + "\n";
    Coordinates first;
    run_scene(scene, {},
              [&](const taut::StepView &view)
              {
                ends[repeats].push_back(place(view, 0, {1., 0., 0.}));
                ends[repeats].push_back(place(view, 1, {0., 1., 0.}));
                const Coordinates along = place(view, 0, b) - place(view, 0, a);
                EXPECT_LT(norm(place(view, 1, b) - place(view, 0, b)), 1e-9);
                if (view.state.time == 0.)
                  first = along;
                if (view.state.time > 1.)
                {
                  EXPECT_GT(norm(along - first), .1); // it has turned
                }
              });
  }
  ASSERT_EQ(ends[0].size(), ends[1].size());
  ASSERT_GT(ends[0].size(), 2000u);
  for (std::size_t i = 0; i < ends[0].size(); ++i)
    ASSERT_LT(norm(ends[0][i] - ends[1][i]), 1e-7) << i;
}

// A joint of two that contradicts the other one is an error with both names.
TEST(RigidJoints, repeated_joints_that_contradict_each_other)
{
  const std::string second = "Link h: Type = ball joint; From = a @ 0, 0, -0.5; To = ground\n";
  const std::string drawn =
      "Mass m: Position = 0, 0, -0.5; Motions = x; Mass = 1; Prescribed z = 1e-3*t\n"
      "Link h: Type = ball joint; From = a @ 0, 0, -0.5; To = m\n";
  const auto error = [](const std::string &scene)
  { return error_of([&] { run_scene(scene, {}); }); };
  EXPECT_EQ(error(door + second), "");
  const std::string found = error(door + drawn);
  EXPECT_TRUE(has(found, "the links 'g z', 'h z' contradict each other")) << found;
}

// A body turns about x on a hinge, and a second one about a hinge of the first, which is along z at
// the start. Expected: their angles by Lagrange's equations.
TEST(RigidJoints, gimbal_of_hinges)
{
  const std::string scene =
      "Gravity = 0, -9.81, 0; Start = given\n"
      "Body b0: Type = rigid body; Mass = 2; Moments of inertia = 0.5, 0.4, 0.3; "
      "Angular velocity = 2, 0, 0\n"
      "Body b1: Type = rigid body; Mass = 1; Centre = 0.1, 0, 0; Moments of inertia = 0.1, 0.12, "
      "0.15; Velocity = 0, 0.15, 0; Angular velocity = 2, 0, 1.5\n"
      "Link outer: Type = hinge; From = b0 @ 1, 0, 0; To = ground; Axis = 1, 0, 0\n"
      "Link inner: Type = hinge; From = b1 @ 0, 0, 0.5; To = b0 @ 0, 0, 0.5\n"
      "Time: End = 3; Step = 1e-3\n";
  const double m = 1., r = .1, I = .5, J1 = .1, J2 = .12, J3 = .15;
  const auto rates = [=](const Angles &y)
  {
    const double a = y[0], b = y[1], da = y[2], db = y[3], c = std::cos(b), s = std::sin(b),
                 A = I + J1 * c * c + (J2 + m * r * r) * s * s,
                 dA = 2. * s * c * (J2 + m * r * r - J1), B = J3 + m * r * r;
    return Angles{da, db, (m * g * r * s * std::sin(a) - dA * da * db) / A,
                  (.5 * dA * da * da - m * g * r * c * std::cos(a)) / B};
  };
  const Angles expected = integrated({0., 0., 2., 1.5}, rates, 3., 3000);
  Coordinates tip, end;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              EXPECT_LT(norm(place(view, 1, {0., 0., -.5}) - place(view, 0, {0., 0., -.5})), 1e-9);
              tip = place(view, 0, {0., 1., 0.});
              end = place(view, 1, {1., 0., 0.});
            });
  const double a = expected[0], b = expected[1];
  EXPECT_GT(std::fabs(a), 1.6); // beyond a quarter of a turn, where joints along x and y part
  EXPECT_LT(norm(tip - Coordinates{0., std::cos(a), std::sin(a)}), 2e-4);
  EXPECT_LT(
      norm(end - Coordinates{std::cos(b), std::sin(b) * std::cos(a), std::sin(b) * std::sin(a)}),
      2e-4);
}

// The same gimbal with joints along directions that stay: a warning says why it parts.
TEST(RigidJoints, gimbal_by_the_page)
{
  const auto joints = [](const std::string &second)
  {
    return "Gravity = 0, -9.81, 0; Start = given\nTime: End = 2e-3; Step = 2e-3\n"
           "Body b0: Type = rigid body; Mass = 2; Moments of inertia = 0.5, 0.4, 0.3\n"
           "Body b1: Type = rigid body; Mass = 1; Moments of inertia = 0.1, 0.12, 0.15\n"
           "Link g: Type = hinge; From = b0 @ 1, 0, 0; To = ground; Axis = 1, 0, 0\n"
           "Link h: Type = ball joint; From = b1 @ 0, 0, 0.5; To = b0 @ 0, 0, 0.5\n" +
           second;
  };
  const std::string at = ": From = b1 @ 0, 0, -0.5; To = b0 @ 0, 0, -0.5; Direction = ",
                    warning = "Warning: joints 'kx', 'ky' hold the rigid bodies 'b0' and 'b1'";
  const std::string log =
      log_of(joints("Link kx" + at + "1, 0, 0\nLink ky" + at + "0, 1, 0\n"), {});
  EXPECT_TRUE(has(log, warning) && has(log, "up to a mirror image") &&
              has(log, "Type 'hinge' or 'universal joint'"))
      << log;
  // One warning, of all pairs, and of the error that no step mends.
  const auto count = [](const std::string &text, const std::string &words)
  {
    std::size_t n = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
      ++n;
    return n;
  };
  const std::string two =
      log_of(joints("Link kx" + at + "1, 0, 0\nLink ky" + at + "0, 1, 0\n") +
                 "Body b2: Type = rigid body; Mass = 1; Moments of inertia = 0.1, 0.12, 0.15\n"
                 "Link i: Type = ball joint; From = b2 @ 0, 0.5, 0; To = b1 @ 0, 0.5, 0\n"
                 "Link lx: From = b2 @ 0, -0.5, 0; To = b1 @ 0, -0.5, 0; Direction = 1, 0, 0\n"
                 "Link lz: From = b2 @ 0, -0.5, 0; To = b1 @ 0, -0.5, 0; Direction = 0, 0, 1\n",
             {});
  EXPECT_TRUE(has(two, warning + ", 'lx', 'lz' 'b1' and 'b2' at a second place")) << two;
  EXPECT_EQ(count(two, "Warning"), 1) << two;
  // Of steps that are too long, as it is rounding that says on which side shorter ones pass the
  // place where the bodies may part.
  const std::string parts = log_of(joints("Link kx" + at + "1, 0, 0\nLink ky" + at + "0, 1, 0\n") +
                                       "Body b0: Angular velocity = 2, 0, 0\n"
                                       "Body b1: Angular velocity = 2, 0, 2.5\n",
                                   {"Time/End=3", "Time/Step=0.2"});
  EXPECT_EQ(count(parts, "Warning"), 1) << parts;
  EXPECT_TRUE(has(parts, "other steps. The cause may be the joints")) << parts;
  EXPECT_FALSE(has(log_of(joints(""), {}), "Warning: joints"));
  EXPECT_FALSE(has(log_of(joints("Link k: Type = ball joint; From = b1 @ 0, 0, -0.5; "
                                 "To = b0 @ 0, 0, -0.5\n"),
                          {}),
                   "Warning: joints"));
}

// Two shafts at 40 degrees on a universal joint, on a hinge and a bearing in its middle; three of
// 14 rows repeat others. Expected: Cardan's tan(b) = tan(a) cos(40 degrees) between the angles from
// where the axis on the second shaft is across both, and the energy of the start.
TEST(RigidJoints, universal_joint_of_two_shafts)
{
  const double bend = 40. * pi / 180.;
  const Coordinates out = {std::cos(bend), std::sin(bend), 0.},
                    up = {-std::sin(bend), std::cos(bend), 0.};
  // The axis of the first shaft is along z and that of the second one across both shafts' plane's
  // normal: at the start a = 0 with the arm of the first shaft along z.
  const double rate = 3., of_second = rate * std::cos(bend); // d tan(b) = d tan(a) cos(bend)
  const std::string scene =
      "Gravity = 0, 0, 0; Start = given\nTime: End = 3; Step = 1e-3\n"
      "Body in: Type = rigid body; Mass = 2; Centre = -0.5, 0, 0; Moments of inertia = 0.2, 0.5, "
      "0.5; Angular velocity = " +
      number(rate) + ", 0, 0\n" +
      "Body out: Type = rigid body; Mass = 1; Centre = " + text(add_scaled({}, .5, out)) +
      "; Moments of inertia = 0.1, 0.3, 0.3; First axis = " + text(out) +
      "; Second axis = " + text(up) +
      "; Angular velocity = " + text(add_scaled({}, of_second, out)) + "\n" +
      "Link first: Type = hinge; From = in @ -1, 0, 0; To = ground; Axis = 1, 0, 0\n"
      "Link last: Type = hinge; From = out @ " +
      text(out) + "; To = ground; Axis = " + text(out) + "\n" +
      "Link joint: Type = universal joint; From = in @ 0, 0, 0; To = out @ 0, 0, 0; "
      "Axis = 0, 0, 1; Second axis = " +
      text(up) + "\n";
  double turned = 0., before = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              // The arm of the first shaft, and the one of the second shaft, by their angles.
              const Coordinates arm = place(view, 0, {0., 0., 1.}), other = place(view, 1, up);
              EXPECT_LT(norm(place(view, 0, {}) - Coordinates{}), 1e-9);
              EXPECT_LT(std::fabs(dot(arm, other)), 1e-9);
              const double a = std::atan2(-arm.y, arm.z), b = std::atan2(other.z, dot(other, up));
              EXPECT_NEAR(std::sin(b) * std::cos(a), std::cos(b) * std::sin(a) * std::cos(bend),
                          1e-9);
              turned += std::remainder(a - before, 2. * pi);
              before = a;
              if (view.state.time == 0.)
                return;
              double energy = 0.;
              for (std::size_t k = 0; k < view.structure.size(); ++k)
              {
                const std::vector<double> &V = view.state.V[k],
                                          MV = matrix_times(view.structure[k].mass(), V);
                for (std::size_t i = 0; i < V.size(); ++i)
                  energy += .5 * V[i] * MV[i];
              }
              const double start = .5 * .2 * rate * rate + .5 * .1 * of_second * of_second;
              EXPECT_NEAR(energy, start, 1e-6 * start);
            });
  EXPECT_GT(std::fabs(turned), 2. * pi);
}

// A body hangs on an axis along z, whose two places are 0.37 mm apart. The start closes that.
// Expected: its place is at the ground, and its axis along z; a universal joint keeps it in that
// plane.
TEST(RigidJoints, hinges_and_universal_joints_with_an_offset)
{
  const Coordinates offset = {1e-4, 2e-4, 3e-4};
  for (const std::string type : {"hinge", "universal joint"})
  {
    Coordinates at, along;
    double gap = 1.;
    run_scene("Gravity = 0, -9.81, 0; Start = equilibrium\nTime: End = 0\n"
              "Body a: Type = rigid body; Mass = 1; Centre = 0, -0.5, 0; "
              "Moments of inertia = 0.1, 0.2, 0.25\nLink h: Type = " +
                  type + "; To = ground @ 0, 0, 0; Axis = 0, 0, 1; From = a @ " + text(offset) +
                  (type == "hinge" ? "\n" : "; Second axis = 0, 1, 0\n"),
              {},
              [&](const taut::StepView &view)
              {
                at = place(view, 0, offset);
                along = place(view, 0, add_scaled(offset, 1., {0., 0., 1.})) - at;
                gap = largest(view.state.distance);
              });
    EXPECT_LT(norm(at), 1e-12) << type;
    EXPECT_LT(std::fabs(along.y), 1e-12) << type;
    if (type == "hinge")
    {
      EXPECT_LT(std::fabs(along.x), 1e-12);
    }
    EXPECT_LT(gap, 1e-12) << type;
  }
}

// What hinges and universal joints cannot be, with the entry.
TEST(RigidJoints, hinges_of_what_has_no_axis)
{
  const auto error = [](const std::string &link)
  {
    return error_of(
        [&]
        {
          run_scene("Start = given\nTime: End = 1e-3; Step = 1e-3\n"
                    "Body a: Type = rigid body; Mass = 1; Moments of inertia = 1, 1, 1\n"
                    "Mass m: Position = 0, 0; Motions = x, y, z; Mass = 1\nLink h: " +
                        link + "\n",
                    {});
        });
  };
  const std::string ends = "From = a @ 0, 0, 0; To = ground; ";
  EXPECT_TRUE(has(error("Type = hinge; From = a @ 0, 0, 0; To = m"), "Link h/To"));
  EXPECT_TRUE(has(error("Type = hinge; From = a @ 0, 0, 0; To = m"), "between rigid bodies"));
  EXPECT_TRUE(
      has(error("Type = universal joint; " + ends + "Axis = 1, 0, 0; Second axis = 1, 1, 0"),
          "right angle"));
  EXPECT_TRUE(has(error("Type = hinge; " + ends + "Second axis = 1, 1, 0"), "Link h/Second axis"));
  EXPECT_TRUE(has(error("Type = hinge; " + ends + "Stiffness = 1e6"), "Link h/Stiffness"));
  EXPECT_EQ(error("Type = hinge; " + ends + "Axis = 1, 1, 0"), "");
}

// A ladder of 4 m that starts at rest, 30 degrees from its wall, on a smooth floor: it leaves the
// wall where its height has fallen to two thirds. Expected: 0.65006 s, the published time; without
// friction t = sqrt(L / 3 g) int d(angle) / sqrt(cos 30 - cos(angle)).
TEST(RigidJoints, ladder_that_leaves_its_wall)
{
  const double length = 4., start = pi / 6., c = std::cos(start);
  // With cos(angle) = c - s^2 the integrand is smooth; Simpson's rule.
  const auto integrand = [&](const double s)
  { return 2. / std::sqrt(1. - std::pow(c - s * s, 2)); };
  const double end = std::sqrt(c / 3.);
  double sum = integrand(0.) + integrand(end);
  for (int i = 1; i < 1000; ++i)
    sum += (i % 2 == 1 ? 4. : 2.) * integrand(i * end / 1000.);
  const double expected = std::sqrt(length / (3. * g)) * sum * end / 3000.;
  EXPECT_NEAR(expected, .65006, 5e-6);

  const Coordinates foot = {length * std::sin(start), 0., 0.}, top = {0., length * c, 0.},
                    centre = add_scaled(add_scaled({}, .5, foot), .5, top),
                    along = {-std::sin(start), c, 0.}, across = {-c, -std::sin(start), 0.};
  const double J = 12. * length * length / 12.;
  const std::string scene =
      "Gravity = 0, -9.81, 0; Start = given\nTime: End = 0.7; Step = 5e-4\n"
      "Body ladder: Type = rigid body; Mass = 12; Centre = " +
      text(centre) + "; First axis = " + text(along) + "; Second axis = " + text(across) +
      "; Moments of inertia = " + number(1e-4 * J) + ", " + number(J) + ", " + number(J) + "\n" +
      "Link wall: Type = stop; From = ground; To = ladder @ " + text(top) +
      "; Direction = 1, 0, 0\nLink floor: Type = stop; From = ground; To = ladder @ " + text(foot) +
      "; Direction = 0, 1, 0\n";
  double left = 0.;
  run_scene(scene, {},
            [&](const taut::StepView &view)
            {
              if (force(view, "wall") > 0.)
                left = view.state.time;
            });
  EXPECT_NEAR(left, expected, 1.5e-3);
}
