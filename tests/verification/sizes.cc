// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the sizes that certificates divide by are those of the vectors and constraints,
// not-a-number included. Source: a loop over all entries.
#include "scene_tests.h"

#include "model/scene_constraints.h"
#include "time/matrix_norms.h"
#include <taut/interface/constraints.h>

using namespace verification;

namespace
{
  /// A body of n DoFs whose kinds repeat themselves.
  class Body : public taut::Substructure
  {
  public:
    Body(const unsigned int n, const std::vector<unsigned char> &pattern) : Substructure("body")
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(n);
      kinds = pattern;
    }
    void initial_state(std::vector<double> &, std::vector<double> &) const override {}
    NullSpace null_space() const override { return {}; }
  };

  void expect_same(const double a, const double b)
  {
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << " and " << b;
  }
} // namespace

TEST(Sizes, largest_entries_of_vectors_are_those_of_a_loop)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-1., 1.);
  const std::vector<std::vector<unsigned char>> patterns = {
      {0}, {1}, {0, 1}, {0, 0, 1}, {0, 1, 1, 0}};
  for (const std::vector<unsigned char> &pattern : patterns)
    for (unsigned int n = pattern.size(); n < 90; n += pattern.size())
      for (const bool with_nan : {false, true})
      {
        SCOPED_TRACE(std::to_string(pattern.size()) + " kinds, " + std::to_string(n) + " DoFs");
        const Body body(n, pattern);
        std::array<std::vector<double>, 4> x;
        for (std::vector<double> &v : x)
        {
          v.resize(n);
          for (double &entry : v)
            entry = value(random);
          if (with_nan && value(random) > 0.)
            v[random() % n] = std::numeric_limits<double>::quiet_NaN();
        }
        for (int v = 0; v < 4; ++v)
        {
          taut::ByKind expected = {0., 0.};
          for (unsigned int i = 0; i < n; ++i)
            raise(expected[body.kind(i)], x[v][i]);
          for (int kind = 0; kind < 2; ++kind)
            expect_same(taut::max_norms(body, x[v])[kind], expected[kind]);
        }
      }
}

TEST(Sizes, largest_forces_of_rows_are_those_of_a_loop)
{
  Session session(scene_file("en50318_2002_250_two"), {"Time.End=0.01", "Statistics.Window="});
  session.run();
  const taut::SceneBodies &structure = session.simulation().structure();
  taut::Constraints constraints = taut::scene_constraints(session.simulation().scene(), structure);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> value(-1., 1.);
  for (int i = 0; i < 20; ++i)
  {
    constraints.update(.01 * i);
    std::vector<double> N(constraints.size());
    for (double &force : N)
      force = value(random) > 0. ? value(random) : 0.;
    if (i % 5 == 0)
      N[random() % N.size()] = std::numeric_limits<double>::quiet_NaN();
    std::vector<taut::ByKind> expected(structure.size(), {0., 0.}), found;
    std::vector<double> motion(constraints.size()), size(constraints.size());
    taut::BodyVectors U = structure.zero(), P = structure.zero(), P_expected = P;
    for (std::vector<double> &u : U)
      for (double &entry : u)
        entry = value(random);
    constraints.share_of_motions(U, motion, size);
    constraints.add_forces(N, P);
    for (std::size_t r = 0; r < constraints.size(); ++r)
    {
      for (const auto &[k, form, of] : constraints[r].terms)
        for (std::size_t j = 0; j < form.index.size(); ++j)
        {
          // A zero has no force, not even of a multiplier that is not a number.
          if (form.value[j] != 0.)
            P_expected[k][form.index[j]] += N[r] * form.value[j];
          raise(expected[k][structure[k].kind(form.index[j])], form.value[j] * N[r]);
        }
      EXPECT_NEAR(motion[r], evaluate(constraints[r].terms, U), 1e-15);
      EXPECT_NEAR(size[r], magnitude(constraints[r].terms, U), 1e-15);
    }
    constraints.largest_forces(N, found);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      for (int kind = 0; kind < 2; ++kind)
        expect_same(found[k][kind], expected[k][kind]);
      for (std::size_t j = 0; j < P[k].size(); ++j)
        expect_same(P[k][j], P_expected[k][j]);
    }
  }
}
