// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: 'automatic' takes generalised-alpha where a step resolves the impacts at all unilateral
// links, otherwise Moreau-Jean with conditions on gaps, then velocities; it takes the mass of
// contact nodes where that suits, says which and why, and is nearer to exact solutions than what
// else it might have taken. Sources: wave equation (prm/bar_on_wall.prm), free fall onto a rigid
// floor.
#include "scene_tests.h"

#include <taut/base/registry.h>
#include <taut/time/integrator.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

using namespace verification;

namespace
{
  /// The line of the log about the scheme, and whether nodes gave their mass; or the error.
  std::string choice(const std::string &scene, const Overrides &more)
  {
    std::string result;
    const std::string error = error_of(
        [&]
        {
          const std::string log = log_of(scene, Overrides{"Time.Scheme=automatic"} + more),
                            mark = "Scheme (automatic): ";
          const std::size_t at = log.find(mark) + mark.size();
          result = log.substr(at, log.find('\n', at) - at) +
                   (has(log, "gave their mass") ? "; nodes gave their mass" : "");
        });
    return error.empty() ? result : "error: " + error;
  }

  void expect_choice(const std::string &scene, const Overrides &more, const std::string &scheme,
                     const std::string &reason)
  {
    const std::string line = choice(scene, more);
    EXPECT_EQ(line.substr(0, scheme.size()), scheme) << line;
    EXPECT_TRUE(has(line, reason)) << line;
  }

  /// Two masses on a spring fall 0.8 m onto a floor.
  std::string falling_masses(const std::string &floor = "")
  {
    return R"(Gravity = 0, -10; Start = given
Mass lower: Position = 0, 0.8; Motions = y; Mass = 2
Mass upper: Position = 0, 1.8; Motions = y; Mass = 2
Spring spring: From = lower; To = upper; Stiffness = 1
Link floor: Type = stop; From = ground; To = lower; Direction = 0, 1; Gap = 0.8; )" +
           floor + R"(
Time: Step = 1e-3; End = 0.7
)";
  }

  /// Root mean square error of the lower end of the bar on the wall over that of its motion.
  double bar_error(const double elements, const Overrides &more)
  {
    double error = 0., size = 0.;
    run_scene(
        scene_file("bar_on_wall"),
        Overrides{"Network.Wire bar.Element size=0.1", "Time.Step=" + number(elements * .1 / 30.)} +
            more,
        [&](const taut::StepView &view)
        {
          const double t = view.state.time,
                       exact = t < .5 ? -10. * t : std::max(-5., -5. + 10. * (t - 7. / 6.)),
                       e = displacement(view, 0, 0.) - exact;
          error += e * e;
          size += exact * exact;
        });
    return std::sqrt(error / size);
  }

  /// A scheme of an author, whose entry is not in a subsection of its own.
  class HHTOfAnAuthor : public taut::TimeIntegrator
  {
  public:
    void declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Alpha", alpha, "", dealii::Patterns::Double(0., .3));
    }
    taut::StepCoefficients coefficients(const double step) const override
    {
      return taut::hht(step, alpha);
    }
    std::string description() const override { return "author's HHT " + number(alpha); }

  private:
    double alpha = .1;
  };
  const taut::Register<taut::TimeIntegrator, HHTOfAnAuthor> author("author's HHT", "of a test");
} // namespace

TEST(Schemes, entries_of_a_registered_scheme_are_read)
{
  const std::string scene = scene_file("inclined_cable");
  const Overrides scheme = {"Time.Scheme=author's HHT", "Time.End=0.01"};
  EXPECT_TRUE(has(log_of(scene, scheme), "author's HHT 0.1"));
  EXPECT_TRUE(has(log_of(scene, scheme + Overrides{"Time.Alpha=0.05"}), "author's HHT 0.05"));
  for (const char *wrong : {"Time.Alpha=0.5", "Time.Alfa=0.05"})
    EXPECT_TRUE(has(error_of([&] { log_of(scene, scheme + Overrides{wrong}); }), "Alpha")) << wrong;
}

