// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: sum and first moment of a load along a wire are those of its formula to 1e-6 of the
// integral of its absolute value, also of loads narrower than an element, with jumps, and of pulses
// that move; where four Gauss points an element give as much, the forces are theirs to the bit.
// A smooth one that mixes s and t in any way is that of the Gauss rule to 1e-6 of its largest
// force. Sources: closed forms of the integrals of blocks and waves; the Gauss rule, computed here.
#include "scene_tests.h"

#include "base/dot.h"
#include <taut/wire/wire_component.h>

#include <deal.II/base/quadrature_lib.h>

using namespace verification;

namespace
{
  constexpr double length = 21., element = .7, bound = 1e-6;

  taut::Wire wire_of(const std::string &kind, const double own_length = length)
  {
    taut::Wire wire;
    wire.name = "wire";
    wire.b = {own_length, 0.};
    wire.mass_per_length = 1.;
    wire.tension = 500.;
    wire.element_size = element;
    wire.weight = false;
    wire.transverse = kind == "beam" ? taut::TransverseKind::beam : taut::TransverseKind::string;
    wire.bending_stiffness = kind == "beam" ? 200. : 0.;
    wire.degree = kind == "beam" ? 1 : kind.back() - '0';
    // The shapes of a translation and of a rotation about the first end.
    using taut::Expression;
    wire.transverse_start = {Expression(1.),
                             Expression("s", "start", Expression::Variables::position)};
    return wire;
  }

  const std::vector<std::string> kinds = {"string 1", "string 2", "string 4", "beam"};

  /// A wire under one load, and the work of the load on its rigid motions.
  struct LoadedWire
  {
    std::unique_ptr<taut::Substructure> body;
    std::vector<double> translation, rotation, P;

    LoadedWire(const std::string &kind, const std::string &formula, const bool is_moment = false,
               const double own_length = length)
    {
      taut::Load load;
      load.name = "load";
      load.kind = taut::Load::Kind::distributed;
      load.magnitude = taut::Expression(formula, "load");
      load.rotational = is_moment;
      if (is_moment)
        load.direction = {0., 0., 1.};
      body =
          taut::make_wire(wire_of(kind, own_length), taut::WireMotion::transverse, {}, {}, {load});
      body->initial_state(translation, rotation);
    }
    double force(const double t = 0.) { return work(t, translation); }
    double moment(const double t = 0.) { return work(t, rotation); }

  private:
    double work(const double t, const std::vector<double> &motion)
    {
      body->external_force(t, P);
      return taut::dot(P, motion);
    }
  };

  std::string block(const double force, const double middle, const double width)
  {
    return number(force / width) + "*(abs(s-" + number(middle) + ")<" + number(.5 * width) + ")";
  }

  std::string error_of(const std::string &kind, const std::string &formula, const double last)
  {
    return verification::error_of(
        [&]
        {
          LoadedWire wire(kind, formula);
          for (double t = 0.; t <= last; t += 1e-2)
            wire.force(t);
        });
  }

  /// The rule of four Gauss points on each element.
  std::vector<double> by_gauss_points(const taut::Substructure &body, const taut::Wire &wire,
                                      const taut::Expression &q, const double t,
                                      const unsigned int n_points = 4)
  {
    taut::Scene scene;
    scene.wires = {wire};
    const std::vector<double> nodes = taut::grid(scene, 0);
    const dealii::QGauss<1> rule(n_points);
    std::vector<double> P(body.n_dofs(), 0.);
    for (std::size_t e = 0; e + 1 < nodes.size(); ++e)
      for (unsigned int k = 0; k < rule.size(); ++k)
      {
        const double h = nodes[e + 1] - nodes[e], s = nodes[e] + h * rule.point(k)[0];
        taut::LinearForm shape = body.displacement({s, 0.}, {0., 1.});
        for (double &v : shape.value)
          v *= h * rule.weight(k);
        shape.add_to(q(s, t), P);
      }
    return P;
  }

  void expect_force(const std::string &kind, const std::string &formula, const double force,
                    const double moment, const double size, double &worst, const double t = 0.)
  {
    LoadedWire wire(kind, formula);
    double error = 0.;
    raise(error, (wire.force(t) - force) / size);
    raise(error, (wire.moment(t) - moment) / (size * length));
    raise(worst, error);
    EXPECT_LE(error, bound) << kind << ", " << formula << ", t = " << t;
  }
} // namespace

