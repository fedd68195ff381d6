// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/memory.h"

#include <deal.II/base/exceptions.h>

#include <new>
#include <stdexcept>

namespace taut
{
  bool is_memory_shortage(const std::exception &e)
  {
    return dynamic_cast<const std::bad_alloc *>(&e) != nullptr ||
           dynamic_cast<const std::length_error *>(&e) != nullptr ||
           dynamic_cast<const dealii::StandardExceptions::ExcOutOfMemory *>(&e) != nullptr;
  }

  std::string whole_text(const std::ostringstream &stream)
  {
    if (!stream)
      throw std::bad_alloc();
    return stream.str();
  }
} // namespace taut
