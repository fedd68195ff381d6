// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the static state of railway lines is that of strings under point loads, computed here by
// sums of forces, and stays as it is when nothing moves. Reference values: string copy of the line
// of EN 50318:2002, dropper forces 102.6, 79.5, 86.1, ... N, lengths 0.9856, 0.8041, 0.6473,
// 0.5533, 0.5220 m; a published simple line of 55 m spans, lengths 1.017, 0.896, 0.810, 0.758,
// 0.741 m.
#include "scene_tests.h"

#include "model/scene_constraints.h"
#include <taut/time/motion.h>

using namespace verification;

namespace
{

  /// A line of strings, one inner span; droppers at p, contact wire at -sag below its supports.
  struct StringLine
  {
    double span, contact_tension, messenger_mass;
    std::vector<double> p, sag;
    double dropper_mass = 0., messenger_clamp = 0., contact_clamp = 0.;
    const double encumbrance = 1.2, contact_mass = 1.35, messenger_tension = 16000.;

    /// Tensions of the droppers [N] and their lengths [m] by sums of forces.
    void solve(std::vector<double> &tension, std::vector<double> &length) const
    {
      const std::size_t n = p.size();
      length.assign(n, encumbrance);
      tension.assign(n, 0.);
      for (int iteration = 0; iteration < 50; ++iteration)
      {
        // Each dropper carries half of the contact wire to its neighbours and the kink of its
        // tension; the neighbour across a mast hangs as deep.
        std::vector<double> load(n);
        for (std::size_t i = 0; i < n; ++i)
        {
          const double left = i > 0 ? p[i] - p[i - 1] : p[0] + span - p[n - 1],
                       right = i + 1 < n ? p[i + 1] - p[i] : p[0] + span - p[n - 1],
                       before = i > 0 ? sag[i - 1] : sag[n - 1],
                       after = i + 1 < n ? sag[i + 1] : sag[0];
          const double half = .5 * dropper_mass * length[i] * g;
          tension[i] = contact_mass * g * .5 * (left + right) -
                       contact_tension * ((sag[i] - before) / left - (after - sag[i]) / right) +
                       contact_clamp * g + half;
          load[i] = tension[i] + messenger_clamp * g + half;
        }
        for (std::size_t i = 0; i < n; ++i)
        {
          // Bending moment of a simple beam over the tension.
          const double x = p[i];
          double moment = .5 * messenger_mass * g * x * (span - x);
          for (std::size_t j = 0; j < n; ++j)
            moment += load[j] * std::min(x, p[j]) * (span - std::max(x, p[j])) / span;
          length[i] = encumbrance - moment / messenger_tension + sag[i];
        }
      }
    }
  };

  /// What the program found: forces and lengths of the droppers of one span (counted from 0).
  struct Found
  {
    std::vector<double> force, length, height;
    double residual = 0.;
  };

  Found find(const std::string &file, const std::size_t span, const std::size_t n_droppers,
             const Overrides &more = {})
  {
    Found found;
    run_scene(file,
              Overrides{"Time.Step=1e-3", "Time.End=1e-3", "Time.Scheme=backward Euler",
                        "Statistics.Window="} +
                  more,
              [&](const taut::StepView &view)
              {
                if (view.state.time > 0.)
                  return;
                found.residual = view.residuals.complementarity;
                for (std::size_t i = 0; i < n_droppers; ++i)
                {
                  const std::size_t link = span * n_droppers + i;
                  const taut::Link &dropper = view.scene.links[link];
                  found.force.push_back(
                      view.state.multiplier[view.constraints.index_of_link(link)]);
                  found.length.push_back(dropper.length);
                  found.height.push_back(displacement(view, 1, dropper.to.position));
                }
              });
    return found;
  }

  const StringLine en50318 = {60.,
                              20000.,
                              1.07,
                              {5., 10.5, 17., 23.5, 30., 36.5, 43., 49.5, 55.},
                              std::vector<double>(9, 0.)};

