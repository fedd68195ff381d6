// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what a program or a scene of a plugin says that makes no sense is one UserError that names
// the body, the constraint or the item, and leaves no trace. Source: the tables below.
#include "common.h"
#include "fuzz/library_bodies.h"

#include "mechanism/mechanism.h"
#include <taut/cable/cable.h>
#include <taut/scene/scene.h>
#include <taut/time/stepper.h>
#include <taut/wire/wire_component.h>

namespace
{
  using namespace verification;
  using namespace library;
  using taut::Constraint;
  using taut::Scene;

  void expect_refused(const std::function<void()> &work, const std::string &name)
  {
    const std::string message = error_of(work);
    EXPECT_TRUE(has(message, name)) << "'" << name << "' is not in: '" << message << "'";
    EXPECT_FALSE(has(message, "\n")) << message;
  }

  using Numbers = std::vector<double>;
  const taut::Coordinates up = {0., 1., 0.};

  /// A mass that hangs on a spring, u = -weight / stiffness = -0.0981 m.
  struct Hanging
  {
    taut::System system;
    std::size_t body;
    taut::Displacement height;

    explicit Hanging(const Defect defect = Defect::none)
        : body(system.add("hanging", std::bind(chain_of, "hanging", Numbers{1., 1.},
                                               Numbers{200., 100.}, defect)))
    {
      if (static_cast<int>(defect) < first_of_places)
        height = system.displacement(body, {1.}, up);
    }
  };

  constexpr double rest_of_first = -2. * gravity / 200., rest = rest_of_first - gravity / 100.;

  /// A place that gives what it should up to a time, and then something else.
  class FadingPlace : public taut::MovingPlace
  {
  public:
    FadingPlace(taut::Displacement form, std::function<void(taut::Displacement &, double &)> spoil)
        : form(std::move(form)), spoil(std::move(spoil))
    {
    }
    double position(double) const override { return 0.; }
    void append_terms(const double t, taut::Displacement &terms) const override
    {
      terms = at(t).first;
    }
    void append_rates(double, taut::Displacement &) const override {}
    double gap(const double t) const override { return at(t).second; }

  private:
    std::pair<taut::Displacement, double> at(const double t) const
    {
      std::pair<taut::Displacement, double> result{form, .1};
      if (t > .0045)
        spoil(result.first, result.second);
      return result;
    }
    const taut::Displacement form;
    const std::function<void(taut::Displacement &, double &)> spoil;
  };

  /// Says that it is not linear and has some of the functions that this asks for.
  class PartOfBody : public Chain
  {
  public:
    explicit PartOfBody(const int n_functions)
        : Chain("partial", {1.}, {100.}), n_functions(n_functions)
    {
    }
    bool is_linear() const override { return false; }
    void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                        std::vector<double> &f) const override
    {
      if (n_functions < 1)
        return Chain::internal_force(U, V, f);
      f = {100. * U[0] + 1e3 * U[0] * U[0] * U[0]};
    }
    std::unique_ptr<taut::SymmetricMatrix> tangent(const std::vector<double> &U,
                                                   const std::vector<double> &V, const double rate,
                                                   const bool definite) const override
    {
      if (n_functions < 2)
        return Chain::tangent(U, V, rate, definite);
      auto result = std::make_unique<taut::CompressedMatrix>(1);
      result->add(0, 0, 100. + 3e3 * U[0] * U[0]);
      return result;
    }
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             const double step, std::vector<double> &f) const override
    {
      if (n_functions < 3)
        return Chain::mean_internal_force(U0, U1, step, f);
      const double a = U0[0], b = U1[0];
      f = {50. * (a + b) + 250. * (a + b) * (a * a + b * b)};
    }
    double strain_energy(const std::vector<double> &U) const override
    {
      if (n_functions < 4)
        return Chain::strain_energy(U);
      return 50. * U[0] * U[0] + 250. * U[0] * U[0] * U[0] * U[0];
    }

  private:
    const int n_functions;
  };

  /// A wire with a support, a mass on it, a mass on a spring, a stop, a load and a probe.
  Scene good_scene()
  {
    using Kind = taut::Attachment::Kind;
    Scene scene;
    taut::Wire wire;
    wire.name = "wire";
    wire.b = {10., 0., 0.};
    wire.mass_per_length = 1.;
    wire.transverse = taut::TransverseKind::string;
    wire.tension = 1e3;
    scene.wires = {wire};
    const auto add = [](auto &items, const std::string &name) -> auto &
    {
      items.emplace_back().name = name;
      return items.back();
    };
    add(scene.supports, "ends").positions = {0., 10.};
    add(scene.point_masses, "clip").positions = {5.};
    add(scene.masses, "block").mass = 2.;
    taut::Spring &spring = add(scene.springs, "spring");
    spring.to = 0;
    spring.stiffness = 100.;
    taut::Link &stop = add(scene.links, "stop");
    stop.kind = taut::LinkKind::stop;
    stop.from = {Kind::mass, 0};
    stop.to = {Kind::wire, 0, 3.};
    add(scene.loads, "push").target = {Kind::mass, 0};
    add(scene.probes, "probe").point = {Kind::wire, 0, 5.};
    return scene;
  }
} // namespace

