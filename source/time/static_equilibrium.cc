// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/static_step.h"
#include "time/turning_at_rest.h"

#include "base/newton_search.h"
#include "base/text.h"
#include "time/matrix_norms.h"
#include "time/nonlinear_bodies.h"
#include <taut/base/exceptions.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace taut
{
  namespace
  {
    /// Of the change of the displacements, relative to themselves: 1e-12 is some thousand
    /// roundings. Changes up to 1e-7 that five iterations do not halve count as rounding, and the
    /// certificate of the state measures what they leave: rigid bodies, whose tangent leaves a part
    /// out, may converge by a tenth in each.
    constexpr NewtonConvergence::Limits limits = {1e-12, 1e-7, 5, 500};

    /// Displacements count as this part of the longest link that turns at least: where a structure
    /// is at rest as it is made, they are nothing but rounding. That is 1e-16 of a length, and so
    /// 1e-13 of this part, below the limit of convergence.
    constexpr double least_part_of_links = 1e-3;

    /// The same with bodies that are softer than their own, as a start for the next search: its
    /// bodies are up to ten times as stiff, so that more digits of the start would be lost again.
    constexpr NewtonConvergence::Limits rough = {1e-3, 1e-3, 1, 500};

    /// Iterations: with full steps first, then with a line search. Near a solution full steps
    /// double the digits, and five give all of them; the others are for the way. More full steps
    /// would delay the line search where they end nowhere.
    constexpr int most_full_steps = 20, most_iterations = 1000;

    /**
     * Newton's method with the complementarity problem solved exactly in each iteration (N. H.
     * Josephy, 1979), with full steps; if that ends nowhere, or where a tangent is not definite,
     * with an axial stiffness that rises by factors of ten from 2 to 20 times the load; then with a
     * line search on the energy and tangents that are made definite. An equilibrium whose own
     * tangent is not definite is none that a structure stays in.
     */
    class NonlinearEquilibrium : private DescentProblem
    {
    public:
      NonlinearEquilibrium(const Structure &structure, const Constraints &constraints,
                           const SolverParameters &parameters, const double t)
          : structure(structure), constraints(constraints), parameters(parameters), time(t),
            soft(structure), load(sum_of_loads()), turning(structure, constraints, load),
            start(structure.zero()), motion_of_body(structure.all_bodies().size(), 0.)
      {
      }

      StaticState find()
      {
        const BodyVectors undeformed = start;
        if (is_found([&] { return search.find(*this); }))
          return state;
        if (find_start() && (is_found([&] { return search.find(*this); }) || descends()))
          return state;
        start = undeformed;
        if (!descends())
          fail();
        return state;
      }

    private:
      /// Starts from the displacements with softer bodies; false if there are none, or no such
      /// displacements.
      bool find_start()
      {
        const double EA = structure.communicator().max(structure.largest_axial_stiffness());
        const NewtonSearch roughly(rough, most_full_steps, most_iterations);
        bool result = false;
        is_rough = true;
        // One that is not found is left out: the next one may be within reach.
        for (const double limit : SlenderBody::softer_axial_stiffnesses(EA, load))
        {
          soft = structure;
          structure.communicator().agree([&] { soft.limit_axial_stiffness(limit); });
          if (is_found([&] { return roughly.find(*this); }) ||
              is_found([&] { return roughly.descend(*this); }))
          {
            start = state.displacement;
            result = true;
          }
        }
        is_rough = false;
        soft = structure;
        return result;
      }

      /// [N]
      double sum_of_loads() const
      {
        double sum = 0.;
        structure.communicator().agree(
            [&]
            {
              std::vector<double> P;
              for (std::size_t k = 0; k < structure.size(); ++k)
              {
                structure[k].external_force(time, P);
                for (std::size_t i = 0; i < P.size(); ++i)
                  if (structure[k].kind(i) == 0)
                    sum += std::fabs(P[i]);
              }
            });
        structure.communicator().sum(&sum, 1);
        return sum;
      }

      /// Directions of links that are far from those at rest may have no solution, which is no
      /// error of the user.
      bool is_found(const std::function<bool()> &search_once) const
      {
        if (turning.empty())
          return search_once();
        try
        {
          return search_once();
        }
        catch (const UserError &)
        {
          return false;
        }
      }

      /// As is_found(), but what no equilibrium is known of is the error of the last search.
      bool descends()
      {
        return gives_way.empty() ? search.descend(*this)
                                 : is_found([&] { return search.descend(*this); });
      }

      void begin() override
      {
        U = start;
        is_first = true;
        repeated = {};
        turning.begin(U);
      }

      /// Linearised at U, where a tangent that is not definite is an error of the start only.
      double solve() override
      {
        try
        {
          const std::vector<char> closed = step ? step->closed() : std::vector<char>();
          step.emplace(soft, turning.constraints(), parameters, time, U);
          step->start_from(closed);
        }
        catch (const BodyNotHeld &)
        {
          if (is_first)
            throw;
          return std::numeric_limits<double>::quiet_NaN();
        }
        is_first = false;
        step->set_repeated_rows(repeated);
        state = step->solve();
        repeated = step->repeated_rows();
        change = relative_change(step->bodies(), U, state.displacement);
        if (!turning.empty())
          change = std::max(change, turning.change(state));
        return change;
      }

      void go_on() override
      {
        U = state.displacement;
        turning.go_on(state);
      }

      bool accept() override
      {
        if (is_rough)
          return true;
        if (!stays(*step, state))
          return false;
        state.residuals = step->certify();
        turning.finish(state);
        return is_stable();
      }

      /// True if the tangents are definite or, of cables that lie on something or hang
      /// freely, indifferent: what is slack there stays where it is, and a free end has no tension.
      bool stays(const StaticStep &step, const StaticState &state) const
      {
        const Communicator &processes = structure.communicator();
        if (!processes.any(!step.has_own_tangents()))
          return true;
        bool touches = false;
        for (std::size_t i = 0; i < constraints.size(); ++i)
          touches = touches || (constraints[i].cone.may_open() && state.multiplier[i] > 0.);
        touches = constraints.any(touches);
        return (touches || !processes.any(!are_in_tension(structure, state.displacement))) &&
               !processes.any(!are_indifferent(structure, state.displacement));
      }

      /// False if links that push give way to the side.
      bool is_stable()
      {
        const std::vector<TurningAtRest::Across> springs = turning.begin_check(state);
        if (springs.empty())
          return true;
        StaticStep step(structure, turning.constraints(), parameters, time, state.displacement);
        step.solve();
        const std::size_t unstable = turning.first_that_gives_way(step, springs);
        if (unstable == springs.size())
          return true;
        const std::size_t i = turning.constraint_of(springs[unstable]);
        gives_way = to_text(
            "static equilibrium: none that is stable was found; links that push give way to the "
            "side, link '",
            constraints[i].name, "' with ", std::fabs(state.multiplier[i]),
            " N: what holds its ends across it has to be stiffer than that over its length, ",
            springs[unstable].stiffness, " N/m. Hold its ends, or start from 'undeformed'");
        origin_of_unstable = constraints.origin(i);
        return false;
      }

      /// The largest change over the largest displacement, or, if that is less, the force of the
      /// change over the largest internal force, which counts where nothing moves.
      double relative_change(const FactoredStructure &bodies, const BodyVectors &from,
                             const BodyVectors &to)
      {
        ByKind moved = {0., 0.}, size = {0., 0.}, lack = {0., 0.}, force = {0., 0.};
        std::vector<double> difference, product;
        for (std::size_t k = 0; k < structure.size(); ++k)
        {
          difference = to[k];
          for (std::size_t i = 0; i < difference.size(); ++i)
            difference[i] -= from[k][i];
          const ByKind own = max_norms(structure[k], difference);
          motion_of_body[structure.number(k)] = own[0];
          add_largest(own, moved);
          add_largest(max_norms(structure[k], to[k]), size);
          bodies.multiply(k, difference, product);
          add_largest(significant_part(structure[k], max_norms(structure[k], product)), lack);
        }
        structure.communicator().agree(
            [&]
            {
              for (std::size_t k = 0; k < structure.size(); ++k)
              {
                soft[k].internal_force(to[k], {}, product);
                add_largest(max_norms(structure[k], product), force);
              }
            });
        double result = 0.;
        for (int kind = 0; kind < 2; ++kind)
        {
          double sums[] = {moved[kind], size[kind], lack[kind], force[kind]};
          for (double &value : sums)
            value = structure.communicator().max(value);
          if (!std::isfinite(sums[0]) || !std::isfinite(sums[3]))
            return std::numeric_limits<double>::infinity();
          if (kind == 0)
            sums[1] = std::max(sums[1], least_part_of_links * turning.largest_length());
          if (sums[0] > 0.)
            result = std::max(result, sums[3] > 0. ? std::min(sums[0] / sums[1], sums[2] / sums[3])
                                                   : sums[0] / sums[1]);
        }
        return result;
      }

      static void add_largest(const ByKind &own, ByKind &all)
      {
        for (int kind = 0; kind < 2; ++kind)
          all[kind] = std::isnan(own[kind]) ? std::numeric_limits<double>::infinity()
                                            : std::max(all[kind], own[kind]);
      }

      /// Names the body that moves most, with its section on its rank.
      [[noreturn]] void fail()
      {
        if (!gives_way.empty())
          throw EntryError(origin_of_unstable, gives_way);
        structure.communicator().sum(motion_of_body);
        const std::size_t body =
            std::max_element(motion_of_body.begin(), motion_of_body.end()) - motion_of_body.begin();
        const std::string message = to_text(
            "static equilibrium: none that is stable was found; the displacements still change by ",
            change, " of themselves, most in body '", structure.all_bodies()[body].name,
            "'. Check lengths and supports for bodies that nothing holds, and cables that nothing "
            "holds in tension; start from 'undeformed', or give cables some bending stiffness");
        structure.communicator().agree(
            [&]
            {
              for (std::size_t k = 0; k < structure.size(); ++k)
                if (structure.number(k) == body)
                  throw EntryError(structure[k].origin(), message);
            });
        throw UserError(message);
      }

      /// Strain energy, minus the work of loads and of the forces of rigid constraints.
      double energy(const BodyVectors &U, const std::vector<double> &N) const
      {
        double sum = 0.;
        structure.communicator().agree(
            [&]
            {
              std::vector<double> P;
              for (std::size_t k = 0; k < structure.size(); ++k)
              {
                structure[k].external_force(time, P);
                sum += soft[k].strain_energy(U[k]) -
                       std::inner_product(P.begin(), P.end(), U[k].begin(), 0.);
              }
            });
        const std::vector<double> gaps = turning.gaps(U);
        for (std::size_t i = 0; i < constraints.size(); ++i)
        {
          if (!constraints.is_own(i))
            continue;
          const double gap = gaps[i];
          if (constraints[i].spring.is_rigid())
            sum -= N[i] * gap;
          else if (constraints[i].cone.is_closed(-gap))
            sum += constraints[i].spring.energy(gap);
        }
        structure.communicator().sum(&sum, 1);
        return sum;
      }

      Descent descent() override
      {
        // Of two energies with 1e-16 of rounding: the difference quotient is off by 1e-10 of the
        // energy, and by this part of the curvature. A line search needs a few digits of the slope.
        constexpr double difference = 1e-6;
        const double energy_at_guess = energy(U, state.multiplier);
        end = state.displacement;
        return {energy_at_guess, (shorten_to(difference) - energy_at_guess) / difference};
      }

      double shorten_to(const double s) override
      {
        for (std::size_t k = 0; k < U.size(); ++k)
          for (std::size_t i = 0; i < U[k].size(); ++i)
            state.displacement[k][i] = U[k][i] + s * (end[k][i] - U[k][i]);
        return energy(state.displacement, state.multiplier);
      }

      const Structure &structure;
      const Constraints &constraints;
      const SolverParameters &parameters;
      const double time;
      Structure soft;    ///< slender bodies as soft as a search begins with
      const double load; ///< sum of the sizes of all [N]
      TurningAtRest turning;
      const NewtonSearch search{limits, most_full_steps, most_iterations};
      BodyVectors start;
      bool is_first = true, is_rough = false;
      BodyVectors U, end; ///< guess, and the solution before it is shortened
      std::optional<StaticStep> step;
      StaticState state; ///< solution
      double change = 0.;
      std::string gives_way, origin_of_unstable; ///< of the last equilibrium that is not stable
      RepeatedRows repeated;                     ///< joints that repeat others at the first guess
      std::vector<double> motion_of_body; ///< of those of this rank, in the last iteration [m]
    };
  } // namespace

  StaticState static_equilibrium(const Structure &structure, const Constraints &constraints,
                                 const SolverParameters &parameters, const double t)
  {
    bool is_linear = true;
    for (std::size_t k = 0; k < structure.size(); ++k)
      is_linear = is_linear && structure[k].is_linear();
    if (!constraints.turning_rows().empty() || structure.communicator().any(!is_linear))
      return NonlinearEquilibrium(structure, constraints, parameters, t).find();
    StaticStep step(structure, constraints, parameters, t, structure.zero());
    StaticState state = step.solve();
    state.residuals = step.certify();
    return state;
  }
} // namespace taut
