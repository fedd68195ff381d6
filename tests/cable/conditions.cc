// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what holds a cable, what is linked to it and how it starts fit each other or are refused
// by the name of the entry. Fields of linearised cables have their own tension.
#include "cable/one_cable.h"
#include "verification/scene_tests.h"

namespace
{
  using namespace verification;
  using namespace taut;

  const auto has_part = [](const std::string &error, const std::string &part)
  { return has(error, part); };

  CableData cable_data()
  {
    return cable_to({60., 0., 0.}, 59.93, {1.3e7, 0., 1.07, 0.}, CableData().n_elements);
  }

  std::string tensions(const Cable &cable, const std::vector<double> &U)
  {
    const std::string path = testing::TempDir() + "taut_linear_tension.vtu";
    cable.write_vtu(path, U);
    const std::string text = file_text(path);
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

  std::string error_of_scene(const Overrides &entries)
  {
    return error_of([&] { run_scene(scene, entries, {}); });
  }
} // namespace

/// Out of the plane a displacement changes nothing in first order; half of its square is 65 kN.
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
  EXPECT_PRED2(has_part, error_of(make), "Held ends");
  data.holds_to = false;
  EXPECT_EQ(error_of(make), "");
  data.clamped = true;
  EXPECT_PRED2(has_part, error_of(make), "Clamped");
  data.holds_from = false;
  EXPECT_PRED2(has_part, error_of(make), "Clamped"); // of no end at all
  data.clamped = false;
  EXPECT_EQ(error_of(make), "");
}

TEST(CableConditions, a_link_has_two_places_along_the_cable_and_a_direction)
{
  EXPECT_EQ(error_of_scene({}), "");
  for (const auto &[entry, value] : {std::pair{"Link l/From", "cable @ 39, 7"},
                                     {"Link l/From", "cable @ 39, 0, 9"},
                                     {"Link l/To", "cable @ 39, 0"},
                                     {"Link l/Direction", ""}})
    EXPECT_PRED2(has_part, error_of_scene({std::string("Network/") + entry + "=" + value}), entry);
}