TEST(Library, every_defect_of_a_body_is_named)
{
  for (int i = 0; i < n_defects; ++i)
  {
    const auto defect = static_cast<Defect>(i);
    const std::string message = error_of(
        [&]
        {
          Hanging hanging(defect);
          hanging.height = hanging.system.displacement(hanging.body, {1.}, up);
          taut::StepperOptions options;
          options.start = taut::Start::given;
          taut::Stepper stepper(hanging.system, options);
          stepper.advance();
        });
    EXPECT_EQ(message.empty(), defect == Defect::none) << i << ": " << message;
    EXPECT_EQ(message.find("hanging") == std::string::npos, message.empty()) << message;
  }
}

TEST(Library, forms_belong_to_their_system)
{
  Hanging one, other;
  other.system.add(Constraint::unilateral("own", other.height).gap(1.));
  expect_refused([&] { one.system.add(Constraint::unilateral("stop", other.height)); },
                 "constraint 'stop'");
  taut::Stepper stepper(one.system);
  EXPECT_NEAR(stepper.displacement(one.height), rest, 1e-12);
  expect_refused([&] { stepper.displacement(other.height); }, "on another system");
  expect_refused([&] { stepper.velocity(other.height); }, "on another system");
}

TEST(Library, a_stepper_knows_what_there_was)
{
  Hanging hanging;
  const std::size_t stop =
      hanging.system.add(Constraint::unilateral("stop", hanging.height).gap(.05));
  taut::Stepper stepper(hanging.system);
  const double N = stepper.multiplier(stop);
  // Balance of the mass between the springs, then of the one on the stop.
  const double u0 = (100. * -.05 - gravity) / 300.;
  EXPECT_NEAR(N, gravity + 100. * (-.05 - u0), 1e-9);
  const std::size_t late = hanging.system.add(Constraint::unilateral("late", hanging.height));
  const std::size_t body = hanging.system.add("late", [] { return chain_of("late", {1.}, {9.}); });
  const taut::Displacement form = hanging.system.displacement(body, {}, up);
  expect_refused([&] { stepper.multiplier(late); }, "number 1");
  expect_refused([&] { stepper.gap(99); }, "number 99");
  expect_refused([&] { stepper.displacement(body); }, "number 1");
  expect_refused([&] { stepper.displacement(form); }, "body number 1");
  stepper.advance();
  EXPECT_NEAR(stepper.multiplier(stop), N, 1e-9);
  EXPECT_EQ(stepper.displacement(hanging.body).size(), 2u);
}

TEST(Library, a_place_that_moves_is_watched)
{
  using Spoil = std::function<void(taut::Displacement &, double &)>;
  const std::pair<std::string, Spoil> list[] = {
      {"", [](taut::Displacement &, double &) {}},
      {"body number 5000", [](taut::Displacement &form, double &) { form[0].substructure = 5000; }},
      {"DoF 70000", [](taut::Displacement &form, double &) { form[0].form.index[0] = 70000; }},
      {"2 indices", [](taut::Displacement &form, double &) { form[0].form.index.push_back(0); }},
      {"no finite number",
       [](taut::Displacement &form, double &) { form[0].form.value[0] = infinite; }},
      {"no finite gap", [](taut::Displacement &, double &gap) { gap = not_a_number; }}};
  for (const auto &[name, spoil] : list)
  {
    Hanging hanging;
    hanging.system.add(
        Constraint::unilateral("contact", std::make_shared<FadingPlace>(hanging.height, spoil)));
    taut::Stepper stepper(hanging.system);
    const std::string message = error_of(
        [&]
        {
          while (stepper.time() < .01)
            stepper.advance();
        });
    EXPECT_TRUE(has(message, name)) << message;
    EXPECT_EQ(message.find("constraint 'contact'") == std::string::npos, name.empty()) << message;
    EXPECT_NEAR(stepper.time(), name.empty() ? .01 : .004, 1e-12) << name;
  }
}

