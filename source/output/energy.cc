// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/dot.h"
#include "output/total_displacement.h"
#include <taut/base/archive.h>
#include <taut/output/observer.h>
#include <taut/output/table_file.h>
#include <taut/time/integrator.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Writes the energy balance of a run, energy.csv. Energies are those of the state; works are
   * summed since the start [J]:
   *
   *     kinetic + strain + links = start + loads + supports + contacts - damping - link dampers
   *                                - algorithmic.
   *
   * Works use the mean of the forces before and after a step. The algorithmic dissipation follows
   * from the definition of the scheme, dU . M a - (change of kinetic energy) - dU . (mean of the
   * scheme - mean) of the forces, with a the acceleration of its balance. The error of the sum
   * hence shows energy that a step does not explain. Contacts do work where a rigid contact ends an
   * impact, where a force opens or closes within a step, and where a contact slides on a slope.
   */
  class Energy : public Observer
  {
  public:
    std::vector<std::string> files() const override { return {"energy.csv"}; }

    /// Each rank provides its bodies; the root writes, at least run.interval apart [s].
    void begin(const RunView &run) override;

    /// Records the start, then each step.
    void record(const StepView &step) override;

    /// Throws UserError when the disk is full.
    void finish() override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    /// Energies and works of a state, or summed over a run [J].
    struct Balance
    {
      double kinetic = 0., strain = 0., links = 0.;
      double loads = 0., supports = 0., contacts = 0.;
      double damping = 0., link_dampers = 0., algorithmic = 0.;

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        for (double *value : {&kinetic, &strain, &links, &loads, &supports, &contacts, &damping,
                              &link_dampers, &algorithmic})
          archive &*value;
      }
    };

    void begin_balance(const StepView &start);
    void add_bodies(const StepView &step, Balance &share);
    void add_work(const StepView &step, std::size_t k, Balance &share);
    void add_moving_rows(const StepView &step, Balance &share) const;
    void add_row(const StepView &step, std::size_t i, Balance &to) const;
    void keep(const StepView &step);
    void set_forces(const StepView &step);
    void set_prescribed_velocities(const StepView &step, std::size_t k,
                                   std::vector<double> &V) const;
    void write(double time);

    std::unique_ptr<TableFile> file;
    bool has_begun = false;
    double interval = 0., next = 0., start_energy = 0.;
    Balance total;

    std::vector<double> reference_energy;  ///< strain energy of each body of this rank [J]
    BodyVectors CV, balance, impulses;     ///< of the last call
    BodyVectors loads0, CV0, balance0, A0; ///< of the call before
    std::vector<double> N0, gap0;
    std::vector<State::Spring> springs0;
    std::vector<std::vector<Term>> terms0; ///< of varying constraints

    /// Of one call, kept for their memory: forces of constraints; of one body its displacement U
    /// after the step and before it, an acceleration or velocity, products and forces.
    std::vector<double> in_balance, impulsive, U, before, a, product, damping, f;
  };

  namespace
  {
    bool is_mean(const StepView &step, const std::size_t i)
    {
      return step.report.is_mean(i);
    }
  } // namespace

  void Energy::begin(const RunView &run)
  {
    interval = run.interval;
    if (run.communicator.is_root())
      file = std::make_unique<TableFile>(
          run.folder + "/energy.csv",
          std::vector<std::string>{"time [s]", "kinetic [J]", "strain [J]", "links [J]",
                                   "loads [J]", "supports [J]", "contacts [J]", "damping [J]",
                                   "link dampers [J]", "algorithmic [J]", "error [J]"},
          run.resumes);
  }

  void Energy::save(OutputArchive &archive)
  {
    const std::size_t length = file ? file->save() : 0;
    archive << next << start_energy << total << length;
  }

  /// The vectors of the last step follow from its state.
  void Energy::resume(InputArchive &archive, const StepView &step)
  {
    std::size_t length = 0;
    archive >> next >> start_energy >> total >> length;
    if (file)
      file->resume(length);
    CV = balance = impulses = step.structure.zero();
    set_forces(step);
    keep(step);
    has_begun = true;
  }

  void Energy::begin_balance(const StepView &start)
  {
    CV = balance = impulses = start.structure.zero();
    set_forces(start);
    Balance share;
    add_bodies(start, share);
    for (std::size_t i = 0; i < start.constraints.size(); ++i)
      if (start.constraints.is_own(i))
        share.links += start.constraints[i].spring.energy(start.state.springs[i].u);
    double sums[] = {share.kinetic, share.strain, share.links};
    start.structure.communicator().sum(sums, 3);
    total.kinetic = sums[0];
    total.strain = sums[1];
    total.links = sums[2];
    start_energy = total.kinetic + total.strain + total.links;
    keep(start);
    has_begun = true;
    write(start.state.time);
  }

  /// Sets C V, P + B N - C V - K U and impulses of the present state.
  void Energy::set_forces(const StepView &step)
  {
    const State &state = step.state;
    in_balance = state.multiplier;
    impulsive.assign(step.constraints.size(), 0.);
    for (std::size_t i = 0; i < step.constraints.size(); ++i)
      if (is_mean(step, i))
        std::swap(in_balance[i], impulsive[i]);
    for (std::size_t k = 0; k < step.structure.size(); ++k)
    {
      const Substructure &body = step.structure[k];
      CV[k].assign(body.n_dofs(), 0.);
      impulses[k].assign(body.n_dofs(), 0.);
      product = state.V[k];
      set_prescribed_velocities(step, k, product);
      body.damping().vmult_add(1., product.data(), CV[k].data());
      for (std::size_t i = 0; i < CV[k].size(); ++i)
        balance[k][i] = step.loads[k][i] - CV[k][i] - state.KU[k][i];
    }
    step.constraints.add_forces(in_balance, balance);
    step.constraints.add_forces(impulsive, impulses);
  }

  /// The velocities of prescribed motions in the equation of motion, see PrescribedMotions.
  void Energy::set_prescribed_velocities(const StepView &step, const std::size_t k,
                                         std::vector<double> &V) const
  {
    const State &state = step.state;
    if (!(state.last_step > 0.) || !step.structure[k].has_moving_constraints())
      return;
    for (const ConstrainedDof &constraint : step.structure[k].constraints())
      if (const unsigned int i = constraint.dof; constraint.motion)
        V[i] = state.dU[k][i] / state.last_step + .5 * (state.V[k][i] - state.V_old[k][i]);
  }

  void Energy::add_bodies(const StepView &step, Balance &share)
  {
    const State &state = step.state;
    if (reference_energy.empty())
      for (std::size_t k = 0; k < step.structure.size(); ++k)
        reference_energy.push_back(step.structure[k].strain_energy(step.reference.displacement[k]));
    for (std::size_t k = 0; k < step.structure.size(); ++k)
    {
      const Substructure &body = step.structure[k];
      const std::size_t n = body.n_dofs();
      product.assign(n, 0.);
      body.mass().vmult_add(1., state.V[k].data(), product.data());
      share.kinetic += .5 * dot(product, state.V[k]);
      set_total_displacement(step, k, U);
      if (body.is_linear())
      {
        share.strain += reference_energy[k];
        for (std::size_t i = 0; i < n; ++i)
          share.strain += state.U[k][i] * (step.reference.force[k][i] + .5 * state.KU[k][i]);
      }
      else
        share.strain += body.strain_energy(U);
      if (!loads0.empty())
        add_work(step, k, share);
    }
  }

  /// Adds energies given to a body of this rank and taken from it in the last step.
  void Energy::add_work(const StepView &step, const std::size_t k, Balance &share)
  {
    const State &state = step.state;
    const StepCoefficients &c = step.report.method.c;
    const Substructure &body = step.structure[k];
    const std::size_t n = body.n_dofs();
    a.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      a[i] = (1. - c.alpha_m) * state.A[k][i] + c.alpha_m * A0[k][i];
    product.assign(n, 0.);
    body.mass().vmult_add(1., a.data(), product.data());
    const std::vector<double> &dU = state.dU[k];
    damping = CV[k];
    if (step.report.method.corrects_velocities)
    {
      // The equation of motion holds for the velocities before their projection.
      for (std::size_t i = 0; i < n; ++i)
        a[i] = state.V_old[k][i] + state.last_step * state.A[k][i];
      set_prescribed_velocities(step, k, a);
      damping.assign(n, 0.);
      body.damping().vmult_add(1., a.data(), damping.data());
    }
    if (!body.is_linear())
    {
      // Dissipation of the material.
      before = U;
      for (std::size_t i = 0; i < n; ++i)
        before[i] -= dU[i];
      body.mean_internal_force(before, U, state.last_step, f);
      share.damping += dot(f, dU) - (body.strain_energy(U) - body.strain_energy(before));
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      share.loads += (step.reference.force[k][i] + .5 * (loads0[k][i] + step.loads[k][i])) * dU[i];
      share.damping += .5 * (CV0[k][i] + damping[i]) * dU[i];
      share.algorithmic +=
          dU[i] * (product[i] - (.5 - c.alpha_f) * (balance[k][i] - balance0[k][i]));
    }
    for (const ConstrainedDof &constraint : body.constraints())
    {
      const unsigned int i = constraint.dof;
      share.supports += dU[i] * (product[i] - (1. - c.alpha_f) * balance[k][i] -
                                 c.alpha_f * balance0[k][i] - impulses[k][i]);
      if (!constraint.motion)
        continue;
      // Inertia takes its energy from the velocities, which a kink or a jump does not divide as the
      // way.
      const double inertial =
          product[i] * (.5 * state.last_step * (state.V_old[k][i] + state.V[k][i]) - dU[i]);
      share.supports += inertial;
      share.algorithmic += inertial;
    }
  }

  /// Adds the work of sliding and turning constraints on the bodies of this rank.
  void Energy::add_moving_rows(const StepView &step, Balance &share) const
  {
    const State &state = step.state;
    std::size_t k = 0;
    for (const std::size_t i : step.constraints.varying_rows())
    {
      const ConstraintData &constraint = step.constraints[i];
      const double now = state.multiplier[i] * evaluate(constraint.terms, state.dU);
      const double before = N0[i] * evaluate(terms0[k++], state.dU);
      if (!is_mean(step, i))
        share.contacts += .5 * (before + now);
      else if (step.constraints.slides(i) && step.report.method.rules[i].corrected)
        share.contacts += step.report.method.c.alpha_f * before;
    }
  }

  /// Adds springs and dampers of the links, and the work of constraints by their own motions.
  void Energy::add_row(const StepView &step, const std::size_t i, Balance &to) const
  {
    const State &state = step.state;
    const ConstraintData &constraint = step.constraints[i];
    const State::Spring &spring = state.springs[i];
    to.links += constraint.spring.energy(spring.u);
    if (is_mean(step, i))
    {
      // Work on the spring that it does not store is work of the contact.
      const double damper = constraint.spring.damping * spring.du * spring.du / state.last_step;
      if (std::isfinite(damper))
        to.link_dampers += damper;
      to.contacts += step.report.work[i];
      if (!constraint.spring.is_rigid())
        to.contacts +=
            constraint.spring.energy(spring.u) - constraint.spring.energy(springs0[i].u) + damper;
      return;
    }
    const double mean = .5 * (N0[i] + state.multiplier[i]);
    // For a law, forces at the ends of a step do not give the stored work.
    if (constraint.spring.law)
      to.algorithmic += (.5 * (constraint.spring.law->force(springs0[i].u) +
                               constraint.spring.law->force(spring.u)) -
                         constraint.spring.law->mean_force(springs0[i].u, spring.u)) *
                        spring.du;
    if (!constraint.spring.is_rigid())
      to.link_dampers += constraint.spring.damping * .5 * (springs0[i].v + spring.v) * spring.du;
    to.contacts +=
        mean * (step.constraints.is_fixed(i) ? state.complementarity_gap[i] - gap0[i] : spring.du);
  }

  void Energy::keep(const StepView &step)
  {
    const State &state = step.state;
    std::swap(CV, CV0);
    std::swap(balance, balance0);
    if (CV.empty())
      CV = balance = step.structure.zero();
    loads0 = step.loads;
    A0 = state.A;
    N0 = state.multiplier;
    gap0 = state.complementarity_gap;
    springs0 = state.springs;
    const Constraints::Rows varying = step.constraints.varying_rows();
    terms0.resize(varying.size());
    for (std::size_t k = 0; k < terms0.size(); ++k)
      terms0[k] = step.constraints[varying[k]].terms;
  }

  void Energy::record(const StepView &step)
  {
    if (!has_begun)
    {
      begin_balance(step);
      return;
    }
    set_forces(step);
    Balance share;
    add_bodies(step, share);
    add_moving_rows(step, share);
    for (std::size_t i = 0; i < step.constraints.size(); ++i)
      if (step.constraints.is_own(i))
        add_row(step, i, share);
    double sums[] = {share.kinetic,     share.strain,   share.loads,
                     share.supports,    share.contacts, share.damping,
                     share.algorithmic, share.links,    share.link_dampers};
    step.structure.communicator().sum(sums, std::size(sums));
    total.algorithmic += sums[6] - (sums[0] - total.kinetic) + step.report.impulse_work;
    total.kinetic = sums[0];
    total.strain = sums[1];
    total.loads += sums[2];
    total.supports += sums[3];
    total.contacts += sums[4];
    total.damping += sums[5];
    total.links = sums[7];
    total.link_dampers += sums[8];
    keep(step);
    if (step.state.time >= next - 1e-9 * interval)
      write(step.state.time);
  }

  void Energy::write(const double time)
  {
    next = time + interval;
    if (!file)
      return;
    const Balance &b = total;
    const double error = b.kinetic + b.strain + b.links - start_energy - b.loads - b.supports -
                         b.contacts + b.damping + b.link_dampers + b.algorithmic;
    file->begin_line(time);
    *file << b.kinetic << b.strain << b.links << b.loads << b.supports << b.contacts << b.damping
          << b.link_dampers << b.algorithmic << error;
    file->end_line();
  }

  void Energy::finish()
  {
    if (file)
      file->close();
  }

  namespace
  {
    const Register<Observer, Energy>
        register_energy("energy",
                        "energy.csv: kinetic and elastic energy, work of loads, supports "
                        "and contacts, dissipation of dampers and of the time integration, "
                        "and the error of their balance, as often as Interval says");
  }
} // namespace taut
