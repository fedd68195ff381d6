// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: a cable that is linear, about its shape at rest or as a straight wire, moves as closed
// forms say, and is refused where it has none. Expected values: closed forms.
#include "cable/slack_cable.h"
#include "verification/scene_tests.h"

#include <taut/cable/find_shape.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace
{
  using namespace verification;
  using namespace taut;

  std::vector<double> frequencies(const Substructure &body, const unsigned int n)
  {
    const std::vector<unsigned int> &held = body.constrained_dofs();
    std::vector<unsigned int> dofs;
    for (unsigned int i = 0; i < body.n_dofs(); ++i)
      if (std::find(held.begin(), held.end(), i) == held.end())
        dofs.push_back(i);
    const auto dense = [&](const SymmetricMatrix &matrix)
    {
      dealii::LAPACKFullMatrix<double> result(dofs.size());
      for (std::size_t j = 0; j < dofs.size(); ++j)
      {
        std::vector<double> unit(body.n_dofs(), 0.);
        unit[dofs[j]] = 1.;
        const std::vector<double> column = matrix_times(matrix, unit);
        for (std::size_t i = 0; i < dofs.size(); ++i)
          result(i, j) = column[dofs[i]];
      }
      return result;
    };
    dealii::LAPACKFullMatrix<double> K = dense(body.stiffness()), M = dense(body.mass());
    std::vector<dealii::Vector<double>> no_modes;
    K.compute_generalized_eigenvalues_symmetric(M, no_modes);
    std::vector<double> result;
    for (unsigned int k = 0; k < n; ++k)
      result.push_back(std::sqrt(K.eigenvalue(k).real()));
    return result;
  }

  TEST(CableGeometries, LinearisedCableSwings)
  {
    CableData data = slack_cable();
    data.geometry = CableGeometry::linearised;
    data.n_elements = 64;
    const MakeCable make = [&](const double length) { return make_elements(data, length); };
    const double H = 16e3, m = 1.07, l = 60., w = m * 9.81;
    data.length = length_for_tension(make, data.from, data.to, force_per_length(data), H);
    const auto nonlinear = std::make_shared<Cable>(data);
    EXPECT_FALSE(nonlinear->is_linear());
    const std::vector<double> rest(nonlinear->n_dofs(), 0.);
    const std::shared_ptr<const Substructure> linear = nonlinear->linearised(rest);
    const auto &cable = dynamic_cast<const Cable &>(*linear);
    EXPECT_TRUE(cable.is_linear());
    const std::vector<double> P = unbalanced(cable, rest);
    EXPECT_LT(largest_of(P, cable.constrained_dofs()), 1e-6);
    EXPECT_NEAR(std::hypot(P[0], P[1]), std::hypot(H, .5 * w * data.length), 1e-3);
    // Irvine 1981, chapter 3: across the plane and antisymmetric n pi / l sqrt(H/m); symmetric ones
    // in the plane tan(x) = x - 4 x^3 / lambda^2 with x = omega l / 2 sqrt(m/H).
    const double sag_ratio = w * l / (8. * H), stretched = l * (1. + 8. * sag_ratio * sag_ratio),
                 lambda2 = std::pow(w * l / H, 2) * l * 1.3e7 / (H * stretched);
    const double x =
        end_of(.5 * pi + 1e-6, 1.5 * pi - 1e-6,
               [&](const double y) { return std::tan(y) - y + 4. * y * y * y / lambda2 < 0.; });
    const double string = pi / l * std::sqrt(H / m), symmetric = 2. * x / l * std::sqrt(H / m);
    std::vector<double> expected = {string, 2. * string, 2. * string, symmetric};
    std::sort(expected.begin(), expected.end());
    const std::vector<double> found = frequencies(cable, 4);
    for (int k = 0; k < 4; ++k)
    {
      figure("frequency " + std::to_string(k + 1) + " of a cable over that of a shallow one",
             found[k] / expected[k]);
      EXPECT_NEAR(found[k] / expected[k], 1., 3e-3);
    }
  }

  // The tension along the chord is H over its slope's cosine: weight acts across the level.
  TEST(CableGeometries, LinearCableIsAStraightWire)
  {
    CableData data = slack_cable();
    data.geometry = CableGeometry::linear;
    data.n_elements = 64;
    data.from = {};
    data.to = {48., 36., 0.};
    data.section.bending_stiffness = 0.;
    const MakeCable make = [&](const double length) { return make_elements(data, length); };
    const double H = 16e3, T = H / .8, l = 60., F = 10., EA = data.section.axial_stiffness;
    data.length = length_for_tension(make, data.from, data.to, force_per_length(data), H);
    const double m = data.section.mass_per_length * data.length / l;
    const Cable wire(data);
    const double string = pi / l * std::sqrt(T / m);
    const std::vector<double> found = frequencies(wire, 4);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(found[k] / (string * (1 + k / 2)), 1., 1e-4) << k;
    const Coordinates middle = {.5 * data.length, 0.}, along = {.8, .6, 0.};
    for (const Coordinates &direction : {along, {-.6, .8, 0.}, {0., 0., 1.}})
    {
      data.element = CableElement::bar; // which has a kink where it is pulled
      Cable pulled(data);
      const LinearForm form = pulled.displacement(middle, direction);
      pulled.add_force(form, F);
      const double expected = direction == along ? F * data.length / (4. * EA) : F * l / (4. * T);
      EXPECT_NEAR(form.dot(equilibrium(pulled)) / expected, 1., 1e-4);
    }
  }

  TEST(CableGeometries, LinearisedOnlyUnderTension)
  {
    // So stiff in bending that the weight does not take all of its compression.
    CableData data = slack_cable();
    data.to = {110., 20., -3.};
    data.length = 10.05;
    data.section.bending_stiffness = 1e4;
    EXPECT_NO_THROW(Cable{data});
    for (const CableGeometry geometry : {CableGeometry::linearised, CableGeometry::linear})
      try
      {
        data.geometry = geometry;
        const auto cable = std::make_shared<Cable>(data);
        cable->linearised(std::vector<double>(cable->n_dofs(), 0.));
        ADD_FAILURE() << "was taken";
      }
      catch (const EntryError &e)
      {
        EXPECT_EQ(e.entry(), "Body cable/Geometry");
      }
  }
} // namespace
