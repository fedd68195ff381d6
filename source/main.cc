// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/interruption.h>
#include <taut/base/memory.h>
#include <taut/base/rank_abort.h>
#include <taut/base/version.h>
#include <taut/base/write_file.h>
#include <taut/output/progress.h>
#include <taut/output/scene_report.h>
#include <taut/simulation/simulation.h>
#include <taut/study/accuracy_search.h>
#include <taut/study/study.h>
#include <taut/study/sweep.h>

#include <deal.II/base/multithread_info.h>

#include <boost/program_options.hpp>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace
{
  namespace po = boost::program_options;

  constexpr const char *default_file = "taut.prm";
  constexpr const char *too_large =
      "the scene needs more memory than there is; take larger elements or fewer links";

  /// Without a file: an annotated one with all defaults, which runs.
  void write_default_file()
  {
    if (std::filesystem::exists(default_file))
      throw taut::UserError(std::string("there is a '") + default_file +
                            "' already: run 'taut taut.prm', or move it away to get a new one");
    taut::Parameters parameters;
    parameters.set_defaults();
    std::ostringstream text;
    parameters.print(text);
    taut::check_memory();
    taut::write_file(default_file, text.str());
    std::cout << "Wrote '" << default_file
              << "' with all entries and their defaults: a railway line with a pantograph.\n"
              << "Run it with 'taut " << default_file << "'; see 'taut --help'.\n";
  }

  using Names = std::vector<std::string>;

  void exclude(const po::variables_map &arguments, const std::string &one, const Names &others)
  {
    for (const std::string &other : others)
      if (arguments.count(one) && arguments.count(other))
        throw taut::UserError("--" + one + " and --" + other + " exclude each other; choose one");
  }

  void run_once(const po::variables_map &arguments, const std::string &file, const Names &overrides,
                const taut::Communicator &processes)
  {
    taut::Parameters parameters;
    parameters.read(file, overrides, processes);
    parameters.output.overwrite = arguments.count("overwrite") > 0;
    parameters.output.resume = arguments.count("resume") > 0;
    try
    {
      if (!arguments.count("check"))
        taut::check_results_folder(parameters, processes);
      taut::Simulation simulation(parameters, std::cout, processes);
      simulation.stop_if(taut::interruption);
      // Before what may fail: the drawing shows why.
      if (arguments.count("sketch"))
      {
        const taut::ScenePlaces places =
            taut::places_in_space(simulation.scene(), simulation.structure());
        if (processes.is_root())
          taut::write_sketch(simulation.scene(), places, arguments["sketch"].as<std::string>());
      }
      if (arguments.count("check"))
      {
        simulation.check();
        return;
      }
      // mpirun passes on whole lines only, though its ranks may have a terminal of their own.
      const bool has_terminal = processes.size() == 1 && isatty(STDOUT_FILENO);
      taut::Progress progress(std::cout, has_terminal, parameters.end_time);
      if (parameters.end_time > 0.)
        simulation.observe(progress);
      simulation.run();
    }
    catch (const taut::EntryError &e)
    {
      throw taut::UserError(parameters.explain(e));
    }
  }

  void find_accuracy(const po::variables_map &arguments, const std::string &file,
                     const Names &overrides, const taut::Communicator &processes)
  {
    exclude(arguments, "accuracy", {"study", "sweep", "check", "sketch", "resume"});
    if (processes.size() > 1)
      throw taut::UserError("--accuracy measures one process; run it without mpirun");
    taut::AccuracySearch search(file, overrides, arguments["accuracy"].as<double>(),
                                arguments.count("overwrite") > 0, std::cout);
    search.stop_if(taut::interruption);
    search.run();
  }

  void run(const po::variables_map &arguments, const taut::Communicator &processes)
  {
    const std::string file = arguments["file"].as<std::string>();
    const Names overrides = arguments.count("set") ? arguments["set"].as<Names>() : Names();
    exclude(arguments, "sweep", {"study", "accuracy", "check", "sketch"});
    if (arguments.count("sweep"))
    {
      exclude(arguments, "resume", {"overwrite"});
      taut::Sweep sweep(file, overrides, processes, std::cout);
      sweep.set_overwrite(arguments.count("overwrite") > 0);
      sweep.set_resume(arguments.count("resume") > 0);
      sweep.stop_if(taut::interruption);
      sweep.run();
      return;
    }
    if (arguments.count("jobs"))
      throw taut::UserError("--jobs are the workers of a --sweep; a run takes 'mpirun -np N taut'");
    if (arguments.count("accuracy"))
    {
      find_accuracy(arguments, file, overrides, processes);
      return;
    }
    exclude(arguments, "resume", {"study", "check", "overwrite"});
    if (!arguments.count("study"))
    {
      run_once(arguments, file, overrides, processes);
      return;
    }
    if (processes.size() > 1)
      throw taut::UserError("a study measures one process; run it without mpirun");
    exclude(arguments, "study", {"check"});
    if (arguments.count("sketch"))
      throw taut::UserError("--study draws no --sketch; draw it with --check");
    taut::Study study(file, overrides, arguments.count("overwrite") > 0, std::cout);
    study.stop_if(taut::interruption);
    study.run();
  }

  /// Becomes 'mpirun -np N' of the same command, without its --jobs. Returns if there is no mpirun.
  void become_parallel(const int argc, char **argv, const unsigned int n)
  {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe");
    std::vector<std::string> words = {"mpirun", "-np", std::to_string(n), program};
    for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word == "-j" || word == "--jobs")
        ++i;
      else if (word.compare(0, 2, "-j") != 0 && word.compare(0, 7, "--jobs=") != 0)
        words.push_back(word);
    }
    std::vector<char *> pointers;
    for (std::string &word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);
    // One core a worker, also of more workers than there are cores, and also of root, with Open MPI
    // 4 and 5; what the user has set stays.
    for (const auto &[variable, value] :
         std::initializer_list<std::pair<const char *, const char *>>{
             {"OPENBLAS_NUM_THREADS", "1"},
             {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
             {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
             {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
             {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"}})
      setenv(variable, value, 0);
    execvp("mpirun", pointers.data());
  }

  struct Options
  {
    po::options_description shown = po::options_description("Options"), all;
    po::positional_options_description positional;

    Options()
    {
      shown.add_options()("check", "read the file, check the scene and print it, without a run")(
          "sketch", po::value<std::string>()->value_name("FILE.svg"),
          "draw the undeformed scene before the check or the run")(
          "study",
          "run the scene with all settings of its section Study and measure cost and error of "
          "each")("accuracy", po::value<double>()->value_name("ERROR"),
                  "find step and mesh for this relative error, such as 0.01, and store them for "
                  "Study/Accuracy")(
          "sweep", "run the scene once for each case of its section Sweep and write a "
                   "table of quantities")("jobs,j", po::value<unsigned int>()->value_name("N"),
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

  void work(const int argc, char **argv, const taut::Communicator &processes)
  {
    // Processes share the work. An error in a thread of deal.II would end the program there.
    dealii::MultithreadInfo::set_thread_limit(1);
    const Options options;
    po::variables_map arguments;
    po::store(po::command_line_parser(argc, argv)
                  .options(options.all)
                  .positional(options.positional)
                  .run(),
              arguments);
    po::notify(arguments);
    if (arguments.count("help"))
      std::cout
          << "taut: mechanical systems whose parts touch through unilateral contacts\n\n"
          << "Usage: taut FILE.prm [options]    run a parameter file\n"
          << "       taut                       write an annotated parameter file, taut.prm\n\n"
          << options.shown;
    else if (arguments.count("version"))
      std::cout << "taut " << taut::version() << '\n';
    else if (arguments.count("file"))
    {
      const unsigned int jobs = arguments.count("jobs") ? arguments["jobs"].as<unsigned int>() : 1;
      if (arguments.count("sweep") && jobs > 1 && processes.size() == 1)
      {
        become_parallel(argc, argv, jobs);
        throw taut::UserError("cannot start 'mpirun' for --jobs: install Open MPI, or run "
                              "without --jobs");
      }
      run(arguments, processes);
    }
    else if (processes.is_root())
      write_default_file();
    taut::check_memory();
  }

  bool memory_is_told = false; ///< that it was short
  std::terminate_handler usual_end = nullptr;

  /// The destructors of some libraries need memory, and end the program when they find none.
  void end_without_memory()
  {
    if (taut::memory_was_short() && !memory_is_told)
    {
      std::cout.flush();
      std::cerr << "taut: " << too_large << '\n';
      memory_is_told = true;
    }
    if (!memory_is_told)
      usual_end();
    std::fflush(stdout);
    std::_Exit(1);
  }

  /// Says once what went wrong, without memory of its own. Returns the exit code.
  int report(taut::RankAbort &rank_abort, const char *message, const int code = 1,
             const char *before = "", const char *after = "")
  {
    taut::ignore_interruptions();
    std::cout.flush();
    if (taut::memory_was_short())
    {
      message = too_large;
      before = after = "";
      memory_is_told = true;
    }
    if (rank_abort.are_own())
      std::cerr << "taut: " << before << message << after << '\n';
    rank_abort.end_others(code);
    return code;
  }
} // namespace

int main(int argc, char **argv)
{
  taut::watch_memory();
  usual_end = std::set_terminate(end_without_memory);
  taut::Communicator processes;
  if (taut::started_in_parallel())
  {
    taut::start_mpi();
    processes = taut::Communicator(MPI_COMM_WORLD);
  }
  taut::RankAbort rank_abort(processes);
  if (!processes.is_root())
    std::cout.setstate(std::ios::failbit);
  taut::catch_interruptions(processes.is_root());
  try
  {
    work(argc, argv, processes);
    std::cout.flush();
    if (processes.is_root() && !std::cout)
      return report(rank_abort, "cannot write the log: the disk is full, or its reader is gone; "
                                "results are complete");
    return 0;
  }
  catch (const po::error &e)
  {
    return report(rank_abort, e.what(), 1, "", "; see 'taut --help'");
  }
  catch (const taut::Interrupted &e)
  {
    return report(rank_abort, e.what(), 128 + e.signal());
  }
  catch (const taut::UserError &e)
  {
    return report(rank_abort, e.what());
  }
  catch (const std::exception &e)
  {
    memory_is_told = taut::is_memory_shortage(e);
    if (memory_is_told)
      return report(rank_abort, too_large);
    return report(rank_abort, e.what(), 1, "internal error: ");
  }
}
