// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables, masses on ropes and rigid bodies on stops come to rest with the forces of their
// own equations to 1 %, or a warning says why not, or the scene is refused. Source: the equations
// of the elastic catenary (H. M. Irvine, Cable Structures, 1981); the least of the convex energy of
// springs that only pull or push.
#include "common.h"
#include "scene_text.h"

#include "verification/run.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

namespace
{
  using hunt::number;
  using hunt::Random;
  using hunt::SceneText;
  using hunt::short_number;
  using verification::g;
  using Vector = std::vector<double>;

  constexpr double bound = .01, least_agreed = .6, most_alarms = .05;

  /// A scene at rest and the sizes of its link forces [N].
  struct Rest
  {
    std::string text;
    Vector forces;
  };

  /// A spring that only acts where its elongation is positive: it, its gradient and its Hessian.
  struct Spring
  {
    double k;
    std::function<double(const Vector &q, Vector &gradient, dealii::FullMatrix<double> &hessian)> u;
  };

  /// The forces of the springs at the least energy of springs and a constant load, which is convex.
  /// Empty: nothing holds the load.
  Vector forces_at_rest(const std::vector<Spring> &springs, const Vector &load, Vector q)
  {
    const unsigned int n = load.size();
    dealii::FullMatrix<double> hessian(n, n), H(n, n);
    Vector gradient(n), G(n);
    const auto energy = [&](const Vector &at)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < n; ++i)
        sum -= load[i] * at[i];
      for (const Spring &spring : springs)
      {
        const double u = std::max(0., spring.u(at, gradient, hessian));
        sum += .5 * spring.k * u * u;
      }
      return sum;
    };
    double stiffest = 0.;
    for (const Spring &spring : springs)
      stiffest = std::max(stiffest, spring.k);
    for (int iteration = 0; iteration < 500; ++iteration)
    {
      H = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        G[i] = -load[i];
        H(i, i) = 1e-9 * stiffest;
      }
      for (const Spring &spring : springs)
      {
        const double u = spring.u(q, gradient, hessian);
        for (unsigned int i = 0; u > 0. && i < n; ++i)
        {
          G[i] += spring.k * u * gradient[i];
          for (unsigned int j = 0; j < n; ++j)
            H(i, j) += spring.k * (gradient[i] * gradient[j] + u * hessian(i, j));
        }
      }
      dealii::FullMatrix<double> inverse(n, n);
      inverse.invert(H);
      dealii::Vector<double> rhs(G.begin(), G.end()), step(n);
      inverse.vmult(step, rhs);
      double size = 0., slope = 0., part = 1.;
      for (unsigned int i = 0; i < n; ++i)
      {
        size = std::max(size, std::fabs(step[i]));
        slope += step[i] * G[i];
      }
      const double before = energy(q);
      Vector next(n);
      do
      {
        for (unsigned int i = 0; i < n; ++i)
          next[i] = q[i] - part * step[i];
        part *= .5;
      } while (energy(next) > before - 1e-4 * part * slope && part > 1e-12);
      q = next;
      if (size < 1e-13)
        break;
    }
    Vector forces, sum(n, 0.);
    for (const Spring &spring : springs)
    {
      forces.push_back(spring.k * std::max(0., spring.u(q, gradient, hessian)));
      for (unsigned int i = 0; i < n; ++i)
        sum[i] += forces.back() * gradient[i];
    }
    for (unsigned int i = 0; i < n; ++i)
      if (std::fabs(sum[i] - load[i]) > 1e-6 * verification::largest(forces))
        return {};
    return forces;
  }

  /// An elastic cable between two points: the force at its first end, H and V.
  Rest cable(Random &random)
  {
    const double d = short_number(random.decades(0, 2.3)),
                 h = short_number(d * random.uniform(-.7, .7)), chord = std::hypot(d, h),
                 L = short_number(chord * random.uniform(.97, 1.6)),
                 m = short_number(random.decades(-1, 1)),
                 EA = short_number(m * g * L * random.decades(1.5, 5)), w = m * g;
    // End of a cable that begins with the forces H and V.
    const auto end = [&](const double H, const double V)
    {
      return std::pair(
          H * L / EA + H / w * (std::asinh(V / H) - std::asinh((V - w * L) / H)),
          -(L / EA * (V - .5 * w * L) + (std::hypot(H, V) - std::hypot(H, V - w * L)) / w));
    };
    // Bisections: for each H the V that ends at the height, then the H that ends at the distance.
    const auto V_of = [&](const double H)
    {
      double low = -1e3 * (w * L + H), high = -low;
      for (int k = 0; k < 200; ++k)
      {
        const double V = .5 * (low + high);
        (end(H, V).second > h ? low : high) = V;
      }
      return .5 * (low + high);
    };
    double low = 1e-9 * w * L, high = 10. * EA;
    for (int k = 0; k < 200; ++k)
    {
      const double H = std::sqrt(low * high);
      (end(H, V_of(H)).first < d ? low : high) = H;
    }
    const double H = std::sqrt(low * high);
    SceneText text;
    text.line() << "Gravity = 0, -" << g;
    text.line() << "Body rope: Type = cable; From = 0, 0; To = " << d << ", " << h
                << "; Unstressed length = " << L << "; Axial stiffness = " << EA
                << "; Mass per length = " << m << "; Element = bar; Elements = 48; Held ends = to";
    text.line() << "Link x: Type = joint; From = ground; To = rope @ 0, 0; Direction = 1, 0";
    text.line() << "Link y: Type = joint; From = ground; To = rope @ 0, 0; Direction = 0, 1";
    return {text.text(), {H, std::fabs(V_of(H))}};
  }

  /// A mass on three to five elastic ropes in space, some of them slack.
  Rest ropes(Random &random)
  {
    const double l = short_number(random.decades(-1, 2)), m = short_number(random.decades(-1, 3));
    const int n = random.integer(3, 5);
    std::vector<Spring> springs;
    SceneText text;
    text.line() << "Gravity = 0, -" << g << "\nStart = equilibrium";
    text.line() << "Mass bob: Position = 0, 0, 0; Motions = x, y, z; Mass = " << m;
    for (int i = 0; i < n; ++i)
    {
      const std::array<double, 3> a = {
          short_number(l * std::cos(2.1 * i + random.uniform(-.5, .5))),
          short_number(l * random.uniform(.3, 1.5)),
          short_number(l * std::sin(2.1 * i + random.uniform(-.5, .5)))};
      const double length = short_number(std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) *
                                         random.uniform(.8, 1.1)),
                   k = short_number(m * g / l * random.decades(.5, 4));
      text.line() << "Link rope" << number(i) << ": Type = dropper; Turns = true; From = ground @ "
                  << a[0] << ", " << a[1] << ", " << a[2] << "; To = bob; Length = " << length
                  << "; Stiffness = " << k;
      springs.push_back({k,
                         [=](const Vector &q, Vector &gradient, dealii::FullMatrix<double> &hessian)
                         {
                           double r = 0.;
                           for (int c = 0; c < 3; ++c)
                             r += (q[c] - a[c]) * (q[c] - a[c]);
                           r = std::sqrt(r);
                           for (int c = 0; c < 3; ++c)
                             gradient[c] = (q[c] - a[c]) / r;
                           for (int c = 0; c < 3; ++c)
                             for (int b = 0; b < 3; ++b)
                               hessian(c, b) = ((c == b) - gradient[c] * gradient[b]) / r;
                           return r - length;
                         }});
    }
    return {text.text(), forces_at_rest(springs, {0., -m * g, 0.}, {.01 * l, -.3 * l, .02 * l})};
  }

  /// A rigid box on stops of unequal stiffness and gaps that hardly let it turn.
  Rest box(Random &random)
  {
    const double l = short_number(random.decades(-1, 1.5)), m = short_number(random.decades(-1, 4)),
                 x = short_number(.5 * l * random.uniform(-1., 1.)),
                 z = short_number(.5 * l * random.uniform(-1., 1.)),
                 soft = 1e-4 * l; // compressions
    SceneText text;
    text.line() << "Gravity = 0, -" << g << "\nStart = equilibrium";
    text.line() << "Body box: Type = rigid body; Mass = " << m << "; Centre = " << x << ", "
                << .2 * l << ", " << z << "; Moments of inertia = " << .3 * m * l * l << ", "
                << .4 * m * l * l << ", " << .3 * m * l * l;
    std::vector<Spring> springs;
    const int n = random.integer(4, 8);
    for (int i = 0; i < n; ++i)
    {
      const double sx = i < 4 ? (i % 2 ? l : -l) : short_number(l * random.uniform(-1., 1.)),
                   sz = i < 4 ? (i / 2 ? l : -l) : short_number(l * random.uniform(-1., 1.)),
                   k = short_number(m * g / soft * random.decades(-1, 1)),
                   gap = short_number(soft * random.uniform(0., 2.));
      text.line() << "Link leg" << number(i) << ": Type = stop; From = ground; To = box @ " << sx
                  << ", 0, " << sz << "; Direction = 0, 1; Gap = " << gap << "; Stiffness = " << k;
      springs.push_back(
          {k, [=](const Vector &q, Vector &gradient, dealii::FullMatrix<double> &hessian)
           {
             hessian = 0.;
             gradient = {-1., -(sx - x) / l, -(sz - z) / l};
             return gradient[0] * q[0] + gradient[1] * q[1] + gradient[2] * q[2] - gap;
           }});
    }
    // The box needs to be held along x and z, and about y.
    for (const std::string &at : {std::string("0, 0, 0"), number(l) + ", 0, 0"})
      text.line() << "Link z" << (at[0] == '0' ? "0" : "1")
                  << ": Type = joint; From = ground; To = box @ " << at << "; Direction = 0, 0, 1";
    text.line() << "Link x: Type = joint; From = ground; To = box @ 0, 0, 0; Direction = 1, 0, 0";
    return {text.text(), forces_at_rest(springs, {-m * g, 0., 0.}, {0., 0., 0.})};
  }
} // namespace

