// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/interruption.h"

#include <unistd.h>

#include <csignal>

namespace taut
{
  namespace
  {
    volatile std::sig_atomic_t requested = 0;
    bool is_heard = false;

    /// Calls only functions that a signal handler may call.
    void request_end(const int signal)
    {
      if (requested != 0)
        _exit(128 + signal);
      requested = signal;
      static const char text[] = "\ntaut: ending; what is computed is written first. "
                                 "A second signal ends at once.\n";
      if (is_heard && write(STDERR_FILENO, text, sizeof text - 1) < 0)
        return; // no one reads the message
    }
  } // namespace

  void catch_interruptions(const bool says_so)
  {
    is_heard = says_so;
    struct sigaction action = {};
    action.sa_handler = request_end;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART; // files are written as if nothing had happened
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }

  void ignore_interruptions()
  {
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGTERM, SIG_IGN);
  }

  int interruption()
  {
    return requested;
  }

  std::string signal_name(const int signal)
  {
    return signal == SIGINT    ? "SIGINT"
           : signal == SIGTERM ? "SIGTERM"
                               : "signal " + std::to_string(signal);
  }
} // namespace taut
