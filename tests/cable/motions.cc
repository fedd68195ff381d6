// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables that swing, go slack, snap and lie down on a floor keep their energy and have the
// forces of closed forms. Source: energy; Saint-Venant's waves; catenaries; another element,
// scheme.
#include "cable/elastic_catenary.h"
#include "cable/one_cable.h"
#include "cable/slack_cable.h"
#include "common.h"

#include "base/dot.h"
#include <taut/time/static_equilibrium.h>

namespace
{
  using namespace verification;
  using namespace taut;

  /// A cable that starts from its shape turned about the x axis, and moves through large angles.
  class TurnedCable : public Cable
  {
  public:
    TurnedCable(const CableData &data, const double angle) : Cable(data), angle(angle) {}
    void initial_state(std::vector<double> &U, std::vector<double> &V) const override
    {
      U = shape().positions;
      V.assign(U.size(), 0.);
      for (std::size_t i = 0; i < U.size(); i += 3)
      {
        const double y = U[i + 1], z = U[i + 2];
        U[i + 1] = std::cos(angle) * y - std::sin(angle) * z;
        U[i + 2] = std::sin(angle) * y + std::cos(angle) * z;
      }
      for (std::size_t i = 0; i < U.size(); ++i)
        U[i] -= shape().positions[i];
    }

  private:
    double angle;
  };

  CableData slack_span(const double axial_damping = 0.)
  {
    return cable_to({8., 0., 0.}, 10., {1e6, 1., 1., axial_damping}, 32);
  }

  struct MotionOfCable
  {
    double energy_change = 0.; ///< largest rise over the first energy above that at rest
    double energy_loss = 0.;
    double iterations = 0.; ///< a step
    double middle = 0.;     ///< y of the middle at the end
  };

  double energy(const Cable &cable, const std::vector<double> &U, const std::vector<double> &V)
  {
    std::vector<double> P;
    cable.external_force(0., P);
    return cable.strain_energy(U) + .5 * dot(V, matrix_times(cable.mass(), V)) - dot(P, U);
  }

  MotionOfCable swing(const CableData &data, const double angle, const double step,
                      const double end, const std::string &scheme = "automatic")
  {
    const OneCable<TurnedCable> one(data, angle);
    const Cable *const cable = one.cable;
    StepperOptions options = steps_of(step, Start::given, scheme);
    options.allow_unsuitable_scheme = true;
    Stepper stepper(one.system, options);
    std::vector<double> U, V;
    cable->initial_state(U, V);
    const double start = energy(*cable, U, V),
                 scale = start - energy(*cable, std::vector<double>(U.size(), 0.), V);
    MotionOfCable motion;
    int n = 0;
    for (; stepper.time() < end - .5 * step; ++n)
    {
      stepper.advance();
      const double change =
          (energy(*cable, stepper.displacement(0), stepper.state().V[0]) - start) / scale;
      motion.energy_change = std::max(motion.energy_change, change);
      motion.energy_loss = std::max(motion.energy_loss, -change);
    }
    motion.iterations = static_cast<double>(stepper.n_newton_iterations()) / n;
    motion.middle =
        stepper.displacement({{0, cable->displacement({.5 * data.length, 0., 0.}, {0., 1., 0.})}});
    return motion;
  }

  /// Half of a symmetric cable on a floor: horizontal force from the free part of length a, depth
  /// H / w (cosh - 1), and the rest on the floor under H (Irvine 1981, with elastic stretch).
  double horizontal_on_floor(const double EA, const double w, const double half_length,
                             const double half_span, const double depth)
  {
    const auto span_at = [&](const double H)
    {
      // Free length from the depth: y = s w s / (2 EA) + (sqrt(H^2 + w^2 s^2) - H) / w.
      const double s = end_of(0., half_length,
                              [&](const double a) {
                                return .5 * w * a * a / EA + (std::hypot(H, w * a) - H) / w < depth;
                              });
      return H * s / EA + H / w * std::asinh(w * s / H) + (half_length - s) * (1. + H / EA);
    };
    return std::exp(end_of(std::log(1e-3), std::log(1e6),
                           [&](const double log_H)
                           { return span_at(std::exp(log_H)) < half_span; }));
  }
} // namespace

