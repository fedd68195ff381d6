// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: cables, masses on ropes, rigid bodies on stops, strings on bumps, and solids that overlap
// flat and wavy floors, bores and pins come to rest with the forces of their own equations to 1 %,
// and one or two bodies on hinges swing as their equations do to 2 %, or a warning says why not, or
// the scene is refused. Source: equations of the elastic catenary (H. M. Irvine, Cable Structures,
// 1981); the least of the convex energy of springs that only pull or push; the complementarity
// problem of the exact flexibilities of a string; uniaxial strain, and that a wave has no mean; a
// half-plane on a sine (H. M. Westergaard, J. Appl. Mech. 6, 1939), with its mean gap from the
// compliance of periodic punches; Lame's ring; the physical pendulum and Lagrange's equations of
// two.
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

  /// Of forces at rest, and of places in motion, as `automatic` promises them.
  constexpr double bound = .01, bound_of_motion = .02;
  constexpr double least_agreed = .6, most_alarms = .05;

  /// What is compared of a scene.
  enum class Kind
  {
    forces, ///< at rest, of the first links
    sum,    ///< at rest, of all forces
    places  ///< of the probes, at the end of a motion
  };

  /// A scene, and the sizes of forces [N] or places [m]; none: it cannot be decided.
  struct BodyScene
  {
    std::string text;
    Vector expected;
    Kind kind = Kind::forces;
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
  BodyScene cable(Random &random)
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
  BodyScene ropes(Random &random)
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
  BodyScene box(Random &random)
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

  /// A string that sags on stops at any height.
  BodyScene string_on_bumps(Random &random)
  {
    const double L = short_number(random.decades(-1, 2)), m = short_number(random.decades(-2, 1)),
                 sag = short_number(L * random.decades(-5, -2)), q = m * g,
                 T = short_number(q * L * L / (8. * sag));
    const int n_elements = random.integer(8, 40), n = random.integer(2, 7);
    SceneText text;
    text.line() << "Gravity = 0, -" << g;
    text.line() << "Wire wire: From = 0, 0; To = " << L
                << ", 0; Components = string; Tension = " << T << "; Mass per length = " << m
                << "; Element size = " << L / n_elements;
    text.line() << "Support ends: Wire = wire; Positions = 0, " << L;
    Vector place(n), distance(n), N(n, 0.);
    for (int i = 0; i < n; ++i)
    {
      place[i] = short_number(L * (i + random.uniform(.2, .8)) / n);
      const double gap = short_number(sag * random.uniform(-.3, 1.));
      distance[i] = gap - q * place[i] * (L - place[i]) / (2. * T);
      text.line() << "Link bump" << number(i) << ": Type = stop; From = ground; To = wire @ "
                  << place[i] << "; Direction = 0, 1; Gap = " << gap;
    }
    const auto flexibility = [&](const double a, const double b)
    { return std::min(a, b) * (L - std::max(a, b)) / (T * L); };
    for (int sweep = 0; sweep < 20000; ++sweep) // of the method of Gauss and Seidel, projected
      for (int i = 0; i < n; ++i)
      {
        double gap = distance[i];
        for (int k = 0; k < n; ++k)
          gap += flexibility(place[i], place[k]) * N[k];
        N[i] = std::max(0., N[i] - gap / flexibility(place[i], place[i]));
      }
    return {text.text(), verification::largest(N) > 0. ? N : Vector()};
  }

  /// What all solids without gravity begin with.
  void begin_solid(SceneText &text, const double E, const double nu, const std::string &more)
  {
    text.line() << "Generator = network; Gravity = 0, 0; Start = equilibrium";
    text.line() << "Body block: Type = solid; Young's modulus = " << E
                << "; Poisson's ratio = " << nu << "; Density = 1000; " << more;
  }

  /// A block between smooth walls that is held above a floor inside it. With half a wave the floor
  /// is so flat that all of the block touches it: the wave changes pressures, and not their sum.
  BodyScene block(Random &random, const bool has_wave)
  {
    const double w = short_number(random.decades(-2, 1)),
                 h = short_number(w * random.decades(-.7, .7)),
                 E = short_number(random.decades(5, 11)),
                 nu = short_number(random.uniform(0., .45)),
                 overlap = short_number(h * random.decades(-7, -3.5)),
                 wave = short_number(random.uniform(.02, .2) * overlap * w / (w + h));
    SceneText text;
    begin_solid(text, E, nu,
                "Fixed boundaries = 3; Symmetry boundaries = 0, 1; Degree = " +
                    std::to_string(random.integer(1, 2)));
    text.line() << "Body block/Mesh: Generator = subdivided_hyper_rectangle; Arguments = "
                << random.integer(has_wave ? 4 : 1, has_wave ? 16 : 7) << ", "
                << random.integer(has_wave ? 2 : 1, 7) << " : 0, 0 : " << w << ", " << h;
    text.line() << "Contact floor: Slave = block: 2; Direction = 0, 1; Obstacle = "
                << (has_wave ? "height; Height = " + number(overlap) + "+" + number(wave) +
                                   "*cos(pi*x/" + number(w) + ")"
                             : "plane; Point = 0, " + number(overlap));
    return {
        text.text(), {E * (1. - nu) / ((1. + nu) * (1. - 2. * nu)) * overlap / h * w}, Kind::sum};
  }

  /// A block between smooth walls that touches the crests of a wavy floor: the contact of an
  /// elastic half-plane with a sine, whose mean gap is c = h (1 - x + x ln x) where x is the mean
  /// pressure over that of full contact, pi E* h / length.
  BodyScene block_on_crests(Random &random)
  {
    const double w = short_number(random.decades(-2, 1)), length = 2. * w, height = 3. * w,
                 E = short_number(random.decades(5, 11)),
                 nu = short_number(random.uniform(0., .45)),
                 h = short_number(w * random.decades(-6, -3)), x = random.uniform(.1, .9),
                 full = M_PI * E / (1. - nu * nu) * h / length,
                 confined = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu)),
                 raised = x * full * height / confined - h * (1. - x + x * std::log(x));
    SceneText text;
    const int n = random.integer(10, 24);
    begin_solid(text, E, nu,
                "Fixed boundaries = 3; Symmetry boundaries = 0, 1; Degree = " +
                    std::to_string(random.integer(1, 2)));
    text.line() << "Body block/Mesh: Generator = subdivided_hyper_rectangle; Arguments = " << n
                << ", " << 3 * n << " : 0, 0 : " << w << ", " << height
                << "; Local refinements = 2; Refine where = " << .4 * w << "/2^t - y";
    text.line() << "Contact floor: Slave = block: 2; Direction = 0, 1; Obstacle = height; Height = "
                << number(raised) << "+" << number(h) << "*cos(pi*x/" << number(w)
                << "); Height difference = " << number(1e-4 * w);
    return {text.text(), {x * full * w}, Kind::sum};
  }

  /// A disc in a bore that is too small: all of it is pressed alike.
  BodyScene disc_in_a_bore(Random &random)
  {
    const double R = short_number(random.decades(-2, 1)), E = short_number(random.decades(5, 11)),
                 nu = short_number(random.uniform(0., .45)),
                 less = short_number(R * random.decades(-7, -3.5));
    const bool whole = random.chance(.5);
    SceneText text;
    begin_solid(text, E, nu,
                std::string(whole ? "" : "Symmetry boundaries = 1; ") +
                    "Degree = " + std::to_string(random.integer(1, 2)));
    text.line() << "Body block/Mesh: Generator = " << (whole ? "hyper_ball" : "quarter_hyper_ball")
                << "; Arguments = 0, 0 : " << R << "; Refinements = " << random.integer(3, 4);
    text.line() << "Contact bore: Slave = block: 0; Obstacle = cylinder; Point = 0, 0; Direction = "
                << "0, 0, 1; Encloses body = true; Radius = " << number(R - less);
    return {text.text(),
            {E / ((1. + nu) * (1. - 2. * nu)) * less / R * (whole ? 2. : .5) * M_PI * R},
            Kind::sum};
  }

  /// A pin that is too thick in the hole of a wide plate.
  BodyScene pin_in_a_hole(Random &random)
  {
    const double a = short_number(random.decades(-2, 1)), E = short_number(random.decades(5, 11)),
                 nu = short_number(random.uniform(0., .45)),
                 more = short_number(a * random.decades(-4.5, -3)),
                 rim = short_number(a * random.uniform(8., 14.));
    SceneText text;
    begin_solid(text, E, nu, "Degree = 2");
    text.line() << "Body block/Mesh: Generator = plate_with_a_hole; Arguments = " << a << " : "
                << 2. * a << " : " << rim << ", " << rim << ", " << rim << ", " << rim
                << " : 0, 0; Refinements = 2";
    text.line() << "Contact pin: Slave = block: 4; Obstacle = cylinder; Point = 0, 0; Direction = "
                << "0, 0, 1; Radius = " << number(a + more);
    // Lame's ring, as wide as a circle of the area of the plate.
    const double b2 = 4. * (rim + 2. * a) * (rim + 2. * a) / M_PI, a2 = a * a,
                 compliance = a * (1. + nu) / E * (a2 * (1. - 2. * nu) + b2) / (b2 - a2);
    return {text.text(), {more / compliance * 2. * M_PI * a}, Kind::sum};
  }

  BodyScene pressed_block(Random &random)
  {
    return block(random, false);
  }

  BodyScene block_on_waves(Random &random)
  {
    return block(random, true);
  }

  /// Two rigid bodies that swing from rest, the second one on a hinge at the first one.
  BodyScene hinged_chain(Random &random)
  {
    const std::array<double, 2> m = {short_number(random.decades(-1, 3)),
                                     short_number(random.decades(-1, 3))},
                                a = {short_number(random.uniform(.2, 1.)),
                                     short_number(random.uniform(.2, 1.))},
                                start = {random.uniform(-.9, .9), random.uniform(-.9, .9)};
    const double length = short_number(random.uniform(.5, 1.5));
    std::array<double, 2> I;
    for (int k = 0; k < 2; ++k)
      I[k] = short_number(m[k] * a[k] * a[k] * random.uniform(.2, 1.5));
    const auto places = [&](const std::array<double, 2> &angle)
    {
      std::array<double, 4> at = {a[0] * std::sin(angle[0]), -a[0] * std::cos(angle[0])};
      at[2] = length * std::sin(angle[0]) + a[1] * std::sin(angle[1]);
      at[3] = -length * std::cos(angle[0]) - a[1] * std::cos(angle[1]);
      return at;
    };
    const std::array<double, 4> from = places(start);
    const double pin_x = length * std::sin(start[0]), pin_y = -length * std::cos(start[0]),
                 period = 2. * M_PI * std::sqrt(length / g),
                 step = short_number(period / random.decades(2., 3.3));
    const int n_steps = std::lround(random.uniform(.4, 1.2) * period / step);
    SceneText text;
    text.line() << "Gravity = 0, -" << g << "\nStart = undeformed";
    for (int k = 0; k < 2; ++k)
    {
      const std::string name = k == 0 ? "first" : "second";
      text.line() << "Body " << name << ": Type = rigid body; Mass = " << m[k]
                  << "; Centre = " << number(from[2 * k]) << ", " << number(from[2 * k + 1])
                  << ", 0; Moments of inertia = " << number(.8 * I[k]) << ", " << number(.7 * I[k])
                  << ", " << I[k];
      for (const auto &[axis, direction] : {std::pair("x", "1, 0, 0"), {"y", "0, 1, 0"}})
        text.line() << "Probe " << name << " " << axis << ": Point = " << name << " @ "
                    << number(from[2 * k]) << ", " << number(from[2 * k + 1])
                    << ", 0; Direction = " << direction;
    }
    text.line() << "Link ground: Type = hinge; From = ground; To = first @ 0, 0, 0; Axis = 0, 0, 1";
    const std::string pin = " @ " + number(pin_x) + ", " + number(pin_y) + ", 0";
    text.line() << "Link pin: Type = hinge; From = first" << pin << "; To = second" << pin
                << "; Axis = 0, 0, 1";
    text.line() << "Time: Step = " << step << "; End = " << n_steps * step;

    // Lagrange's equations of the double physical pendulum, by Runge and Kutta's classical method.
    using State = std::array<double, 4>; // angles and rates
    const auto rate_of = [&](const State &s)
    {
      const double c = m[1] * length * a[1] * std::cos(s[0] - s[1]),
                   q = m[1] * length * a[1] * std::sin(s[0] - s[1]),
                   A = I[0] + m[0] * a[0] * a[0] + m[1] * length * length,
                   B = I[1] + m[1] * a[1] * a[1],
                   f = -q * s[3] * s[3] - (m[0] * a[0] + m[1] * length) * g * std::sin(s[0]),
                   h = q * s[2] * s[2] - m[1] * a[1] * g * std::sin(s[1]);
      return State{s[2], s[3], (B * f - c * h) / (A * B - c * c),
                   (A * h - c * f) / (A * B - c * c)};
    };
    const auto ahead = [](const State &s, const double dt, const State &rate)
    {
      return State{s[0] + dt * rate[0], s[1] + dt * rate[1], s[2] + dt * rate[2],
                   s[3] + dt * rate[3]};
    };
    State s = {start[0], start[1], 0., 0.};
    const int n_fine = 20 * std::max(n_steps, 500);
    const double dt = n_steps * step / n_fine;
    for (int k = 0; k < n_fine; ++k)
    {
      const State r1 = rate_of(s), r2 = rate_of(ahead(s, .5 * dt, r1)),
                  r3 = rate_of(ahead(s, .5 * dt, r2)), r4 = rate_of(ahead(s, dt, r3));
      for (int i = 0; i < 4; ++i)
        s[i] += dt / 6. * (r1[i] + 2. * r2[i] + 2. * r3[i] + r4[i]);
    }
    const std::array<double, 4> to = places({s[0], s[1]});
    return {text.text(),
            {to[0] - from[0], to[1] - from[1], to[2] - from[2], to[3] - from[3]},
            Kind::places};
  }

  /// A rigid body that swings on a hinge from rest.
  BodyScene hinged_body(Random &random)
  {
    const double m = short_number(random.decades(-2, 4)), d = short_number(random.decades(-2, 1)),
                 radius = d * random.uniform(.2, 1.5), start = random.uniform(-2.8, 2.8),
                 x = short_number(d * std::sin(start)), y = short_number(-d * std::cos(start)),
                 I = short_number(m * radius * radius), r = std::hypot(x, y),
                 frequency = std::sqrt(m * g * r / (I + m * r * r)),
                 step = short_number(2. * M_PI / frequency / random.decades(1.5, 3.3));
    const int n_steps = std::lround(random.uniform(.4, 1.5) * 2. * M_PI / frequency / step);
    SceneText text;
    text.line() << "Gravity = 0, -" << g << "\nStart = undeformed";
    text.line() << "Body pendulum: Type = rigid body; Mass = " << m << "; Centre = " << x << ", "
                << y << ", 0; Moments of inertia = " << short_number(random.uniform(.6, 1.) * I)
                << ", " << short_number(random.uniform(.6, 1.) * I) << ", " << I;
    text.line()
        << "Link hinge: Type = hinge; From = ground; To = pendulum @ 0, 0, 0; Axis = 0, 0, 1";
    for (const auto &[name, direction] : {std::pair("px", "1, 0, 0"), {"py", "0, 1, 0"}})
      text.line() << "Probe " << name << ": Point = pendulum @ " << x << ", " << y
                  << ", 0; Direction = " << direction;
    text.line() << "Time: Step = " << step << "; End = " << n_steps * step;
    // The classical method of Runge and Kutta, whose error is far below the bound.
    double angle = std::atan2(x, -y), rate = 0.;
    const auto acceleration = [&](const double at)
    { return -frequency * frequency * std::sin(at); };
    const int n_fine = 20 * std::max(n_steps, 200);
    const double dt = n_steps * step / n_fine;
    for (int k = 0; k < n_fine; ++k)
    {
      const double a1 = acceleration(angle), v2 = rate + .5 * dt * a1,
                   a2 = acceleration(angle + .5 * dt * rate), v3 = rate + .5 * dt * a2,
                   a3 = acceleration(angle + .5 * dt * v2), v4 = rate + dt * a3,
                   a4 = acceleration(angle + dt * v3);
      angle += dt / 6. * (rate + 2. * v2 + 2. * v3 + v4);
      rate += dt / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
    }
    return {text.text(), {r * std::sin(angle) - x, -r * std::cos(angle) - y}, Kind::places};
  }

  /// Largest difference over the largest size, for places over the largest one so far.
  double error_of_run(const BodyScene &scene, std::string &log)
  {
    std::vector<std::string> entries = {"Output/Field interval=0"};
    if (scene.kind != Kind::places)
      entries.emplace_back("Time/End=0");
    verification::Session session(scene.text + "\n", entries);
    Vector found;
    double scale = verification::largest(scene.expected);
    session.run(
        [&](const taut::StepView &view)
        {
          const Vector &N = view.state.multiplier;
          if (scene.kind == Kind::places)
          {
            found = view.probes;
            scale = std::max(scale, verification::largest(found));
          }
          else if (scene.kind == Kind::sum)
            found = {std::accumulate(N.begin(), N.end(), 0.)};
          else
          {
            found.assign(N.begin(), N.begin() + scene.expected.size());
            for (double &force : found)
              force = std::fabs(force);
          }
        });
    log = session.log();
    double error = 0.;
    for (std::size_t k = 0; k < found.size(); ++k)
      verification::raise(error, found[k] - scene.expected[k]);
    return error / scale;
  }
} // namespace

