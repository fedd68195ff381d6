// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_exceptions_h
#define taut_exceptions_h

#include <stdexcept>
#include <string>

namespace taut
{
  /**
   * A mistake in what the user asked for, or a limit of the method that the user can do something about. The message
   * says what is wrong, where, and what to do; the program prints it without a stack trace and ends with exit code 1.
   */
  class UserError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A complementarity problem without a solution: the gaps of the named rows contradict each other.
  class ContradictoryRows : public UserError
  {
  public:
    using UserError::UserError;
  };

  /// A body that the equations do not hold: a singular matrix, or loads that no admissible contact force balances.
  class BodyNotHeld : public UserError
  {
  public:
    using UserError::UserError;
  };
} // namespace taut

#endif
