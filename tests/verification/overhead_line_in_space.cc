// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the generator 'catenary' makes lines in space: without stagger and wind they are those of
// the plane; at rest they are taut strings with ropes between them, also in wind. Sources: the
// scene in the plane; closed forms of a string and of a tensioned beam; the nonlinear equilibrium
// of strings and ropes that may turn, found here by Newton's method.
#include "scene_tests.h"

#include "output/reactions.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace verification;

namespace
{
  const taut::Coordinates up = {0., 1.}, aside = {0., 0., 1.};

  /// Force of a support that is named [N].
  double support_force(const taut::StepView &step, const std::string &name)
  {
    const auto points = taut::support_points(step.scene);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].name == name)
        return step.supports.at(i);
    ADD_FAILURE() << "no support is called '" << name << "'";
    return 0.;
  }

  /// Ropes of an inner span of the line of strings.
  struct Ropes
  {
    static constexpr std::size_t n = 9;
    using Place = std::array<double, 2>; // y, z
    std::array<double, n> rope = {}, tension = {};
    std::array<Place, n> place[2] = {}; ///< of the ends of the ropes on both wires
  };

  /// The wires of the span as strings, under ropes of given unstressed lengths that turn freely.
  struct Span : Ropes
  {
    const double length = 60., encumbrance = 1.2, stiffness = 1e5;
    const double T[2] = {16000., 20000.}, m[2] = {1.07, 1.35}; // messenger, contact wire
    const std::array<double, n> p = {5., 10.5, 17., 23.5, 30., 36.5, 43., 49.5, 55.};
    double stagger = 0., wind[2] = {0., 0.};

    Place end(const int wire, const std::size_t mast) const
    {
      return wire == 0 ? Place{encumbrance, 0.} : Place{0., mast == 0 ? stagger : -stagger};
    }

    double gap(const std::size_t i) const // from the rope at i - 1, or the mast
    {
      return i == 0 ? p[0] : i == n ? length - p[n - 1] : p[i] - p[i - 1];
    }

    /// Newton's method for the balance of all ends of ropes, from a shape near it.
    void solve()
    {
      for (int wire : {0, 1})
        for (std::size_t i = 0; i < n; ++i)
        {
          const double part = p[i] / length;
          place[wire][i] = {wire == 0 ? encumbrance - 2. * part * (1. - part) : 0.,
                            (1. - part) * end(wire, 0)[1] + part * end(wire, 1)[1]};
        }
      for (int iteration = 0; iteration < 50; ++iteration)
      {
        dealii::FullMatrix<double> K(4 * n);
        dealii::Vector<double> force(4 * n), change(4 * n);
        for (std::size_t wire : {0, 1})
          for (int k : {0, 1})
            for (std::size_t i = 0; i <= n; ++i) // between two ropes, or a mast and a rope
            {
              const std::size_t before = 2 * (n * wire + i - 1) + k, behind = before + 2;
              const double l = gap(i), load = l / 2. * (k == 0 ? -m[wire] * g : wind[wire]);
              // No arm holds the height of the contact wire: at a mast it is level by symmetry.
              const bool is_level = wire == 1 && k == 0 && i % n == 0;
              const double t = is_level ? 0. : T[wire] / l,
                           pull = t * ((i == n ? end(wire, 1) : place[wire][i])[k] -
                                       (i == 0 ? end(wire, 0) : place[wire][i - 1])[k]);
              if (i > 0)
              {
                force[before] += pull + load + (is_level ? load : 0.);
                K(before, before) += t;
              }
              if (i < n)
              {
                force[behind] += load - pull + (is_level ? load : 0.);
                K(behind, behind) += t;
              }
              if (i > 0 && i < n)
              {
                K(before, behind) -= t;
                K(behind, before) -= t;
              }
            }
        for (std::size_t i = 0; i < n; ++i)
        {
          const Place d = {place[1][i][0] - place[0][i][0], place[1][i][1] - place[0][i][1]};
          const double length_now = std::hypot(d[0], d[1]);
          tension[i] = stiffness * std::max(length_now - rope[i], 0.);
          const double active = tension[i] > 0. ? stiffness : 0.;
          for (int k : {0, 1})
          {
            force[2 * i + k] += tension[i] * d[k] / length_now;
            force[2 * (n + i) + k] -= tension[i] * d[k] / length_now;
            for (int j : {0, 1})
            {
              const double nn = d[k] * d[j] / (length_now * length_now);
              const double stiff =
                  active * nn + tension[i] / length_now * ((k == j ? 1. : 0.) - nn);
              K(2 * i + k, 2 * i + j) += stiff;
              K(2 * (n + i) + k, 2 * (n + i) + j) += stiff;
              K(2 * i + k, 2 * (n + i) + j) -= stiff;
              K(2 * (n + i) + k, 2 * i + j) -= stiff;
            }
          }
        }
        K.gauss_jordan();
        K.vmult(change, force);
        for (int wire : {0, 1})
          for (std::size_t i = 0; i < n; ++i)
            for (int k : {0, 1})
              place[wire][i][k] += change[2 * (n * wire + i) + k];
        if (change.linfty_norm() < 1e-14)
          return;
      }
      ADD_FAILURE() << "the reference does not converge";
    }
  };

  /// The span from the fourth mast to the fifth of the line of strings.
  struct Found : Ropes
  {
    double arm = 0., arm_by_kink = 0.;
  };

  Found find(const Overrides &overrides, const double wind = 0.)
  {
    Found found;
    const Span span;
    run_scene(scene_file("en50318_2002_string"), overrides,
              [&](const taut::StepView &step)
              {
                for (std::size_t i = 0; i < Span::n; ++i)
                {
                  const std::size_t link = 4 * Span::n + i;
                  const double N = step.state.multiplier[step.constraints.index_of_link(link)],
                               x = 240. + span.p[i];
                  found.rope[i] = step.scene.links[link].length - N / span.stiffness;
                  found.tension[i] = N;
                  for (const std::size_t wire : {0, 1})
                    found.place[wire][i] = {(wire == 0 ? span.encumbrance : 0.) +
                                                displacement(step, wire, x, up),
                                            displacement(step, wire, x, aside)};
                }
                const auto z = [&](const double x) { return displacement(step, 1, x, aside); };
                found.arm = support_force(step, "steady arm at mast 4");
                found.arm_by_kink = 20000. * (2. * z(240.) - z(235.) - z(245.)) / 5. - 5. * wind;
              });
    return found;
  }

  /// Largest difference of places [m], and of tensions over the largest.
  std::array<double, 2> difference(const Found &found, const Span &span)
  {
    std::array<double, 2> result = {0., 0.};
    const double size = *std::max_element(span.tension.begin(), span.tension.end());
    for (std::size_t i = 0; i < Span::n; ++i)
    {
      for (const int wire : {0, 1})
        for (const int k : {0, 1})
          raise(result[0], found.place[wire][i][k] - span.place[wire][i][k]);
      result[1] = std::max(result[1], std::fabs(found.tension[i] - span.tension[i]) / size);
    }
    return result;
  }

  const std::string stagger = "Catenary.Contact wire.Stagger=0.2",
                    contact_wind = "Catenary.Contact wire.Wind=",
                    messenger_wind = "Catenary.Messenger wire.Wind=";

  /// Multipliers of the links, and motions of the probes, in all steps of the line of EN 50318.
  std::array<std::vector<double>, 2> motions(const Overrides &overrides)
  {
    std::array<std::vector<double>, 2> result;
    run_scene(scene_file("en50318_2002_250"), overrides,
              [&](const taut::StepView &step)
              {
                ASSERT_EQ(step.scene.links.size(), 91u);
                ASSERT_EQ(step.probes.size(), 3u);
                for (std::size_t i = 0; i < 91; ++i)
                  result[0].push_back(step.state.multiplier[step.constraints.index_of_link(i)]);
                result[1].insert(result[1].end(), step.probes.begin(), step.probes.end());
              });
    return result;
  }
} // namespace