TEST(Library, a_body_that_is_not_linear_has_its_own_functions)
{
  for (int n = 0; n <= 4; ++n)
  {
    const std::string message = error_of(
        [&]
        {
          taut::System system;
          const std::size_t body =
              system.add("partial", [&] { return std::make_unique<PartOfBody>(n); });
          taut::StepperOptions options;
          options.start = n == 4 ? taut::Start::equilibrium : taut::Start::undeformed;
          taut::Stepper stepper(system, options);
          for (int k = 0; k < 3; ++k)
            stepper.advance();
          const double u = stepper.displacement(body)[0];
          EXPECT_NEAR(100. * u + 1e3 * u * u * u, -gravity, n == 4 ? 1e-9 : INFINITY);
        });
    const std::string expected =
        n == 4 ? "" : "body 'partial' says that it is not linear, and does not override ";
    EXPECT_EQ(message.substr(0, expected.size()), expected) << n << ": " << message;
    EXPECT_EQ(message.empty(), n == 4) << message;
  }
}

TEST(Library, values_of_a_scene_of_a_generator)
{
  const std::pair<std::string, std::function<void(Scene &)>> list[] = {
      {"Gravity", [](Scene &s) { s.gravity.y = not_a_number; }},
      {"wire 'wire'", [](Scene &s) { s.wires[0].mass_per_length = -1.; }},
      {"wire 'wire'", [](Scene &s) { s.wires[0].tension = not_a_number; }},
      {"wire 'wire'", [](Scene &s) { s.wires[0].damping.mass = -1.; }},
      {"wire 'wire'", [](Scene &s) { s.wires[0].b.y = infinite; }},
      {"wire 'wire'", [](Scene &s) { s.wires[0].degree = 9; }},
      {"support 'ends'", [](Scene &s) { s.supports[0].wire = 7; }},
      {"support 'ends'", [](Scene &s) { s.supports[0].prescribed = taut::Expression(infinite); }},
      {"support 'ends'", [](Scene &s) { s.supports[0].positions[0] = not_a_number; }},
      {"point mass 'clip'", [](Scene &s) { s.point_masses[0].wire = 1; }},
      {"point mass 'clip'", [](Scene &s) { s.point_masses[0].mass = -3.; }},
      {"mass 'block'", [](Scene &s) { s.masses[0].mass = -1.; }},
      {"mass 'block'", [](Scene &s) { s.masses[0].mass = not_a_number; }},
      {"mass 'block'", [](Scene &s) { s.masses[0].velocity[1] = infinite; }},
      {"mass 'block'", [](Scene &s) { s.masses[0].moves[1] = false; }},
      {"spring 'spring'", [](Scene &s) { s.springs[0].to = 4; }},
      {"spring 'spring'", [](Scene &s) { s.springs[0].stiffness = -5.; }},
      {"spring 'spring'", [](Scene &s) { s.springs[0].direction = {0., 2., 0.}; }},
      {"link 'stop'", [](Scene &s) { s.links[0].from.index = 3; }},
      {"link 'stop'", [](Scene &s) { s.links[0].to.index = 3; }},
      {"link 'stop'", [](Scene &s) { s.links[0].to = {taut::Attachment::Kind::body, 0}; }},
      {"link 'stop'", [](Scene &s) { s.links[0].stiffness = -5.; }},
      {"link 'stop'", [](Scene &s) { s.links[0].stiffness = not_a_number; }},
      {"link 'stop'", [](Scene &s) { s.links[0].gap = not_a_number; }},
      {"link 'stop'", [](Scene &s) { s.links[0].direction = {}; }},
      {"load 'push'", [](Scene &s) { s.loads[0].target.index = 1; }},
      {"load 'push'", [](Scene &s) { s.loads[0].magnitude = taut::Expression(not_a_number); }},
      {"probe 'probe'", [](Scene &s) { s.probes[0].point.index = 1; }},
      {"probe 'probe'", [](Scene &s) { s.probes[0].direction.x = not_a_number; }},
      {"body 'ghost'", [](Scene &s) {
         s.bodies = {{"ghost", "", "none", nullptr}};
       }}};
  taut::check(good_scene(), 1.);
  for (const auto &[name, spoil] : list)
  {
    Scene scene = good_scene();
    spoil(scene);
    expect_refused([&] { taut::check(scene, 1.); }, name);
  }
}

TEST(Library, wires_and_masses_of_a_program)
{
  const Scene scene = good_scene();
  EXPECT_GT(taut::make_wire(scene.wires[0], taut::WireMotion::transverse, scene.supports)->n_dofs(),
            10u);
  taut::Wire wire = scene.wires[0];
  wire.tension = -1.;
  expect_refused([&] { taut::make_wire(wire); }, "wire 'wire'");
  std::vector<taut::PointMass> masses = scene.point_masses;
  masses[0].positions = {11.};
  expect_refused([&] { taut::make_wire(scene.wires[0], taut::WireMotion::transverse, {}, masses); },
                 "point mass 'clip'");
  using Members = std::vector<std::size_t>;
  EXPECT_EQ(taut::Mechanism(scene, Members{0}).n_dofs(), 1u);
  expect_refused([&] { taut::Mechanism(scene, Members{}); }, "mechanism");
  expect_refused([&] { taut::Mechanism(scene, Members{5}); }, "number 5");
}
