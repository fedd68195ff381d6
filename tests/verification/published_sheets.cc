// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: problems of contact from published sheets of validation, and problems like them, come out
// as there. Sources: each test; what it compares with is computed in it, or quoted.
#include "scene_tests.h"

using namespace verification;

namespace
{

  /// Solves a small system by elimination with pivots.
  std::vector<double> solve(std::vector<std::vector<double>> A, std::vector<double> b)
  {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      std::size_t p = i;
      for (std::size_t r = i + 1; r < n; ++r)
        if (std::fabs(A[r][i]) > std::fabs(A[p][i]))
          p = r;
      std::swap(A[i], A[p]);
      std::swap(b[i], b[p]);
      for (std::size_t r = i + 1; r < n; ++r)
      {
        const double f = A[r][i] / A[i][i];
        for (std::size_t c = i; c < n; ++c)
          A[r][c] -= f * A[i][c];
        b[r] -= f * b[i];
      }
    }
    for (std::size_t i = n; i-- > 0;)
    {
      for (std::size_t c = i + 1; c < n; ++c)
        b[i] -= A[i][c] * b[c];
      b[i] /= A[i][i];
    }
    return b;
  }

  double displacement_of(const taut::StepView &view, const std::size_t body, const double x,
                         const double y)
  {
    taut::Attachment point{taut::Attachment::Kind::body, body};
    point.place = {x, y};
    std::vector<taut::Term> terms;
    view.structure.motion(point, false, {0., 1.}, 1., terms);
    return displacement(view, terms);
  }

  /// Deflections of the ends of a slab of steel on springs that only push, its load down
  /// 'c (x - L)^2' [N/m], the feet of the springs raised.
  std::pair<double, double> ends_of_slab(const double length, const std::vector<double> &stiffness,
                                         const double c, const double raised)
  {
    const std::size_t n = stiffness.size();
    std::ostringstream text;
    text << "Generator = network; Gravity = 0, 0; Start = equilibrium\n"
            "Body slab: Type = solid; Degree = 2; Young's modulus = 2e11; Poisson's ratio = 0.3; "
            "Traction = 3: 0, -"
         << number(c) << "*(x-" << number(length) << ")^2\n"
         << "Body slab/Mesh: Arguments = " << n - 1 << ", 2 : 0, 0 : " << number(length)
         << ", 0.3\nLink hold: Direction = 1, 0; To = slab @ 0, 0\nTime: End = 0\n";
    for (std::size_t i = 0; i < n; ++i)
      text << "Link s" << i << ": Type = stop; Direction = 0, 1; To = slab @ "
           << number(length * double(i) / double(n - 1)) << ", 0; Gap = " << number(-raised)
           << "; Stiffness = " << number(stiffness[i]) << "\n";
    std::pair<double, double> ends;
    run_scene(text.str(), {},
              [&](const taut::StepView &view) {
                ends = {displacement_of(view, 0, 0., 0.), displacement_of(view, 0, length, 0.)};
              });
    return ends;
  }

  /// The same of a rigid slab: springs that would pull are left out until none does.
  std::pair<double, double> ends_of_rigid_slab(const double length,
                                               const std::vector<double> &stiffness, const double c,
                                               const double raised)
  {
    const std::size_t n = stiffness.size();
    std::vector<char> pushes(n, 1);
    for (;;)
    {
      double s[3] = {0., 0., 0.};
      for (std::size_t i = 0; i < n; ++i)
        for (int p = 0; p < 3; ++p)
          s[p] += pushes[i] ? stiffness[i] * std::pow(length * double(i) / double(n - 1), p) : 0.;
      // Force and moment of the load about x = 0.
      const std::vector<double> w =
          solve({{s[0], s[1]}, {s[1], s[2]}},
                {c * std::pow(length, 3) / 3., c * std::pow(length, 4) / 12.});
      bool same = true;
      for (std::size_t i = 0; i < n; ++i)
      {
        const char now = w[0] + w[1] * length * double(i) / double(n - 1) > 0.;
        same = same && now == pushes[i];
        pushes[i] = now;
      }
      if (same)
        return {raised - w[0], raised - w[0] - w[1] * length};
    }
  }
} // namespace

