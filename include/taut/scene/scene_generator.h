// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_scene_generator_h
#define taut_scene_generator_h

#include <taut/base/registry.h>
#include <taut/scene/scene.h>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /**
   * Fills a scene from a parameter file. Derive from it in a plugin, and register it, to generate
   * scenes of your own. The entry `Generator` chooses it by name. Functions are called in the order
   * below.
   */
  class SceneGenerator
  {
  public:
    virtual ~SceneGenerator() = default;

    /// Declares the entries that list names, e.g. of wires. These entries are read first and
    /// leniently.
    virtual void declare_names(dealii::ParameterHandler &) {}

    /// Declares all entries, with a section for each name. They are read strictly.
    virtual void declare_parameters(dealii::ParameterHandler &prm) = 0;

    /// Adds wires, links and other items of the entries to a scene, which already has gravity,
    /// start and the bodies of the parameter file. Throws UserError.
    virtual void fill(Scene &scene) const = 0;

    /// Values that are possible, but probably of another unit: each in one line, for the log.
    virtual std::vector<std::string> warnings() const { return {}; }
  };
} // namespace taut

#endif
