// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: meshes from files follow curves that entries name, and faces of degree 2 that do not are
// warned of. Source: the radius of a circle and the height of its chords.
#include "solid/limits_run.h"

#include <gtest/gtest.h>

using namespace solid_limits;

namespace
{
  /// A quarter of a ring between the radii 1 and 2 in 4 x 2 straight cells; boundary 7 is its inner
  /// side, 8 its outer one, and 6 its two ends.
  struct QuarterRing
  {
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("taut_ring_" + std::to_string(getpid()) + ".msh");

    QuarterRing()
    {
      std::ofstream file(path);
      file.precision(16);
      file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n15\n";
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 5; ++i)
          file << 1 + i + 5 * j << ' ' << (1. + .5 * j) * std::cos(M_PI / 8. * i) << ' '
               << (1. + .5 * j) * std::sin(M_PI / 8. * i) << " 0\n";
      file << "$EndNodes\n$Elements\n20\n";
      int n = 0;
      const auto line = [&](const int id, const int a, const int b)
      { file << ++n << " 1 2 " << id << ' ' << id << ' ' << a << ' ' << b << '\n'; };
      for (int i = 0; i < 4; ++i)
      {
        line(7, 1 + i, 2 + i);
        line(8, 11 + i, 12 + i);
      }
      for (int j = 0; j < 2; ++j)
      {
        line(6, 1 + 5 * j, 6 + 5 * j);
        line(6, 5 + 5 * j, 10 + 5 * j);
      }
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 4; ++i)
          file << ++n << " 3 2 0 0 " << 1 + i + 5 * j << ' ' << 6 + i + 5 * j << ' '
               << 7 + i + 5 * j << ' ' << 2 + i + 5 * j << '\n';
      file << "$EndElements\n";
    }
    ~QuarterRing() { std::filesystem::remove(path); }
  };
} // namespace

// Claim: a mesh from a file follows a circle that an entry names, and facets are named. Expected:
// middles of sides at the radius 1, or nearer by the height of a chord.
TEST(SolidMeshes, a_mesh_from_a_file_follows_a_circle)
{
  const QuarterRing ring;
  const auto pressed = [&](const std::string &curve)
  {
    return run(scene("equilibrium",
                     "set Bodies = ring\n" +
                         body("ring", "set File = " + ring.path.string() + "\n" + curve,
                              "set Degree = 2\nset Symmetry boundaries = 6\nset Displacement = 8: "
                              "-1e-4*x, -1e-4*y"),
                     "set Contacts = pin\nsubsection Contact pin\nset Slave = ring: 7\n"
                     "set Obstacle = cylinder\nset Point = 0, 0\nset Direction = 0, 0, 1\n"
                     "set Radius = 0.99995\nend\n" +
                         at_rest));
  };
  const double chord = std::cos(M_PI / 16.);
  for (const bool follows : {false, true})
  {
    const Ran found =
        pressed(follows ? "set Curved boundaries = 7: circle, 0, 0" : "set Shift = 0, 0");
    // Middles of straight sides are in the obstacle, where a run at rest pushes them out.
    ASSERT_EQ(found.error, "");
    ASSERT_EQ(found.constraints.size(), 9u);
    double least = 2.;
    for (const taut::SurfaceConstraint &c : found.constraints)
      least = std::fmin(least, norm(c.point));
    EXPECT_NEAR(least, follows ? 1. : chord, 1e-12);
    EXPECT_EQ(has(found.log, "have a kink of"), !follows) << found.log;
  }
  EXPECT_TRUE(has(pressed("set Curved boundaries = 7: circle, 0.1, 0").error, "on no one radius"));
  EXPECT_TRUE(has(pressed("set Curved boundaries = 9: circle, 0, 0").error, "no boundary 9"));
  EXPECT_TRUE(has(pressed("set Curved boundaries = 7: sphere, 0, 0").error, "id: circle, x, y"));
}
