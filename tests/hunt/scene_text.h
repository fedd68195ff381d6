// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_scene_text_h
#define taut_hunt_scene_text_h

#include "verification/scene_builder.h"

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hunt
{
  /// Random numbers that are the same with every standard library.
  class Random
  {
  public:
    explicit Random(const std::uint64_t seed) : engine(seed) {}

    double uniform(double a, double b);
    double decades(double a, double b); ///< 10^uniform(a, b)
    int integer(int first, int last);   ///< both may come
    bool chance(double probability) { return uniform(0., 1.) < probability; }

  private:
    std::mt19937_64 engine;
  };

  /// With three digits: what a user writes.
  double short_number(double x);
  std::string number(double x);

  using Entries = std::vector<std::pair<std::string, std::string>>;

  /// A parameter file of the generator 'network' that grows item by item.
  class SceneText
  {
  public:
    /// Kind as in 'subsection <kind> <name>': Mass, Spring, Link, ...
    void add(const std::string &kind, const std::string &name, const Entries &entries);
    void set(const std::string &section, const std::string &entry, const std::string &value);
    std::string text() const { return scene.text(); }

  private:
    verification::SceneBuilder scene;
  };
} // namespace hunt

#endif