TEST(HuntOfBodies, no_answer_at_rest_is_silent_and_wrong)
{
  const char *const given = std::getenv("TAUT_HUNT_BODIES"), *const seeds =
                                                                 std::getenv("TAUT_HUNT_SEED");
  const int n_scenes = given ? std::atoi(given) : 42;
  const unsigned long seed = seeds ? std::strtoul(seeds, nullptr, 10) : 1;
  const std::array<std::pair<const char *, Rest (*)(Random &)>, 3> families = {
      {{"cable", cable}, {"mass on ropes", ropes}, {"box on stops", box}}};
  std::map<std::string, std::array<int, 4>> table; // agreed, alarmed, warned or refused, undecided
  int n_agreed = 0, n_alarms = 0, n_decided = 0;
  for (int i = 0; i < n_scenes; ++i)
  {
    Random random(seed * 7919 + i);
    const auto &[name, make] = families[i % families.size()];
    const Rest rest = make(random);
    std::array<int, 4> &counts = table[name];
    if (rest.forces.empty())
    {
      ++counts[3];
      continue;
    }
    ++n_decided;
    std::string log;
    double error = 0.;
    const std::string refused = verification::error_of(
        [&]
        {
          verification::Session session(rest.text + "\n",
                                        {"Time/End=0", "Output/Field interval=0"});
          Vector forces;
          session.run(
              [&](const taut::StepView &view)
              {
                const std::size_t n = rest.forces.size();
                forces.assign(view.state.multiplier.begin(), view.state.multiplier.begin() + n);
              });
          for (std::size_t k = 0; k < forces.size(); ++k)
            verification::raise(error, std::fabs(forces[k]) - rest.forces[k]);
          error /= verification::largest(rest.forces);
          log = session.log();
        });
    const bool agrees = refused.empty() && error <= bound,
               is_warned = verification::has(log, "Warning");
    ++counts[agrees ? is_warned : 2];
    n_agreed += agrees;
    n_alarms += agrees && is_warned;
    EXPECT_TRUE(agrees || is_warned || !refused.empty())
        << "scene " << i << ", " << name << ": silent, error " << error << '\n'
        << rest.text;
    if (!refused.empty() && std::getenv("TAUT_HUNT_VERBOSE"))
      std::printf("%d %s: %s\n", i, name, refused.c_str());
  }
  std::printf("%-16s%10s%10s%20s%12s\n", "family", "agreed", "alarmed", "warned, refused",
              "undecided");
  for (const auto &[name, c] : table)
    std::printf("%-16s%10d%10d%20d%12d\n", name.c_str(), c[0], c[1], c[2], c[3]);
  EXPECT_GE(n_agreed, least_agreed * n_decided);
  EXPECT_LE(n_alarms, most_alarms * n_agreed);
}
