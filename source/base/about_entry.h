// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_about_entry_h
#define taut_about_entry_h

#include <taut/base/exceptions.h>

#include <string>

namespace taut
{
  /// Returns the result of @p function. A UserError of @p function becomes an EntryError about the
  /// entry or section @p path of the parameter file, unless it names an entry itself.
  template <typename Function>
  auto about_entry(const std::string &path, const Function &function) -> decltype(function())
  {
    try
    {
      return function();
    }
    catch (const EntryError &)
    {
      throw;
    }
    catch (const UserError &e)
    {
      throw EntryError(path, e.what());
    }
  }
} // namespace taut

#endif
