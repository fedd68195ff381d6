// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: scenes too large for a copy in extended precision are right, too: one element and 100 000
// in a wire, 1 and 1000 parts, 10 000 steps at rest. Source: sums of forces, free fall, other runs.
#include "common.h"
#include "observation.h"

using verification::g;

using namespace extremes;

namespace
{

  Case heavy_wire(const double length, const double n_elements, const taut::TransverseKind kind,
                  const bool is_held)
  {
    Case c;
    c.scene.supports.resize(is_held);
    for (taut::Support &ends : c.scene.supports)
    {
      ends.name = "ends";
      ends.positions = {0., length};
    }
    taut::Wire w;
    w.name = "wire";
    w.b = {length, 0.};
    w.element_size = length / n_elements;
    w.mass_per_length = 1.5;
    w.tension = kind == taut::TransverseKind::string ? 2e4 : 0.;
    w.bending_stiffness = 10.;
    w.transverse = kind;
    c.scene.gravity = {0., -g};
    c.scene.wires = {w};
    return c;
  }

  double largest_change(const Answer &answer, const Quantity q)
  {
    double change = 0.;
    for (const Observation &o : answer.steps)
      change = std::max(change, verification::largest_difference(answer.steps.front()[q], o[q]));
    return change;
  }

  /// A string on forty stops, half of them out of reach.
  Case string_on_stops(const double n_elements)
  {
    Case c = heavy_wire(200., n_elements, taut::TransverseKind::string, true);
    for (int i = 1; i <= 40; ++i)
    {
      taut::Link stop;
      stop.name = "stop" + std::to_string(i);
      stop.kind = taut::LinkKind::stop;
      stop.to = {taut::Attachment::Kind::wire, 0, 200. * i / 41.};
      stop.gap = i % 2 ? 1e-3 : 1e3;
      c.scene.links.push_back(stop);
    }
    return c;
  }
} // namespace

TEST(Large, string_of_one_and_of_100000_elements_sags_by_its_weight)
{
  for (const double n : {1., 2., 1e3, 1e5})
  {
    Case c = heavy_wire(100., n, taut::TransverseKind::string, true);
    c.n_steps = 1;
    const Answer answer = program_answer(c);
    ASSERT_EQ(answer.error, "") << n;
    const std::vector<double> &u = answer.steps.front()[displacement];
    const double sag = *std::min_element(u.begin(), u.end());
    const double exact = -1.5 * g * 100. * 100. / (8. * 2e4);
    // One quadratic element is exact in its ends only; its observed points are these.
    if (n > 1.)
    {
      std::printf("figure | sag, %.0f elements, over the exact one - 1 | %.2e\n", n,
                  sag / exact - 1.);
      EXPECT_NEAR(sag, exact, 1e-6 * -exact) << n;
    }
    EXPECT_EQ(u.front(), 0.);
    EXPECT_EQ(u.back(), 0.);
  }
}

// Backward Euler falls by g tau^2 n (n + 1)/2 in n steps, whatever the wire is made of.
TEST(Large, free_wires_of_one_and_of_100000_elements_fall)
{
  for (const taut::TransverseKind kind : {taut::TransverseKind::string, taut::TransverseKind::beam})
    for (const double n : {1., 1e5})
      for (const double step : {1e-9, 1e-6, 1e-3})
      {
        Case c = heavy_wire(100., n, kind, false);
        c.scene.start = taut::Start::undeformed;
        c.step = step;
        c.n_steps = 3;
        const Answer answer = program_answer(c);
        ASSERT_EQ(answer.error, "") << n << ' ' << step;
        const double exact = -g * step * step * 6.;
        for (const double u : answer.steps.back()[displacement])
          EXPECT_NEAR(u, exact, -1e-6 * exact) << n << ' ' << step;
      }
}

TEST(Large, answers_of_1_to_1000_parts_agree)
{
  Case c = string_on_stops(2000.);
  c.n_steps = 3;
  const Answer whole = program_answer(c);
  ASSERT_EQ(whole.error, "");
  for (const unsigned int n : {2u, 10u, 100u, 1000u})
  {
    c.n_parts = n;
    const Answer cut = program_answer(c);
    ASSERT_EQ(cut.error, "") << n;
    const Deviation d = compare(cut.steps, whole.steps, scales(c, whole), {}, 1e-6, 1e-8);
    std::printf("figure | deviation of %u parts over what is allowed (1e-8) | %.2e\n", n, d.excess);
    EXPECT_LE(d.excess, 1.) << n << " parts: " << d.where;
  }
}

// TAUT_EXTREMES_STEPS=1000000 in the long run.
TEST(Large, rest_does_not_drift)
{
  const char *const n_steps = std::getenv("TAUT_EXTREMES_STEPS");
  for (const char *scheme : {"backward Euler", "generalised-alpha"})
  {
    Case c = string_on_stops(100.);
    c.scheme = scheme;
    c.n_steps = n_steps ? std::atoi(n_steps) : 10000;
    const Answer answer = program_answer(c);
    ASSERT_EQ(answer.error, "");
    const std::array<double, n_quantities> size = scales(c, answer);
    const double of_motion = largest_change(answer, displacement) / size[displacement],
                 of_force = largest_change(answer, force) / size[force];
    std::printf("figure | drift in %u steps at rest, %s | displacement %.2e, force %.2e\n",
                c.n_steps, scheme, of_motion, of_force);
    EXPECT_LE(of_motion, 1e-10);
    EXPECT_LE(of_force, 1e-8);
  }
}
