// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program/command_line.h"

#include <taut/base/exceptions.h>
#include <taut/base/version.h>

#include <boost/program_options.hpp>

#include <sstream>

namespace taut
{
  namespace
  {
    namespace po = boost::program_options;

    struct Options
    {
      po::options_description shown = po::options_description("Options"), all;
      po::positional_options_description positional;

      Options()
      {
        shown.add_options()("check", "read the file, check the scene and print it, without a run")(
            "sketch", po::value<std::string>()->value_name("FILE.svg"),
            "draw the undeformed scene before the check or the run")(
            "write-network", po::value<std::string>()->value_name("FILE.prm"),
            "write the scene with each wire, support, mass, spring, link and load by its own, as a "
            "file for the generator 'network' that gives the same results, without a run")(
            "study", "run the scene with all settings of its section Study and measure cost and "
                     "error of each")("accuracy", po::value<double>()->value_name("ERROR"),
                                      "find step and mesh for this relative error, such as 0.01, "
                                      "and store them for Study/Accuracy")(
            "elasticity",
            "measure the static uplift over a force along the contact wires, see section "
            "Elasticity")(
            "sweep", "run the scene once for each case of its section Sweep and write a table of "
                     "quantities")("jobs,j", po::value<unsigned int>()->value_name("N"),
                                   "workers of a sweep: starts itself with 'mpirun -np N'")(
            "set,s", po::value<std::vector<std::string>>()->composing()->value_name("ENTRY=VALUE"),
            "change an entry of the file: Section.Entry=value (or Section/Entry=value); may be "
            "repeated")("overwrite", "replace the results of an earlier run in the same folder")(
            "resume", "go on with a run that was ended early, from its last checkpoint "
                      "(Output/Checkpoint interval)")("version", "print the version")(
            "help,h", "print this text");
        all.add(shown).add_options()("file", po::value<std::string>());
        positional.add("file", 1);
      }
    };

    std::string help(const Options &options)
    {
      std::ostringstream text;
      text.exceptions(std::ios::badbit); // no memory: the error, not half of the text
      text << "taut: mechanical systems whose parts touch through unilateral contacts\n\n"
           << "Usage: taut FILE.prm [options]    run a parameter file\n"
           << "       taut                       write an annotated parameter file, taut.prm\n\n"
           << options.shown;
      return text.str();
    }

    void exclude(const po::variables_map &arguments, const std::string &one,
                 const std::vector<std::string> &others)
    {
      for (const std::string &other : others)
        if (arguments.count(one) && arguments.count(other))
          throw UserError("--" + one + " and --" + other + " exclude each other; choose one");
    }

    void check_choice(const po::variables_map &arguments)
    {
      exclude(arguments, "write-network",
              {"sweep", "study", "accuracy", "check", "sketch", "resume"});
      exclude(arguments, "sweep", {"study", "accuracy", "check", "sketch"});
      exclude(arguments, "elasticity", {"sweep", "study", "accuracy", "check", "sketch", "resume"});
      exclude(arguments, "accuracy", {"study", "check", "sketch", "resume"});
      exclude(arguments, "resume", {"study", "check", "overwrite"});
      exclude(arguments, "study", {"check"});
      if (arguments.count("jobs") && !arguments.count("sweep"))
        throw UserError("--jobs are the workers of a --sweep; a run takes 'mpirun -np N taut'");
      if (arguments.count("study") && arguments.count("sketch"))
        throw UserError("--study draws no --sketch; draw it with --check");
    }

    template <typename T, typename Value>
    void assign(const po::variables_map &arguments, const char *name, Value &value)
    {
      if (arguments.count(name))
        value = arguments[name].as<T>();
    }

    void read(const int argc, char **argv, CommandLine &line)
    {
      const Options options;
      po::variables_map arguments;
      po::store(po::command_line_parser(argc, argv)
                    .options(options.all)
                    .positional(options.positional)
                    .run(),
                arguments);
      po::notify(arguments);
      if (arguments.count("help"))
        line.answer = help(options);
      else if (arguments.count("version"))
        line.answer = "taut " + version() + '\n';
      if (!line.answer.empty() || !arguments.count("file"))
        return;
      check_choice(arguments);
      for (const auto &[name, flag] :
           std::initializer_list<std::pair<const char *, bool *>>{{"check", &line.check},
                                                                  {"study", &line.study},
                                                                  {"elasticity", &line.elasticity},
                                                                  {"sweep", &line.sweep},
                                                                  {"overwrite", &line.overwrite},
                                                                  {"resume", &line.resume}})
        *flag = arguments.count(name) > 0;
      assign<std::string>(arguments, "file", line.file);
      assign<std::vector<std::string>>(arguments, "set", line.overrides);
      assign<std::string>(arguments, "sketch", line.sketch);
      assign<std::string>(arguments, "write-network", line.network);
      assign<double>(arguments, "accuracy", line.accuracy);
      assign<unsigned int>(arguments, "jobs", line.jobs);
    }
  } // namespace

  CommandLine read_command_line(const int argc, char **argv)
  {
    CommandLine line;
    try
    {
      read(argc, argv, line);
    }
    catch (const po::error &e)
    {
      line.mistake = std::string(e.what()) + "; see 'taut --help'";
    }
    catch (const UserError &e)
    {
      line.mistake = e.what();
    }
    return line;
  }
} // namespace taut