// 10 N on a fiftieth of an element, inside of elements and across a node, with all parts of its
// width on either side; 10 N up beside 10 N down.
TEST(DistributedLoads, narrow_ones_give_their_force_and_moment)
{
  double worst = 0.;
  for (const std::string &kind : kinds)
  {
    const double width = element / 50.;
    std::vector<double> middles = {length - .5 * width};
    for (int k = -13; k <= 13; ++k)
      middles.push_back(10 * element + .05 * k * width);
    for (int k = 0; k < 40; ++k)
      middles.push_back(3. + .137 * k);
    for (const double middle : middles)
      expect_force(kind, block(10., middle, width), 10., 10. * middle, 10., worst);
    for (const double apart : {.02, .1, .5, 3.})
      expect_force(kind, block(10., 5., width) + "-" + block(10., 5. + apart, width), 0.,
                   -10. * apart, 20., worst);
    expect_force(kind, "3*(s>4)*(s<11.3)", 21.9, 21.9 * 7.65, 21.9, worst);
    expect_force(kind, "4*sin(300*s)^2", 2. * length - std::sin(600. * length) / 300.,
                 length * length - length * std::sin(600. * length) / 300. -
                     (std::cos(600. * length) - 1.) / 180000.,
                 2. * length, worst);
  }
  figure("narrow load, largest error of force and moment over the load", worst);
}

// The same, by the forces of the supports of a scene, whole and in parts.
TEST(DistributedLoads, narrow_ones_are_carried_by_the_supports)
{
  const double width = element / 50.;
  double worst = 0.;
  for (const std::string components : {"string", "beam"})
    for (const double middle : {7.0005, 7.0069, 6.9937, 3.3, 17.71})
      for (const int parts : {1, 5})
        run_scene(R"(Gravity = 0, 0
Wire wire: To = 21, 0; Components = )" +
                      components + R"(; Mass per length = 1; Tension = 500;
  Bending stiffness = 200; Element size = 0.7
Support ends: Wire = wire; Positions = 0, 21
Load load: Type = distributed; On = wire; Magnitude = )" +
                      block(10., middle, width) + R"(
Time: End = 0
)",
                  {"Partition/Number of substructures=" + std::to_string(parts)},
                  [&](const taut::StepView &step)
                  {
                    const double first = -step.supports.at(0), last = -step.supports.at(1);
                    worst = std::max({worst, std::fabs(first + last - 10.) / 10.,
                                      std::fabs(last * length / middle - 10.) / 10.});
                    EXPECT_NEAR(first + last, 10., 10. * bound) << components << " " << middle;
                    EXPECT_NEAR(last * length, 10. * middle, 10. * bound * length);
                  });
  figure("narrow load, largest error of the supports' forces over the load", worst);
}

TEST(DistributedLoads, smooth_ones_are_those_of_four_gauss_points_to_the_bit)
{
  for (const std::string &kind : kinds)
  {
    for (const std::string formula :
         {"7", "3*s", "10*sin(pi*s/21)", "2*cos(2*s)", "5+sin(3.5*s)", "exp(-((s-9)/2)^2)",
          "12*sin(7*t)", "5*sin(6*t)*sin(s/3)", "cos(1.5*s-20*t)", "sin(2*s)/(s)"})
      for (const double t : {0., .31, 2.7})
      {
        LoadedWire wire(kind, formula);
        wire.force(t);
        const taut::Expression load(formula, "load");
        const std::vector<double> P = by_gauss_points(*wire.body, wire_of(kind), load, t);
        // What moves along the wire is integrated by polynomials of its shape; what is a product
        // of a function of s and one of t is integrated without the latter.
        if (load.depends_on_time())
          EXPECT_LE(verification::largest_difference(wire.P, P),
                    (load.separated().travelling.empty() ? 1e-14 : 1e-6) *
                        verification::largest(P));
        else
          EXPECT_TRUE(wire.P == P) << kind << ", " << formula << ", t = " << t;
      }
    // A jump changes its own element.
    const std::string jump = "sin(s/3)+(s>10.3)";
    LoadedWire wire(kind, jump);
    wire.force();
    const std::vector<double> P =
        by_gauss_points(*wire.body, wire_of(kind), taut::Expression(jump, "load"), 0.);
    std::size_t n_changed = 0;
    for (std::size_t i = 0; i < P.size(); ++i)
      n_changed += wire.P[i] != P[i];
    EXPECT_GE(n_changed, 1u) << kind;
    EXPECT_LE(n_changed, 5u) << kind;
  }
}

