// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what a scene answers does not depend on how it is computed: both local solvers, assembled
// and matrix-free interface operator, and both complementarity methods give the same forces and
// displacements, to 1e-10 of the largest one or 10 eps cond(F), whichever is more.
#include "scene_tests.h"

#include "interface/schur_complement.h"

#include <deal.II/lac/lapack_templates.h>

using namespace verification;

namespace
{
  /// Forces and probes of a run, step by step.
  struct Record
  {
    std::vector<std::vector<double>> forces, probes;
    double condition = 1.;    ///< of F
    double displacement = 0.; ///< largest of the start [m]
    int n_fallbacks = 0;      ///< steps that the semismooth Newton method did not end
    std::string log;
  };

  /// Condition number of F, of a step by backward Euler or, without one, of the static equilibrium.
  double condition_number(const taut::Structure &structure, const taut::Constraints &constraints,
                          const double step)
  {
    taut::FactoredStructure solvers(structure, "sparse direct");
    if (step > 0.)
      solvers.factor(1. / (step * step), 1. / step);
    else
      solvers.factor_stiffness();
    std::vector<double> S(constraints.size());
    for (std::size_t i = 0; i < constraints.size(); ++i)
      S[i] = 1. / (constraints[i].spring.stiffness +
                   (step > 0. ? constraints[i].spring.damping / step : 0.));
    const auto schur = taut::make_schur_complement({"assembled dense"}, solvers, constraints);
    schur->setup(S);
    const int n = constraints.size();
    if (n == 0)
      return 1.;
    std::vector<double> F, column, unit(n, 0.), w(n), work(40 * n);
    for (int i = 0; i < n; ++i)
    {
      unit[i] = 1.;
      schur->matrix().apply(unit, column);
      unit[i] = 0.;
      F.insert(F.end(), column.begin(), column.end());
    }
    const int lwork = work.size();
    int info = 0;
    dealii::syev("N", "L", &n, F.data(), &n, w.data(), work.data(), &lwork, &info);
    EXPECT_EQ(info, 0);
    return w.back() / std::max(w.front(), std::numeric_limits<double>::min());
  }

  Record record(const std::string &scene, const Overrides &overrides)
  {
    Record r;
    Session session(scene_file(scene), overrides);
    session.run(
        [&](const taut::StepView &view)
        {
          r.forces.push_back(view.state.multiplier);
          r.probes.push_back(view.probes);
          r.n_fallbacks += view.residuals.fallback;
          if (r.forces.size() == 1)
            for (const std::vector<double> &u : view.reference.displacement)
              r.displacement = std::max(r.displacement, largest(u));
        });
    const taut::Structure &structure = session.simulation().structure();
    r.condition =
        condition_number(structure, session.simulation().constraints(), session.parameters().step);
    // Scenes that start from an equilibrium start with the rounding of its forces.
    if (session.simulation().scene().start == taut::Start::equilibrium)
      r.condition = std::max(r.condition,
                             condition_number(structure, session.simulation().constraints(), 0.));
    r.log = session.log();
    return r;
  }

  /// Largest difference over the largest entry, or over a given size if that is larger.
  double difference(const std::vector<std::vector<double>> &a,
                    const std::vector<std::vector<double>> &b, double size)
  {
    EXPECT_EQ(a.size(), b.size());
    double error = 0.;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    {
      error = std::max(error, largest_difference(a[i], b[i]));
      size = std::max(size, largest(a[i]));
    }
    return size > 0. ? error / size : error;
  }

  struct Case
  {
    std::string scene;
    Overrides overrides;
  };

  /// Largest difference over what is allowed.
  double compare(const Case &c, const Overrides &other, const std::string &name)
  {
    const Record one = record(c.scene, c.overrides), two = record(c.scene, c.overrides + other);
    EXPECT_EQ(one.n_fallbacks, 0) << c.scene << ": these scenes do not make Newton's method cycle";
    const double forces = difference(one.forces, two.forces, 0.),
                 probes = difference(one.probes, two.probes, one.displacement),
                 tolerance =
                     std::max(1e-10, 10. * std::numeric_limits<double>::epsilon() * one.condition);
    figure(c.scene + ", " + name + ", difference of the forces", forces);
    figure(c.scene + ", " + name + ", difference of the probes", probes);
    figure(c.scene + ", cond F", one.condition);
    EXPECT_LT(forces, tolerance) << c.scene << ", " << name << ", cond F " << one.condition;
    EXPECT_LT(probes, tolerance) << c.scene << ", " << name << ", cond F " << one.condition;
    return std::max(forces, probes) / tolerance;
  }

  const std::vector<Case> short_scenes = {
      {"bar_on_wall", {}},
      {"string_on_stop", {}},
      {"oscillator_with_stop", {}},
      {"inclined_cable", {}},
      {"beam_angular_stop", {}},
      {"beam_over_supports", {}},
      {"en50318_2002_string", {"Time.Step=1e-3", "Time.End=0.01"}},
      {"line_55m", {"Time.Step=1e-3", "Time.End=0.01"}},
      {"en50318_2002_250", {"Time.End=0.3", "Statistics.Window="}},
      {"en50318_2002_300", {"Time.End=0.3", "Statistics.Window="}},
      {"en50318_2002_250_two", {"Time.End=0.3", "Statistics.Window="}}};
} // namespace

TEST(SameAnswers, of_both_local_solvers)
{
  double worst = 0.;
  for (const Case &c : short_scenes)
    worst = std::max(worst, compare(c, {"Solver.Local solver=sparse direct"}, "sparse direct"));
  figure("both local solvers, largest difference over the allowed one", worst);
}

TEST(SameAnswers, of_all_forms_of_the_interface_operator)
{
  double worst = 0.;
  for (const Case &c : short_scenes)
    for (const std::string form : {"assembled sparse", "matrix-free"})
      worst = std::max(worst, compare(c, {"Solver.Interface operator=" + form}, form));
  figure("all forms of F, largest difference over the allowed one", worst);
}

TEST(SameAnswers, of_all_complementarity_methods_on_every_scene)
{
  double worst = 0.;
  for (Case c : short_scenes)
  {
    if (c.scene.find("en50318_2002_2") == 0 || c.scene.find("en50318_2002_3") == 0)
      c.overrides.clear();
    for (const std::string method : {"energy-ordered", "MPRGP"})
      worst = std::max(worst, compare(c, {"Solver.Complementarity=" + method}, method));
  }
  figure("all complementarity methods, largest difference over the allowed one", worst);
}