TEST(OverheadLineInSpace, without_stagger_and_wind_moves_as_in_the_plane)
{
  const Overrides shorter = {"Time.End=1.2",
                             "Statistics.Window=", "Catenary.Uplift positions=80, 100, 120"};
  const auto plane = motions(shorter),
             space = motions(shorter + Overrides{"Catenary.Lateral component=true"});
  for (const int i : {0, 1})
    EXPECT_LT(
        figure(i == 0
                   ? "line with lateral motion but no stagger against the plane, forces, relative"
                   : "its uplift at three masts, relative",
               largest_difference(plane[i], space[i]) / largest(plane[i])),
        1e-10);
}

TEST(OverheadLineInSpace, droppers_and_stagger_at_rest_are_those_of_ropes_that_turn)
{
  const Found found = find({stagger});
  Span span;
  span.stagger = .2;
  span.rope = found.rope;
  span.solve();
  const auto [place, tension] = difference(found, span);
  for (const auto &at : span.place[1])
    EXPECT_NEAR(at[0], 0., 1e-9); // as prescribed
  EXPECT_LT(place, 1e-9);
  EXPECT_LT(tension, 1e-9);
  EXPECT_NEAR(found.arm, found.arm_by_kink, 1e-7);
  // The droppers pull the contact wire off the straight line from arm to arm.
  EXPECT_GT(std::fabs(span.place[1][0][1] - .2 * (1. - 2. * 5. / 60.)), 1e-3);
  figure("inclined droppers at rest against ropes that turn", place, "m");
  figure("their tensions, relative", tension);
  figure("force of a steady arm", found.arm, "N");
}

