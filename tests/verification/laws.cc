// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: links follow their laws: statics to rounding, impacts with the order of the scheme and
// without a gain of energy, with every form of the interface operator and any cuts. Sources: a law
// whose points lie on a straight line is the stiffness; closed forms of two slopes and of a cubic
// spring; forces and energies of random laws, evaluated here.
#include "scene_tests.h"

#include <taut/base/force_law.h>

using namespace verification;

namespace
{
  /// A mass of 2 kg that meets a stop at x = 0 with 3 m/s, after half a millisecond.
  std::string thrown_mass(const std::string &law)
  {
    return R"(Gravity = 0, 0; Start = given
Mass mass: Position = 0, 0; Mass = 2; Motions = y; Initial displacement = 0, 0.0015, 0;
  Initial velocity = 0, -3, 0
Link stop: Type = stop; From = ground; To = mass; Direction = 0, 1; )" +
           law + R"(
Time: Step = 1e-4; End = 0.1
)";
  }
  constexpr double mass = 2., speed = 3., start = .0015;

  const char *const two_slopes = "Law = table; Law points = 0.01: 200, 0.02: 1200";
  const char *const cubic = "Law = formula; Law formula = 1e6*d^3; Law range = 0.2";

  /// Time in contact: a quarter of a vibration by each slope, once in and once out.
  double contact_of_two_slopes()
  {
    const double k1 = 2e4, k2 = 1e5, u1 = .01, w1 = std::sqrt(k1 / mass), w2 = std::sqrt(k2 / mass),
                 v1 = std::sqrt(speed * speed - k1 * u1 * u1 / mass),
                 t1 = std::asin(w1 * u1 / speed) / w1;
    // m u'' = -k2 (u - u1) - k1 u1: about the point where that force is 0.
    const double below = k1 * u1 / k2, t2 = (.5 * std::acos(-1.) - std::atan(w2 * below / v1)) / w2;
    return 2. * (t1 + t2);
  }

  /// Of a link [J].
  double spring_energy(const taut::StepView &view, const std::size_t i)
  {
    return view.constraints[i].spring.energy(view.state.springs[i].u);
  }

  struct Flight
  {
    double contact = 0., lost = 0., gained = 0.;
  };

  /// Time in contact, by where the mass is at the end, and what it lost of its energy.
  Flight fly(const std::string &law, const std::string &scheme, const double step)
  {
    Flight result;
    const double all = .5 * mass * speed * speed;
    double last = all;
    run_scene(thrown_mass(law), {"Time.Scheme=" + scheme, "Time.Step=" + number(step)},
              [&](const taut::StepView &view)
              {
                const double v = view.state.V[0][0],
                             energy = .5 * mass * v * v + spring_energy(view, 0);
                result.gained = std::max(result.gained, (energy - last) / all);
                last = energy;
                result.contact = view.state.time - start / speed - (view.state.U[0][0]) / speed;
              });
    result.lost = 1. - last / all;
    return result;
  }

  /// Masses in a row on springs, each with one or two links to the ground whose laws have slopes of
  /// all sizes in any order.
  std::string random_row(std::mt19937 &random, const int n)
  {
    const auto uniform = [&](const double a, const double b)
    { return std::uniform_real_distribution<double>(a, b)(random); };
    std::ostringstream parts;
    parts << "Start = equilibrium\nTime: Step = 1e-3; End = 0\n";
    for (int i = 0; i < n; ++i)
    {
      parts << "Mass m" << i << ": Position = " << i
            << ", 0; Mass = " << std::pow(10., uniform(0., 3.)) << "; Motions = y\n";
      if (i > 0)
        parts << "Spring s" << i << ": From = m" << i - 1 << "; To = m" << i
              << "; Stiffness = " << std::pow(10., uniform(2., 5.)) << "\n";
      for (const char l : {'a', 'b'})
      {
        parts << "Link l" << i << l << ": Type = stop; From = ground; To = m" << i
              << "; Direction = 0, 1; Gap = " << (l == 'b' ? uniform(0., .2) : 0.)
              << "; Law = table; Law points = ";
        double u = 0., f = 0.;
        const int points = std::uniform_int_distribution<int>(1, 6)(random);
        for (int p = 0; p < points; ++p)
        {
          const double du = std::pow(10., uniform(-4., -1.));
          u += du;
          f += du * std::pow(10., uniform(1., 6.));
          parts << (p ? ", " : "") << number(u) << ": " << number(f);
        }
        parts << "\n";
      }
    }
    return parts.str();
  }

  /// The largest of what forces lack of their laws and of equilibrium of the whole, over the
  /// weight.
  double largest_lack(const taut::StepView &view)
  {
    double weight = 0., held = 0., lack = 0.;
    for (const taut::Mass &m : view.scene.masses)
      weight += 9.81 * m.mass;
    const std::vector<double> &at_rest = view.reference.multiplier,
                              &forces = at_rest.empty() ? view.state.multiplier : at_rest;
    for (std::size_t i = 0; i < view.constraints.size(); ++i)
    {
      const double N = forces[i], g = view.state.distance[i];
      held += N;
      raise(lack, N - (g < 0. ? view.constraints[i].spring.law->force(-g) : 0.));
    }
    raise(lack, held - weight);
    return lack / weight;
  }

  /// prm/hanging_cable.prm, whose middle is held by a dropper, in a motion of a tenth of a second.
  struct HeldCable
  {
    double force = 0., elongation = 0.;
    std::vector<double> motion;
  };

  /// The dropper has this law or stiffness.
  HeldCable hold(const Overrides &spring)
  {
    Overrides entries = {"Network/Links=dropper", "Network/Load weight/Magnitude=100+40*sin(50*t)",
                         "Time/Step=2e-3", "Time/End=0.1"};
    for (const std::string &entry :
         spring + Overrides{"Type=dropper", "From=ground", "To=cable @ 39, 0", "Direction=0, -1",
                            "Gap=0.4"})
      entries.push_back("Network/Link dropper/" + entry);
    HeldCable result;
    run_scene(
        scene_file("hanging_cable"), entries,
        [&](const taut::StepView &view)
        {
          if (result.motion.empty())
          {
            result.force = view.state.multiplier[0];
            result.elongation = -view.state.distance[0];
            EXPECT_LT(view.residuals.complementarity, 1e-11);
          }
          result.motion.insert(result.motion.end(), {view.probes[0], view.state.multiplier[0]});
        });
    return result;
  }
} // namespace