  /// Largest relative change of a contact force, forces smaller than 1 N counting as 1 N.
  double change(const std::vector<double> &from, const std::vector<double> &to)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < from.size(); ++i)
      raise(largest, (to[i] - from[i]) / std::max(1., std::fabs(from[i])));
    return largest;
  }

  /// Largest difference of nine values, over those expected.
  double relative_error(const std::vector<double> &found, const std::vector<double> &expected)
  {
    double largest = 0.;
    for (int i = 0; i < 9; ++i)
      raise(largest, found.at(i) / expected.at(i) - 1.);
    return largest;
  }
} // namespace

TEST(LineOfStrings, forces_and_lengths_are_those_of_sums_of_forces)
{
  std::vector<double> tension, length;
  en50318.solve(tension, length);
  const double printed_force[] = {102.6, 79.5, 86.1, 86.1, 86.1, 86.1, 86.1, 79.5, 102.6},
               printed_length[] = {.9856, .8041, .6473, .5533, .5220, .5533, .6473, .8041, .9856};
  const Found found = find(scene_file("en50318_2002_string"), 4, 9);
  double sum = 0.;
  for (int i = 0; i < 9; ++i)
  {
    if (i < 5)
    {
      figure("line of strings, force of dropper " + std::to_string(i + 1), found.force[i], "N");
      figure("line of strings, length of dropper " + std::to_string(i + 1), found.length[i], "m");
    }
    EXPECT_NEAR(found.force[i], printed_force[i], 1e-3 * printed_force[i]) << "dropper " << i + 1;
    EXPECT_NEAR(found.length[i], printed_length[i], 1e-3 * printed_length[i])
        << "dropper " << i + 1;
    sum += found.force[i];
  }
  EXPECT_LT(figure("line of strings, forces against sums of forces, largest relative difference",
                   relative_error(found.force, tension)),
            1e-9);
  EXPECT_LT(figure("line of strings, lengths against sums of forces, largest relative difference",
                   relative_error(found.length, length)),
            1e-9);
  EXPECT_LT(figure("line of strings, contact wire out of level at the droppers",
                   1e3 * largest(found.height), "mm"),
            1e-7);
  EXPECT_NEAR(sum, 60. * 1.35 * g, 1e-9 * sum);
}

TEST(LineOfStrings, two_spans_at_the_ends_are_mirror_images)
{
  const Found first = find(scene_file("en50318_2002_string"), 0, 9),
              last = find(scene_file("en50318_2002_string"), 9, 9);
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(first.force[i], last.force[8 - i], 1e-9 * first.force[i]);
    EXPECT_NEAR(first.length[i], last.length[8 - i], 1e-9 * first.length[i]);
  }
  // At the anchor the contact wire ends: 5 m instead of 10 m to the next support.
  EXPECT_NEAR(first.force[0], 1.35 * g * .5 * (5. + 5.5), 1e-7);
}

