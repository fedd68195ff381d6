// SPDX-License-Identifier: LGPL-2.1-or-later
#include "program/command_line.h"

#include "base/interruption.h"
#include "base/memory.h"
#include "base/rank_abort.h"
#include "base/write_file.h"
#include "output/progress.h"
#include "output/scene_report.h"
#include "output/scene_sketch.h"
#include "simulation/network_file.h"
#include "study/accuracy_search.h"
#include "study/elasticity.h"
#include "study/study.h"
#include "study/sweep.h"
#include <taut/base/communicator.h>
#include <taut/base/exceptions.h>
#include <taut/simulation/simulation.h>

#include <deal.II/base/multithread_info.h>

#include <unistd.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  constexpr const char *default_file = "taut.prm";

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
    taut::write_file(default_file, taut::whole_text(text));
    std::cout << "Wrote '" << default_file
              << "' with all entries and their defaults: a railway line with a pantograph.\n"
              << "Run it with 'taut " << default_file << "'; see 'taut --help'.\n";
  }

  void write_out(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    taut::Parameters parameters;
    parameters.read(*line.file, line.overrides, processes);
    parameters.output.overwrite = line.overwrite;
    processes.agree(
        [&]
        {
          if (!processes.is_root())
            return;
          try
          {
            std::vector<std::string> left_out;
            taut::write_network(parameters, *line.network, left_out);
            std::cout << "Wrote '" << *line.network << "'\n";
            for (const std::string &section : left_out)
              std::cout << "Left out " << section << ", which varies entries of the generator '"
                        << parameters.generator_name << "'\n";
          }
          catch (const taut::EntryError &e)
          {
            throw taut::UserError(parameters.explain(e));
          }
        });
  }

  void run_once(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    taut::Parameters parameters;
    parameters.read(*line.file, line.overrides, processes);
    parameters.output.overwrite = line.overwrite;
    parameters.output.resume = line.resume;
    try
    {
      if (!line.check)
        taut::check_results_folder(parameters, processes);
      taut::Simulation simulation(parameters, std::cout, processes);
      simulation.stop_if(taut::interruption);
      // Before what may fail: the drawing shows why.
      if (line.sketch)
      {
        const taut::ScenePlaces places =
            taut::places_in_space(simulation.scene(), simulation.structure());
        if (processes.is_root())
          taut::write_sketch(simulation.scene(), places, *line.sketch);
      }
      if (line.check)
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

  void run_sweep(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    taut::Sweep sweep(*line.file, line.overrides, processes, std::cout);
    sweep.set_overwrite(line.overwrite);
    sweep.set_resume(line.resume);
    sweep.stop_if(taut::interruption);
    sweep.run();
  }

  void find_accuracy(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    if (processes.size() > 1)
      throw taut::UserError("--accuracy measures one process; run it without mpirun");
    taut::AccuracySearch search(*line.file, line.overrides, *line.accuracy, line.overwrite,
                                std::cout);
    search.stop_if(taut::interruption);
    search.run();
  }

  void find_elasticity(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    if (processes.size() > 1)
      throw taut::UserError("--elasticity takes one process; run it without mpirun");
    taut::Elasticity elasticity(*line.file, line.overrides, line.overwrite, std::cout);
    elasticity.stop_if(taut::interruption);
    elasticity.run();
  }

  void run_study(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    if (processes.size() > 1)
      throw taut::UserError("a study measures one process; run it without mpirun");
    taut::Study study(*line.file, line.overrides, line.overwrite, std::cout);
    study.stop_if(taut::interruption);
    study.run();
  }

  void work(const taut::CommandLine &line, const taut::Communicator &processes)
  {
    // Processes share the work. An error in a thread of deal.II would end the program there.
    dealii::MultithreadInfo::set_thread_limit(1);
    if (!line.mistake.empty())
      throw taut::UserError(line.mistake);
    if (!line.answer.empty())
      std::cout << line.answer;
    else if (line.file)
      (line.network      ? write_out
       : line.sweep      ? run_sweep
       : line.accuracy   ? find_accuracy
       : line.elasticity ? find_elasticity
       : line.study      ? run_study
                         : run_once)(line, processes);
    else if (processes.is_root())
      write_default_file();
  }

  /// Says once what went wrong. Returns the exit code.
  int report(taut::RankAbort &rank_abort, const char *message, const int code = 1,
             const char *before = "")
  {
    taut::ignore_interruptions();
    std::cout.flush();
    if (rank_abort.are_own())
      std::cerr << "taut: " << before << message << '\n';
    rank_abort.end_others(code);
    return code;
  }
} // namespace

int taut::run(const CommandLine &line)
{
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
    work(line, processes);
    std::cout.flush();
    if (processes.is_root() && !std::cout)
      return report(rank_abort, "cannot write the log: the disk is full, or its reader is gone; "
                                "results are complete");
    return 0;
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
    if (taut::is_memory_shortage(e))
      return report(rank_abort, taut::too_large);
    return report(rank_abort, e.what(), 1, "internal error: ");
  }
}