TEST(Laws, a_table_is_a_chain_of_straight_lines)
{
  const taut::TableLaw law({{.01, 100.}, {.03, 200.}, {.04, 600.}});
  EXPECT_DOUBLE_EQ(law.force(.005), 50.);
  EXPECT_DOUBLE_EQ(law.force(.02), 150.);
  EXPECT_DOUBLE_EQ(law.force(-.02), -150.);
  EXPECT_DOUBLE_EQ(law.force(.05), 1000.);
  EXPECT_DOUBLE_EQ(law.energy(.04), .5 + 3. + 4.);
  EXPECT_DOUBLE_EQ(law.energy(-.04), law.energy(.04));
  EXPECT_NEAR(law.mean_force(.01, .04), 7. / .03, 1e-12);
  EXPECT_NEAR(law.mean_force(.04, .01), 7. / .03, 1e-12);
  EXPECT_NEAR(law.mean_force(-.01, .04), 7. / .05, 1e-12);
  EXPECT_NEAR(law.mean_force(.02, .02 + 1e-12), 150., 1e-8);
  EXPECT_DOUBLE_EQ(law.largest_stiffness(), 4e4);
  for (const double N : {1e-9, 50., 100., 150., 599., 1e6})
    EXPECT_NEAR(law.force(law.elongation(N)), N, 1e-14 * N);
  EXPECT_THROW(taut::TableLaw({{.01, 100.}, {.02, 100.}}), std::invalid_argument);
}