// Where a step does not move, its tangent is that of the state, in the axes of clamped ends, too.
TEST(CableMotions, tangent_of_a_step_at_rest_is_that_of_the_state)
{
  CableData data = slack_span();
  data.to = {6., 4., 2.};
  data.section.bending_stiffness = 50.;
  data.clamped = true;
  const Cable cable(data);
  std::vector<double> U(cable.n_dofs()), direction(U.size());
  for (std::size_t i = 0; i < U.size(); ++i)
  {
    U[i] = .01 * std::sin(.3 * i);
    direction[i] = std::cos(2. * i);
  }
  const auto a = matrix_times(*cable.tangent(U, {}, 1e-3, false), direction),
             b = matrix_times(*cable.mean_tangent(U, U, 1e-3, false), direction);
  EXPECT_LT(largest_difference(a, b), 1e-12 * largest(a));
}

// Nothing moves it: what it gains is rounding, beside an energy of motion that is less.
TEST(CableMotions, a_cable_at_rest_stays_there)
{
  for (const double length : {7.99, 8.1, 10., 20.})
    for (const CableElement element : {CableElement::ancf, CableElement::bar})
    {
      CableData data = slack_span();
      data.length = length;
      data.element = element;
      data.section.axial_stiffness = 1e5;
      data.section.bending_stiffness = 0.;
      data.n_elements = 8;
      const OneCable<> one(data);
      Stepper stepper(one.system, steps_of(1e-2, Start::equilibrium));
      while (stepper.time() < 1.)
        stepper.advance();
      EXPECT_EQ(stepper.measures().error(), "") << length;
      EXPECT_TRUE(stepper.measures().warnings().empty()) << length;
      EXPECT_NEAR(
          stepper.displacement({{0, one.cable->displacement({.5 * length, 0., 0.}, {0., 1., 0.})}}),
          0., 1e-9);
    }
}

// Released from the horizontal plane; it goes slack and snaps at each turn.
TEST(CableMotions, slack_span_keeps_its_energy)
{
  for (const auto &[step, most] : {std::pair{.01, 11.}, {.005, 8.5}, {.002, 7.}})
  {
    const MotionOfCable motion = swing(slack_span(), .5 * pi, step, 3.);
    EXPECT_LE(std::max(motion.energy_change, motion.energy_loss), 1e-7) << step;
    EXPECT_LE(motion.iterations, most) << step;
  }
}

TEST(CableMotions, axial_damping_only_takes_energy)
{
  const MotionOfCable motion = swing(slack_span(1e3), .5 * pi, .005, 3.);
  EXPECT_LE(motion.energy_change, 1e-9);
  EXPECT_GT(motion.energy_loss, 1e-4);
  EXPECT_LT(motion.energy_loss, .5);
}

TEST(CableMotions, values_at_the_end_of_a_step_gain_energy)
{
  double gain = 1.; // if there is no answer any more
  error_of([&] { gain = swing(slack_span(), .5 * pi, .01, 6., "Newmark").energy_change; });
  EXPECT_GT(gain, .1);
}

// Small angle, before any chaos: second order, and the other scheme tends to the same motion.
TEST(CableMotions, order_in_time_and_a_second_scheme)
{
  CableData data = slack_span();
  data.section.axial_stiffness = 1e4;
  const auto middle = [&](const double step, const std::string &scheme)
  { return swing(data, .3, step, .4, scheme).middle; };
  const double a = middle(4e-3, "automatic"), b = middle(2e-3, "automatic"),
               c = middle(1e-3, "automatic"), limit = c + (c - b) / 3.;
  EXPECT_NEAR((a - b) / (b - c), 4., 1.);
  const double d = middle(1e-3, "backward Euler"), e = middle(5e-4, "backward Euler");
  EXPECT_NEAR(2. * e - d, limit, .1 * std::fabs(e - d));
  EXPECT_NEAR((d - limit) / (e - limit), 2., .2);
}

