// SPDX-License-Identifier: LGPL-2.1-or-later
// Prints what the steps of scenes allocate.
#include "counted_run.h"

namespace
{
  using namespace allocations;

  struct Options
  {
    Steps steps;
    std::vector<std::string> overrides, scenes;
  };

  Options read(const int argc, char **argv)
  {
    Options options;
    const auto number = [&](const int i) { return std::strtol(argv[i], nullptr, 10); };
    for (int i = 1; i < argc; ++i)
    {
      const std::string argument = argv[i];
      const bool has_value = i + 1 < argc;
      if (argument == "--warm-up" && has_value)
        options.steps.warm_up = number(++i);
      else if (argument == "--steps" && has_value)
        options.steps.counted = number(++i);
      else if (argument == "--set" && has_value)
        options.overrides.push_back(argv[++i]);
      else if (argument.rfind("--", 0) == 0)
        throw std::runtime_error("usage: allocations [--warm-up N] [--steps N] "
                                 "[--set Entry=value]... [SCENE]...");
      else
        options.scenes.push_back(argument);
    }
    if (options.scenes.empty())
      options.scenes = moving_scenes();
    return options;
  }

  void print(const Options &options, const std::string &scene)
  {
    const CountedRun run = run_counted(scene, options.steps, options.overrides);
    const std::size_t n_steps = run.by_step.size();
    const double n = std::max<std::size_t>(n_steps, 1);
    std::printf("%-28s %5zu %10ld %12.2f %8ld %8ld  %s\n", scene.c_str(), n_steps, run.total(),
                run.total() / n, run.largest(), run.n_without(), run.ending.c_str());
    std::fflush(stdout);
  }
} // namespace

int main(const int argc, char **argv)
{
  try
  {
    const Options options = read(argc, argv);
    std::printf("%-28s %5s %10s %12s %8s %8s\n", "scene", "steps", "in all", "a step", "largest",
                "without");
    for (const std::string &scene : options.scenes)
      print(options, scene);
  }
  catch (const std::exception &error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
