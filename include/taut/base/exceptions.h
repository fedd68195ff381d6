// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_exceptions_h
#define taut_exceptions_h

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * A mistake of the user, or a limit of the method that the user can avoid. Throw it with a
   * message that says what is wrong, where, and what to do. The program prints the message without
   * a stack trace and ends with exit code 1.
   */
  class UserError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A UserError about one entry of a parameter file. The reader of the file adds file, line and
   * value. entry() is the path of sections and entry, "Network/Link a/Stiffness", or the path of a
   * section.
   */
  class EntryError : public UserError
  {
  public:
    EntryError(const std::string &entry, const std::string &message)
        : UserError(entry.empty() ? message : entry + ": " + message), path(entry), text(message)
    {
    }

    const std::string &entry() const { return path; }
    const std::string &message() const { return text; }

  private:
    std::string path, text;
  };

  /// A file or folder that could not be written: the machine is at fault, not the scene.
  class NotWritten : public UserError
  {
  public:
    using UserError::UserError;
  };

  /// A complementarity problem without a solution: the gaps of the named rows contradict each
  /// other.
  class ContradictoryRows : public UserError
  {
  public:
    explicit ContradictoryRows(const std::string &message, std::vector<std::size_t> rows = {})
        : UserError(message), row_indices(std::move(rows))
    {
    }

    /// Indices of rows in the complementarity problem, for callers that know the names of the rows.
    const std::vector<std::size_t> &rows() const { return row_indices; }

  private:
    std::vector<std::size_t> row_indices;
  };

  /// A step of nonlinear bodies without a solution; a shorter step may have one. The message is the
  /// reason, with its entry.
  class StepNotSolved : public EntryError
  {
  public:
    explicit StepNotSolved(const UserError &why) : StepNotSolved(why, as_entry_error(why)) {}

  private:
    StepNotSolved(const UserError &why, const EntryError *of_entry)
        : EntryError(of_entry ? of_entry->entry() : "", of_entry ? of_entry->message() : why.what())
    {
    }
    static const EntryError *as_entry_error(const UserError &why)
    {
      return dynamic_cast<const EntryError *>(&why);
    }
  };

  /// A body that the equations do not hold: a singular matrix, or loads that no admissible contact
  /// force balances. The entry is the section of the body, once the section is known.
  class BodyNotHeld : public EntryError
  {
  public:
    explicit BodyNotHeld(const std::string &message, std::vector<std::size_t> null_space = {},
                         const std::string &entry = "")
        : EntryError(entry, message), null_space_indices(std::move(null_space))
    {
    }

    /// Indices of the null space vectors that remain unbalanced in the complementarity problem;
    /// empty for other causes.
    const std::vector<std::size_t> &null_space() const { return null_space_indices; }

  private:
    std::vector<std::size_t> null_space_indices;
  };

  /// A complementarity problem whose residual remains above the tolerance.
  class NotSolved : public UserError
  {
  public:
    using UserError::UserError;
  };
} // namespace taut

#endif