// Claim: a slab on 17 springs that only push lifts off at one side, and follows their feet. Source:
// code_aster, SSNL130 (V6.02.130), modelling B: k = 10 kN/m in all, 5 (x - 2)^2 N/m on 2 m;
// analytic -3.532908705 and 1.149763188 mm, then 5 mm more. With 13 springs in contact these are
// -208 / 58875 and 176 / 153075 m.
TEST(PublishedSheets, a_slab_on_springs_that_only_push)
{
  std::vector<double> k(17, 10000. / 16.);
  k.front() = k.back() = 10000. / 32.;
  for (const double raised : {0., .005})
  {
    const auto ends = ends_of_slab(2., k, 5., raised),
               rigid = ends_of_rigid_slab(2., k, 5., raised);
    EXPECT_NEAR(rigid.first, raised - 208. / 58875., 1e-15);
    EXPECT_NEAR(rigid.second, raised + 176. / 153075., 1e-15);
    EXPECT_NEAR(ends.first, rigid.first, 1e-6 * std::fabs(rigid.first));
    EXPECT_NEAR(ends.second, rigid.second, 1e-6 * std::fabs(rigid.second));
  }
}

// Claim: so does one of other length on 11 springs that stiffen towards its far end. Expected: the
// rigid slab of this test; the slab bends by some 1e-7 m.
TEST(PublishedSheets, a_slab_on_springs_that_stiffen)
{
  std::vector<double> k;
  for (int i = 0; i < 11; ++i)
    k.push_back(2e4 * (1. + .3 * i));
  const auto ends = ends_of_slab(3.5, k, 60., -.002),
             rigid = ends_of_rigid_slab(3.5, k, 60., -.002);
  EXPECT_GT(rigid.second, -.002) << "lifts off";
  EXPECT_NEAR(ends.first, rigid.first, 1e-4 * std::fabs(rigid.first));
  EXPECT_NEAR(ends.second, rigid.second, 1e-4 * std::fabs(rigid.second));
}

namespace
{
  /// Two bars in a line, of length 1 m each: one flies to the left against the right end of the
  /// other, which is held at its left end, with the distance @p gap.
  struct Bars
  {
    double left_area, right_area, speed, gap;
    static constexpr double modulus = 2e11, density = 7800.;
    static double wave_speed() { return std::sqrt(modulus / density); }
    double impedance(const double area) const { return area * modulus / wave_speed(); }

    std::string text(const int n, const double end) const
    {
      std::ostringstream out;
      const double h = 1. / n;
      const auto bar = [&](const std::string &name, const double x, const double area)
      {
        out << "Wire " << name << ": From = " << number(x) << ", 0; To = " << number(x + 1.)
            << ", 0; Components = bar; Degree = 1; Mass matrix = reduced; Element size = "
            << number(h) << "; Mass per length = " << number(density * area)
            << "; Axial stiffness = " << number(modulus * area) << "\n";
      };
      out << "Generator = network; Gravity = 0, 0; Start = given\n";
      bar("held", -1., left_area);
      bar("flying", gap, right_area);
      out << "Wire flying: Initial axial velocity = " << number(-speed)
          << "\nSupport foot: Wire = held; Motion = axial; Positions = 0\n"
             "Link meet: Type = stop; From = held @ 1; To = flying @ 0; Direction = 1, 0; Gap = "
          << number(gap) << "\nTime: Scheme = Moreau-Jean; Step = " << number(h / wave_speed())
          << "; End = " << number(end) << "\nTime/Moreau-Jean: Theta = 0.5; Conditions = gaps\n";
      return out.str();
    }
  };
} // namespace

