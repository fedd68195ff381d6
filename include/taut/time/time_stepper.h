// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_time_stepper_h
#define taut_time_stepper_h

#include <taut/complementarity/solver.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/certificate.h>
#include <taut/time/integrator.h>
#include <taut/time/matrix_norms.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/state.h>

#include <initializer_list>
#include <memory>
#include <vector>

namespace taut
{
  /**
   * Advances the bodies and the multipliers by fixed steps:
   *
   *     moving rows -> history P^_k -> free motion of the rows -> N -> U_k -> certificate.
   *
   * Everything is in increments, A dU = P^ + B N, and gaps of fixed rows are carried as increments
   * too, because the gap rounds at eps times its size and F^-1 = O(1/step^2) makes force noise of
   * that.
   */
  class TimeStepper
  {
  public:
    /**
     * @p structure and @p rows are kept by reference. @p at_rest says that the start is an
     * equilibrium, so that accelerations are zero; otherwise the first step is the source's, which
     * needs no initial acceleration.
     */
    TimeStepper(const Structure &structure, ContactRows &rows, const SolverParameters &parameters,
                const TimeIntegrator &integrator, double step, Reference reference, State start,
                bool at_rest);

    /// One step. Throws UserError, naming time and row, if the certificate misses the contact
    /// tolerance.
    void advance();

    const State &state() const { return current; }
    const Reference &reference() const { return origin; }
    const Certificate &certificate() const { return last; }
    long n_steps_done() const { return n_steps; }

    /// Form and size of the interface operator, for the log.
    std::string interface_description() const { return schur->description(); }

  private:
    void prepare(const StepCoefficients &c);
    void set_history(std::size_t k);
    void set_free_gaps();
    double moving_gap(std::size_t i) const;
    void share_free_motion();
    void share_motions();
    void share(std::initializer_list<std::vector<double> *> vectors);
    void solve_rows();
    void accept(std::size_t k);
    void update_rows();
    void certify();
    void certify_balance();
    void certify_rows();
    void fail_balance() const;
    void fail(const std::string &what, const std::string &entry = "") const;

    const Structure &structure;
    ContactRows &rows;
    const SolverParameters parameters;
    const TimeIntegrator &integrator;
    const double step;
    const Reference origin;
    State current;
    Certificate last;

    StepCoefficients coefficients;
    bool first_step_by_source;
    long n_steps = 0;
    double start_time = 0.;

    FactoredStructure solvers;
    std::unique_ptr<SchurComplement> schur;
    ComplementaritySolver complementarity;
    MixedComplementarityProblem problem;
    std::vector<double> compliance; ///< S
    std::vector<double>
        link_history; ///< part of a link spring's compression that does not depend on N
    std::vector<double> reference_gap; ///< gap of the fixed rows at the reference
    std::vector<double> gap_terms;     ///< largest terms of the gaps of the fixed rows so far
    /// Of the moving rows: gap of the start minus the one of its displacements, rounding that would
    /// be a force over a small compliance.
    std::vector<double> gap_correction;
    std::vector<double> motion;      ///< B^T dU
    std::vector<double> position;    ///< B^T U, with the reference's of a moving row
    std::vector<double> terms_size;  ///< sum of the absolute terms of these
    std::vector<double> motion_size; ///< what B^T dU rounds with
    std::vector<double> old_multiplier;
    std::vector<std::vector<KindNorm>> norms; ///< of M, C, K of each body
    std::vector<PerKind> reference_force;     ///< largest of K U_ref of each body [N, N m]
    std::vector<PerKind> contact_force;       ///< largest of one row on each body [N, N m]

    BlockVector P; ///< external force minus the reference's [N]
    BlockVector right_hand_side;
    BlockVector lift; ///< increments of moving supports
    BlockVector predictor_v, predictor_a, old_A, old_balance, increment;
    std::vector<double> work;
  };
} // namespace taut

#endif
