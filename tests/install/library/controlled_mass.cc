// SPDX-License-Identifier: LGPL-2.1-or-later
// A mass above a rigid stop, stepped by hand and held by a controller of another program: it lets
// the mass come to rest 0.1 m above the stop after it has touched it.
#include <taut/time/stepper.h>

#include <cmath>
#include <cstdio>

namespace
{
  class Mass : public taut::Substructure
  {
  public:
    Mass(const double mass, const double &force) : Substructure("mass")
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(1);
      M->add(0, 0, mass);
      constant_force = {-9.81 * mass};
      taut::LinearForm one;
      one.add(0, 1.);
      time_loads.push_back(std::make_unique<taut::PointLoad>(one, [&](double) { return force; }));
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
} // namespace

int main()
{
  double force = 0.; // what the controller sets
  taut::System system;
  const auto mass = system.add("mass", [&] { return std::make_unique<Mass>(2., force); });
  const taut::Displacement height = system.displacement(mass, {}, {0., 1., 0.});
  const auto stop = system.add(taut::Constraint::unilateral("stop", height).gap(.2));

  taut::StepperOptions options;
  options.start = taut::Start::undeformed;
  taut::Stepper stepper(system, options);
  double largest = 0.;
  while (stepper.time() < 3.)
  {
    stepper.advance();
    largest = std::fmax(largest, stepper.multiplier(stop));
    if (stepper.time() > .5)
      force =
          2. * 9.81 - 400. * (stepper.displacement(height) + .1) - 40. * stepper.velocity(height);
  }
  const double rest = stepper.displacement(height);
  std::printf("%s: %.9f m, certificate %.1e\n", stepper.scheme().c_str(), rest,
              stepper.residuals().max());
  return std::fabs(rest + .1) < 1e-6 && largest > 0. && stepper.residuals().max() < 1e-10 ? 0 : 1;
}
