// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/complementarity/active_set_system.h>
#include <taut/time/row_motions.h>

#include <algorithm>

namespace taut
{
  const std::vector<double> &RowMotions::correct(const State &state, SchurComplement &schur,
                                                 const FactoredStructure &solvers,
                                                 const BlockVector &left)
  {
    MixedComplementarityProblem problem;
    problem.unilateral.assign(rows.size(), 0);
    schur.free_motion(left, problem.free_gap, problem.gap_scale);
    share({&problem.free_gap, &problem.gap_scale});
    for (std::size_t i = 0; i < rows.size(); ++i)
      problem.free_gap[i] += state.gap[i];
    if (!conditions.kernel_resistance.empty())
      set_free_motions(solvers, left, problem);
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (applied_multiplier[i] != 0.)
        closed.push_back(i);
    const ComplementarityOptions options;
    std::vector<double> terms;
    correction.reset(problem);
    for (bool is_admissible = false; !is_admissible;)
    {
      if ((!closed.empty() || problem.n_kernel() > 0) &&
          ActiveSetSystem(options).solve(problem, schur.matrix(), closed, options.linear_tolerance,
                                         correction, terms) != ActiveSetSystem::Outcome::solved)
      {
        correction.reset(problem);
        break;
      }
      // A row that would pull has a force that is nothing but rounding: it stays as it is.
      const std::size_t n = closed.size();
      closed.erase(std::remove_if(closed.begin(), closed.end(),
                                  [&](const std::size_t i) {
                                    return rows[i].unilateral &&
                                           applied_multiplier[i] + correction.multiplier[i] < 0.;
                                  }),
                   closed.end());
      is_admissible = closed.size() == n;
    }
    return correction.multiplier;
  }

  void RowMotions::add_correction(const BlockVector &dU, State &state)
  {
    const std::vector<double> moved = rows.motions(dU);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const double dN = correction.multiplier[i], du = S[i] * dN;
      applied_multiplier[i] += dN;
      balanced[i] += dN;
      state.multiplier[i] += dN;
      motion[i] += moved[i];
      position[i] += moved[i];
      state.geometric_gap[i] += moved[i];
      State::LinkSpring &spring = state.link_springs[i];
      spring.u += du;
      spring.du += du;
      spring.v += c.velocity * du;
      spring.a += c.acceleration * du;
      state.gap[i] = state.geometric_gap[i] + spring.u;
    }
    for (std::size_t k = 0; k < amplitude.size(); ++k)
      amplitude[k] += correction.kernel_amplitude[k];
  }
} // namespace taut