// Bending rounds the kinks of the messenger over sqrt(EI/T): at its support, load R, and at the
// dropper, tension N, it lies (R + N) sqrt(EI/T)/(2 T) above the string: 4.3 mm, 0.43 % to 0.82 %.
// Elements of 0.5 m are longer than these 0.09 m and make it 5.0 mm.
TEST(LineOfBeams, bending_lengthens_the_droppers_by_the_rounding_of_the_kinks)
{
  std::vector<double> tension, length;
  en50318.solve(tension, length);
  double support = 1.07 * g * 60.;
  for (const double N : tension)
    support += N;
  EXPECT_NEAR(support, 1424.4, .05);
  const double T = 16000., rounding = std::sqrt(131.7 / T);
  for (const double h : {.5, .05})
  {
    const std::string size = ", elements of " + std::string(h == .5 ? "0.5 m" : "0.05 m");
    const Found found = find(scene_file("en50318_2002_250"), 4, 9,
                             h == .5 ? Overrides()
                                     : Overrides{"Catenary.Contact wire.Element size=0.05",
                                                 "Catenary.Messenger wire.Element size=0.05"});
    std::vector<double> growths;
    for (int i = 0; i < 9; ++i)
    {
      const double growth = found.length[i] - length[i],
                   exact = (support + tension[i]) * rounding / (2. * T);
      if (i < 5)
      {
        const std::string name = "line of beams, dropper " + std::to_string(i + 1);
        figure(name + ", length minus that with strings" + size, 1e3 * growth, "mm");
        figure(name + ", growth" + size, 100. * growth / length[i], "%");
        if (h != .5)
          figure(name + ", length minus that with strings, rounding of kinks", 1e3 * exact, "mm");
      }
      growths.push_back(growth);
      if (h != .5)
      {
        // The contact wire bends as well, which moves a little of the load to other droppers.
        EXPECT_NEAR(growth, exact, .02 * exact) << i;
        EXPECT_GT(growth / length[i], .004) << i;
        EXPECT_LT(growth / length[i], .0084) << i;
      }
    }
    const auto [least, most] = std::minmax_element(growths.begin(), growths.end());
    EXPECT_GT(*least, .002) << size;
    EXPECT_LT(*most, .006) << size;
  }
}

TEST(Line55m, lengths_and_forces_are_the_published_ones)
{
  const StringLine line = {55.,
                           22000.,
                           1.08,
                           {4.5, 10.25, 16., 21.75, 27.5, 33.25, 39., 44.75, 50.5},
                           {0., .024, .041, .052, .055, .052, .041, .024, 0.},
                           .117,
                           .195,
                           .165};
  std::vector<double> tension, length;
  line.solve(tension, length);
  const double published[] = {1.017, .896, .810, .758, .741},
               strings[] = {1.0166, .8956, .8089, .7587, .7404},
               force[] = {191.1, 51.0, 54.8, 47.2, 54.8};
  const Found found = find(scene_file("line_55m"), 4, 9);
  double height = 0.;
  for (int i = 0; i < 9; ++i)
  {
    raise(height, found.height[i] + line.sag[i]);
    if (i > 4)
      continue;
    // The multiplier carries clamp and half a dropper; the published force the clamp alone.
    const double with_clamp = found.force[i] - .5 * line.dropper_mass * found.length[i] * g;
    const std::string name = "55 m line, dropper " + std::to_string(i + 1);
    figure(name + ", length minus the published one", 1e3 * (found.length[i] - published[i]), "mm");
    figure(name + ", force with half the dropper", found.force[i], "N");
    EXPECT_NEAR(figure(name + ", length", found.length[i], "m"), published[i], 1.5e-3) << name;
    EXPECT_NEAR(found.length[i], strings[i], 1.5e-3) << name;
    EXPECT_NEAR(figure(name + ", force on wire and clamp", with_clamp, "N"), force[i], .06) << name;
  }
  EXPECT_LT(figure("55 m line, forces against sums of forces, largest relative difference",
                   relative_error(found.force, tension)),
            1e-9);
  EXPECT_LT(figure("55 m line, lengths against sums of forces, largest relative difference",
                   relative_error(found.length, length)),
            1e-9);
  EXPECT_LT(figure("55 m line, contact wire away from its prescribed height", 1e3 * height, "mm"),
            1e-7);
}

