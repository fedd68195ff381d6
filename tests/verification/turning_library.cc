// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: ropes, props and rods that a program adds to a System are the links of a parameter file
// that turn. Expected values: the same pendulums from a parameter file; the lowest place.
#include "one_body.h"
#include "turning_scene.h"

using namespace turning;

namespace
{
  using verification::error_of;
  const Coordinates start = {.6, -.5, .2}, speed = {.3, 1., -.4};
  constexpr double mass = 3.;

  struct Pendulum
  {
    taut::System system;
    std::size_t body = 0;
    taut::LinkEnd bob;

    Pendulum()
    {
      taut::Scene scene;
      taut::Mass ball;
      ball.mass = mass;
      for (const unsigned int motion : {0, 1, 3})
      {
        ball.moves[motion] = true;
        ball.velocity[motion] = speed[motion == 3 ? 2 : motion];
      }
      scene.masses = {ball};
      body = system.add(
          "bob",
          [&] { return std::make_unique<taut::Mechanism>(scene, std::vector<std::size_t>{0}); });
      bob = system.link_end(body, {0.}, start);
    }

    Coordinates place(const taut::Stepper &stepper) const
    {
      const auto &motion = bob.motion;
      return add_scaled(bob.position, 1.,
                        {stepper.displacement(motion[0]), stepper.displacement(motion[1]),
                         stepper.displacement(motion[2])});
    }
  };
} // namespace

TEST(TurningLibrary, pendulums_are_those_of_a_parameter_file)
{
  for (const std::string type : {"dropper", "stop", "joint", "elastic rope"})
  {
    Pendulum pendulum;
    const bool is_prop = type == "stop", is_elastic = type == "elastic rope";
    // The prop is below, and the mass falls on it.
    const taut::LinkEnd pivot{is_prop ? Coordinates{.5, -1.4, .1} : Coordinates{0., 0., 0.}};
    const double length = norm(start - pivot.position) * (is_prop ? .9 : 1.);
    using taut::Constraint;
    const Constraint link =
        is_prop           ? Constraint::prop("link", pivot, pendulum.bob, length)
        : type == "joint" ? Constraint::rod("link", pivot, pendulum.bob, length)
        : is_elastic
            ? Constraint::rope("link", pivot, pendulum.bob, length).stiffness(500.).damping(4.)
            : Constraint::rope("link", pivot, pendulum.bob, length);
    const std::size_t row = pendulum.system.add(link);
    constexpr double step = 2e-3;
    taut::Stepper stepper(pendulum.system, verification::steps_of(step, taut::Start::given));

    Scene scene = thrown({{mass, start, speed}},
                         {"From = ground @ " + text(pivot.position) + "; To = m0; Type = " +
                          (is_elastic ? "dropper; Stiffness = 500; Damping = 4" : type) +
                          "; Length = " + number(length)},
                         1.5, step);
    double largest = 0.;
    scene.run(
        [&](const Motion &m)
        {
          if (m.time > 0.)
            stepper.advance();
          EXPECT_NEAR(stepper.time(), m.time, 1e-12);
          EXPECT_LT(norm(pendulum.place(stepper) - m.place[0]), 1e-11) << type << m.time;
          EXPECT_NEAR(stepper.multiplier(row), m.multiplier[0], 1e-7) << type << m.time;
          EXPECT_NEAR(stepper.gap(row), m.gap[0], 1e-11) << type << m.time;
          largest = std::max(largest, m.multiplier[0]);
        });
    EXPECT_GT(largest, 10.) << type;
  }
}

TEST(TurningLibrary, comes_to_rest)
{
  Pendulum pendulum;
  const std::size_t rope = pendulum.system.add(
      taut::Constraint::rope("rope", {{0., 2., 0.}}, pendulum.bob, 1.5).stiffness(1e3));
  const taut::Stepper stepper(pendulum.system);
  const double N = mass * g;
  EXPECT_LT(norm(pendulum.place(stepper) - Coordinates{0., .5 - N / 1e3, 0.}), 1e-8);
  EXPECT_NEAR(stepper.multiplier(rope), N, 1e-8 * N);
  EXPECT_NEAR(stepper.gap(rope), -N / 1e3, 1e-8);
}

TEST(TurningLibrary, what_cannot_turn_is_refused)
{
  const Pendulum pendulum;
  const auto expect = [](const std::string &error, const std::string &part)
  { EXPECT_TRUE(has(error, part)) << error; };
  using taut::Constraint;
  expect(error_of([&] { Constraint::rope("r", {start}, pendulum.bob, 1.); }),
         "start at one place, (0.6, -0.5, 0.2) m");
  for (const double length : {0., -1., std::nan("")})
    expect(error_of([&] { Constraint::prop("p", {{}}, pendulum.bob, length); }), "positive length");
  expect(error_of([&] { Constraint::rod("r", {{}}, pendulum.bob, 1.).gap(.1); }),
         "follows from its length");
  expect(error_of([&] { pendulum.system.link_end(pendulum.body, {3.}); }), "1 masses");
}
