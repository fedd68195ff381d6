// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what holds a cable, what is linked to it and how it starts fit each other or are refused
// by the name of the entry. Fields of linearised cables show their own tension. Expected values:
// closed forms.
#include "cable/one_cable.h"
#include "verification/scene_tests.h"

#include <cstdio>

using verification::error_of;
using verification::has;

namespace
{
  using namespace taut;

  CableData cable_data()
  {
    return verification::cable_to({60., 0., 0.}, 59.93, {1.3e7, 0., 1.07, 0.},
                                  CableData().n_elements);
  }

  void expect_entry(const std::string &entry, const std::string &error)
  {
    EXPECT_TRUE(has(error, entry)) << error;
  }

  /// The tensions of a .vtu file, as it has them encoded.
  std::string tensions(const Cable &cable, const std::vector<double> &U)
  {
    const std::string path = testing::TempDir() + "taut_linear_tension.vtu";
    cable.write_vtu(path, U);
    const std::string text = verification::file_text(path);
    std::remove(path.c_str());
    const std::size_t begin = text.find('>', text.find("Name=\"tension\"")) + 1;
    return text.substr(begin, text.find('<', begin) - begin);
  }

  const std::string scene = R"(Gravity = 0, -9.81
Body cable: Type = cable; From = 0, 0; To = 60, 0; Unstressed length = 78;
  Axial stiffness = 13e6; Mass per length = 1.07; Elements = 8
Mass m: Position = 30, -30; Motions = y; Mass = 10
Link l: Type = dropper; From = cable @ 39, 0; To = m; Stiffness = 1e5; Direction = 0, -1
Time: End = 0
)";

  std::string error_of_scene(const verification::Overrides &entries)
  {
    return error_of([&] { verification::run_scene(scene, entries, {}); });
  }
} // namespace

/// Out of the plane of the cable a displacement changes nothing in first order, while half of the
/// square of its slope would be 65 kN.
TEST(CableConditions, tension_of_a_linearised_cable_is_linear)
{
  for (const CableElement element : {CableElement::ancf, CableElement::bar})
  {
    CableData data = cable_data();
    data.geometry = taut::CableGeometry::linearised;
    data.element = element;
    const auto nonlinear = std::make_shared<Cable>(data);
    const auto linear = nonlinear->linearised(std::vector<double>(nonlinear->n_dofs(), 0.));
    const auto &cable = dynamic_cast<const Cable &>(*linear);
    const auto moved = [&](const Coordinates &slope)
    {
      return cable.elements().interpolate([&](const double s) { return add_scaled({}, s, slope); },
                                          [&](double) { return slope; });
    };
    const std::string rest = tensions(cable, std::vector<double>(cable.n_dofs(), 0.));
    ASSERT_GT(rest.size(), 100u);
    EXPECT_EQ(tensions(cable, moved({0., 0., .1})), rest);
    EXPECT_NE(tensions(cable, moved({1e-3, 0., 0.})), rest);
  }
}

TEST(CableConditions, a_straight_start_fits_what_is_held)
{
  CableData data = cable_data();
  data.length = 78.;
  data.section.bending_stiffness = 1.;
  data.starts_straight = true;
  data.start_direction = {1., 0., 0.};
  const auto make = [&] { Cable cable(data); };
  expect_entry("Held ends", error_of(make));
  data.holds_to = false;
  EXPECT_EQ(error_of(make), "");
  data.clamped = true;
  expect_entry("Clamped", error_of(make));
  data.holds_from = false;
  expect_entry("Clamped", error_of(make)); // of no end at all
  data.clamped = false;
  EXPECT_EQ(error_of(make), "");
}

TEST(CableConditions, a_link_has_two_places_along_the_cable_and_a_direction)
{
  EXPECT_EQ(error_of_scene({}), "");
  expect_entry("Link l/From", error_of_scene({"Network/Link l/From=cable @ 39, 7"}));
  expect_entry("Link l/From", error_of_scene({"Network/Link l/From=cable @ 39, 0, 9"}));
  expect_entry("Link l/To", error_of_scene({"Network/Link l/To=cable @ 39, 0"}));
  expect_entry("Link l/Direction", error_of_scene({"Network/Link l/Direction="}));
}