// Claim: two beams that hit each other move together by half of the speed, until the wave comes
// back from the foot. Source: code_aster, SDNL111 (V5.02.111): E = 200 GPa, 7800 kg/m^3, 2 cm x 2
// cm, 1 m, 1 m/s; the end that hits is at -0.1, -0.2, -0.1, 0 and 0.2 mm after 0.2, 0.4, 0.6, 0.8
// and 1 ms. The wave takes 0.3949 ms to and fro, so that the sheet's values are rounded by 5 um at
// most.
TEST(PublishedSheets, two_beams_that_hit_each_other)
{
  const Bars bars{4e-4, 4e-4, 1., 0.};
  std::vector<double> times, places, forces;
  run_scene(bars.text(200, 1.001e-3), {},
            [&](const taut::StepView &view)
            {
              times.push_back(view.state.time);
              places.push_back(displacement(view, 1, 0., {1.}));
              forces.push_back(view.state.multiplier[0]);
            });
  for (const auto &[time, place] :
       {std::pair{2e-4, -1e-4}, {4e-4, -2e-4}, {6e-4, -1e-4}, {8e-4, 0.}, {1e-3, 2e-4}})
  {
    const std::size_t i = std::lower_bound(times.begin(), times.end(), time) - times.begin();
    EXPECT_NEAR(places[i], place, 1.2e-5) << time;
  }
  const double force = .5 * bars.impedance(4e-4);
  for (std::size_t i = 3; i < times.size() && times[i] < 3.9e-4; ++i)
    EXPECT_NEAR(forces[i], force, 1e-6 * force) << times[i];
}

// Claim: two tubes that pound push each other with v Z1 Z2 / (Z1 + Z2), Z the density times area
// and wave speed, from the touch on. Tubes of other sections with a gap between them; the closed
// form is that of plane waves in thin bars.
TEST(PublishedSheets, two_tubes_that_pound)
{
  const auto tube = [](const double outer, const double wall)
  { return pi * (outer - wall) * wall; };
  const Bars bars{tube(.219, .008), tube(.1683, .0125), 7.3, 2.19e-3};
  const double Z1 = bars.impedance(bars.left_area), Z2 = bars.impedance(bars.right_area),
               force = bars.speed * Z1 * Z2 / (Z1 + Z2), touch = bars.gap / bars.speed,
               back = touch + 2. / bars.wave_speed();
  double largest = 0., before = 0.;
  int n = 0;
  run_scene(bars.text(200, back), {},
            [&](const taut::StepView &view)
            {
              const double t = view.state.time, N = view.state.multiplier[0];
              before = std::fmax(before, t < touch ? N : 0.);
              if (t < touch + 2e-5 || t > back - 2e-5)
                return;
              ++n;
              largest = std::fmax(largest, std::fabs(N / force - 1.));
            });
  EXPECT_EQ(before, 0.);
  EXPECT_GT(n, 300);
  EXPECT_LT(largest, 2e-3);
  figure("force of two tubes that pound, deviation from plane waves", largest);
}