// A mass at the end of a straight cable pulls at it with F = EA v / c, so that its speed falls as
// exp(-(EA / c) t / mass) until the first wave is back (Saint-Venant; Love, Treatise on the
// Mathematical Theory of Elasticity, section 281).
TEST(CableMotions, waves_of_an_impact)
{
  constexpr double length = 10., EA = 1e5, mass_per_length = 1., v = .1;
  const double wave = std::sqrt(EA / mass_per_length);
  for (const double ratio : {1., .1, .01})
  {
    CableData data = cable_to({1.01 * length, 0., 0.}, length, {EA, 0., mass_per_length, 0.}, 100);
    data.gravity = {};
    data.element = CableElement::bar;
    data.holds_to = false;
    const double mass = length * mass_per_length / ratio;
    class Struck : public Cable
    {
    public:
      Struck(const CableData &data, const double mass, const double v) : Cable(data), v(v)
      {
        for (const unsigned int i : elements().end_dofs(true))
          M->add(i, i, mass);
        std::vector<double> f;
        elements().internal_force(shape().positions, {}, f);
        for (const unsigned int i : elements().end_dofs(true))
          constant_force[i] = f[i]; // the pull that it stands under
      }
      void initial_state(std::vector<double> &U, std::vector<double> &V) const override
      {
        Cable::initial_state(U, V);
        V[elements().end_dofs(true)[0]] = v;
      }

    private:
      double v;
    };
    const OneCable<Struck> one(data, mass, v);
    Stepper stepper(one.system, steps_of(.25 * length / 100. / wave, Start::given));
    const unsigned int end = one.cable->elements().end_dofs(true)[0];
    while (stepper.time() < 1.9 * length / wave)
    {
      stepper.advance();
      const double exact = v * std::exp(-EA / wave / mass * stepper.time());
      EXPECT_NEAR(stepper.displacement(0)[end], (v - exact) * mass * wave / EA,
                  2e-3 * v * length / wave)
          << ratio;
    }
    const double exact = v * std::exp(-EA / wave / mass * stepper.time());
    EXPECT_NEAR(stepper.state().V[0][end], exact, .02 * v) << ratio;
  }
}

TEST(CableMotions, floor_takes_what_hangs_too_low)
{
  for (const double length : {70., 74., 78., 80.})
    for (const double EA : {1.3e5, 1.3e7})
      for (const int n : {16, 32, 64})
      {
        const double depth = 12.;
        OneCable<> one(cable_to({60., 0., 0.}, length, {EA, 0., 1.07, 0.}, n));
        one.add_floor(depth, length, n);
        SCOPED_TRACE(std::to_string(length) + " m, EA " + std::to_string(EA) + ", elements " +
                     std::to_string(n));
        const auto check = [&]
        {
          const Stepper stepper(one.system);
          const double H = unbalanced(*one.cable, stepper.displacement(0))[0];
          const double exact = horizontal_on_floor(EA, 1.07 * 9.81, .5 * length, 30., depth);
          EXPECT_NEAR(H, exact, .1 * 1.07 * 9.81 * length / n);
          EXPECT_LE(stepper.residuals().balance, 1e-8);
        };
        EXPECT_EQ(error_of(check), "");
      }
}

// The difference of nonlinear and linearised statics falls with the square of the load.
TEST(CableMotions, small_loads_make_linearised_motions)
{
  const auto lowered = [](const CableGeometry geometry, const double load)
  {
    CableData data = cable_to({60., 0., 0.}, 60.1, {1.3e7, 0., 1.07, 0.}, 32);
    data.geometry = geometry;
    const OneCable<> one(data);
    one.cable->add_force(one.cable->displacement({30.05, 0., 0.}, {0., -1., 0.}), load);
    // About the shape of the cable without the load.
    Structure structure = one.system.structure();
    structure.linearise(structure.zero());
    const StaticState rest =
        static_equilibrium(structure, one.system.constraints(structure), {}, 0.);
    return evaluate(one.system.displacement(0, {30.05, 0., 0.}, {0., -1., 0.}), rest.displacement);
  };
  double before = INFINITY;
  for (const double load : {8., 4., 2., 1.})
  {
    const double difference = std::fabs(lowered(CableGeometry::nonlinear, load) -
                                        lowered(CableGeometry::linearised, load));
    EXPECT_GT(before / difference, 3.5) << load;
    before = difference;
  }
}