// 20 N on 0.2 m and on a hundredth of an element at 20 m/s: its force is constant, and that of its
// part on the wire at the ends.
TEST(DistributedLoads, pulse_that_moves_keeps_its_force)
{
  double worst = 0.;
  for (const std::string &kind : kinds)
    for (const double half : {.1, .005 * element})
    {
      LoadedWire wire(kind, number(10. / half) + "*(abs(s-20*t)<" + number(half) + ")");
      for (int k = 0; k <= 2150; ++k)
      {
        const double t = 5e-4 * k, first = std::max(0., 20. * t - half),
                     last = std::min(length, 20. * t + half),
                     force = 10. / half * std::max(0., last - first),
                     error =
                         std::max(std::fabs(wire.force(t) - force),
                                  std::fabs(wire.moment(t) - .5 * force * (first + last)) / length);
        worst = std::max(worst, error / 20.);
        ASSERT_LE(error, 20. * bound) << kind << ", t = " << t;
      }
    }
  figure("pulse that moves, largest error of force and moment over its force", worst);
}

// What stands may be as narrow as a load without time.
TEST(DistributedLoads, narrow_one_that_swells_in_place)
{
  double worst = 0.;
  for (const std::string &kind : kinds)
    for (const double middle : {7.0005, 6.9937, 3.3, 17.71})
      for (const double t : {.05, .2, .3, 4.})
        expect_force(kind, "sin(5*t)*(" + block(10., middle, element / 50.) + ")",
                     10. * std::sin(5. * t), 10. * std::sin(5. * t) * middle, 10., worst, t);
  figure("narrow load that swells, largest error of force and moment over the load", worst);
}

TEST(DistributedLoads, what_cannot_be_integrated_is_refused)
{
  for (const std::string &kind : kinds)
  {
    const std::string narrow = error_of(kind, "100*(abs(s-20*t-0.03)<0.01+0*sin(s*t))", .995);
    for (const char *const part :
         {"load 'load' is 0.02 m wide", "0.14 m wide, a fifth of an element"})
      EXPECT_TRUE(has(narrow, part)) << narrow;
    const std::string travelling = error_of(kind, "100*(abs(s-20*t-0.03)<0.0014)", .995);
    EXPECT_TRUE(has(travelling, "narrower than a hundredth of an element")) << travelling;
    EXPECT_EQ(error_of(kind, "1e300*exp(-((s-20*t+1195)/5)^2)", .995), "");
    EXPECT_EQ(error_of(kind, "3*exp(-((s-700*t+595)/8)^2)", .995), "");
    for (const std::string factor : {"", "(1+t)*"})
    {
      const std::string noise =
          error_of(kind, factor + "(sin(1e9*s)*43758.5453-rint(sin(1e9*s)*43758.5453))", .5);
      EXPECT_TRUE(has(noise, "load 'load' cannot be integrated to 1e-06")) << noise;
    }
    EXPECT_TRUE(has(error_of(kind, "rand(1)", 0.), "random"));
  }
}

// Names of files may look like variables; a load is what it is at times before the start, too.
TEST(DistributedLoads, no_term_is_lost)
{
  double largest_error = 0.;
  Folder folder;
  const std::string table = folder.write("wind-t.csv", "s [m],t\n0,3\n21,3\n");
  for (const std::string &kind : kinds)
    for (const double t : {0., .3, 2.})
    {
      expect_force(kind, "2*sin(t) + table(" + table + ", t, s)", length * (2. * std::sin(t) + 3.),
                   .5 * length * length * (2. * std::sin(t) + 3.), 3. * length, largest_error, t);
      expect_force(kind, "100*(abs(s-20*t-50)<0.1)", 20., 200., 20., largest_error, -2.);
      expect_force(kind, "t*(abs(s-4)<1)+3*s-sin(s-4*t)+sin(s-4*t)", 2. * t + 1.5 * length * length,
                   8. * t + length * length * length, 60. * length, largest_error, t);
    }
}

// A moment m a length turns a wire by m L about any point, and pushes nowhere.
TEST(DistributedLoads, moments_turn)
{
  LoadedWire wire("beam", "3*(s>2)*(s<9.25)", true);
  EXPECT_NEAR(wire.force(), 0., 1e-9);
  EXPECT_NEAR(wire.moment(), 3. * 7.25, 3. * 7.25 * bound);
}

