// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/choose_scheme.h"
#include "base/dot.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/interface/constraints.h>
#include <taut/substructure/factored_structure.h>
#include <taut/time/integrator.h>
#include <taut/time/step_parameters.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace taut
{
  /**
   * The largest natural frequency of the bodies with their elastic constraints closed in their
   * present places [rad/s]. Rigid constraints, which can only lower it, are left out; massless DoFs
   * are held. Power iteration gives a lower bound, short by a few hundredths at most. 0 without
   * bodies that have mass and stiffness. Called by all ranks together.
   */
  double largest_frequency(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters);

  namespace
  {
    /// Relative change of Rayleigh quotients that ends the iteration [1]. Where the error falls
    /// with 1 / n as below, it is then the root of 1e-5 log(N): 1.2 % of the quotient with 1e6
    /// DoFs.
    constexpr double same_quotient = 1e-5;
    /// After n iterations from any vector of N DoFs the mean error of the quotient is at most
    /// log(N) / n, half of it for the frequency: 2 % with 1e6 DoFs.
    constexpr unsigned int most_power_iterations = 400;

    /// Y = K X, including springs of elastic constraints.
    void multiply_with_springs(const Structure &structure, const Constraints &constraints,
                               const BodyVectors &X, BodyVectors &Y)
    {
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        Y[k].assign(X[k].size(), 0.);
        structure[k].stiffness().vmult_add(1., X[k].data(), Y[k].data());
      }
      const std::vector<double> motions = constraints.motions(X);
      for (std::size_t i = 0; i < constraints.size(); ++i)
        if (!constraints[i].spring.is_rigid())
          for (const Term &term : constraints[i].terms)
            term.form.add_to(constraints[i].spring.stiffness * motions[i], Y[term.substructure]);
    }
  } // namespace

  double largest_frequency(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters)
  {
    const Communicator &processes = structure.communicator();
    FactoredStructure masses(structure, parameters.local_solver);
    processes.agree([&] { masses.factor_mass(); });
    BodyVectors X = structure.zero(), Y = X;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::mt19937 generator(static_cast<unsigned int>(structure.number(k)) + 1);
      for (double &x : Y[k])
        x = std::uniform_real_distribution<>(-1., 1.)(generator);
    }
    masses.solve(Y);
    double quotient = 0.;
    for (unsigned int n = 0; n < most_power_iterations; ++n)
    {
      // Y = M^-1 K X, and X^T K X over X^T M X with X of length 1.
      std::vector<double> products(1, 0.);
      for (std::size_t k = 0; k < structure.size(); ++k)
        products[0] += dot(Y[k], Y[k]);
      processes.sum(products);
      if (!(products[0] > 0.))
        return 0.;
      for (std::size_t k = 0; k < structure.size(); ++k)
        for (std::size_t i = 0; i < X[k].size(); ++i)
          X[k][i] = Y[k][i] / std::sqrt(products[0]);
      multiply_with_springs(structure, constraints, X, Y);
      std::vector<double> energies(2, 0.);
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        std::vector<double> MX(X[k].size(), 0.);
        structure[k].mass().vmult_add(1., X[k].data(), MX.data());
        energies[0] += dot(X[k], Y[k]);
        energies[1] += dot(X[k], MX);
      }
      processes.sum(energies);
      const double before = quotient;
      quotient = energies[0] / energies[1];
      if (std::fabs(quotient - before) <= same_quotient * quotient && n > 0)
        break;
      masses.solve(Y);
    }
    return std::sqrt(quotient);
  }

  namespace
  {
    /// Safety factor of the longest stable step: largest_frequency() is a lower bound, short by
    /// about 2 % with 1e6 DoFs, see most_power_iterations.
    constexpr double surely_stable = .98;

    /// Not 0 for each constraint that acts on elements, and not on lumped masses alone.
    std::vector<double> rows_on_elements(const Structure &structure, const Constraints &constraints)
    {
      std::vector<double> result(constraints.size(), 0.);
      for (std::size_t i = 0; i < constraints.size(); ++i)
        for (const Term &term : constraints[i].terms)
          result[i] += !structure[term.substructure].is_lumped();
      constraints.sum(result);
      return result;
    }

    /// Number of the first row of any rank with this property; no_link: none.
    std::size_t first_row_that(const Constraints &constraints,
                               const std::function<bool(std::size_t)> &is_so)
    {
      std::size_t i = 0;
      while (i < constraints.size() && !is_so(i))
        ++i;
      return constraints.number_of_first(i);
    }

    void check_restitution(const Structure &structure, const Constraints &constraints)
    {
      const std::vector<double> on_elements = rows_on_elements(structure, constraints);
      const std::string entry = "Time/Moreau-Jean/Restitution";
      const auto is_rigid = [&](const std::size_t i)
      { return constraints[i].cone.may_open() && constraints[i].spring.is_rigid(); };
      const std::size_t on_body = first_row_that(constraints, [&](const std::size_t i)
                                                 { return is_rigid(i) && on_elements[i] > 0.; });
      if (on_body != no_link)
        throw EntryError(entry, "an elastic body rebounds by its own waves, and with restitution "
                                "its node would bounce at the rigid link '" +
                                    constraints.name(on_body) + "'. Set it to 0");
      if (first_row_that(constraints, is_rigid) == no_link)
        throw EntryError(entry, "restitution is a law of rigid unilateral links, and the scene has "
                                "none. Set it to 0, or remove the Stiffness of a link");
    }

    /// Name of a body of any rank with this property; empty: none.
    std::string body_that(const Structure &structure,
                          const std::function<bool(const Substructure &)> &is_so)
    {
      double index = -1.;
      for (std::size_t k = 0; k < structure.size(); ++k)
        if (is_so(structure[k]))
          index = structure.number(k);
      index = structure.communicator().max(index);
      return index < 0. ? "" : structure.all_bodies()[static_cast<std::size_t>(index)].name;
    }

    std::string body_without_definite_mass(const Structure &structure)
    {
      return body_that(structure,
                       [](const Substructure &body) { return !body.has_definite_mass(); });
    }

    std::size_t link_with_law(const Constraints &constraints)
    {
      return first_row_that(constraints, [&](const std::size_t i)
                            { return constraints[i].spring.law != nullptr; });
    }

    std::string nonlinear_body(const Structure &structure)
    {
      return body_that(structure, [](const Substructure &body) { return !body.is_linear(); });
    }
  } // namespace

  SchemeChoice choose_scheme(const Structure &structure, const Constraints &constraints,
                             const ContactResolution &resolution, const double restitution)
  {
    const std::size_t unresolved = resolution.first_unresolved();
    const bool all_resolved = unresolved == no_link;
    const std::string of_unresolved = constraints.name(unresolved);
    if (restitution > 0.)
      check_restitution(structure, constraints);
    const std::string nonlinear = nonlinear_body(structure);
    const std::size_t law = link_with_law(constraints);
    const Constraints::Rows turning = constraints.turning_rows();
    if (all_resolved && nonlinear.empty() && law == no_link && turning.empty())
      return {"generalised-alpha",
              {{"Generalised-alpha/Spectral radius", "0.8"}},
              "no unilateral link is stiffer than the bodies in one step"};
    const std::string reason =
        !nonlinear.empty() && all_resolved
            ? "body '" + nonlinear +
                  "' moves by large amounts, and the mean forces of this scheme keep its energy"
        : all_resolved && !turning.empty()
            ? "link '" + constraints[turning.front()].name +
                  "' turns, and the mean forces of this scheme keep the energy"
        : all_resolved ? "link '" + constraints.name(law) +
                             "' follows a law that is not linear, and the mean forces of this "
                             "scheme keep its energy"
        : resolution.is_unresolved_rigid()
            ? "unilateral link '" + of_unresolved +
                  "' acts as rigid: it is stiffer than the bodies in one step"
            : "a step does not resolve the impacts at unilateral link '" + of_unresolved + "'";
    const std::string body = body_without_definite_mass(structure);
    if (!body.empty() && !turning.empty())
      throw EntryError("Time/Scheme",
                       "link '" + constraints[turning.front()].name +
                           "' turns, and that needs mass matrices "
                           "that can be inverted; that of body '" +
                           body + "' is 'reduced'. Take another Mass matrix, or 'backward Euler'");
    if (body.empty())
    {
      const std::string without_loss =
          to_text(std::setprecision(std::numeric_limits<double>::max_digits10), restitution);
      return {"Moreau-Jean",
              {{"Moreau-Jean/Theta", "0.5"},
               {"Moreau-Jean/Conditions", "gaps then velocities"},
               {"Moreau-Jean/Restitution", without_loss}},
              reason};
    }
    if (restitution > 0.)
      throw EntryError("Time/Moreau-Jean/Restitution",
                       "restitution needs a mass matrix that can be inverted, and that of body '" +
                           body + "' is 'reduced'. Set it to 0, or take another Mass matrix");
    return {"Moreau-Jean",
            {{"Moreau-Jean/Theta", "0.5"}, {"Moreau-Jean/Conditions", "gaps"}},
            reason + ", and the mass matrix of '" + body + "', 'reduced', has no inverse"};
  }

  namespace
  {
    const std::string anyway = ", or set 'Time/Allow unsuitable scheme'";

    void check_stability(const TimeIntegrator &integrator, const Structure &structure,
                         const Constraints &constraints, const SolverParameters &parameters,
                         const double step)
    {
      const double limit = integrator.largest_stable_frequency(step);
      if (std::isinf(limit) || !body_without_definite_mass(structure).empty())
        return;
      const double largest = largest_frequency(structure, constraints, parameters);
      if (largest <= surely_stable * limit)
        return;
      throw EntryError("Time/Step",
                       to_text(std::setprecision(3), integrator.description(),
                               " is stable for steps up to ",
                               surely_stable * limit * step / largest,
                               " s here, as bodies and links have frequencies up to ", largest,
                               " rad/s. Take such a step, larger elements, or a scheme that is "
                               "stable at every step, as Newmark with a Beta of at least Gamma / 2",
                               anyway));
    }
  } // namespace

  void check_scheme(const TimeIntegrator &integrator, const Structure &structure,
                    const Constraints &constraints,
                    const std::function<const ContactResolution &()> &resolution,
                    const SolverParameters &parameters, const double step)
  {
    check_stability(integrator, structure, constraints, parameters, step);
    const StepCoefficients c = integrator.coefficients(step);
    const std::vector<char> without_mass = constraints.without_mass();
    const bool has_means = integrator.internal_forces() == ForceTime::mean;
    const auto check_row = [&](const std::size_t i)
    {
      if (without_mass[i] && c.alpha_f == .5)
        throw EntryError("Time/Mass redistribution",
                         "Moreau-Jean with conditions on velocities and Theta 1/2 never damps the "
                         "force of a node without mass, here at link '" +
                             constraints[i].name + "'; take other Conditions, Theta > 1/2" +
                             anyway);
      if (constraints.slides(i) && constraints[i].spring.is_rigid())
        throw EntryError("Time/Moreau-Jean/Conditions",
                         "conditions on velocities let the gap of a moving rigid contact drift, "
                         "here of '" +
                             constraints[i].name + "'; take 'gaps then velocities'" + anyway);
    };
    structure.communicator().agree(
        [&]
        {
          for (std::size_t i = 0;
               integrator.rule(RowTraits()).is_on_velocity() && i < constraints.size(); ++i)
            check_row(i);
        });
    if (has_means || !c.rings())
      return;
    const std::string nonlinear = nonlinear_body(structure);
    if (!nonlinear.empty())
      throw EntryError("Time/Scheme",
                       integrator.description() + " gains energy in large motions, here of body '" +
                           nonlinear + "'. Take 'automatic', 'Moreau-Jean' or 'backward Euler'" +
                           anyway);
    if (!constraints.turning_rows().empty())
      throw EntryError("Time/Scheme", integrator.description() + " gains energy where link '" +
                                          constraints[constraints.turning_rows().front()].name +
                                          "' turns. Take 'automatic' or 'backward Euler'" + anyway);
    const std::size_t rigid = resolution().first_rigid(); // by all ranks together
    if (rigid == no_link)
      return;
    throw EntryError(
        "Time/Scheme",
        to_text(integrator.description(), " fails at unilateral links that act as rigid, here '",
                constraints.name(rigid), "': an error of its force keeps ", c.ringing(),
                " of itself from step to step, so that it rings. Take 'automatic' or more "
                "dissipation, give the link a Stiffness, set 'Time/Mass redistribution'",
                anyway));
  }

  void check_mass(const TimeIntegrator &integrator, const Structure &structure)
  {
    if (!integrator.rule(RowTraits()).corrected)
      return;
    const std::string body = body_without_definite_mass(structure);
    if (!body.empty())
      throw EntryError("Time/Moreau-Jean/Conditions",
                       "'gaps then velocities' needs mass matrices that can be inverted, and that "
                       "of body '" +
                           body + "' is 'reduced'; take 'gaps', or another Mass matrix");
  }
} // namespace taut
