// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_energy_h
#define taut_energy_h

#include <taut/output/observer.h>
#include <taut/output/table_file.h>
#include <taut/time/integrator.h>

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
    void add_rows(const StepView &step);
    void keep(const StepView &step);
    void set_forces(const StepView &step);
    void set_prescribed_velocities(const StepView &step, std::size_t k,
                                   std::vector<double> &V) const;
    void write(double time);

    std::unique_ptr<TableFile> file;
    bool has_begun = false;
    double interval = 0., next = 0., start_energy = 0.;
    Balance total;

    std::vector<double> reference_energy; ///< strain energy of each body of this rank [J]
    BodyVectors P, CV, balance, impulses; ///< of the last call
    BodyVectors P0, CV0, balance0, A0;    ///< of the call before
    std::vector<double> N0, gap0;
    std::vector<State::Spring> springs0;
    std::vector<std::vector<Term>> terms0; ///< of varying constraints

    /// Of one call, kept for their memory: forces of constraints; of one body its displacement U
    /// after the step and before it, an acceleration or velocity, products and forces.
    std::vector<double> in_balance, impulsive, U, before, a, product, damping, f;
  };
} // namespace taut

#endif