TEST(HuntOfBodies, no_answer_is_silent_and_wrong)
{
  const char *const given = std::getenv("TAUT_HUNT_BODIES"), *const seeds =
                                                                 std::getenv("TAUT_HUNT_SEED");
  const int n_scenes = given ? std::atoi(given) : 48;
  const unsigned long seed = seeds ? std::strtoul(seeds, nullptr, 10) : 1;
  const std::array<std::pair<const char *, BodyScene (*)(Random &)>, 11> families = {
      {{"cable", cable},
       {"mass on ropes", ropes},
       {"box on stops", box},
       {"string on bumps", string_on_bumps},
       {"pressed block", pressed_block},
       {"block on waves", block_on_waves},
       {"block on crests", block_on_crests},
       {"disc in a bore", disc_in_a_bore},
       {"pin in a hole", pin_in_a_hole},
       {"hinged body", hinged_body},
       {"hinged chain", hinged_chain}}};
  std::map<std::string, std::array<int, 4>> table; // agreed, alarmed, warned or refused, undecided
  int n_agreed = 0, n_alarms = 0, n_decided = 0;
  for (int i = 0; i < n_scenes; ++i)
  {
    Random random(seed * 7919 + i);
    const auto &[name, make] = families[i % families.size()];
    const BodyScene scene = make(random);
    std::array<int, 4> &counts = table[name];
    if (scene.expected.empty())
    {
      ++counts[3];
      continue;
    }
    ++n_decided;
    std::string log;
    double error = 0.;
    const std::string refused = verification::error_of([&] { error = error_of_run(scene, log); });
    const bool agrees = refused.empty() &&
                        error <= (scene.kind == Kind::places ? bound_of_motion : bound),
               is_warned = verification::has(log, "Warning");
    ++counts[agrees ? is_warned : 2];
    n_agreed += agrees;
    n_alarms += agrees && is_warned;
    EXPECT_TRUE(agrees || is_warned || !refused.empty())
        << "scene " << i << ", " << name << ": silent, error " << error << '\n'
        << scene.text;
    if ((!refused.empty() || is_warned) && std::getenv("TAUT_HUNT_VERBOSE"))
      std::printf("%d %s: %s%s\n", i, name, refused.c_str(),
                  is_warned ? log.substr(log.find("Warning")).c_str() : "");
  }
  std::printf("%-16s%10s%10s%20s%12s\n", "family", "agreed", "alarmed", "warned, refused",
              "undecided");
  for (const auto &[name, c] : table)
    std::printf("%-16s%10d%10d%20d%12d\n", name.c_str(), c[0], c[1], c[2], c[3]);
  EXPECT_GE(n_agreed, least_agreed * n_decided);
  EXPECT_LE(n_alarms, most_alarms * n_agreed);
}
