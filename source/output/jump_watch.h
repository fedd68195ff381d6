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

    /// A line if there were jumps.
    void report(std::ostream &log, bool failed) const override;

  private:
    template <typename Archive>
    void store(Archive &archive);
    void start(const StepView &step);
    std::string largest_jump(const StepView &step) const;

    bool is_new = true, some_move = false; ///< some_move: on any rank
    std::vector<std::size_t> moving;       ///< bodies of this rank with prescribed motions
    long n_steps = 0;                      ///< with jumps so far
    std::string first;                     ///< the first jump, as a part of a message
  };
} // namespace taut

#endif
