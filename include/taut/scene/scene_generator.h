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
   * Fills a scene from a parameter file. Chosen by name, from this library or from a plugin; the
   * calls come in the order of the functions below.
   */
  class SceneGenerator
  {
  public:
    virtual ~SceneGenerator() = default;

    /// Declares the entries that list names, e.g. of wires; they are read first and leniently.
    virtual void declare_names(dealii::ParameterHandler &) {}

    /// Declares everything, a section a name; read strictly.
    virtual void declare_parameters(dealii::ParameterHandler &prm) = 0;

    /// Adds what the entries read describe to a scene, which has gravity, start and the bodies of
    /// the parameter file. Throws UserError.
    virtual void fill(Scene &scene) const = 0;
  };
} // namespace taut

#endif
