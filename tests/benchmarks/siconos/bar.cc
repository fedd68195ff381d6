// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs bar.prm with changes and prints what compare.py compares, as JSON: processor time of the
// step loop (least of the repeats), release, standard deviation of the force between 0.2 and 2 s
// and its root mean square error, largest force, energy kept, least gap, root mean square error of
// the motion of the contact.
#include "verification/run.h"

#include <taut/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace
{
  struct Figures
  {
    double release = 0., largest = 0., least_gap = 1e9, energy = 0., sum = 0., square = 0.,
           error = 0., motion = 0.;
    std::clock_t begin = 0, end = 0;
    long n = 0, n_steps = -1;
  };

  /// Kinetic and elastic, of all bodies.
  double energy(const taut::StepView &view)
  {
    double sum = 0.;
    for (std::size_t k = 0; k < view.structure.size(); ++k)
    {
      const taut::Substructure &body = view.structure[k];
      std::vector<double> MV(body.n_dofs(), 0.), KU(body.n_dofs(), 0.);
      body.mass().vmult_add(1., view.state.V[k].data(), MV.data());
      body.stiffness().vmult_add(1., view.state.U[k].data(), KU.data());
      for (std::size_t i = 0; i < MV.size(); ++i)
        sum += .5 * (MV[i] * view.state.V[k][i] + KU[i] * view.state.U[k][i]);
    }
    return sum;
  }

  void record(Figures &f, const taut::StepView &view)
  {
    const double t = view.state.time, force = view.state.multiplier[0],
                 gap = view.state.distance[0];
    const double exact = t < .1 ? .1 - t : t < 2.1 ? 0. : t - 2.1;
    f.motion += (gap - exact) * (gap - exact);
    if (++f.n_steps == 0)
    {
      f.begin = std::clock();
      return;
    }
    if (force > 0.)
      f.release = t;
    f.largest = std::max(f.largest, force);
    f.least_gap = std::min(f.least_gap, gap);
    if (t > .2 && t < 2.)
    {
      ++f.n;
      f.sum += force;
      f.square += force * force;
      f.error += (force - 1.) * (force - 1.);
    }
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: %s FILE.prm REPEATS [Section.Entry=value]...\n", argv[0]);
    return 1;
  }
  try
  {
    double seconds = 1e300;
    Figures figures;
    for (int repeat = 0; repeat < std::atoi(argv[2]); ++repeat)
    {
      verification::Session session(argv[1], {argv + 3, argv + argc});
      const double end = session.parameters().end_time, step = session.parameters().step;
      Figures f;
      session.run(
          [&](const taut::StepView &view)
          {
            record(f, view);
            if (view.state.time > end - .5 * step)
            {
              f.end = std::clock();
              f.energy = energy(view);
            }
          });
      seconds = std::min(seconds, static_cast<double>(f.end - f.begin) / CLOCKS_PER_SEC);
      figures = f;
    }
    const Figures &f = figures;
    const double mean = f.sum / f.n;
    std::printf("{\"seconds\": %.6g, \"release\": %.9g, \"deviation\": %.6g, \"force\": %.6g, "
                "\"largest\": %.9g, "
                "\"energy\": %.9g, \"gap\": %.6g, \"motion\": %.6g}\n",
                seconds, f.release, std::sqrt(std::max(0., f.square / f.n - mean * mean)),
                std::sqrt(f.error / f.n), f.largest, f.energy / .5, f.least_gap,
                std::sqrt(f.motion / (f.n_steps + 1)));
    return 0;
  }
  catch (const taut::UserError &e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
