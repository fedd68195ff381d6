// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_parts_h
#define taut_shared_parts_h

#include <taut/base/kept.h>
#include <taut/substructure/substructure.h>

#include <memory>
#include <vector>

namespace taut
{
  /// Droppers in the static state, in their order.
  struct DropperForm
  {
    std::vector<double> tension;  ///< [N]
    std::vector<double> length;   ///< [m]
    std::vector<double> sideways; ///< of one whose direction is found: its extent across it [m]
  };

  /**
   * Parts of models that runs after each other have in common, so that they are made once: handed
   * from run to run by whoever makes them. Each is made from a ScenePart and nothing else, and
   * found again by all values of that part: a run has the same bits with it and without.
   */
  struct SharedParts
  {
    Kept<DropperForm> forms;
    /// They keep no state (Substructure::save), so that runs can have them in common.
    Kept<std::shared_ptr<Substructure>> wires;

    /// A run begins.
    void begin()
    {
      forms.begin();
      wires.begin();
    }
  };
} // namespace taut

#endif
