// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/jump_watch.h"
#include "base/text.h"
#include "substructure/motion_rate.h"
#include <taut/base/archive.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace taut
{
  void JumpWatch::start(const StepView &step)
  {
    for (std::size_t k = 0; k < step.structure.size(); ++k)
      if (step.structure[k].has_moving_constraints())
        moving.push_back(k);
    some_move = step.structure.communicator().any(!moving.empty());
    is_new = false;
  }

  /// The largest jump in the step on this rank, as a part of a message; empty: none.
  std::string JumpWatch::largest_jump(const StepView &step) const
  {
    const State &state = step.state;
    std::string text;
    double largest = 0.;
    for (const std::size_t k : moving)
      for (const ConstrainedDof &constraint : step.structure[k].constraints())
      {
        if (!constraint.motion)
          continue;
        const unsigned int dof = constraint.dof;
        const double way = state.dU[k][dof],
                     lack = way - .5 * state.last_step * (state.V_old[k][dof] + state.V[k][dof]);
        const JumpOfMotion jump =
            find_jump(constraint.motion, state.time - state.last_step, state.time, way, lack);
        if (std::fabs(jump.size) <= largest)
          continue;
        largest = std::fabs(jump.size);
        text = to_text("at t = ", jump.time, " s '", step.structure[k].name(), "' jumps by ",
                       jump.size, step.structure[k].kind(dof) == 0 ? " m" : " rad");
      }
    return text;
  }

  void JumpWatch::record(const StepView &step)
  {
    if (is_new)
    {
      start(step);
      return;
    }
    if (!some_move || !(step.state.last_step > 0.))
      return;
    const Communicator &processes = step.structure.communicator();
    std::string own;
    processes.agree([&] { own = largest_jump(step); });
    if (!processes.any(!own.empty()))
      return;
    ++n_steps;
    const std::vector<std::string> all = processes.gather(own);
    if (first.empty())
      first = *std::find_if(all.begin(), all.end(),
                            [](const std::string &text) { return !text.empty(); });
  }

  template <typename Archive>
  void JumpWatch::store(Archive &archive)
  {
    archive &n_steps &first;
  }

  void JumpWatch::save(OutputArchive &archive)
  {
    store(archive);
  }

  void JumpWatch::resume(InputArchive &archive, const StepView &step)
  {
    start(step);
    store(archive);
  }

  void JumpWatch::report(std::ostream &log, bool) const
  {
    if (n_steps > 0)
      log << to_text("Prescribed motions jump in ", n_steps,
                     n_steps == 1 ? " step: " : " steps, first ", first, '\n');
  }
} // namespace taut
