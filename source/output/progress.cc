// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/progress.h"

#include <iomanip>
#include <ostream>
#include <string>

namespace taut
{
  Progress::Progress(std::ostream &log, const bool terminal, const double end_time)
      : log(log), terminal(terminal), end_time(end_time)
  {
  }

  void Progress::record(const StepView &step)
  {
    using Clock = std::chrono::steady_clock;
    const double fraction = std::min(1., step.state.time / end_time);
    const bool last = fraction > 1. - 1e-9;
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - begin).count();
    const double factor = seconds > 0. ? step.state.time / seconds : 0.;
    if (terminal)
    {
      if (!last && now - drawn < std::chrono::milliseconds(100))
        return;
      drawn = now;
      constexpr int width = 40;
      const int filled = static_cast<int>(width * fraction);
      log << "\r  [" << std::string(filled, '=') << std::string(width - filled, ' ') << "] "
          << std::setw(3) << static_cast<int>(100. * fraction + 1e-9)
          << " %  t = " << step.state.time << " s  " << std::setprecision(3) << factor
          << " x real time   " << std::setprecision(6) << std::flush;
      return;
    }
    const int tenths = static_cast<int>(10. * fraction + 1e-9);
    if (tenths > shown)
      log << "  " << 10 * tenths << " %  t = " << step.state.time << " s, " << std::setprecision(3)
          << factor << " x real time" << std::setprecision(6) << std::endl;
    shown = tenths;
  }

  void Progress::finish()
  {
    if (terminal)
      log << '\n';
  }
} // namespace taut
