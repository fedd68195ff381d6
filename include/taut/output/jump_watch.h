// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_jump_watch_h
#define taut_jump_watch_h

#include <taut/output/observer.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /// Finds jumps of prescribed places, with their time and size. Before and after a jump a place
  /// has the velocity of its formula or table; the jump itself has none. Where a rigid constraint
  /// presses at such a place, its impulse is that of a way made in one step: it grows with shorter
  /// steps.
  class JumpWatch : public Observer
  {
  public:
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// A line if there were jumps, and a warning if rigid links pressed there.
    void report(std::ostream &log, bool failed) const override;

  private:
    template <typename Archive>
    void store(Archive &archive);
    void start(const StepView &step);
    std::string look(const StepView &step, std::vector<double> &presses);

    bool is_new = true, some_move = false;     ///< some_move: on any rank
    std::vector<std::size_t> moving;           ///< bodies of this rank with prescribed motions
    long n_steps = 0;                          ///< with jumps so far
    std::string first, pressed;                ///< the first jump; the largest impulse in a jump
    double impulse = 0., time_of_impulse = 0.; ///< that impulse [N s, N m s] and its time [s]
  };
} // namespace taut

#endif
