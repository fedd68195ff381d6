// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_scene_text_h
#define taut_hunt_scene_text_h

#include "verification/scene_builder.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace hunt
{
  /// Random numbers that are the same with every standard library.
  class Random
  {
  public:
    explicit Random(const std::uint64_t seed) : engine(seed) {}

    double uniform(double a, double b);
    double decades(double a, double b) { return std::pow(10., uniform(a, b)); }
    int integer(int first, int last) { return first + int(uniform(0., last - first + 1.)); }
    bool chance(double probability) { return uniform(0., 1.) < probability; }

  private:
    std::mt19937_64 engine;
  };

  double short_number(double x); ///< with three digits: what a user writes
  std::string number(double x);

  /// A parameter file that grows line by line of SceneBuilder, each made of parts as by a stream.
  class SceneText
  {
  public:
    class Line
    {
    public:
      explicit Line(verification::SceneBuilder &scene) : scene(scene) {}
      Line(const Line &) = delete;
      ~Line() { scene.add(text); }

      Line &operator<<(const std::string &part)
      {
        text += part;
        return *this;
      }
      Line &operator<<(const double part) { return *this << number(part); }

    private:
      verification::SceneBuilder &scene;
      std::string text;
    };

    Line line() { return Line(scene); }
    std::string text() const { return scene.text(); }

  private:
    verification::SceneBuilder scene;
  };
} // namespace hunt

#endif
