// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs a MoorDyn input file with one line through MoorDyn's C interface, and prints as JSON what
// compare.py compares: processor time of the step loop, positions of a node, forces of the ends.
// compare.py compiles it beside the sources of MoorDyn; it is no part of Taut.
//
//   peer FILE STEP STEPS EVERY NODE SOLVE [x y z]... [-- dx dy dz PERIOD]
//
// STEPS steps of STEP seconds, the positions of NODE at the start and after each EVERY of them.
// With SOLVE = 1 MoorDyn finds its own equilibrium first, otherwise it starts from the input as it
// is. x y z are the places of the coupled points; after -- the last of them moves by
// (dx, dy, dz) sin^4(pi t / PERIOD).
#include <MoorDyn2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

namespace
{
  void expect(const int code, const char *what)
  {
    if (code == MOORDYN_SUCCESS)
      return;
    std::fprintf(stderr, "%s: error %d of MoorDyn\n", what, code);
    std::exit(1);
  }

  struct Motion
  {
    std::vector<double> start, way = {0., 0., 0.};
    double period = 0.;

    bool moves() const { return period > 0.; }

    void at(const double t, std::vector<double> &places) const
    {
      places = start;
      const double part = moves() ? std::pow(std::sin(M_PI * t / period), 4) : 0.;
      for (std::size_t i = 0; i < 3 && places.size() >= 3; ++i)
        places[places.size() - 3 + i] += part * way[i];
    }
  };

  double seconds(const std::clock_t begin)
  {
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }

  void print_position(const MoorDynLine line, const unsigned int node, const bool first)
  {
    double place[3];
    expect(MoorDyn_GetLineNodePos(line, node, place), "position");
    std::printf("%s[%.15g, %.15g, %.15g]", first ? "" : ", ", place[0], place[1], place[2]);
  }

  double least_tension(const MoorDynLine line)
  {
    unsigned int n = 0;
    expect(MoorDyn_GetLineN(line, &n), "segments");
    double least = 1e300, force[3];
    for (unsigned int i = 0; i <= n; ++i)
    {
      expect(MoorDyn_GetLineNodeTen(line, i, force), "tension");
      least = std::min(least, std::hypot(force[0], force[1], force[2]));
    }
    return least;
  }
} // namespace

int main(int argc, char **argv)
{
  if (argc < 7)
  {
    std::fprintf(stderr,
                 "usage: peer FILE STEP STEPS EVERY NODE SOLVE [x y z]... [-- dx dy dz PERIOD]\n");
    return 1;
  }
  const double step = std::atof(argv[2]);
  const long steps = std::atol(argv[3]), every = std::max(1L, std::atol(argv[4]));
  const unsigned int node = std::atoi(argv[5]);
  Motion motion;
  int i = 7;
  for (; i < argc && std::strcmp(argv[i], "--") != 0; ++i)
    motion.start.push_back(std::atof(argv[i]));
  if (i + 4 < argc)
  {
    motion.way = {std::atof(argv[i + 1]), std::atof(argv[i + 2]), std::atof(argv[i + 3])};
    motion.period = std::atof(argv[i + 4]);
  }

  MoorDyn system = MoorDyn_Create(argv[1]);
  if (system == nullptr)
    return 1;
  std::vector<double> places, next, speeds(motion.start.size(), 0.),
      forces(motion.start.size() + 6);
  motion.at(0., places);
  const std::clock_t begin_start = std::clock();
  expect((std::atoi(argv[6]) != 0 ? MoorDyn_Init : MoorDyn_Init_NoIC)(system, places.data(),
                                                                      speeds.data()),
         "start");
  const double start_seconds = seconds(begin_start);
  const MoorDynLine line = MoorDyn_GetLine(system, 1);

  std::printf("{\"positions\": [");
  print_position(line, node, true);
  double least = 1e300, t = 0., spent = 0.;
  std::clock_t begin = std::clock();
  for (long k = 0; k < steps; ++k)
  {
    motion.at(k * step, places);
    motion.at((k + 1) * step, next);
    for (std::size_t j = 0; j < speeds.size(); ++j)
      speeds[j] = (next[j] - places[j]) / step;
    double length = step;
    expect(MoorDyn_Step(system, places.data(), speeds.data(), forces.data(), &t, &length), "step");
    if ((k + 1) % every != 0)
      continue;
    spent += seconds(begin);
    print_position(line, node, false);
    least = std::min(least, least_tension(line));
    begin = std::clock();
  }
  std::printf(
      "], \"start seconds\": %.6g, \"seconds\": %.6g, \"least tension\": %.9g, \"forces\": [",
      start_seconds, spent, least);
  for (std::size_t j = 0; j < motion.start.size(); ++j)
    std::printf("%s%.12g", j == 0 ? "" : ", ", forces[j]);
  double fair = 0.;
  expect(MoorDyn_GetLineFairTen(line, &fair), "tension");
  std::printf("], \"end tension\": %.12g}\n", fair);
  expect(MoorDyn_Close(system), "end");
  return 0;
}