TEST(Schemes, automatic_follows_from_links_bodies_and_step)
{
  const std::string bar = scene_file("bar_on_wall"), beam = scene_file("beam_over_supports"),
                    smooth = "generalised-alpha (spectral radius 0.8)",
                    rigid = "Moreau-Jean (theta 0.5, gaps then velocities, restitution 0)",
                    stiffer = "'floor' acts as rigid", compliant = "no unilateral link is stiffer",
                    massless = "gave their mass", reduced = "Network.Wire bar.Mass matrix=reduced",
                    soon = "Time.End=0.01", joint = "Network.Link floor.Type=joint",
                    at_once = "Network.Link floor.Gap=0";
  expect_choice(falling_masses(), {joint, at_once, soon}, smooth, compliant);
  expect_choice(scene_file("inclined_cable"), {soon}, smooth, compliant);
  expect_choice(scene_file("en50318_2002_250"), {soon, "Statistics.Window="}, smooth, compliant);
  // 400 linear elements, 30 m/s: 0.6 and 0.06 of an element a step, 4, 4.1.
  for (const std::string step : {"5e-4", "5e-5", "3.333e-3"})
    expect_choice(bar, {"Time.Step=" + step, soon}, smooth, massless);
  expect_choice(bar, {"Time.Step=3.5e-3", soon}, rigid, stiffer);
  expect_choice(bar, {reduced, soon}, smooth, massless);
  // A singular mass matrix with a link that acts as rigid.
  expect_choice(bar, {reduced, "Time.Step=3.5e-3", soon}, "Moreau-Jean (theta 0.5, gaps)",
                "the mass matrix of 'bar (axial)', 'reduced', has no inverse");
  // Mass that shall stay.
  const std::string stays = "Time.Mass redistribution=no";
  for (const std::string step : {"1e-5", "1e-4", "5e-4", "5e-3"})
    expect_choice(bar, {stays, "Time.Step=" + step, soon}, rigid, stiffer);
  expect_choice(bar, {"Network.Link floor.Stiffness=1e8", soon}, rigid, stiffer);
  expect_choice(bar, {"Network.Link floor.Stiffness=1e3", soon}, smooth, compliant);
  // Two stops need two elements between them.
  expect_choice(bar, {"Network.Link floor.To=bar @ 0, 0.05", soon}, smooth, massless);
  expect_choice(bar, {"Network.Link floor.To=bar @ 0, 0.025", soon}, rigid, "'floor 1'");
  // Elements that are there: 0.04 m between two stops are two of 0.02 m, 0.03 m two of 0.015 m, of
  // which waves cross 3.8 and 4.2 a step.
  const std::string close = "Network.Link floor.To=bar @ 0, 0.03";
  expect_choice(bar, {"Network.Link floor.To=bar @ 0, 0.04", soon}, smooth, massless);
  expect_choice(bar, {close, "Time.Step=1.9e-3", soon}, smooth, massless);
  expect_choice(bar, {close, "Time.Step=2.1e-3", soon}, rigid, "'floor 1'");
  // Obliquely, waves of 30 m/s along and 3 m/s across: the fastest cross 3.96 and 4.2 elements a
  // step.
  const Overrides oblique = {"Network.Wire bar.Components=bar, string",
                             "Network.Wire bar.Tension=9", "Network.Link floor.Direction=0.6, 0.8",
                             soon};
  expect_choice(bar, oblique + Overrides{"Time.Step=3.3e-3"}, smooth, massless);
  expect_choice(bar, oblique + Overrides{"Time.Step=3.5e-3"}, rigid, stiffer);
  // Beams keep their mass.
  expect_choice(beam, {soon}, rigid, "'support 1' acts as rigid");
  expect_choice(beam, {"Time.Step=1e-5", "Time.End=1e-4"}, rigid, "'support 1' acts as rigid");
  // Masses.
  for (const std::string floor : {"", "Stiffness = 1e9"})
    expect_choice(falling_masses(floor), {soon}, rigid, stiffer);
  expect_choice(falling_masses("Stiffness = 1e3"), {soon}, smooth, compliant);
  // The values that the rules were measured with, not the file's.
  expect_choice(falling_masses(), {"Time.Moreau-Jean.Theta=0.7", soon}, rigid, stiffer);
  expect_choice(bar, {"Time.Generalised-alpha.Spectral radius=0.3", soon}, smooth, massless);
  // A mass that rebounds as a whole wants its energy kept, if steps are adaptive at any of them.
  const std::string spring = "Stiffness = 1e5", impacts = "does not resolve the impacts";
  expect_choice(falling_masses(spring), {"Time.Step=1e-4", soon}, smooth, compliant);
  expect_choice(falling_masses(spring), {"Time.Step=2e-3", soon}, rigid, impacts);
  expect_choice(falling_masses(spring), {"Time.Step=4e-2"}, rigid, stiffer);
  expect_choice(falling_masses(spring), {"Time.Step=1e-4", "Time.Step control=adaptive", soon},
                rigid, impacts);
}

