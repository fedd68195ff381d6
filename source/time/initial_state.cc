// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "time/prescribed_motions.h"
#include "time/turning_constraints.h"
#include <taut/base/exceptions.h>
#include <taut/time/initial_state.h>
#include <taut/time/static_equilibrium.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Makes all turning constraints keep their direction if possible, with rows for springs
    /// across.
    void linearise_links(const Structure &structure, Constraints &constraints, InitialState &result)
    {
      std::vector<double> &N = result.state.multiplier;
      bool others = false;
      for (const std::size_t i : constraints.turning_rows())
      {
        const TurningDirection &turning = constraints.turning(i);
        others = others || turning.sign * N[i] > 0. || turning.length_at;
        for (const std::vector<Term> *const motion : turning.forms())
          for (const Term &term : *motion)
            others = others || !result.linearised[structure.number(term.substructure)];
      }
      if (constraints.turning_rows().empty() || structure.communicator().any(others))
        return;
      const auto first_sliding = N.end() - constraints.sliding_rows().size();
      result.kept.assign(first_sliding - constraints.turning_rows().size(), first_sliding);
      const std::size_t n = first_sliding - N.begin();
      constraints.keep_directions(result.reference.displacement, result.kept);
      N.insert(N.begin() + n, constraints.size() - N.size(), 0.);
      result.state.springs.resize(constraints.size());
    }

    /// Checks the size of a vector at t = 0, and that its numbers are finite.
    void check_vector(const Substructure &body, const std::vector<double> &x, const char *what)
    {
      if (x.size() != body.n_dofs())
        throw EntryError(body.origin(), "body '" + body.name() + "': " + what + " has " +
                                            std::to_string(x.size()) + " entries, and it has " +
                                            std::to_string(body.n_dofs()) + " DoFs");
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!std::isfinite(x[i]))
          throw EntryError(body.origin(), "body '" + body.name() + "': " + what +
                                              " is no finite number at DoF " + std::to_string(i));
    }

    void check_bodies(const Structure &structure)
    {
      structure.communicator().agree(
          [&]
          {
            std::vector<double> P;
            for (std::size_t k = 0; k < structure.size(); ++k)
            {
              structure[k].external_force(0., P);
              check_vector(structure[k], P, "its external force at t = 0");
              for (const ConstrainedDof &constraint : structure[k].constraints())
                if (!std::isfinite(constraint.at(0.)))
                  throw EntryError(structure[k].origin(), "body '" + structure[k].name() +
                                                              "': the motion of DoF " +
                                                              std::to_string(constraint.dof) +
                                                              " is no finite number at t = 0");
            }
          });
    }

    /// Part of its terms by which a gap may start below zero and count as zero: some thousand
    /// roundings of the sum, far less than an atom on any machine.
    constexpr double rounding_of_start = 1e-12;

    /// Sets gaps of rigid unilateral constraints to 0 if they are negative by rounding; the
    /// reference takes the difference.
    void close_rounded_gaps(const Constraints &constraints, const std::vector<double> &motion,
                            const std::vector<Coordinates> &ends, InitialState &result)
    {
      State &state = result.state;
      std::vector<double> sum(constraints.size()), size(constraints.size());
      constraints.share_of_motions(state.U, sum, size);
      constraints.sum(size);
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        const ConstraintData &constraint = constraints[i];
        size[i] += std::fabs(constraint.gap) + constraint.gap_size;
        if (constraints.turns(i))
          size[i] += constraints.turning(i).distance(&ends[*constraints.segments(i).begin()]);
        if (!constraint.cone.may_open() || !(state.complementarity_gap[i] < 0.) ||
            !(-state.complementarity_gap[i] <= rounding_of_start * size[i]))
          continue;
        if (result.reference.gap.empty())
          for (std::size_t j = 0; j < constraints.size(); ++j)
            result.reference.gap.push_back(constraints[j].gap);
        state.distance[i] -= state.complementarity_gap[i];
        state.complementarity_gap[i] = 0.;
        result.reference.gap[i] = state.distance[i] - motion[i];
      }
    }

    /// Refuses rigid unilateral constraints that are closed beyond contact.
    void check_penetration(const Structure &structure, const Constraints &constraints,
                           const std::vector<double> &gaps)
    {
      std::size_t found = no_link;
      for (std::size_t i = constraints.size(); i-- > 0;)
        if (gaps[i] < 0. && constraints[i].cone.may_open())
          found = i;
      const std::size_t i = constraints.index(constraints.number_of_first(found));
      structure.communicator().agree(
          [&]
          {
            if (i < constraints.size())
              throw EntryError(
                  constraints.origin(i),
                  to_text("link '", constraints[i].name, "' starts with a gap of ", gaps[i],
                          constraints[i].rotational ? " rad" : " m",
                          ": a rigid unilateral link starts open or just touching. Change its "
                          "Gap or the start."));
          });
    }

    /// Refuses a turning constraint with a force whose places meet.
    void check_segments(const Constraints &constraints, const std::size_t i,
                        const std::vector<Coordinates> &ends, const InitialState &start)
    {
      for (const std::size_t k : constraints.segments(i))
        if (constraints.turning(i).vanishes(ends[k]))
          throw EntryError(constraints.origin(i),
                           message_of_meeting(constraints[i].name, 0.,
                                              constraints.ends(i, k, start.reference.displacement,
                                                               start.state.U)));
    }

    /// Sets gaps, and springs of links with their forces.
    void set_rows(const Structure &structure, Constraints &constraints, const Start start,
                  InitialState &result)
    {
      State &state = result.state;
      constraints.turn_to(result.reference.displacement, state.U);
      const std::vector<Coordinates> ends =
          constraints.differences(result.reference.displacement, state.U);
      const std::vector<double> reference_motion =
                                    constraints.motions(result.reference.displacement),
                                motion = constraints.motions(state.U),
                                velocity = constraints.motions(state.V);
      state.distance.resize(constraints.size());
      state.complementarity_gap.resize(constraints.size());
      for (std::size_t i = 0; i < constraints.size(); ++i)
      {
        const ConstraintData &constraint = constraints[i];
        state.distance[i] =
            constraints.turns(i)
                ? constraints.turning(i).gap(&ends[*constraints.segments(i).begin()])
                : constraint.gap + reference_motion[i] + motion[i];
        // A spring starts with the compression between its ends, and if compressed, at their speed.
        // Rigid ones have no compression.
        double u = constraint.spring.compression(state.multiplier[i]);
        if (start != Start::equilibrium && !constraint.spring.is_rigid())
        {
          u = constraint.cone.project(-state.distance[i]);
          const double v = constraint.cone.is_closed(u) ? -velocity[i] : 0.;
          state.springs[i].v = v;
          state.multiplier[i] =
              constraint.cone.project(constraint.spring.force(u) + v * constraint.spring.damping);
        }
        state.springs[i].u = u;
        // Rounding of the gap over a small compliance, or over a motion in a short step, would be a
        // force.
        if (start == Start::equilibrium && constraint.cone.is_closed(state.multiplier[i]))
          state.distance[i] = -u;
        else if (start == Start::equilibrium)
          state.distance[i] = std::max(0., state.distance[i]);
        state.complementarity_gap[i] = state.distance[i] + u;
        if (constraints.turns(i) &&
            !constraint.cone.rests_open(state.multiplier[i], state.complementarity_gap[i]))
          check_segments(constraints, i, ends, result);
      }
      if (start == Start::equilibrium)
        result.reference.gap = state.distance;
      else
      {
        close_rounded_gaps(constraints, motion, ends, result);
        check_penetration(structure, constraints, state.complementarity_gap);
      }
    }

    /// Part of the terms of a gap, or of the distance of the ends, up to which a joint counts as
    /// closed: for numbers with five digits.
    constexpr double closed = 1e-5;

    /// Refuses open rigid joints: they would close within the first step, of any length.
    void check_joints(const Structure &structure, const Constraints &constraints,
                      const InitialState &start)
    {
      const State &state = start.state;
      std::vector<double> motion(constraints.size()), size(constraints.size());
      constraints.share_of_motions(state.U, motion, size);
      constraints.sum(size);
      const auto check = [&](const std::size_t i)
      {
        const ConstraintData &joint = constraints[i];
        const double gap = state.distance[i], terms = constraints.turns(i)
                                                          ? constraints.turning(i).length
                                                          : size[i] + std::fabs(joint.gap);
        if (joint.cone.may_open() || !joint.spring.is_rigid() || constraints.slides(i) ||
            std::fabs(gap) <= closed * terms)
          return;
        throw EntryError(
            constraints.origin(i),
            to_text(
                "joint '", joint.name, "' starts with a gap of ", gap,
                joint.rotational ? " rad" : " m",
                ": a rigid one starts closed, or would close within the first step. Change its ",
                constraints.turns(i) ? "Length" : "Gap", " or the start, or give it a Stiffness"));
      };
      structure.communicator().agree(
          [&]
          {
            for (std::size_t i = 0; i < constraints.size(); ++i)
              check(i);
          });
    }
  } // namespace

  InitialState find_initial_state(Structure &structure, Constraints &constraints,
                                  const SolverParameters &parameters, const Start start,
                                  const double step)
  {
    check_bodies(structure);
    constraints.update(0.);
    InitialState result;
    State &state = result.state = state_at_rest(structure, constraints.size());
    result.reference.displacement = result.reference.force = result.loads = structure.zero();
    if (start == Start::equilibrium)
    {
      StaticState rest = static_equilibrium(structure, constraints, parameters, 0.);
      result.reference.displacement = std::move(rest.displacement);
      state.multiplier = std::move(rest.multiplier);
      result.residuals = rest.residuals;
      result.repeated_joints = constraints.names(rest.repeated_joints);
    }
    if (start == Start::given)
      structure.communicator().agree(
          [&]
          {
            for (std::size_t k = 0; k < structure.size(); ++k)
            {
              structure[k].initial_state(state.U[k], state.V[k]);
              check_vector(structure[k], state.U[k], "its displacement at the start");
              check_vector(structure[k], state.V[k], "its velocity at the start");
            }
          });
    result.linearised = structure.linearise(result.reference.displacement);
    if (start == Start::equilibrium)
      linearise_links(structure, constraints, result);
    structure.communicator().agree(
        [&]
        {
          for (std::size_t k = 0; k < structure.size(); ++k)
          {
            // A body may have prestress as constructed.
            structure[k].internal_force(result.reference.displacement[k], {},
                                        result.reference.force[k]);
            structure[k].external_force(0., result.loads[k]);
            for (std::size_t i = 0; i < result.loads[k].size(); ++i)
              result.loads[k][i] -= result.reference.force[k][i];
            if (start != Start::equilibrium)
            {
              for (const ConstrainedDof &constraint : structure[k].constraints())
              {
                state.U[k][constraint.dof] = constraint.at(0.);
                state.V[k][constraint.dof] = 0.;
              }
              structure[k].internal_force(state.U[k], {}, state.KU[k]);
              for (std::size_t i = 0; i < state.KU[k].size(); ++i)
                state.KU[k][i] -= result.reference.force[k][i];
            }
          }
          set_prescribed_velocities(structure, step, state);
        });
    set_rows(structure, constraints, start, result);
    if (start != Start::equilibrium)
      check_joints(structure, constraints, result);
    return result;
  }
} // namespace taut
