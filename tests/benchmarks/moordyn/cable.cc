// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs a scene with one cable and prints what compare.py compares, as JSON: processor time of the
// step loop and of what comes before it, positions of a place of the cable at the start and after
// each interval, multipliers at the start.
#include "verification/run.h"

#include <taut/cable/cable.h>

namespace
{
  const taut::Cable &cable_of(const taut::SceneBodies &structure, std::size_t &index)
  {
    for (index = 0; index < structure.size(); ++index)
      if (const auto *cable = dynamic_cast<const taut::Cable *>(&structure[index]))
        return *cable;
    throw taut::UserError("there is no cable");
  }

  struct Run
  {
    double s = 0.;
    double interval = 1.; ///< between two positions [s]; steps may be halved on the way
    std::vector<taut::Coordinates> positions;
    std::vector<double> multipliers;
    std::clock_t begin = 0;
    double seconds = 0., start_seconds = 0.;

    void record(const taut::StepView &view)
    {
      if (view.state.time < (positions.size() - 1e-6) * interval)
        return;
      const std::clock_t now = std::clock();
      (positions.empty() ? start_seconds : seconds) +=
          static_cast<double>(now - begin) / CLOCKS_PER_SEC;
      std::size_t k = 0;
      const taut::Cable &cable = cable_of(view.structure, k);
      std::vector<double> U = view.reference.displacement[k];
      for (std::size_t i = 0; i < U.size(); ++i)
        U[i] += view.state.U[k][i];
      if (positions.empty())
        multipliers = view.state.multiplier;
      positions.push_back(cable.elements().position(cable.positions(U), s));
      begin = std::clock();
    }
  };
} // namespace

int main(int argc, char **argv)
{
  if (argc < 4)
  {
    std::fprintf(stderr, "usage: %s FILE.prm S INTERVAL [Section.Entry=value]...\n", argv[0]);
    return 1;
  }
  try
  {
    Run run;
    run.s = std::atof(argv[2]);
    run.interval = std::atof(argv[3]);
    run.begin = std::clock();
    verification::Session session(argv[1], {argv + 4, argv + argc});
    session.run([&](const taut::StepView &view) { run.record(view); });
    std::printf("{\"positions\": [");
    for (std::size_t i = 0; i < run.positions.size(); ++i)
      std::printf("%s[%.15g, %.15g, %.15g]", i == 0 ? "" : ", ", run.positions[i][0],
                  run.positions[i][1], run.positions[i][2]);
    std::printf("], \"multipliers\": [");
    for (std::size_t i = 0; i < run.multipliers.size(); ++i)
      std::printf("%s%.12g", i == 0 ? "" : ", ", run.multipliers[i]);
    std::printf("], \"seconds\": %.6g, \"start seconds\": %.6g}\n", run.seconds, run.start_seconds);
    return 0;
  }
  catch (const taut::UserError &e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