// A second stop decides whether the node at the first one gives its mass, by how stiff it is.
TEST(Schemes, automatic_leaves_mass_beside_stiff_stops)
{
  const auto run = [](const std::string &stiffness)
  {
    return log_of(scene_file("bar_on_wall"),
                  {"Time.Scheme=automatic", "Time.End=0.01", "Network.Links=floor, roof",
                   "Network.Link roof.Type=stop", "Network.Link roof.From=bar @ 10",
                   "Network.Link roof.To=ground", "Network.Link roof.Direction=0, 1",
                   "Network.Link roof.Gap=50", "Network.Link roof.Stiffness=" + stiffness});
  };
  const std::string taken = "Mass redistribution: nodes of wires under ",
                    kept = "Moreau-Jean (theta 0.5, gaps then velocities";
  const std::string compliant = run("1e3"), stiff = run("1e8");
  EXPECT_TRUE(has(compliant, taken + "'floor' gave")) << compliant;
  EXPECT_TRUE(has(compliant, "generalised-alpha (spectral radius 0.8)"));
  EXPECT_FALSE(has(stiff, taken)) << stiff;
  EXPECT_TRUE(has(stiff, kept)) << stiff;
}

TEST(Schemes, automatic_knows_restitution_or_says_so)
{
  const std::string half = "Time.Moreau-Jean.Restitution=0.5", soon = "Time.End=0.01";
  expect_choice(falling_masses(), {half, soon},
                "Moreau-Jean (theta 0.5, gaps then velocities, restitution 0.5)", "'floor'");
  expect_choice(falling_masses("Stiffness = 1e9"), {half, soon}, "error:",
                "Time/Moreau-Jean/Restitution: restitution is a law of rigid unilateral links");
  expect_choice(falling_masses("Stiffness = 1"), {half, soon}, "error:", "Stiffness");
  expect_choice(scene_file("bar_on_wall"), {half, soon}, "error:", "'floor'");
  expect_choice(falling_masses(),
                {"Network.Link floor.Type=joint", "Network.Link floor.Gap=0", half, soon},
                "error:", "the scene has none");
  // Entries of a scheme that is not taken need not make one, but say that they are not used.
  const std::string gaps = "Time.Moreau-Jean.Conditions=gaps";
  expect_choice(falling_masses(), {half, gaps, soon},
                "Moreau-Jean (theta 0.5, gaps then velocities, restitution 0.5)", "'floor'");
  for (const Overrides &more : {Overrides{half, soon}, Overrides{half, gaps, soon}})
    EXPECT_TRUE(has(log_of(falling_masses(), Overrides{"Time.Scheme=BDF2"} + more),
                    "not used by it: Time/Moreau-Jean/Restitution = 0.5"));
}