TEST(Laws, points_on_a_line_are_the_stiffness)
{
  for (const std::string law : {"Law = table; Law points = 0.01: 72, 0.03: 216",
                                "Law = formula; Law formula = 7200*d; Law range = 0.1"})
    for (const std::string scheme :
         {"Moreau-Jean", "automatic", "Newmark", "BDF2", "generalised-alpha", "backward Euler"})
      for (const std::string damping : {"0", "5"})
      {
        const bool automatic = scheme == "automatic";
        const auto run = [&](const std::string &spring)
        {
          std::pair<std::vector<double>, std::vector<double>> forces_and_motions;
          run_scene(thrown_mass(spring + "; Damping = " + damping),
                    {"Time.Scheme=" + (automatic ? "Moreau-Jean" : scheme),
                     "Time.Allow unsuitable scheme=true", "Time.Step=1e-3",
                     std::string("Time.Moreau-Jean.Conditions=") +
                         (automatic ? "gaps then velocities" : "gaps")},
                    [&](const taut::StepView &view)
                    {
                      forces_and_motions.first.push_back(view.state.multiplier[0]);
                      forces_and_motions.second.push_back(view.state.U[0][0]);
                    });
          return forces_and_motions;
        };
        SCOPED_TRACE(scheme + ", damping " + damping + law);
        const auto [forces, motions] = run("Stiffness = 7200");
        const auto [same_forces, same_motions] = run(law);
        EXPECT_LT(largest_difference(forces, same_forces), 1e-11 * largest(forces));
        EXPECT_LT(largest_difference(motions, same_motions), 1e-11 * .1);
      }
}

TEST(Laws, impacts_have_the_order_of_the_scheme)
{
  // m v^2/2 = k u^4/4, and the integral of 1 / sqrt(1 - x^4) from 0 to 1.
  const double of_cubic =
      2. * std::pow(2. * mass * speed * speed / 1e6, .25) / speed * 1.3110287771460599;
  const std::map<std::string, double> contacts = {{cubic, of_cubic},
                                                  {two_slopes, contact_of_two_slopes()}};
  for (const auto &[law, contact] : contacts)
    for (const std::string scheme :
         {"automatic", "Newmark", "BDF2", "generalised-alpha", "backward Euler"})
    {
      const double order = scheme == "backward Euler" ? 1. : 2.;
      std::vector<double> steps, errors;
      for (int i = 0; i < 5; ++i)
      {
        // Where in a step the contacts begin and end changes the error: its mean counts.
        double sum = 0.;
        steps.push_back((order == 1. ? 1e-4 : 4e-4) / (1 << i));
        for (const double part : {1., .97, .94, .91})
          sum += std::fabs(fly(law, scheme, part * steps.back()).contact - contact);
        errors.push_back(.25 * sum);
      }
      const double fitted = fitted_order(steps, errors);
      const std::string what = std::string(law == cubic ? "cubic" : "two slopes") + ", " + scheme;
      figure("law, " + what + ", error of the time in contact at the smallest step",
             errors.back() / contact);
      // At a kink of the force the error of a step depends on where in the step it is.
      EXPECT_GT(fitted, order - .15) << what;
      EXPECT_LT(figure("law, " + what + ", order", fitted), order + .5) << what;
      EXPECT_LT(errors.back() / contact, order == 1. ? 2e-2 : 2e-4) << what;
    }
}

TEST(Laws, mean_forces_give_no_energy)
{
  for (const char *const law : {cubic, two_slopes})
    for (const double step : {1e-4, 1e-3, 3e-3, 1e-2})
    {
      const Flight flight = fly(law, "automatic", step);
      EXPECT_LT(flight.gained, 1e-13) << law << step;
      EXPECT_GE(flight.lost, -1e-13) << law << step;
      if (step > 1e-4)
        continue;
      figure(std::string("law, ") + (law == cubic ? "cubic" : "two slopes") + ", energy lost",
             flight.lost);
      EXPECT_LT(flight.lost, 1e-4); // when it touches and leaves within a step
    }
}

