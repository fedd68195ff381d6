// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_probe_item_h
#define taut_probe_item_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  struct Scene;

  /// A named probe of a parameter file: one point, or several of a wire or a body.
  struct ProbeItem
  {
    std::string point;
    std::vector<double> direction, axis;
    bool rotational = false;
    std::string quantity = "displacement";
    void declare(dealii::ParameterHandler &prm);

    /// Adds its probes to a scene with all wires, masses and bodies. @p title is the path of its
    /// section. Throws EntryError for a point that is not known.
    void add(const std::string &name, const std::string &title, Scene &scene) const;
  };
} // namespace taut

#endif
