// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the scheme of a moving elastic contact is that of the most flexible place of its way, and
// of each step where the way is not known before the run. Sources: the same scene in a sixteenth of
// the step by other schemes; the load that pushes the roller.
#include "scene_tests.h"

#include <taut/scene/scene.h>
#include <taut/time/stepper.h>
#include <taut/wire/wire_component.h>

using namespace verification;

namespace
{
  constexpr double force = 5., step = 1e-3, end = .38, start_of_way = 4., speed = 5.;

  /// A roller of 10 kg that is pushed against a light wire, from one of its supports nearly to the
  /// next one.
  std::string roller(const bool is_beam)
  {
    return R"(Gravity = 0, 0; Start = equilibrium
Wire wire: To = 8, 0; Mass per length = 0.01; Element size = 0.25;
  )" + std::string(is_beam ? "Components = beam; Bending stiffness = 1" : "Components = string") +
           R"(; Tension = 100
Support posts: Wire = wire; Positions = 0:2:8
Mass roller: Position = 4, 0; Motions = y; Mass = 10
Link contact: Type = sliding contact; From = roller; To = wire @ 4; Direction = 0, 1;
  Stiffness = 1e5; Speed = 5
Load push: Type = point; On = roller; Direction = 0, 1; Magnitude = 5
Statistics: Filter frequency = 0
Time: Step = 1e-3; End = 0.38
)";
  }

  struct Result
  {
    double peak = 0., impulse = 0., height = 0., open = 0.;
    std::string log, error;
  };

  /// Force of the contact and height of the roller.
  Result run(const std::string &text, const Overrides &overrides = {})
  {
    Result result;
    std::unique_ptr<Session> session;
    const Callback record = [&](const taut::StepView &view)
    {
      const double N = view.state.multiplier.back(), dt = view.state.last_step;
      result.peak = std::max(result.peak, N);
      result.open += N > 0. ? 0. : dt;
      result.impulse += N * dt;
      result.height = view.state.U[1][0] + view.reference.displacement[1][0];
    };
    result.error = error_of(
        [&]
        {
          session = std::make_unique<Session>(text, overrides);
          session->run(record);
        });
    if (session)
      result.log = session->log();
    return result;
  }

  const taut::Coordinates up = {0., 1., 0.};

  /// A mass that a force pushes along y.
  class Roller : public taut::Substructure
  {
  public:
    Roller() : Substructure("roller")
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(1);
      M->add(0, 0, 10.);
      constant_force = {force};
      finish();
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &n) const override
    {
      taut::LinearForm form;
      form.add(0, n[1]);
      return form;
    }
    NullSpace null_space() const override { return {{{1.}}, {0}}; }
  };

  /// A place of the wire that leaves its support; if it follows the motion, nobody knows so
  /// before the run.
  class LeavingPlace : public taut::MovingPlace
  {
  public:
    LeavingPlace(const taut::System &system, const std::size_t wire, const std::size_t roller,
                 const bool follows)
        : system(system), wire(wire), roller(roller), follows(follows)
    {
    }
    double position(const double t) const override
    {
      return start_of_way + speed * (follows ? std::min(t, known) : t);
    }
    void append_terms(const double t, std::vector<taut::Term> &terms) const override
    {
      terms = system.displacement(wire, {position(t)}, up);
      for (const taut::Term &term : system.displacement(roller, {}, {0., -1., 0.}))
        terms.push_back(term);
    }
    void append_rates(double, std::vector<taut::Term> &) const override {}
    double gap(const double) const override { return 0.; }
    void follow(const Motion &, const double, const double end_of_step) override
    {
      known = end_of_step;
    }
    void append_course(std::vector<double> &course) const override { course.push_back(known); }
    void set_course(const std::vector<double> &course) override
    {
      known = course.empty() ? 0. : course[0];
    }

  private:
    const taut::System &system;
    const std::size_t wire, roller;
    const bool follows;
    double known = 0.;
  };

  /// The string and the roller of above, by calls.
  struct Rolling
  {
    taut::System system;

    explicit Rolling(const bool follows)
    {
      taut::Wire wire;
      wire.name = "wire";
      wire.b = {8., 0., 0.};
      wire.mass_per_length = .01;
      wire.transverse = taut::TransverseKind::string;
      wire.tension = 100.;
      wire.element_size = .25;
      wire.weight = false;
      taut::Support posts;
      posts.positions = {0., 2., 4., 6., 8.};
      const std::size_t string = system.add(
          "wire", [&] { return taut::make_wire(wire, taut::WireMotion::transverse, {posts}); });
      const std::size_t mass = system.add("roller", [] { return std::make_unique<Roller>(); });
      system.add(taut::Constraint::unilateral(
                     "contact", std::make_shared<LeavingPlace>(system, string, mass, follows))
                     .stiffness(1e5));
    }
  };

  struct Stepped
  {
    double last = 0.;
    std::string scheme, error;
  };
  Stepped step_by_calls(const bool follows, const double until, const bool allow = false)
  {
    Rolling rolling(follows);
    taut::StepperOptions options;
    options.step = step;
    options.end = until;
    options.allow_unsuitable_scheme = allow;
    taut::Stepper stepper(rolling.system, options);
    Stepped result;
    result.scheme = stepper.scheme();
    result.error = error_of(
        [&]
        {
          while (stepper.time() < end - .5 * step)
            stepper.advance();
        });
    result.last = stepper.time();
    return result;
  }
} // namespace