TEST(Rest, nothing_moves_in_2000_steps_and_a_shorter_step_creates_no_force)
{
  for (const std::string scheme : {"generalised-alpha", "BDF2", "backward Euler", "Newmark"})
  {
    Session session(scene_file("en50318_2002_250"),
                    {"Catenary.Pantograph pantograph.Speed=0", "Time.Scheme=" + scheme,
                     "Time.Step=1e-3", "Time.End=2", "Statistics.Window="});
    std::vector<double> at_start;
    double drift = 0., pantograph = 0., frame = 0.;
    std::unique_ptr<taut::Reference> reference;
    taut::State last;
    session.run(
        [&](const taut::StepView &view)
        {
          if (at_start.empty())
          {
            at_start = view.state.multiplier;
            reference = std::make_unique<taut::Reference>(view.reference);
          }
          drift = std::max(drift, change(at_start, view.state.multiplier));
          // 120 N on the frame, less what the base spring of 50 N/m takes.
          frame = view.reference.displacement[2][1] + view.state.U[2][1];
          raise(pantograph, view.state.multiplier.back() / (120. - 50. * frame) - 1.);
          last = view.state;
        });
    figure("EN 50318 line at rest, " + scheme + ", largest relative change of a force, 2000 steps",
           drift);
    EXPECT_LT(drift, 1e-8) << scheme;
    EXPECT_LT(pantograph, 1e-8) << scheme;
    EXPECT_NEAR(frame, .05, .01);

    taut::Constraints constraints =
        taut::scene_constraints(session.simulation().scene(), session.simulation().structure());
    taut::Structure structure = session.simulation().structure();
    taut::InitialState start;
    start.reference = *reference;
    start.state = last;
    taut::StepperOptions options;
    options.step = 1e-5;
    options.solver = session.parameters().solver;
    taut::Motion stepper(structure, constraints, options, start,
                         {std::shared_ptr<void>(), &session.parameters().integrator(scheme)});
    double step_change = 0.;
    for (int i = 0; i < 300; ++i)
    {
      stepper.advance();
      step_change = std::max(step_change, change(at_start, stepper.state().multiplier));
    }
    figure("EN 50318 line at rest, " + scheme +
               ", largest relative change of a force when the step falls from 1 ms to 10 us",
           step_change);
    EXPECT_LT(step_change, 1e-8) << scheme;
  }
}

// Nothing but contact forces acts on the mass, and they cancel: a certificate that measures their
// error by their sum would be of order 1.
TEST(Rest, mass_held_by_stops_alone)
{
  const auto scene = [](const double k, const bool opposed)
  {
    return "Gravity = 0, " + number(opposed ? 0. : -g) + R"(; Start = equilibrium
Mass mass: Mass = 0.7; Motions = y
Link a: Type = stop; To = mass; Direction = 0, 1; Stiffness = 1013; Gap = -0.013
Link b: Type = stop; To = mass; Gap = -0.017; Direction = )" +
           (opposed ? "0, -1" : "0, 1") + "; Stiffness = " + number(k) + R"(
Link c: Type = stop; To = mass; Direction = 0, 1; Stiffness = 331; Gap = -0.011
Time: Step = 1e-3; End = 0.05
)";
  };
  double worst = 0., change_of_force = 0.;
  for (const bool opposed : {false, true})
    for (const double k : {300., 771., 1233., 1700., 4131.})
    {
      std::vector<double> at_start;
      run_scene(scene(k, opposed), {},
                [&](const taut::StepView &view)
                {
                  if (at_start.empty())
                    at_start = view.state.multiplier;
                  raise(worst, view.residuals.max());
                  raise(change_of_force, change(at_start, view.state.multiplier));
                });
      // The sum of the forces falls with the height u of the mass: halve the interval of its zero.
      const double c = opposed ? -1. : 1., weight = opposed ? 0. : .7 * g;
      const double height = end_of(-1., 1.,
                                   [&](const double u)
                                   {
                                     return 1013. * std::max(0., .013 - u) +
                                                331. * std::max(0., .011 - u) +
                                                c * k * std::max(0., .017 - c * u) >
                                            weight;
                                   });
      EXPECT_NEAR(at_start[0], 1013. * std::max(0., .013 - height), 1e-10);
    }
  figure("mass on stops alone, largest relative change of a force in 50 steps", change_of_force);
  EXPECT_LT(figure("mass on stops alone, largest certificate", worst), 1e-11);
  EXPECT_LT(change_of_force, 1e-10);
}