// Claim: a sleeper that hangs under a rail carries what is left when its gap is closed. A hinged
// beam on elastic stops with gaps; expected: Euler's influence lines of a hinged beam, solved for
// the stops that push. Cubic elements are exact at their nodes.
TEST(PublishedSheets, a_hanging_sleeper)
{
  const double L = 7.2, EI = 2. * 6.4e6, P = 125e3, k = 4e7;
  const int n = 11;                              // sleepers, 0.6 m apart
  const auto influence = [&](double x, double a) // deflection at x of a unit force at a
  {
    if (x > a)
      std::swap(x, a);
    const double b = L - a;
    return b * x * (L * L - b * b - x * x) / (6. * L * EI);
  };
  for (const double hanging : {3e-4, 3e-3})
    for (const double load : {3.6, 3.9})
    {
      std::vector<double> place, gap;
      std::ostringstream text;
      text << "Generator = network; Gravity = 0, 0; Start = equilibrium\n"
              "Wire rail: To = 7.2, 0; Components = beam; Mass per length = 120; Element size = "
              "0.3; Bending stiffness = "
           << number(EI)
           << "\nSupport ends: Wire = rail; Positions = 0, 7.2\n"
              "Load wheel: Type = point; On = rail @ "
           << load << "; Direction = 0, -1; Magnitude = " << number(P) << "\nTime: End = 0\n";
      for (int i = 1; i <= n; ++i)
      {
        place.push_back(.6 * i);
        gap.push_back(i == 6 ? hanging : 0.);
        text << "Link s" << i << ": Type = stop; Direction = 0, 1; To = rail @ "
             << number(place.back()) << "; Gap = " << number(gap.back())
             << "; Stiffness = " << number(k) << "\n";
      }
      std::vector<char> pushes(n, 1);
      std::vector<double> N;
      for (bool same = false; !same;)
      {
        // N_i / k + sum_j a_ij N_j = P a_i - gap_i where the stop pushes, N_i = 0 elsewhere.
        std::vector<std::vector<double>> A(n, std::vector<double>(n, 0.));
        std::vector<double> b(n, 0.);
        for (int i = 0; i < n; ++i)
        {
          A[i][i] = pushes[i] ? 1. / k : 1.;
          if (!pushes[i])
            continue;
          b[i] = P * influence(place[i], load) - gap[i];
          for (int j = 0; j < n; ++j)
            A[i][j] += influence(place[i], place[j]);
        }
        N = solve(A, b);
        same = true;
        for (int i = 0; i < n; ++i)
        {
          double sinks = P * influence(place[i], load) - gap[i];
          for (int j = 0; j < n; ++j)
            sinks -= influence(place[i], place[j]) * N[j];
          const char now = pushes[i] ? N[i] > 0. : sinks > 0.;
          same = same && now == pushes[i];
          pushes[i] = now;
        }
      }
      EXPECT_EQ(N[5] > 0., hanging < 1e-3);
      run_scene(text.str(), {},
                [&](const taut::StepView &view)
                {
                  for (int i = 0; i < n; ++i)
                    EXPECT_NEAR(view.state.multiplier[i], N[i], 1e-7 * P) << i << ' ' << hanging;
                });
    }
}

// Claim: a long weightless beam on a bed that only pushes lifts off pi / (2 b) beside a force P,
// and has the moment P / (4 b) coth(pi / 2) under it, b^4 = k / (4 EI). Source: Y. Weitsman, J.
// Appl. Mech. 37 (1970); M. Hetenyi's beam of the length pi / b with free ends. The bed is of stops
// 5 cm apart: an error of order (b h)^2.
TEST(PublishedSheets, a_beam_on_a_tensionless_bed)
{
  for (const auto &[EI, k, P] : {std::tuple{2.4e6, 3.7e6, 12e3}, {5.1e5, 9e6, 40e3}})
  {
    const double b = std::pow(k / (4. * EI), .25), h = .05,
                 moment = P / (4. * b) / std::tanh(pi / 2.);
    std::ostringstream text;
    text << "Generator = network; Gravity = 0, 0; Start = equilibrium\n"
            "Wire beam: To = 8, 0; Components = beam; Mass per length = 50; Element size = 0.05; "
            "Bending stiffness = "
         << number(EI)
         << "\nLoad push: Type = point; On = beam @ 4; Direction = 0, -1; Magnitude = " << number(P)
         << "\nLink bed: Type = stop; Direction = 0, 1; To = beam @ 0:0.05:8; Stiffness = "
         << number(k * h)
         << "\nOutput: Observers = section forces\nOutput/section forces: Wires = beam\n"
            "Time: Step = 1e-3; End = 1e-3\n";
    Session session(text.str());
    double lift_off = 0.;
    session.run(
        [&](const taut::StepView &view)
        {
          for (std::size_t i = 80; i < 161; ++i)
            if (view.state.multiplier[i] > 0.)
              lift_off = h * double(i) - 4.;
        });
    EXPECT_NEAR(lift_off, pi / (2. * b), h);
    EXPECT_NEAR(value(session.statistics()["observers"]["beam"], "largest_bending_moment"), moment,
                2e-3 * moment);
  }
}
