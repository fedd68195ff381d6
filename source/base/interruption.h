// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interruption_h
#define taut_interruption_h

#include <stdexcept>
#include <string>

namespace taut
{
  /// Thrown by work that a signal ended early, after it has written its results.
  class Interrupted : public std::runtime_error
  {
  public:
    Interrupted(const int signal, const std::string &message)
        : std::runtime_error(message), number(signal)
    {
    }

    int signal() const { return number; }

  private:
    int number;
  };

  /**
   * For a program, not for a library: from now on the first SIGINT or SIGTERM only sets the value
   * of interruption(). A second signal ends the process at once, with exit code 128 plus its
   * number. With @p says_so the first signal writes a line to the standard error.
   */
  void catch_interruptions(bool says_so);

  /// From now on signals have no effect. Call it before the program says why it ends: mpirun sends
  /// a signal to all ranks when the first rank has ended.
  void ignore_interruptions();

  /// The signal that asked the process to end; 0: none.
  int interruption();

  /// "SIGINT", "SIGTERM", or the number of another signal.
  std::string signal_name(int signal);
} // namespace taut

#endif
