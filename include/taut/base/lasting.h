// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_lasting_h
#define taut_lasting_h

namespace taut
{
  /// The argument of a function that keeps it by reference: a const T &, but no temporary object,
  /// which would be gone before its use.
  template <typename T>
  class Lasting
  {
  public:
    Lasting(const T &object) : object(object) {}
    Lasting(const T &&) = delete;
    operator const T &() const { return object; }

  private:
    const T &object;
  };
} // namespace taut

#endif
