// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: answers do not depend on the cuts of wires, and cuts spare droppers and balance parts.
// Source: the uncut run; counts of nodes.
#include "scene_tests.h"

#include "partition/make_partition.h"

using namespace verification;

namespace
{
  /// What a run leaves behind that must not depend on the cuts, step by step.
  struct Record
  {
    std::vector<double> force, gap, probe;
    std::vector<char> closed;
    std::size_t n_cut_rows = 0;
  };

  Record record(const std::string &scene, const Overrides &overrides)
  {
    Record result;
    run_scene(scene_file(scene), overrides,
              [&](const taut::StepView &view)
              {
                result.n_cut_rows = view.structure.cut_constraints().size();
                for (std::size_t i = 0; i < view.constraints.size(); ++i)
                {
                  if (view.constraints[i].is_link())
                  {
                    result.force.push_back(view.state.multiplier[i]);
                    result.gap.push_back(view.state.distance[i]);
                    result.closed.push_back(view.state.multiplier[i] != 0.);
                  }
                }
                result.probe.insert(result.probe.end(), view.probes.begin(), view.probes.end());
              });
    return result;
  }

  /// Largest difference over the largest value, or over @p size if that is larger.
  double difference(const std::vector<double> &a, const std::vector<double> &b, double size = 0.)
  {
    size = std::max(size, largest(a));
    return largest_difference(a, b) / (size > 0. ? size : 1.);
  }

  void expect_same(const std::string &scene, const Overrides &overrides,
                   const std::vector<std::string> &partitions)
  {
    const Record uncut = record(scene, overrides);
    // A link that never opens has gaps of nothing but rounding: the motion of the bodies counts
    // too.
    const double way = largest(uncut.probe);
    for (const std::string &partition : partitions)
    {
      SCOPED_TRACE(scene + ", " + partition);
      const Record cut = record(scene, overrides + Overrides{partition});
      EXPECT_GT(cut.n_cut_rows, 0u);
      EXPECT_LT(figure(scene + ", " + partition + ", force", difference(uncut.force, cut.force)),
                1e-7);
      EXPECT_LT(figure(scene + ", " + partition + ", gap", difference(uncut.gap, cut.gap, way)),
                1e-9);
      EXPECT_LT(difference(uncut.probe, cut.probe), 1e-9);
      EXPECT_EQ(uncut.closed, cut.closed);
    }
  }

  std::string parts(const unsigned int n)
  {
    return "Partition/Number of substructures=" + std::to_string(n);
  }
} // namespace

// Claim: the answers do not depend on how METIS cuts the wires; the contact crosses cuts without a
// trace. Expected: the uncut run, to 1e-9 of the largest gap and 1e-7 of the largest force, with
// the same links open.
TEST(Partition, en50318_is_the_same_in_any_number_of_parts)
{
  expect_same("en50318_2002_250",
              {"Time/End=2.4", "Time/Step=2e-3", "Catenary/Number of spans=5",
               "Catenary/Uplift positions=120", "Statistics/Window="},
              {parts(2), parts(7), parts(64)});
}

// Claim: so in statics, where most pieces float and their rigid body modes are unknowns, and with
// moving supports, stops, angular stops, bars and axial cuts. Expected: the uncut run.
TEST(Partition, every_wire_scene_is_the_same_in_three_parts)
{
  for (const char *scene : {"beam_over_supports", "bar_on_wall", "string_on_stop",
                            "beam_angular_stop", "inclined_cable"})
    expect_same(scene, {"Time/End=1.2"}, {parts(3)});
}

// Claim: the mesh does not change with the cuts, and cuts can be given by hand. Expected: two cuts
// of a beam are four constraints (displacement and slope), and the answers those of the whole beam.
TEST(Partition, cuts_by_hand_keep_the_answers)
{
  const Record cut = record("beam_over_supports", {"Time/End=0.1", "Partition/Method=given",
                                                   "Partition/Cuts=beam @ 3.5, 12.25"}),
               uncut = record("beam_over_supports", {"Time/End=0.1"});
  EXPECT_EQ(cut.n_cut_rows, 4u);
  EXPECT_LT(difference(uncut.force, cut.force), 1e-7);
  EXPECT_LT(difference(uncut.gap, cut.gap), 1e-9);
}

// Claim: a cut between two nodes is made at the nearer one. Expected: the node before a cut at 0.3
// of an element, the node after one at 0.7, the node itself.
TEST(Partition, cuts_by_hand_are_at_the_nearest_node)
{
  Session session(scene_file("beam_over_supports"), {"Time/End=0"});
  const taut::Scene &scene = session.simulation().scene();
  const std::vector<double> nodes = grid(scene, 0);
  const auto place = [&](const std::size_t i, const double part)
  { return std::to_string(nodes[i] + part * (nodes[i + 1] - nodes[i])); };
  taut::PartitionParameters parameters;
  parameters.method = "given";
  parameters.cuts = "beam @ " + place(5, .3) + ", " + place(9, .7) + ", " + place(14, 0.);
  const taut::Partition partition = make_partition(scene, parameters);
  std::vector<std::size_t> first;
  for (const auto &piece : partition.wires[0])
    first.push_back(piece.first);
  EXPECT_EQ(first, (std::vector<std::size_t>{0, 5, 10, 14}));
}

// Claim: the cuts of METIS avoid the droppers, and parts are balanced. Expected: no fixed link of
// the EN line touches a cut node; the largest of 16 parts has at most 1.3 times the mean number of
// nodes, and no more cuts than slices through both wires make.
TEST(Partition, metis_balances_the_parts_and_spares_the_droppers)
{
  Session session(scene_file("en50318_2002_250"), {parts(16), "Time/End=0"});
  const taut::Scene &scene = session.simulation().scene();
  const taut::Partition partition = make_partition(scene, session.parameters().partition);
  ASSERT_EQ(partition.n_parts, 16u);
  std::vector<double> size(16, 0.);
  double all = 0.;
  std::size_t n_cuts = 0;
  for (std::size_t w = 0; w < scene.wires.size(); ++w)
  {
    const std::vector<double> nodes = grid(scene, w);
    const auto &pieces = partition.wires[w];
    n_cuts += pieces.size() - 1;
    for (std::size_t p = 0; p < pieces.size(); ++p)
    {
      const std::size_t end = p + 1 < pieces.size() ? pieces[p + 1].first : nodes.size();
      size[pieces[p].part] += end - pieces[p].first;
      all += end - pieces[p].first;
      if (p == 0)
        continue;
      for (const taut::Link &link : scene.links)
        for (const taut::Attachment *at : {&link.from, &link.to})
        {
          if (!link.moving() && at->kind == taut::Attachment::Kind::wire && at->index == w)
          {
            EXPECT_GT(std::fabs(at->position - nodes[pieces[p].first]), 1e-9) << link.name;
          }
        }
    }
  }
  EXPECT_LE(figure("EN 50318 in 16 parts, cuts", n_cuts), 15 * scene.wires.size());
  EXPECT_LT(*std::max_element(size.begin(), size.end()), 1.3 * all / 16.);
  EXPECT_GT(*std::min_element(size.begin(), size.end()), 0.7 * all / 16.);
}