// The roller hides the support, where the wire does not yield: a contact that stays there is
// compliant, one that leaves it has the light wire alone to push.
TEST(MovingContacts, have_the_scheme_of_the_most_flexible_place_of_their_way)
{
  for (const bool is_beam : {false, true})
  {
    const std::string text = roller(is_beam);
    const Result stays = run(text, {"Network.Link contact.Speed=0", "Time.End=0.01"}),
                 leaves = run(text);
    EXPECT_EQ(stays.error + leaves.error, "");
    EXPECT_TRUE(has(stays.log, "generalised-alpha")) << stays.log;
    for (const char *const part : {"Moreau-Jean", "'contact' acts as rigid"})
      EXPECT_TRUE(has(leaves.log, part)) << leaves.log;
    // By its name the scheme of a compliant contact is refused before the first step.
    const std::string by_name = run(text, {"Time.Scheme=Newmark"}).error;
    EXPECT_TRUE(has(by_name, "act as rigid, here 'contact'")) << by_name;
  }
}

// Expected: peaks and impulses of another scheme in a sixteenth of the step.
TEST(MovingContacts, press_a_roller_on_a_wire_from_support_to_support)
{
  for (const bool is_beam : {false, true})
  {
    const std::string name = is_beam ? "roller on a beam" : "roller on a string",
                      text = roller(is_beam);
    const Overrides other = {"Time.Scheme=generalised-alpha", "Time.Allow unsuitable scheme=true",
                             "Time.Allow energy gain=true"};
    const Result reference = run(text, other + Overrides{"Time.Step=6.25e-5"}), chosen = run(text),
                 old = run(text, other);
    ASSERT_EQ(chosen.error + reference.error, "");
    for (const auto &[what, r] : {std::pair(", fine, ", &reference),
                                  {", automatic, ", &chosen},
                                  {", compliant scheme, ", &old}})
    {
      figure(name + what + "largest force", r->peak, "N");
      figure(name + what + "part of the time open", r->open / end);
      figure(name + what + "impulse", r->impulse, "N s");
      figure(name + what + "height of the roller", r->height, "m");
    }
    EXPECT_NEAR(chosen.peak, reference.peak, .06 * reference.peak);
    EXPECT_NEAR(chosen.impulse, reference.impulse, .02 * reference.impulse);
    EXPECT_NEAR(chosen.height, reference.height, .02 * reference.height);
  }
}

// The scheme suits the first step, and steps that the tolerance lets grow are longer. Expected:
// the motion of the fine run, or an error that names the contact and asks for a step.
TEST(MovingContacts, in_steps_that_grow_are_right_or_end_the_run)
{
  const std::string text = roller(false);
  const Result reference = run(text, {"Time.Scheme=Moreau-Jean", "Time.Step=6.25e-5"});
  ASSERT_EQ(reference.error, "");
  for (const std::string first : {"1e-3", "1e-4", "2e-5"})
    for (const std::string tolerance : {"1e-3", "1e-5"})
    {
      const Result r = run(text, {"Time.Step control=adaptive", "Time.Step=" + first,
                                  "Time.Adaptive step.Tolerance=" + tolerance});
      if (r.error.empty())
      {
        EXPECT_NEAR(r.impulse, reference.impulse, .02 * reference.impulse) << first << tolerance;
        EXPECT_NEAR(r.height, reference.height, .02 * reference.height) << first << tolerance;
        continue;
      }
      for (const char *const part :
           {"Network/Link contact", "'contact' acts as rigid at t = ", "Take 'Moreau-Jean'"})
        EXPECT_TRUE(has(r.error, part)) << r.error;
    }
}

// A program that does not say how far it goes, and a place that follows the motion.
TEST(MovingContacts, end_a_run_where_their_scheme_does_not_suit_any_more)
{
  const Stepped known = step_by_calls(false, end);
  EXPECT_TRUE(has(known.scheme, "Moreau-Jean")) << known.scheme;
  EXPECT_EQ(known.error, "");
  EXPECT_NEAR(known.last, end, 1e-9);
  for (const bool follows : {false, true})
  {
    const Stepped unknown = step_by_calls(follows, follows ? end : 0.);
    EXPECT_TRUE(has(unknown.scheme, "generalised-alpha")) << unknown.scheme;
    for (const char *const part :
         {"'contact' acts as rigid at t = ", "Take 'Moreau-Jean', or a smaller step"})
      EXPECT_TRUE(has(unknown.error, part)) << unknown.error;
    figure("scheme that does not suit any more, way from the support at the end",
           speed * unknown.last, "m");
    EXPECT_LT(unknown.last, .5 * end);
    EXPECT_EQ(step_by_calls(follows, follows ? end : 0., true).error, "");
  }
}
