// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: weights that stand on links are at rest only if what holds them to the sides is stiffer
// than these links are soft; otherwise there is an error that names a link. Expected values: the
// critical stiffness P/L of a prop, eigenvalues of two props, guys with their own tension.
#include "turning_scene.h"

using verification::g;

using namespace turning;

namespace
{
  constexpr double weight = 400., length = 1.6;

  std::string link(const std::string &type, const std::string &from, const std::string &to,
                   const double of_length)
  {
    return "Type = " + type + "; From = " + from + "; To = " + to +
           "; Length = " + number(of_length);
  }

  /// Weights one above the other on props, or rods.
  Scene tower(const int n, const std::string &type = "stop")
  {
    Scene scene;
    for (int i = 0; i < n; ++i)
    {
      scene.masses.push_back({weight / g, {0., length * (i + 1), 0.}, {}});
      scene.links.push_back(link(type, i == 0 ? "ground @ 0, 0" : "m" + std::to_string(i - 1),
                                 "m" + std::to_string(i), length));
    }
    return scene;
  }

  /// Springs of each weight to the ground, along x and z.
  Overrides springs(const int n, const double along_x, const double along_z)
  {
    Overrides result;
    std::string names;
    for (int i = 0; i < n; ++i)
      for (const auto &[axis, k] : {std::pair("x", along_x), {"z", along_z}})
      {
        const std::string name = axis + std::to_string(i), section = "Network/Spring " + name;
        names += (names.empty() ? "" : ", ") + name;
        result.insert(result.end(), {section + "/To=m" + std::to_string(i),
                                     section + "/Direction=" + (*axis == 'x' ? "1, 0" : "0, 0, 1"),
                                     section + "/Stiffness=" + number(k)});
      }
    result.push_back("Network/Springs=" + names);
    return result;
  }

  /// The error; empty: they stand, where the scene has them and with a force @p N of link 0.
  std::string error_of(const Scene &scene, const Overrides &overrides, const double N)
  {
    return verification::error_of(
        [&]
        {
          scene.run(
              [&](const Motion &m)
              {
                EXPECT_NEAR(m.multiplier[0], N, 1e-9 * N);
                for (std::size_t i = 0; i < m.place.size(); ++i)
                {
                  EXPECT_NEAR(m.place[i].x, scene.masses[i].place.x, 1e-9);
                  EXPECT_NEAR(m.place[i].z, scene.masses[i].place.z, 1e-9);
                }
              },
              overrides);
        });
  }

  void expect_refused(const std::string &error, const std::string &name)
  {
    for (const std::string &part :
         {"Network/Link " + name, "link '" + name + "' with", std::string("Hold its ends")})
      EXPECT_TRUE(has(error, part)) << part << " in: " << error;
  }

  /// At this part of the critical stiffness the weights are refused, and at the inverse they stand.
  constexpr double below = .995;
} // namespace

TEST(TurningStability, weight_on_a_prop_without_anything_beside_it)
{
  for (const char *const type : {"stop", "joint"})
    expect_refused(error_of(tower(1, type), {}, weight), "l0");
  EXPECT_EQ(error_of(tower(1, "dropper"), {"Gravity=0, 9.81"}, weight), "");
}

TEST(TurningStability, critical_stiffness_of_a_prop)
{
  const double critical = weight / length;
  for (const auto &[type, form] : {std::pair("stop", "assembled dense"),
                                   {"joint", "assembled sparse"},
                                   {"stop", "matrix-free"}})
  {
    const auto error = [type = type, form = form](const double along_x, const double along_z)
    {
      return error_of(tower(1, type),
                      springs(1, along_x, along_z) +
                          Overrides{"Solver/Interface operator=" + std::string(form)},
                      weight);
    };
    EXPECT_EQ(error(critical / below, critical / below), "");
    expect_refused(error(critical * below, critical / below), "l0");
    expect_refused(error(critical / below, critical * below), "l0");
    EXPECT_EQ(error(1e9, 1e9), "");
  }
}

TEST(TurningStability, elastic_prop_gets_shorter)
{
  constexpr double stiffness = 1000.;
  Scene scene = tower(1);
  scene.links[0] += "; Stiffness = " + number(stiffness);
  const double critical = weight / (length - weight / stiffness);
  EXPECT_EQ(error_of(scene, springs(1, critical / below, critical / below), weight), "");
  expect_refused(error_of(scene, springs(1, critical * below, critical * below), weight), "l0");
}

TEST(TurningStability, two_weights_one_above_the_other)
{
  // Geometric stiffness (3, -1; -1, 1) P/L: its largest eigenvalue.
  const double critical = (2. + std::sqrt(2.)) * weight / length;
  EXPECT_EQ(error_of(tower(2), springs(2, critical / below, critical / below), 2. * weight), "");
  expect_refused(error_of(tower(2), springs(2, critical * below, 1e6), 2. * weight), "l1");
}

TEST(TurningStability, guys_hold_a_mast)
{
  // Four elastic ropes at 45 degrees under a tension T hold the head with k + 3 T/l against the
  // prop's (P + 4 T/sqrt(2))/L.
  constexpr double tension = 100.;
  const double rope_length = length * std::sqrt(2.),
               critical =
                   (weight + 4. * tension / std::sqrt(2.)) / length - 3. * tension / rope_length;
  for (const double part : {below, 1. / below})
  {
    const double k = critical * part;
    Scene scene = tower(1);
    for (const Coordinates &foot :
         {Coordinates{length, 0., 0.}, {-length, 0., 0.}, {0., 0., length}, {0., 0., -length}})
      scene.links.push_back(rope("ground @ " + text(foot), "m0", rope_length - tension / k) +
                            "; Stiffness = " + number(k));
    const std::string error = error_of(scene, {}, weight + 4. * tension / std::sqrt(2.));
    if (part < 1.)
      expect_refused(error, "l0");
    else
      EXPECT_EQ(error, "");
  }
}

TEST(TurningStability, guys_that_just_touch_hold_a_mast_in_their_plane)
{
  Scene scene = tower(1);
  for (const double x : {-length, length})
    scene.links.push_back("Type = dropper; To = m0; From = ground @ " + text({x, 0., 0.}));
  EXPECT_EQ(error_of(scene, {"Network/Mass m0/Motions=x, y"}, weight), "");
  expect_refused(error_of(scene, {}, weight), "l0");
}
