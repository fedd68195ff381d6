// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_unheld_wires_h
#define taut_unheld_wires_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// A warning for each wire under tension that no support, link or bedding holds across it. A
  /// scene may have such wires, but hardly means them: they fall as a whole.
  std::vector<std::string> warnings_of_unheld_wires(const Scene &scene);
} // namespace taut

#endif