namespace
{
  /// The entry Lengths of all spans.
  std::string list_of(const std::array<double, Span::n> &lengths)
  {
    std::string list = "Catenary/Droppers/Lengths=";
    for (std::size_t i = 0; i < lengths.size(); ++i)
      list += (i > 0 ? ", " : "") + number(lengths[i]);
    return list;
  }
} // namespace

TEST(OverheadLineInSpace, given_lengths_hang_as_ropes_that_turn)
{
  // Longer and shorter ropes than those that hold the wire level, one of them nearly slack.
  const Found level = find({stagger});
  Span span;
  span.stagger = .2;
  span.rope = level.rope;
  span.rope[2] += .004;
  span.rope[4] += .03;
  span.rope[6] -= .002;
  const Found found = find({stagger, list_of(span.rope)});
  span.solve();
  const auto [place, tension] = difference(found, span);
  EXPECT_LT(span.tension[4], 10.);
  EXPECT_GT(std::fabs(span.tension[6] - level.tension[6]), 5.);
  EXPECT_LT(figure("given lengths with stagger against ropes that turn", place, "m"), 1e-6);
  EXPECT_LT(figure("their tensions, relative", tension), 2e-5);
}

TEST(OverheadLineInSpace, given_lengths_in_wind_are_those_that_were_found)
{
  const Overrides windy = {stagger, contact_wind + "3", messenger_wind + "3"};
  const Found found = find(windy, 3.),
              given = find(windy + Overrides{list_of(find({stagger}).rope)}, 3.);
  for (std::size_t i = 0; i < Span::n; ++i)
  {
    EXPECT_NEAR(given.tension[i], found.tension[i], 1e-6 * found.tension[i]) << i;
    EXPECT_NEAR(given.place[1][i][1], found.place[1][i][1], 1e-8) << i;
  }
}

TEST(OverheadLineInSpace, wind_turns_the_droppers_as_ropes_but_for_the_square_of_the_angle)
{
  const Found still = find({stagger});
  std::vector<double> errors;
  for (const double w : {1.5, 3.})
  {
    const Found found =
        find({stagger, contact_wind + std::to_string(w), messenger_wind + std::to_string(w)}, w);
    Span span;
    span.stagger = .2;
    span.wind[0] = span.wind[1] = w;
    span.rope = still.rope;
    span.solve();
    const auto [place, tension] = difference(found, span);
    errors.push_back(place);
    EXPECT_NEAR(found.arm, found.arm_by_kink, 1e-7);
    const double blown = span.place[1][4][1]; // middle of the span: 0 in still air
    EXPECT_NEAR(found.place[1][4][1], blown, 1e-3 * blown);
    figure("blow-off of the line in the middle of a span", found.place[1][4][1], "m");
    figure("against ropes that turn, height and side", place, "m");
    figure("tensions, relative", tension);
  }
  EXPECT_LT(errors[1], 2e-3);
  EXPECT_LT(errors[0], .35 * errors[1]); // of second order
}

