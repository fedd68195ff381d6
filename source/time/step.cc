// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/step.h"

#include <algorithm>

namespace taut
{
  namespace
  {
    /// Balance above which a step is refined: normal steps are below 1e-11. A repetition gains at
    /// least the six digits that FactoredStructure leaves, or stops: two are enough for
    /// twelve, and one more sees that the error stays.
    constexpr double refined_balance = 1e-10;
    constexpr int most_repetitions = 3;

    /// Most coefficients whose factors are kept, and most DoFs of all of them together: a step that
    /// is halved and doubled again goes between two to four lengths. Factors of solids take some kB
    /// a DoF.
    constexpr std::size_t most_coefficients = 8, most_kept_dofs = 50000;
  } // namespace

  Step::Step(const Structure &structure, const Constraints &constraints,
             const SolverParameters &parameters, const Reference &reference,
             const StepMethod &method, const NonlinearBodies &bodies,
             const TurningConstraints &turning, const State &start)
      : structure(structure), constraints(constraints), parameters(parameters), method(method),
        bodies(bodies), turning(turning),
        own_contacts(structure, constraints, turning, reference, method, start),
        own_history(structure, reference, method),
        own_balance(structure, constraints, reference, method, bodies),
        own_check(structure, constraints, parameters.contact_tolerance)
  {
    structure.communicator().agree([&] { own_history.set_external_forces(start.time); });
    kept.push_back(make_equations());
  }

  Step::ReusedValues Step::make_equations() const
  {
    ReusedValues result{{}, std::make_unique<StepEquations>(structure, constraints, parameters)};
    if (!bodies.indices().empty())
      result.equations->set_nonlinear(bodies.indices(),
                                      [this](const std::size_t k, const int attempt)
                                      { return bodies.tangent(k, attempt); });
    return result;
  }

  /// Tangents and directions belong to a state, and are not kept.
  std::size_t Step::most_kept() const
  {
    const Communicator &processes = structure.communicator();
    if (!turning.empty() || processes.any(!bodies.indices().empty()))
      return 1;
    const double n_dofs = processes.max(static_cast<double>(structure.n_dofs()));
    return std::clamp<std::size_t>(most_kept_dofs / std::max(1., n_dofs), 1, most_coefficients);
  }

  void Step::prepare()
  {
    const StepCoefficients &c = method.c;
    own_contacts.prepare();
    const std::vector<double> &S = own_contacts.compliance();
    const auto is_for = [&](const ReusedValues &one) { return one.is_prepared && one.c == c; };
    const std::size_t most = most_kept();
    auto found = most > 1 ? std::find_if(kept.begin(), kept.end(), is_for) : kept.end();
    const bool is_known = found != kept.end(), goes_on = most > 1 && kept.front().is_prepared;
    if (!is_known && goes_on && kept.size() < most)
      found = kept.insert(kept.end(), make_equations());
    else if (!is_known)
      found = kept.end() - 1;
    std::rotate(kept.begin(), found, found + 1);
    if (is_known)
      equations().set_compliance(S);
    else
    {
      kept.front().is_prepared = false;
      equations().prepare(c, S);
      kept.front() = {c, std::move(kept.front().equations), true};
    }
    if (goes_on)
      equations().start_from(own_contacts.applied().closed);
  }

  void Step::reset()
  {
    earlier = interface_statistics();
    kept.clear();
    kept.push_back(make_equations());
  }

  InterfaceStatistics Step::interface_statistics() const
  {
    InterfaceStatistics result = earlier;
    for (const ReusedValues &one : kept)
      if (one.is_prepared)
        result += one.equations->interface().statistics();
    return result;
  }

  void Step::set_loads(State &before)
  {
    structure.communicator().agree([&] { own_history.set_loads(equations(), before); });
    const std::vector<double> &old = own_contacts.forces_at_previous_place(before);
    if (!old.empty())
      constraints.add_forces(old, own_history.loads());
    own_costs.lap(StepPart::loads);
  }

  void Step::find_increments(State &state, Residuals &residuals)
  {
    own_contacts.set_problem(state, equations(), own_history.loads(), own_history.prescribed());
    own_costs.lap(StepPart::free_gaps);
    if (constraints.n_of_all() > 0 || equations().has_modes())
    {
      const Residuals before = residuals;
      own_contacts.find_multipliers(equations(), own_check, residuals, state);
      residuals.iterations += before.iterations;
      residuals.fallback = residuals.fallback || before.fallback;
    }
    own_costs.lap(StepPart::contacts);
    equations().find_increments(own_contacts.applied().multiplier,
                                own_contacts.applied().mode_amplitude, own_history.increments());
    own_costs.lap(StepPart::bodies);
  }

  void Step::accept(State &state)
  {
    own_history.exchange(state);
    for (std::size_t k = 0; k < structure.size(); ++k)
      own_history.accept(k, state);
    own_contacts.update(state, own_report);
  }

  void Step::accept(State &state, Residuals &residuals)
  {
    own_report.method = method;
    own_report.gains.clear();
    own_history.exchange(state);
    for (std::size_t k = 0; k < structure.size(); ++k)
      own_history.accept(k, state);
    measure_balance(state, residuals);
    own_contacts.update(state, own_report);
    own_costs.lap(StepPart::state);
  }

  void Step::measure_balance(State &state, Residuals &residuals)
  {
    structure.communicator().agree(
        [&]
        {
          if (!method.c.is_at_rest())
            own_history.prescribed().impose_velocities_of_step(state);
          own_balance.measure(own_history.forces(), own_contacts.in_balance(),
                              own_contacts.impulsive(), state);
          if (!method.c.is_at_rest())
            own_history.prescribed().impose_velocities(state);
        });
    residuals.balance = structure.communicator().max(own_balance.residual());
  }

  bool Step::correct(State &state, const BodyVectors &on_modes)
  {
    if (!own_contacts.correct(state, equations(), own_history.loads(), on_modes))
      return false;
    equations().find_increments(own_contacts.corrections().multiplier,
                                own_contacts.corrections().mode_amplitude,
                                own_history.increments());
    own_history.add_correction(state);
    own_contacts.add_correction(own_history.increments(), state);
    return true;
  }

  /// Iterative refinement: a large increment against the final displacement loses digits by
  /// cancellation. False if digits were not lost so, on any rank, or the constraints have no
  /// solution. An equilibrium is refined by its search.
  bool Step::refine(State &state)
  {
    if (method.has_means() || method.c.is_at_rest() ||
        structure.communicator().any(!own_balance.is_cancellation()))
      return false;
    own_history.set_lacking(equations(), state);
    return correct(state, own_history.loads());
  }

  void Step::certify(State &state, Residuals &residuals)
  {
    for (int refinements = 0;
         residuals.balance > refined_balance && refinements < most_repetitions && refine(state);
         ++refinements)
      measure_balance(state, residuals);
    residuals.worst_body = own_balance.worst_body();
    std::size_t worst = no_link;
    residuals.complementarity = own_contacts.residual(state, equations(), worst);
    residuals.worst_constraint = constraints.number_of_first(worst);
    residuals.drift = own_contacts.drift(state);
    own_check.check_constraints(residuals,
                                equations().repeated_rows().partners(residuals.worst_constraint));
    own_check.check_balance(residuals, own_balance.residual());
    own_costs.lap(StepPart::residuals);
  }
} // namespace taut
