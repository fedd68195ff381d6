// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene_text.h"

#include <cstdio>
#include <cstdlib>

namespace hunt
{
  double Random::uniform(const double a, const double b)
  {
    return a + (b - a) * std::ldexp(static_cast<double>(engine() >> 11), -53);
  }

  std::string number(const double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", x);
    return text;
  }

  double short_number(const double x)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.2e", x);
    return std::atof(text);
  }
} // namespace hunt