// A mass between two stops, where forces at both ends of a step do not do the work of the law: the
// largest rise of the energy, over that of the start.
TEST(Laws, what_forces_at_the_ends_of_steps_gain_is_measured)
{
  const std::string stops = std::string(cubic) +
                            "\nLink above: Type = stop; From = mass; "
                            "To = ground; Direction = 0, 1; Gap = 0.02; " +
                            cubic;
  const auto largest_gain = [&](const std::string &scheme, const double step)
  {
    const double all = .5 * mass * speed * speed;
    double largest = 0., least = all;
    run_scene(thrown_mass(stops),
              {"Time.Scheme=" + scheme, "Time.Step=" + number(step), "Time.End=10",
               "Time.Allow unsuitable scheme=true", "Time.Allow energy gain=true"},
              [&](const taut::StepView &view)
              {
                const double v = view.state.V[0][0], energy = .5 * mass * v * v +
                                                              spring_energy(view, 0) +
                                                              spring_energy(view, 1);
                least = std::min(least, energy);
                largest = std::max(largest, (energy - least) / all);
              });
    return largest;
  };
  for (const double step : {5e-3, 1e-3})
  {
    const double automatic = largest_gain("automatic", step),
                 newmark = largest_gain("Newmark", step);
    figure("law, energy gained in 10 s by mean forces, step " + number(step), automatic);
    figure("law, energy gained in 10 s by Newmark, step " + number(step), newmark);
    figure("law, energy gained in 10 s by generalised-alpha, step " + number(step),
           largest_gain("generalised-alpha", step));
    EXPECT_LT(automatic, 1e-12);
    EXPECT_GT(newmark, 1e3 * std::max(automatic, 1e-12));
  }
}

TEST(Laws, energy_of_a_law_is_in_the_balance)
{
  for (const std::string scheme : {"automatic", "Newmark", "generalised-alpha", "BDF2"})
  {
    Session session(thrown_mass(std::string(two_slopes) + "; Damping = 20"),
                    {"Time.Scheme=" + scheme, "Time.Step=1e-3", "Output.Observers=energy",
                     "Output.Interval=1e-3"});
    session.run();
    const std::vector<double> errors = read_table(session.folder() + "/energy.csv").at("error [J]");
    EXPECT_LT(largest(errors), 1e-12) << scheme;
    EXPECT_GT(errors.size(), 1u);
  }
}

TEST(Laws, two_slopes_at_rest)
{
  // 1200 N on a dropper of 1000 N at 10 mm and 20 N/mm beyond, and on half as much before it.
  const char *const scene =
      R"(Gravity = 0, -10; Start = equilibrium
Mass heavy: Position = 0, 0; Mass = 120; Motions = y
Mass light: Position = 1, 0; Mass = 60; Motions = y
Link one: Type = dropper; From = ground; To = heavy; Direction = 0, -1; Gap = 0.005;
  Law = table; Law points = 0.01: 1000, 0.03: 1400
Link two: Type = dropper; From = ground; To = light; Direction = 0, -1; Law = table;
  Law points = 0: 0, 0.01: 1000, 0.03: 1400
Time: Step = 1e-3; End = 0.01
)";
  run_scene(scene, {},
            [](const taut::StepView &view)
            {
              EXPECT_NEAR(view.reference.displacement[0][0], -.025, 1e-15);
              EXPECT_NEAR(view.reference.displacement[1][0], -.006, 1e-15);
              EXPECT_NEAR(view.state.multiplier[0], 1200., 1e-10);
              EXPECT_NEAR(view.state.multiplier[1], 600., 1e-10);
              EXPECT_NEAR(view.state.U[0][0], 0., 1e-15);
            });
}

TEST(Laws, rows_of_any_laws_are_at_rest)
{
  std::mt19937 random(1);
  double largest = 0., residual = 0.;
  for (int i = 0; i < 100; ++i)
    run_scene(
        random_row(random, 2 + i % 7),
        {"Solver.Interface operator=" +
         std::vector<std::string>{"assembled dense", "assembled sparse", "matrix-free"}[i % 3]},
        [&](const taut::StepView &view)
        {
          raise(largest, largest_lack(view));
          raise(residual, view.residuals.complementarity);
        });
  figure("law, 100 random rows at rest, largest lack of force over the weight", largest);
  EXPECT_LT(largest, 1e-9);
  EXPECT_LT(figure("law, 100 random rows at rest, largest residual", residual), 1e-11);
}

