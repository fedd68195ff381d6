// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_named_quantity_h
#define taut_named_quantity_h

#include <string>

namespace taut
{
  /// A result that is one number: of a sliding contact, another link, a probe, or what an observer
  /// measures.
  struct NamedQuantity
  {
    std::string item, quantity;
    double value;
    std::string unit;
  };
} // namespace taut

#endif
