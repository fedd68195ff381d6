// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the elastic bar that bounces on a rigid floor touches it when the exact solution does,
// with its force and its energy, to rounding: fronts cross an element a step undistorted, and mean
// forces close gaps at the end of the step. Rounding grows fivefold from contact to contact,
// because a front of the wave arrives at the foot in each touch; the same recurrence with 113 bits
// stays exact through all twenty contacts. Source: D. Doyen, A. Ern, S. Piperno, SIAM J. Sci.
// Comput. 33 (2011), 223-249: a period of 16/3 s, contacts at 1 .. 5/3 and 11/3 .. 13/3 s of each,
// force between 300 and 500 N.
#include "scene_tests.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

using namespace verification;

namespace
{
  constexpr double period = 16. / 3.;
  constexpr std::size_t n_contacts = 20;

  /// A step with a force acts from `begin` to `end`.
  struct Contact
  {
    double begin = 0., end = 0., impulse = 0., largest = 0.;
  };

  /// Largest errors of some contacts: of begin and end [s], of the mean force, 400 N; and the
  /// largest force over the exact one, 500 N.
  struct Errors
  {
    double time = 0., mean = 0., peak = 0.;
  };

  /// The contacts of a run, one in each half of a period.
  class Contacts
  {
  public:
    explicit Contacts(const double step) : step(step), contacts(n_contacts) {}

    /// Mean force N of the step that ends at t.
    void record(const double t, const double N)
    {
      constexpr double grazing = 20.; // of 300 to 500 N
      const auto index = static_cast<std::size_t>(2. * (t - .5 * step) / period);
      if (!(N > grazing) || index >= contacts.size())
        return;
      Contact &c = contacts[index];
      if (c.impulse == 0.)
        c.begin = t - step;
      c.end = t;
      c.impulse += N * step;
      c.largest = std::max(c.largest, N);
    }

    /// Of contacts 1 to @p n.
    Errors errors(const std::size_t n) const
    {
      Errors e;
      for (std::size_t i = 0; i < n; ++i)
      {
        const Contact &c = contacts[i];
        const double begin = (i / 2) * period + (i % 2 == 0 ? 1. : 11. / 3.);
        raise(e.time, c.begin - begin);
        raise(e.time, c.end - begin - 2. / 3.);
        raise(e.mean, c.impulse / (c.end - c.begin) / 400. - 1.);
        raise(e.peak, c.largest / 500.);
      }
      return e;
    }

  private:
    double step;
    std::vector<Contact> contacts;
  };

  /// Kinetic, elastic and potential energy of the first body; displacements count from the
  /// undeformed bar.
  double energy(const taut::StepView &view)
  {
    std::vector<double> P;
    view.structure[0].external_force(0., P);
    double sum = energy_of_bodies(view.structure, view.state);
    for (std::size_t i = 0; i < P.size(); ++i)
      sum -= P[i] * view.state.U[0][i];
    return sum;
  }

  void report(const std::string &name, const Contacts &contacts)
  {
    for (const std::size_t n : {std::size_t(1), std::size_t(10), n_contacts})
    {
      const std::string of =
          "bouncing bar, " + name + ", contacts 1 to " + std::to_string(n) + ", ";
      const Errors e = contacts.errors(n);
      figure(of + "largest error of a time", e.time, "s");
      figure(of + "largest error of a mean force", e.mean);
      figure(of + "largest force over 500 N", e.peak);
    }
  }

  /// The same steps written out for this bar, in any arithmetic: midpoint rule in time and in each
  /// element, step = element / wave speed, so that M / step + step K / 4 is diagonal.
  template <typename Real>
  Contacts recurrence(const unsigned int n_elements)
  {
    const Real h = Real(10) / n_elements, step = h / 30, m = h / 4, k = 900 / h, weight = 10 * h;
    std::vector<Real> u(n_elements + 1, Real(0)), v = u, r = u, e(n_elements);
    Contacts contacts(static_cast<double>(step));
    const auto n_steps = static_cast<long>(53.34 / static_cast<double>(step));
    for (long i = 1; i <= n_steps; ++i)
    {
      for (Real &x : r)
        x = -weight;
      r.front() = r.back() = -weight / 2;
      for (unsigned int j = 0; j < n_elements; ++j)
      {
        const Real inertia = m / step * (v[j] + v[j + 1]);
        const Real force = k * (u[j + 1] - u[j] + step / 4 * (v[j + 1] - v[j]));
        r[j] += inertia + force;
        r[j + 1] += inertia - force;
      }
      for (unsigned int j = 0; j <= n_elements; ++j)
        r[j] /= j == 0 || j == n_elements ? 15 : 30;
      const Real gap = u[0] + 5 + step / 2 * (v[0] + r[0]);
      const Real N = gap < 0 ? Real(-gap * 30 / step) : Real(0);
      r[0] += N / 15;
      for (unsigned int j = 0; j <= n_elements; ++j)
        u[j] += step / 2 * (v[j] + r[j]);
      v.swap(r);
      contacts.record(i * static_cast<double>(step), static_cast<double>(N));
    }
    return contacts;
  }
} // namespace

TEST(BouncingBar, contacts_force_and_energy_are_exact_for_ten_contacts)
{
  for (const int n_elements : {400, 250})
  {
    const double step = 10. / n_elements / 30.;
    Contacts contacts(step);
    double first_energy = 0., last_energy = 0., least_gap = 0.;
    run_scene(
        scene_file("bouncing_bar"),
        {"Network.Wire bar.Element size=" + number(10. / n_elements), "Time.Step=" + number(step)},
        [&](const taut::StepView &view)
        {
          const double t = view.state.time;
          if (t == 0.)
            first_energy = energy(view);
          if (t <= 10. * period)
            last_energy = energy(view);
          least_gap = std::min(least_gap, view.state.distance[0]);
          contacts.record(t, view.state.multiplier[0]);
        });
    const double potential = 10. * 10. * 5., change = (last_energy - first_energy) / potential;
    const std::string name = std::to_string(n_elements) + " elements";
    report(name, contacts);
    figure("bouncing bar, " + name + ", change of energy in ten periods over that of the fall",
           change);
    const Errors ten = contacts.errors(10), all = contacts.errors(20);
    EXPECT_LT(ten.time, 1e-9) << name;
    EXPECT_LT(ten.mean, 1e-4) << name;
    EXPECT_LT(ten.peak, 1.001) << name;
    EXPECT_GT(ten.peak, .998) << name;
    // Contacts 11 to 20: what rounding has grown to by then.
    EXPECT_LT(all.time, .01 * period) << name;
    EXPECT_LT(all.mean, .05) << name;
    EXPECT_LT(all.peak, 1.25) << name;
    EXPECT_LT(change, 1e-10) << name;
    EXPECT_GT(change, -.01) << name;
    EXPECT_GT(least_gap, -1e-13) << name;
  }
}

TEST(BouncingBar, late_peaks_are_rounding)
{
  using Quadruple = boost::multiprecision::cpp_bin_float_quad;
  const Contacts twice = recurrence<double>(100), four_times = recurrence<Quadruple>(100);
  report("recurrence in double precision", twice);
  report("recurrence in quadruple precision", four_times);
  const Errors exact = four_times.errors(20);
  EXPECT_LT(twice.errors(10).time, 1e-9);
  EXPECT_LT(exact.time, 1e-9);
  EXPECT_LT(exact.mean, 1e-9);
  EXPECT_LT(exact.peak, 1.);
  EXPECT_GT(exact.peak, .99);
}
