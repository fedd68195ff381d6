// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_shared_parts_h
#define taut_shared_parts_h

#include "base/reused_values.h"
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
    std::vector<double> sideways; ///< extent across a dropper whose direction is found [m]
  };

  /**
   * Parts of models that consecutive runs have in common, such as the cases of a sweep, so that
   * they are made once. The caller of the runs hands the object from run to run. Each part is made
   * from a ScenePart and nothing else, and found again by all values of this ScenePart. So a run
   * has the same bits with shared parts and without.
   */
  struct SharedParts
  {
    ReusedValues<DropperForm> forms;
    /// Wires keep no state (Substructure::save), so that runs can share them.
    ReusedValues<std::shared_ptr<Substructure>> wires;

    /// Call it when a run begins.
    void begin()
    {
      forms.begin();
      wires.begin();
    }
  };
} // namespace taut

#endif