TEST(Laws, cuts_and_forms_do_not_matter)
{
  const auto forces =
      [](const std::string &scheme, const std::string &form, const std::string &parts)
  {
    std::vector<double> all;
    run_scene(beam_under_laws,
              {"Time.Scheme=" + scheme, "Time.Allow unsuitable scheme=true",
               "Solver.Interface operator=" + form, "Partition.Number of substructures=" + parts},
              [&](const taut::StepView &view)
              {
                for (std::size_t link = 0; link < 11; ++link)
                  all.push_back(view.state.multiplier[view.constraints.index_of_link(link)]);
              });
    return all;
  };
  for (const std::string scheme : {"automatic", "generalised-alpha"})
  {
    const std::vector<double> whole = forces(scheme, "assembled dense", "automatic");
    double largest = 0.;
    for (const std::string form : {"assembled dense", "assembled sparse", "matrix-free"})
      for (const std::string parts : {"1", "3"})
        raise(largest, largest_difference(whole, forces(scheme, form, parts)) /
                           verification::largest(whole));
    figure("law, forms and cuts, " + scheme + ", largest difference of forces", largest);
    EXPECT_LT(largest, 1e-7) << scheme;
  }
}

// Rows that a wave has not reached have gaps and forces of rounding alone, beside rows with all the
// load: droppers with little damping, and with a law, above a joint that carries the whole.
TEST(Laws, rows_that_no_wave_has_reached_do_not_matter)
{
  const auto wire = [](const std::string &name, const std::string &y, const std::string &more)
  {
    return "Wire " + name + ": From = 0, " + y + "; To = 20, " + y + "; Mass per length = 1; " +
           more + "\nSupport of " + name + ": Wire = " + name + "; Positions = 0, 20\n";
  };
  const std::string
      string = "Components = string; Tension = 1000; Element size = .5",
      start = "Gravity = 0, 0\n", damped = "Stiffness = 1e5; Damping = 1",
      table = "Law = table; Law points = 0.001: 10, 0.01: 500",
      beam = "Components = beam; Tension = 1e4; Bending stiffness = 50; Element size = 1",
      tight = "Components = string; Tension = 1e4; Element size = .25",
      stop = "Link stop: Type = stop; From = ground; To = lower @ 1:1:19; Direction ="
             " 0, 1; ";
  const std::string scenes[] = {
      start + "Start = equilibrium\n" + wire("upper", "2", string) + wire("lower", "1", string) +
          "Link dropper: Type = dropper; From = upper @ 1:2:19; To = lower @ 1:2:19; Direction = "
          "0, "
          "-1; " +
          damped + "\n" + stop + "Gap = .05; " + damped +
          "\nLoad pull: On = upper @ 6; Direction = 0, 1; Magnitude = 150*sin(60*t)\n"
          "Time: Step = 1e-3; End = .05\n",
      start + "Start = undeformed\n" + wire("upper", "3", beam) + wire("middle", "2", tight) +
          wire("lower", "1", tight) +
          "Link joint: Type = joint; From = upper @ 1:5:19; To = middle @ 1:5:19; Direction = 0, "
          "-1\nLink dropper: Type = dropper; From = middle @ 1:1:19; To = lower @ 1:1:19; "
          "Direction "
          "= 0, -1; " +
          table + "\n" + stop + "Gap = .01; Stiffness = 1000; Damping = 100" +
          "\nLoad pull: On = upper @ 6; Direction = 0, 1; Magnitude = -200\n"
          "Time: Step = 5e-3; End = .15\n"};
  for (const std::string &scene : scenes)
  {
    const auto forces = [&](const std::string &solver)
    {
      std::vector<double> all;
      run_scene(scene, {"Solver.Interface operator=assembled dense", "Solver." + solver},
                [&](const taut::StepView &view) {
                  all.insert(all.end(), view.state.multiplier.begin(), view.state.multiplier.end());
                });
      return all;
    };
    const std::vector<double> first = forces("Complementarity=semismooth Newton"),
                              second = forces("Complementarity=energy-ordered"),
                              third = forces("Interface operator=matrix-free");
    EXPECT_GT(largest(first), 10.);
    EXPECT_LT(figure("law, waves, largest difference of forces, energy-ordered",
                     largest_difference(first, second) / largest(first)),
              1e-6);
    EXPECT_LT(figure("law, waves, largest difference of forces, matrix-free",
                     largest_difference(first, third) / largest(first)),
              1e-6);
  }
}

