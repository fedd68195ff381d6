// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_command_line_h
#define taut_command_line_h

#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /// What a command line asks for.
  struct CommandLine
  {
    std::string mistake; ///< what is wrong with the command line; empty: nothing
    std::string answer;  ///< the text that --help or --version asks for; empty: there is work

    std::optional<std::string> file; ///< a parameter file; none: write one with all defaults
    std::vector<std::string> overrides;
    bool check = false, elasticity = false, study = false, sweep = false, overwrite = false,
         resume = false;
    std::optional<std::string> sketch;
    std::optional<std::string> network; ///< the file that the scene is written out to
    std::optional<double> accuracy;
    unsigned int jobs = 1;
  };

  CommandLine read_command_line(int argc, char **argv);

  /// Does what a command line asks for. Returns the exit code.
  int run(const CommandLine &line);

  constexpr const char *too_large =
      "the scene needs more memory than there is; take larger elements or fewer links";
} // namespace taut

#endif
