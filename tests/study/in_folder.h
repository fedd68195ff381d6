// SPDX-License-Identifier: LGPL-2.1-or-later
// What tests of studies share: a folder of their own, an oscillator with an exact solution.
#ifndef taut_tests_study_in_folder_h
#define taut_tests_study_in_folder_h

#include "common.h"
#include "verification/scene_builder.h"

namespace studies
{
  using Texts = std::vector<std::string>;

  // w = 10 1/s, u = cos(w t); at t = 1.3 s the mass is at cos(13) m.
  inline const std::string oscillator = R"(Gravity = 0, 0; Start = given
Mass block: Motions = y; Mass = 2; Initial displacement = 0, 1, 0
Spring spring: To = block; Stiffness = 200
Time: Scheme = Newmark; Step = 0.01; End = 1.3
Output: Folder = results; Field interval = 0
Probe place: Point = block
)";

  /// Works in a folder of its own, and removes it.
  class InFolder : public testing::Test
  {
  protected:
    InFolder() { std::filesystem::current_path(folder.path); }
    ~InFolder() override { std::filesystem::current_path(std::filesystem::temp_directory_path()); }
    static void write(const std::string &scene)
    {
      std::ofstream("scene.prm") << verification::prm(scene);
    }

    const verification::Folder folder;
    std::ostringstream log;
  };

  /// Each of the fragments is in a message of one line.
  inline void expect_fragments(const std::string &message, const Texts &fragments)
  {
    for (const std::string &fragment : fragments)
      EXPECT_TRUE(verification::has(message, fragment))
          << "'" << fragment << "' is not in '" << message << "'";
    EXPECT_FALSE(verification::has(message, "\n")) << message;
  }
} // namespace studies

#endif