TEST(Laws, large_motions)
{
  const HeldCable softening = hold({"Law=table", "Law points=0.05: 40, 1: 90"});
  const taut::TableLaw law({{.05, 40.}, {1., 90.}});
  EXPECT_GT(softening.elongation, .06);
  EXPECT_NEAR(softening.force, law.force(softening.elongation), 1e-10);
  // At rest, the spring whose stiffness is that of the chord does the same.
  const HeldCable chord = hold({"Stiffness=" + number(softening.force / softening.elongation)});
  figure("law, cable at rest, force of the chord's stiffness over that of the law, less one",
         chord.force / softening.force - 1.);
  EXPECT_NEAR(chord.force, softening.force, 1e-9 * softening.force);

  const HeldCable table = hold({"Law=table", "Law points=0.05: 40"}),
                  linear = hold({"Stiffness=800"});
  const double difference = largest_difference(table.motion, linear.motion),
               size = largest(linear.motion);
  EXPECT_LT(figure("law, moving cable, a table on a line against the stiffness", difference / size),
            1e-8);
}

// A spring with a damper comes back without a load on it, exponentially, and is there at
// last: numbers without all of their digits would take the search for its forces 1e5 evaluations.
TEST(Laws, a_spring_that_comes_back_is_back_at_last)
{
  double last = 1.;
  run_scene("Gravity = 0, 0; Start = given\n"
            "Mass m: Motions = y; Mass = 0.0663; Initial velocity = 0, -6.86e-4, 0\n"
            "Spring s: To = m; Stiffness = 4.21e-4; Damping = 8.89e-3\n"
            "Link floor: Type = stop; From = ground; To = m; Direction = 0, 1; Gap = 4.33e-4;\n"
            "  Law = formula; Law formula = 0.346*d + 20200000*d^3; Law range = 1.31e-3;\n"
            "  Damping = 2.45e-3\nTime: Step = 3.234e-3; End = 12; Check steps = no\n",
            {}, [&](const taut::StepView &view) { last = view.state.springs[0].u; });
  EXPECT_EQ(last, 0.);
}

TEST(Laws, bump_stop)
{
  double deepest = 0., largest_force = 0., largest_gain = 0., before = 0., t_before = 0.;
  std::vector<double> rises;
  run_scene(scene_file("bump_stop"), {},
            [&](const taut::StepView &view)
            {
              const double y = view.state.U[0][0], t = view.state.time, v = view.state.V[0][0];
              deepest = std::min(deepest, y);
              largest_force = std::max(largest_force, view.state.multiplier[0]);
              const double energy = 150. * v * v + 7500. * y * y + spring_energy(view, 0);
              largest_gain = std::max(largest_gain, energy / 337.5 - 1.);
              if (before < 0. && y >= 0.)
                rises.push_back(t_before + (t - t_before) * before / (before - y));
              before = y;
              t_before = t;
            });
  ASSERT_EQ(rises.size(), 3u);
  const double period = .5 * (rises[2] - rises[0]);
  figure("bump stop, largest compression of the spring", -1e3 * deepest, "mm");
  EXPECT_NEAR(-deepest, .149971, 1e-5);
  EXPECT_NEAR(figure("bump stop, largest force", largest_force, "N"), 8251.04, 4.);
  EXPECT_NEAR(figure("bump stop, period", period, "s"), .704983, 2e-5);
  EXPECT_LT(figure("bump stop, energy gained", largest_gain), 1e-12);
}