// By panels of elements; a wave that grows shorter is integrated by elements where no panel
// resolves it.
TEST(DistributedLoads, smooth_ones_that_mix_place_and_time_are_those_of_gauss_points)
{
  for (const std::string &kind : kinds)
    for (const std::string formula :
         {"3*exp(-((s-7*t-2)/(12+.1*s*t))^2)", "sin(.2*s*(1+.2*t))*sin(.05*s*t)",
          "2+cos(.1*sqrt(s^2+40)-t)", "5*exp(-(s-10.5)^2/(9+s*t))", "sin(s*t)",
          "exp(-((sqrt(s^2+9)-5*t)/5)^2)"})
    {
      LoadedWire wire(kind, formula);
      const taut::Wire own = wire_of(kind);
      const taut::Expression q(formula, "load");
      double difference = 0., most = 0.;
      for (double t = 0.; t < 2.; t += .031)
      {
        wire.force(t);
        const std::vector<double> P = by_gauss_points(*wire.body, own, q, t);
        raise(difference, verification::largest_difference(wire.P, P));
        raise(most, verification::largest(P));
      }
      SCOPED_TRACE(kind + ", " + formula);
      EXPECT_LE(figure("smooth load, panels and Gauss points, " + formula, difference / most),
                bound);
      EXPECT_TRUE(difference > 0.) << "panels are not used";
    }
}

// Waves of many elements to waves shorter than one, on a wire with the longest panels: by panels as
// long as the Gauss points of the elements integrate them, and by elements then. Expected: the rule
// of forty Gauss points, over the largest force that the load could have on an element; moments up
// to the first one to 1e-6, those with the cubic shapes of beams to 2e-5.
TEST(DistributedLoads, smooth_waves_of_any_length_are_those_of_a_fine_rule)
{
  constexpr unsigned int n_elements = 400, n_points = 40;
  const double own_length = n_elements * element;
  for (const auto &[kind, accepted] :
       {std::pair<std::string, double>("string 1", bound), {"beam", 20. * bound}})
    for (const double waves : {.02, .05, .1, .15, .2, .25, .3, .35, .4, .5, .7, 1., 1.5, 2.3})
    {
      const std::string formula =
          "sin(" + number(2. * M_PI * waves / element) + "*sqrt(s^2+40)-3*t)";
      LoadedWire wire(kind, formula, false, own_length);
      const taut::Wire own = wire_of(kind, own_length);
      const taut::Expression q(formula, "load");
      double difference = 0.;
      for (const double t : {0., .31, 1.7})
      {
        wire.force(t);
        raise(difference, verification::largest_difference(
                              wire.P, by_gauss_points(*wire.body, own, q, t, n_points)));
      }
      EXPECT_LE(figure("smooth load, " + number(waves) + " waves in an element, " + kind,
                       difference / element),
                accepted);
    }
}

// A pulse inside of an element under a smooth load that mixes s and t, at a place between the Gauss
// points. Expected: a rule of 300 Gauss points, over the largest force on an element.
TEST(DistributedLoads, pulses_inside_of_an_element_are_seen_under_smooth_loads)
{
  constexpr unsigned int n_points = 300;
  for (const double place : {10.15, 10.3, 10.36, 10.43, 10.5, 10.57})
    for (const std::string moves : {"0", ".0003*t*s"})
    {
      const std::string formula =
          "(1+.1*sin(s*s*t/1000))*(1+5*exp(-((s-" + number(place) + "-" + moves + ")/.08)^8))";
      LoadedWire wire("string 1", formula, false, 400. * element);
      const taut::Wire own = wire_of("string 1", 400. * element);
      const taut::Expression q(formula, "load");
      for (const double t : {0., .4, 1.3})
      {
        wire.force(t);
        const double difference = verification::largest_difference(
            wire.P, by_gauss_points(*wire.body, own, q, t, n_points));
        EXPECT_LE(difference / element, 6. * bound) << formula << ", t = " << t;
      }
    }
}

// About the smallest numbers, which have no digits to integrate, a load is nothing.
TEST(DistributedLoads, loads_fade_below_the_smallest_number)
{
  constexpr double middle = .50037, width = .0003, largest = 3e5;
  for (const std::string &kind : kinds)
  {
    LoadedWire wire(kind, "5*sin(3*t)*0+3e5*exp(-((s-10)/0.5)^2-((t-0.50037)/0.0003)^2)");
    for (double exponent = 690.; exponent < 760.; exponent += .5)
    {
      const double t = middle - width * std::sqrt(exponent),
                   right = .5 * std::sqrt(M_PI) * largest * std::exp(-exponent);
      EXPECT_NEAR(wire.force(t), right, std::max(bound * right, 1e-306)) << exponent;
    }
  }
}

