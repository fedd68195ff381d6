// SPDX-License-Identifier: LGPL-2.1-or-later
// A case goes through the program as a scene generator of its own.
#include "common.h"
#include "observation.h"
#include "verification/run.h"

#include <taut/scene/scene_generator.h>

namespace extremes
{
  namespace
  {
    const taut::Scene *scene_of_next_run = nullptr;

    class ValueGenerator : public taut::SceneGenerator
    {
    public:
      void declare_parameters(dealii::ParameterHandler &) override {}
      void fill(taut::Scene &scene) const override { scene = *scene_of_next_run; }
    };

    const taut::Register<taut::SceneGenerator, ValueGenerator> entry("extremes",
                                                                     "a scene made by the tests");

    Observation observe(const taut::StepView &view, const std::vector<ObservedPoint> &points,
                        const std::vector<std::size_t> &group)
    {
      Observation o;
      for (const ObservedPoint &p : points)
      {
        std::vector<taut::Term> terms;
        view.structure.motion(p.at, p.rotational, p.direction, 1., terms);
        o[p.rotational ? rotation : displacement].push_back(
            verification::displacement(view, terms));
      }
      std::vector<double> sum(group.size(), 0.);
      for (std::size_t k = 0; k < group.size(); ++k)
        sum[group[k]] += view.state.multiplier[view.constraints.index_of_link(k)];
      for (std::size_t k = 0; k < group.size(); ++k)
      {
        const bool rotational = view.scene.links[k].rotational;
        if (group[k] == k)
          o[rotational ? moment : force].push_back(sum[k]);
        o[rotational ? angular_gap : gap].push_back(
            view.state.distance[view.constraints.index_of_link(k)]);
      }
      return o;
    }
  } // namespace

  verification::Session session_of(const Case &c)
  {
    scene_of_next_run = &c.scene;
    const char *const starts[] = {"equilibrium", "undeformed", "given"};
    verification::Overrides overrides = {
        "Gravity=" + verification::number(c.scene.gravity.x) + "," +
            verification::number(c.scene.gravity.y),
        std::string("Start=") + starts[static_cast<int>(c.scene.start)],
        "Time.Scheme=" + c.scheme,
        "Time.Allow unsuitable scheme=true",
        "Time.Allow energy gain=true",
        "Time.Step=" + verification::number(c.step),
        "Time.End=" + verification::number(c.n_steps * c.step),
        "Output.Interval=1e30",
        "Output.Link interval=1e30",
        "Output.Field interval=0",
        "Solver.Local solver=" + c.local_solver,
        "Solver.Interface operator=" + c.interface_operator,
        "Solver.Complementarity=" + c.complementarity,
        "Partition.Number of substructures=" + std::to_string(c.n_parts)};
    return verification::Session("set Generator = extremes\n\n", overrides);
  }

  Answer program_answer(const Case &c)
  {
    Answer answer;
    const std::vector<ObservedPoint> points = observed_points(c.scene);
    const std::vector<std::size_t> group = groups_of_links(c.scene);
    const auto record = [&](const taut::StepView &view)
    {
      answer.steps.push_back(observe(view, points, group));
      answer.conserving.clear();
      for (std::size_t k = 0; k < group.size(); ++k)
        answer.conserving.push_back(
            view.constraints[view.constraints.index_of_link(k)].spring.conserving);
      answer.certificate = std::max(answer.certificate, view.residuals.max());
      answer.iterations = std::max(answer.iterations, view.residuals.iterations);
      answer.n_fallbacks += view.residuals.fallback;
    };
    answer.error = verification::error_of([&] { session_of(c).run(record); });
    return answer;
  }
} // namespace extremes