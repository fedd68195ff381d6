// SPDX-License-Identifier: LGPL-2.1-or-later
// An elastic plate in plane strain with a clamped edge and a hanging node, as any program of
// deal.II assembles it, and a beam of Taut whose tip presses on it: agrees with a Newmark loop of
// the whole, with the contact as a spring.
#include "plate.h"

#include <taut/substructure/fe_body.h>
#include <taut/time/stepper.h>
#include <taut/wire/wire_component.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <cstdio>

using namespace dealii;

int main()
{
  const Plate plate;
  taut::Wire wire;
  wire.name = "beam";
  wire.a = {0., 1.};
  wire.b = {2., 1.};
  wire.mass_per_length = 5.;
  wire.transverse = taut::TransverseKind::beam;
  wire.bending_stiffness = 2e4;
  wire.element_size = .25;
  wire.weight = false;
  wire.damping.stiffness = 1e-3;
  taut::Support clamp;
  clamp.positions = {0.};
  taut::Support slope = clamp;
  slope.motion = taut::WireMotion::slope;
  const double stiffness = 1e5, step = 1e-3, end = .2;
  const auto pull = [](const double t) { return -200. * (1. - std::cos(20. * t)) - 500. * t; };
  taut::Load load;
  load.direction = {0., 1.};
  load.target.position = 2.;
  load.magnitude = taut::Expression("-200*(1-cos(20*t))-500*t", "load");

  taut::System system;
  const auto beam = system.add(
      "beam",
      [&] {
        return taut::make_wire(wire, taut::WireMotion::transverse, {clamp, slope}, {}, {load});
      });
  const auto body =
      system.add("plate",
                 [&]
                 {
                   return std::make_unique<taut::FEBody<2>>("plate", plate.dofs, plate.M, plate.C,
                                                            plate.K, plate.constraints);
                 });
  const taut::Displacement tip = system.displacement(beam, {2.}, {0., 1.}),
                           corner = system.displacement(body, {2., 1.}, {0., 1.});
  const auto contact =
      system.add(taut::Constraint::unilateral("contact", tip, corner).stiffness(stiffness));
  taut::StepperOptions options;
  options.scheme = "Newmark";
  options.step = step;
  options.allow_unsuitable_scheme = true;
  taut::Stepper stepper(system, options);

  // The whole as one dense system: matrices of both, the contact as a spring that is always there.
  const unsigned int nb = system.body(beam)->n_dofs(), n = nb + system.body(body)->n_dofs();
  FullMatrix<double> M(n), C(n), K(n), A(n), inverse(n);
  Vector<double> b(n), P(n), U(n), V(n), acceleration(n);
  for (unsigned int k = 0; k < 2; ++k)
  {
    const taut::Substructure &s = *system.body(k);
    const unsigned int first = k == 0 ? 0 : nb;
    const auto copy = [&](FullMatrix<double> &target)
    {
      return [&target, first](unsigned int i, unsigned int j, double v)
      { target(first + i, first + j) = target(first + j, first + i) = v; };
    };
    s.mass().visit(copy(M));
    s.damping().visit(copy(C));
    s.stiffness().visit(copy(K));
    for (const taut::Term &term : k == 0 ? tip : corner)
      for (unsigned int j = 0; j < term.form.index.size(); ++j)
        b[first + term.form.index[j]] += (k == 0 ? 1. : -1.) * term.form.value[j];
  }
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      K(i, j) += stiffness * b[i] * b[j];
  A.copy_from(K);
  A.add(4. / (step * step), M, 2. / step, C);
  for (unsigned int k = 0; k < 2; ++k)
    for (const unsigned int dof : system.body(k)->constrained_dofs())
    {
      const unsigned int i = dof + (k == 0 ? 0 : nb);
      for (unsigned int j = 0; j < n; ++j)
        A(i, j) = A(j, i) = i == j;
    }
  inverse.invert(A);

  double error = 0., largest = 0., least_force = 1e9;
  std::FILE *const table = std::fopen("plate.csv", "w");
  std::fprintf(table, "time [s],corner [m]\n");
  while (stepper.time() < end - .5 * step)
  {
    stepper.advance();
    for (unsigned int i = 0; i < nb; ++i) // the tip of the beam is its last node
      P[i] = i == nb - 2 ? pull(stepper.time()) : 0.;
    Vector<double> right(P), a(n), v(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      a[i] = 4. / (step * step) * U[i] + 4. / step * V[i] + acceleration[i];
      v[i] = 2. / step * U[i] + V[i];
    }
    M.vmult_add(right, a);
    C.vmult_add(right, v);
    for (unsigned int k = 0; k < 2; ++k)
      for (const unsigned int dof : system.body(k)->constrained_dofs())
        right[dof + (k == 0 ? 0 : nb)] = 0.;
    inverse.vmult(U, right);
    for (unsigned int i = 0; i < n; ++i)
    {
      acceleration[i] = 4. / (step * step) * U[i] - a[i];
      V[i] = 2. / step * U[i] - v[i];
    }
    const double own = stepper.displacement(corner);
    std::fprintf(table, "%.3f,%.15e\n", stepper.time(), own);
    double other = 0.;
    for (unsigned int i = nb; i < n; ++i)
      other -= b[i] * U[i];
    error = std::fmax(error, std::fabs(own - other));
    largest = std::fmax(largest, std::fabs(own));
    least_force = std::fmin(least_force, stepper.multiplier(contact));
  }
  std::fclose(table);
  system.body(body)->write_vtu("plate.vtu", stepper.displacement(body));
  std::printf("corner %.6e m, differs by %.1e of it; force at least %.3f N; certificate %.1e\n",
              largest, error / largest, least_force, stepper.residuals().max());
  return error < 1e-9 * largest && least_force > 0. && stepper.residuals().max() < 1e-9 ? 0 : 1;
}