// A load that grows from numbers without all of their digits lifts a string off a rigid stop.
TEST(DistributedLoads, a_stop_under_a_load_that_grows_from_the_smallest_number)
{
  const std::string log =
      log_of("Gravity = 0, 0; Start = given\n"
             "Wire w: To = 40, 0; Components = string; Mass per length = 1.8; Tension = 3856;\n"
             "  Element size = 4; Mass damping = 2\nSupport e: Wire = w; Positions = 0, 40\n"
             "Load l: Type = distributed; On = w @ 0;\n"
             "  Magnitude = 38.6*exp(-((s-9.7)/5.05)^2)*exp(-((t-1.161)/6.4347e-3)^2)\n"
             "Link st: Type = stop; From = ground; To = w @ 30; Direction = 0, 1\n"
             "Time: Step = 1.52e-4; End = 1.2; Check steps = no\n");
  EXPECT_TRUE(has(log, "steps in")) << log;
}

// A shape whose way has no value at a moment at which the load has one.
TEST(DistributedLoads, ways_without_a_value_leave_the_load_as_it_is)
{
  LoadedWire wire("string 1", "exp(-((s-10)/(1-t))^2)");
  EXPECT_NEAR(wire.force(.5), .5 * std::sqrt(M_PI), 1e-6);
  EXPECT_NEAR(wire.force(1.), 0., 1e-12);
}

// The same formula with a factor of 1 that is no function of a sum a(t)*s + b(t) is integrated by
// panels of elements where it is smooth, and element by element elsewhere.
TEST(DistributedLoads, loads_by_shapes_and_by_products_are_those_by_elements)
{
  for (const std::string &kind : kinds)
    for (const std::string formula :
         {"3*exp(-((s-7*t-2)/12)^2)",
          "2+sin(.2*(s-7*t))",
          "3*exp(-((s-7*t-2)/3)^2)",
          "2+sin(.2*s-1.4*t)",
          "cos(s/5-t/.8)+sin(2*s-12.5*t)",
          "sin(s-2*t)+sin(2*s-3*t)",
          "5*exp(-((s-7*t)/15)^2)+exp(-((t-1.12)/.02)^2)*exp(-((s-11.8)/.25)^2)",
          "sin(s-2*t)+cos(.7*s)*t",
          "exp(-((s-7*t)/.25)^2)",
          "exp(-((t-1)/.01)^2)*s/(1+s^2)",
          "tanh(s-9*t)",
          "100*(abs(s-7*t-1)<0.1)",
          "max(0,1-abs(s-9*t)/0.3)",
          "20*(abs(s-7*t)<0.2)*(1+(s-7*t))-3*(abs(s-7*t+5)<1)",
          "3*exp(-((s-7*t-2)/12)^2)*(1+.3*sin(5*t))",
          "3*exp(-((s+7*t-19)/12)^2)",
          "3*exp(-((s-2*t^2-2)/12)^2)*(s>4.3)*(s<13)",
          "2*sin(.2*s-3*t)*exp(-((s-4*t-9)/12)^2)",
          "3*exp(-((s-7*t-2)/(12+3*t))^2)",
          "(abs(s-7*t-5)<1)*(1+tanh(s+2*t-9))",
          "max(0,1-abs((s-9*t)/(2-.5*t)))",
          "cos((s-8)*(1+.4*t))",
          "exp(-((t-1.12)/.02)^2)*exp(-((s-10.3)/.3)^2)"})
    {
      LoadedWire smooth(kind, formula), other(kind, "(" + formula + ")*(1+0*sin(s*t))");
      double difference = 0., largest = 0.;
      for (double t = 0.; t < 3.; t += .031)
      {
        smooth.force(t);
        other.force(t);
        raise(difference, verification::largest_difference(smooth.P, other.P));
        raise(largest, verification::largest(other.P));
      }
      SCOPED_TRACE(kind + ", " + formula);
      EXPECT_GT(largest, 0.);
      EXPECT_LE(
          figure("load by shapes, products and by elements, " + formula, difference / largest),
          2. * bound);
      const bool travels = has(formula, "/12") || has(formula, ".2*") || has(formula, "s/5");
      EXPECT_TRUE(!travels || difference > 0.) << "shapes are not used";
    }
}
