// SPDX-License-Identifier: LGPL-2.1-or-later

#include "simulation/results_folder.h"
#include "base/data_files.h"
#include "base/memory.h"
#include "base/write_file.h"
#include "simulation/checkpoint.h"
#include <taut/base/exceptions.h>
#include <taut/base/version.h>
#include <taut/output/observer.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

namespace taut
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Names of tables and other single files of a run, including those of all observers, which may
    /// be from another run.
    std::set<std::string> names_of_results()
    {
      std::set<std::string> names = {"used.prm",        "original.prm",       "start.csv",
                                     "droppers.csv",    "dropper_cycles.csv", "wires.pvd",
                                     "statistics.json", "links.pvd"};
      for (const char *const table : {"sliding", "links", "probes", "supports", "certificate"})
        for (const char *const ending : {".csv", ".bin"})
          names.insert(std::string(table) + ending);
      for (const char *const name : checkpoint_names)
        names.insert(name);
      for (const std::string &observer : Registry<Observer>::instance().list())
        for (const std::string &name : Registry<Observer>::instance().create(observer)->files())
          names.insert(name);
      return names;
    }

    bool is_of_results(const std::string &name, const std::set<std::string> &names)
    {
      const auto begins = [&](const char *const stem) { return name.rfind(stem, 0) == 0; };
      const std::string ending = fs::path(name).extension().string();
      return names.count(name) || (ending == ".vtu" && (begins("wires_") || begins("links_"))) ||
             ((ending == ".vtu" || ending == ".pvtu" || ending == ".pvd") &&
              (begins("body_") || begins("contact_"))) ||
             (ending == ".csv" && begins("contact_"));
    }

    /// Files of a run in a folder and its fields; none in an unreadable folder, which writing then
    /// reports.
    std::vector<fs::path> results_in(const fs::path &folder)
    {
      const std::set<std::string> names = names_of_results();
      std::vector<fs::path> results;
      std::error_code error;
      for (const fs::path &place : {folder, folder / "fields"})
        for (const fs::directory_entry &entry : fs::directory_iterator(place, error))
          if (is_of_results(entry.path().filename().string(), names))
            results.push_back(entry.path());
      return results;
    }

    /// Removes what a process that was killed was about to rename: write_file() puts a host, which
    /// may have dots, a number and .tmp behind the name of a result. The folder is locked.
    void remove_unfinished(const fs::path &folder)
    {
      std::set<std::string> names = names_of_results();
      for (const auto &[name, text] : data_files())
        names.insert(copied_name(name));
      const std::regex unfinished("(.+)\\.[0-9]+\\.tmp");
      std::error_code error;
      for (const fs::path &place : {folder, folder / "fields"})
        for (const fs::directory_entry &entry : fs::directory_iterator(place, error))
        {
          std::smatch parts;
          std::string name = entry.path().filename().string();
          if (!std::regex_match(name, parts, unfinished))
            continue;
          for (name = parts[1]; name.find('.') != std::string::npos;)
          {
            name.resize(name.rfind('.'));
            if (is_of_results(name, names))
              fs::remove(entry.path(), error);
          }
        }
    }

    /// Copies of the files that a run reads must not take the place of others.
    void check_copies(const OutputParameters &output)
    {
      const std::set<std::string> results = names_of_results();
      for (const auto &[name, text] : data_files())
      {
        const std::string copy = copied_name(name);
        if (results.count(copy))
          throw EntryError("Output/Folder", "a file that the run reads has the name '" + copy +
                                                "' of a file of results; rename it");
        std::error_code error;
        if (!output.overwrite && fs::exists(fs::path(output.folder) / copy, error) &&
            !changed_copy({{name, text}}, output.folder).empty())
          throw EntryError("Output/Folder",
                           "'" + output.folder + "' has another file '" + copy +
                               "' than the run reads; name another folder, or run with "
                               "--overwrite");
      }
    }

    void check_resumed_folder(const Parameters &parameters)
    {
      const OutputParameters &output = parameters.output;
      for (const char *const name : checkpoint_names)
        if (fs::exists(fs::path(output.folder) / name))
          return;
      if (!results_in(output.folder).empty() &&
          !parameters.has_entries_of(output.folder + "/used.prm"))
        throw EntryError("Output/Folder", "'" + output.folder +
                                              "' has no checkpoint, and its results are of a run "
                                              "with other entries: nothing to resume there. Name "
                                              "the folder of the run, or run with --overwrite");
    }
  } // namespace

  void check_folder(const Parameters &parameters)
  {
    const OutputParameters &output = parameters.output;
    std::error_code error;
    if (fs::exists(output.folder, error) && !fs::is_directory(output.folder, error))
      throw EntryError("Output/Folder", "it is a file; name a folder");
    if (output.resume)
      check_resumed_folder(parameters);
    else if (!output.overwrite && !results_in(output.folder).empty())
      throw EntryError(
          "Output/Folder",
          "'" + output.folder +
              "' holds the results of a run; name another folder, or run with --overwrite" +
              (output.checkpoint_interval > 0. ? ", or go on with it with --resume" : ""));
  }

  void prepare_folder(const Parameters &parameters, const std::vector<std::string> &comments)
  {
    const fs::path folder = parameters.output.folder;
    const std::string original = parameters.file_text(); // which may be in the folder
    std::error_code error;
    check_folder(parameters);
    check_copies(parameters.output);
    // Files of a longer run would mix with new ones. used.prm goes last, as it names their run.
    const fs::path used_file = folder / "used.prm";
    for (const fs::path &file : results_in(folder))
      if (file != used_file)
        fs::remove(file, error);
    fs::create_directories(folder, error);
    const std::string failed = "cannot make '" + folder.string() + "': " + error.message();
    if (error == std::errc::no_space_on_device || error == std::errc::io_error)
      throw NotWritten(failed +
                       "; name another folder in Output/Folder, or make room for this one");
    if (error)
      throw EntryError("Output/Folder", failed);
    std::ostringstream used;
    used << "# Written by taut " << version()
         << "; the entries of the run whose results are beside this file.\n";
    for (const std::string &comment : comments)
      used << "# " << comment << '\n';
    parameters.print(used);
    copy_data_files(data_files(), folder.string());
    replace_file(used_file, whole_text(used));
    if (!original.empty())
      write_file((folder / "original.prm").string(), original);
  }

  void check_results_folder(const Parameters &parameters, const Communicator &processes)
  {
    processes.agree(
        [&]
        {
          if (!processes.is_root())
            return;
          FolderLock lock;
          lock.take(parameters.output.folder);
          check_folder(parameters);
          remove_unfinished(parameters.output.folder);
        });
  }

  void FolderLock::take(const std::string &folder)
  {
    release();
    file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0 || flock(file, LOCK_EX | LOCK_NB) == 0)
      return;
    const bool is_taken = errno == EWOULDBLOCK;
    release();
    if (is_taken)
      throw EntryError("Output/Folder",
                       "another run writes its results to '" + folder +
                           "' at this moment; name another folder, or wait until it has ended");
  }

  void FolderLock::release()
  {
    if (file >= 0)
      close(file);
    file = -1;
  }
} // namespace taut
