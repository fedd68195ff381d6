// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/time/initial_state.h>
#include <taut/time/static_equilibrium.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Gaps, and the springs of the links with their forces.
    void set_rows(const ContactRows &rows, const Start start, InitialState &result)
    {
      State &state = result.state;
      const std::vector<double> reference_motion = rows.motions(result.reference.displacement),
                                motion = rows.motions(state.U), velocity = rows.motions(state.V);
      state.geometric_gap.resize(rows.size());
      state.gap.resize(rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        const Row &row = rows[i];
        state.geometric_gap[i] = row.gap + reference_motion[i] + motion[i];
        // The spring of a link starts as compressed as its ends stand, and a compressed one as fast
        // as they move; a rigid one is not compressed.
        double u = state.multiplier[i] / row.stiffness;
        if (start != Start::equilibrium && !std::isinf(row.stiffness))
        {
          u = row.unilateral ? std::max(0., -state.geometric_gap[i]) : -state.geometric_gap[i];
          const double v = !row.unilateral || u > 0. ? -velocity[i] : 0.;
          state.link_springs[i].v = v;
          state.multiplier[i] = u * row.stiffness + v * row.damping;
          if (row.unilateral)
            state.multiplier[i] = std::max(0., state.multiplier[i]);
        }
        state.link_springs[i].u = u;
        // Rounding of the gap over a small compliance, or over what a short step moves, would be a
        // force.
        if (start == Start::equilibrium && (!row.unilateral || state.multiplier[i] > 0.))
          state.geometric_gap[i] = -u;
        else if (start == Start::equilibrium)
          state.geometric_gap[i] = std::max(0., state.geometric_gap[i]);
        state.gap[i] = state.geometric_gap[i] + u;
        if (start != Start::equilibrium && state.gap[i] < 0. && row.unilateral)
          throw EntryError(rows.origin(i), "link '" + row.name + "' starts with a gap of " +
                                               std::to_string(state.gap[i]) +
                                               ": a rigid one-sided link starts open or just "
                                               "touching. Change its Gap or the start.");
      }
      if (start == Start::equilibrium)
        result.reference.gap = state.geometric_gap;
    }
  } // namespace

  InitialState find_initial_state(const Structure &structure, ContactRows &rows,
                                  const SolverParameters &parameters, const Start start)
  {
    InitialState result;
    State &state = result.state;
    rows.update(0.);
    state.U = state.V = state.A = state.dU = state.V_old = state.KU = state.balance =
        structure.zero();
    state.multiplier.assign(rows.size(), 0.);
    state.link_springs.resize(rows.size());
    result.reference.displacement = result.reference.force = structure.zero();
    if (start == Start::equilibrium)
    {
      StaticState rest = static_equilibrium(structure, rows, parameters, 0.);
      result.reference.displacement = std::move(rest.displacement);
      for (std::size_t k = 0; k < structure.size(); ++k)
        structure[k].stiffness().vmult_add(1., result.reference.displacement[k].data(),
                                           result.reference.force[k].data());
      state.multiplier = std::move(rest.multiplier);
      result.certificate = rest.certificate;
    }
    else if (start == Start::given)
      structure.communicator().agree(
          [&]
          {
            for (std::size_t k = 0; k < structure.size(); ++k)
            {
              structure[k].initial_state(state.U[k], state.V[k]);
              for (const ConstrainedDof &constraint : structure[k].constraints())
                state.U[k][constraint.dof] = constraint.at(0.);
              structure[k].stiffness().vmult_add(1., state.U[k].data(), state.KU[k].data());
            }
          });
    set_rows(rows, start, result);
    return result;
  }
} // namespace taut