TEST(Schemes, automatic_is_nearer_to_the_wave_equation)
{
  const std::string reduced = "Network.Wire bar.Mass matrix=reduced";
  for (const double elements : {.05, .2, .5, 1., 2.})
  {
    double errors[3];
    const std::string at = ", " + std::to_string(elements) + " elements a step",
                      schemes[] = {"automatic", "BDF2", "backward Euler"};
    for (int i = 0; i < 3; ++i)
      errors[i] = figure("bar on a wall, error of the motion, " + schemes[i] + at,
                         bar_error(elements, {"Time.Scheme=" + schemes[i]}));
    EXPECT_LT(errors[0], .7 * errors[1]) << elements;
    EXPECT_LT(errors[0], .4 * errors[2]) << elements;
  }
  const Overrides exact = {"Time.Scheme=Moreau-Jean", "Time.Moreau-Jean.Conditions=gaps", reduced};
  EXPECT_LT(bar_error(1., {"Time.Scheme=automatic", reduced}), 2e-3);
  EXPECT_LT(bar_error(1., exact), 1e-9) << "by name, where waves cross an element a step";
}

// The mass stays on a rigid floor. On a stiff one it rebounds: two equal masses on a spring of
// 1 rad/s have rates 4 and -4 m/s then, and the lower one is at 4 sin t - 5 t^2. BDF2 lets
// it rebound by more or less as the step is, and generalised-alpha and Newmark let it jump higher
// than it was: a run that ends in an error, which is allowed here.
TEST(Schemes, automatic_leaves_a_mass_on_a_rigid_floor)
{
  const auto rebound =
      [](const std::string &floor, const std::string &scheme, const std::string &step)
  {
    double largest = 0.;
    run_scene(falling_masses(floor),
              {"Time.Scheme=" + scheme, "Time.Step=" + step, "Time.End=0.9",
               "Time.Allow unsuitable scheme=true", "Time.Allow energy gain=true"},
              [&](const taut::StepView &view)
              {
                if (view.state.time > .41)
                  raise(largest, view.state.distance[0]);
              });
    return largest;
  };
  const std::string stiff = "Stiffness = 1e9";
  constexpr double highest_at = .37206; // 4 cos t = 10 t
  const double exact = 4. * std::sin(highest_at) - 5. * highest_at * highest_at;
  double highest = 0.;
  for (const std::string step : {"3.3e-3", "1.1e-3", "3.3e-4"})
  {
    EXPECT_LT(rebound("", "automatic", step), 1e-12) << step;
    const double height = rebound(stiff, "automatic", step);
    highest = std::max(highest, rebound("", "BDF2", step));
    figure("mass on a floor of 1e9 N/m, automatic, rebound, step " + step + " s", 1e3 * height,
           "mm");
    EXPECT_NEAR(height, exact, 2e-3) << step;
  }
  EXPECT_GT(highest, .05);
  for (const std::string scheme : {"generalised-alpha", "Newmark"})
  {
    const double height = rebound(stiff, scheme, "3.3e-4");
    figure("mass on a floor of 1e9 N/m, " + scheme + ", rebound", 1e3 * height, "mm");
    EXPECT_GT(height, .82) << "energy from nothing";
  }
}

TEST(Schemes, a_scheme_by_name_keeps_the_mass_of_its_nodes)
{
  const auto force = [](const Overrides &overrides)
  {
    return largest(history_of(scene_file("bar_on_wall"), overrides,
                              [](const taut::StepView &view) { return view.state.multiplier[0]; }));
  };
  const double by_name = force({"Time.Scheme=BDF2"});
  EXPECT_EQ(by_name, force({"Time.Scheme=BDF2", "Time.Mass redistribution=no"}));
  EXPECT_NE(by_name, force({"Time.Scheme=BDF2", "Time.Mass redistribution=mass"}));
}