TEST(OverheadLineInSpace, a_wire_alone_is_blown_off_by_the_parabola)
{
  const double L = 60., T = 20000., w = 3.;
  run_scene(scene_file("en50318_2002_string"),
            {stagger, contact_wind + "3", "Catenary.Droppers.Positions="},
            [&](const taut::StepView &step)
            {
              const double middle = displacement(step, 1, 270., aside);
              EXPECT_NEAR(middle, w * L * L / (8. * T), 1e-10);
              // Against the wind at masts with the wire on its side, with it at the others.
              const double pull = 4. * .2 * T / L;
              EXPECT_NEAR(support_force(step, "steady arm at mast 4"), pull - w * L, 1e-7);
              EXPECT_NEAR(support_force(step, "steady arm at mast 5"), -pull - w * L, 1e-7);
              figure("blow-off of the contact wire alone, error relative",
                     std::fabs(middle / (w * L * L / (8. * T)) - 1.));
            });
}

TEST(OverheadLineInSpace, bending_rounds_the_kink_at_a_steady_arm)
{
  // Between two arms w = A + B s + C sinh(s/l), l = sqrt(EI/T), with no slope at the arms: far from
  // them the slope is 2a/(L - 2l tanh(L/2l)), and T times its change is the force of an arm.
  const double L = 60., T = 20000., EI = 195., a = .2, l = std::sqrt(EI / T);
  const double exact = 4. * a * T / (L - 2. * l * std::tanh(L / (2. * l)));
  std::vector<double> errors;
  for (const std::string size : {"0.25", "0.125", "0.0625"})
    run_scene(scene_file("en50318_2002_250"),
              {stagger, "Catenary.Droppers.Positions=", "Time.End=0",
               "Statistics.Window=", "Catenary.Contact wire.Element size=" + size},
              [&](const taut::StepView &step)
              {
                const auto z = [&](const double x) { return displacement(step, 1, x, aside); };
                const double force = support_force(step, "steady arm at mast 4");
                const double change = (z(225.) - z(215.)) / 10. - (z(265.) - z(255.)) / 10.;
                EXPECT_NEAR(force, T * change, 1e-7);
                errors.push_back(std::fabs(force / exact - 1.));
              });
  EXPECT_LT(errors[2], 1e-5);
  EXPECT_LT(errors[1], .2 * errors[0]);
  EXPECT_LT(errors[2], .2 * errors[1]);
  figure("force of a steady arm on a beam, error relative", errors[2]);
}

TEST(OverheadLineInSpace, rest_of_the_whole_line_under_refinement)
{
  std::vector<double> blown, arm, length;
  for (const std::string size : {"0.5", "0.25", "0.125"})
    run_scene(scene_file("en50318_in_space"),
              {"Time.End=0", "Statistics.Window=", "Catenary.Contact wire.Element size=" + size,
               "Catenary.Messenger wire.Element size=" + size},
              [&](const taut::StepView &step)
              {
                blown.push_back(displacement(step, 1, 270., aside));
                arm.push_back(support_force(step, "steady arm at mast 4"));
                length.push_back(step.scene.links.at(4 * Span::n).length);
              });
  for (const auto *values : {&blown, &arm, &length})
  {
    const auto &v = *values;
    const double last = std::fabs(v[2] - v[1]), before = std::fabs(v[1] - v[0]);
    EXPECT_LT(last, .5 * before);
    EXPECT_LT(last, 1e-3 * std::fabs(v[2]));
  }
  figure("blow-off of the whole line", blown[2], "m");
  figure("its change by the last refinement", std::fabs(blown[2] - blown[1]), "m");
  figure("force of a steady arm in the wind", arm[2], "N");
  figure("its change by the last refinement", std::fabs(arm[2] - arm[1]), "N");
  figure("length of an inclined dropper", length[2], "m");
  figure("its change by the last refinement", std::fabs(length[2] - length[1]), "m");
}
