// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/sweep.h"
#include "base/data_files.h"
#include "base/interruption.h"
#include "base/memory.h"
#include "base/write_file.h"
#include <taut/base/exceptions.h>
#include <taut/base/growing_file.h>
#include <taut/output/table_file.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <sstream>

namespace taut
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr const char *table_name = "sweep.csv", *entries_name = "sweep.prm",
                         *too_large = "more memory than there is";

    std::string title(const NamedQuantity &quantity)
    {
      return quantity.item + ": " + quantity.quantity + " [" + quantity.unit + "]";
    }

    /**
     * Approximate time of a batch of cases [s]. A killed sweep loses this time of each worker. At
     * the end of a batch workers wait for the slowest worker, for a small part of this time:
     * differences between many cases average out.
     */
    constexpr double batch_seconds = 10.;

    /// The lines of all workers in the order of the cases, which workers have in turn, up to the
    /// first missing line.
    std::vector<std::string> in_order(const std::vector<std::string> &texts)
    {
      std::vector<std::istringstream> of_workers(texts.begin(), texts.end());
      std::vector<std::string> lines;
      for (std::string line;; lines.push_back(line))
        if (!std::getline(of_workers[lines.size() % texts.size()], line))
          return lines;
    }
  } // namespace

  Sweep::Sweep(const std::string &file, const std::vector<std::string> &overrides,
               const Communicator &workers, std::ostream &log)
      : workers(workers), log(log), runner(file, overrides)
  {
    parameters.read(file, overrides, workers);
    try
    {
      if (parameters.sweep.items.names.empty())
        throw EntryError("Sweep/Parameters", "a sweep needs one or more entries to vary");
      if (!(parameters.end_time > 0.))
        throw EntryError("Time/End", "a sweep takes quantities of runs in time; take a later end");
      swept = parameters.sweep.parameters(parameters.values());
      cases = parameters.sweep.cases();
      for (std::size_t i = 0; i < swept.size(); ++i)
      {
        const auto &items = parameters.sweep.items;
        const std::string values = items.items[i].is_random() ? "/Range" : "/Values";
        for (const std::string &entry : swept[i].entries)
          runner.set_origin(entry, parameters.place_of(items.title(i) + values));
      }
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters.explain(e));
    }
  }

  std::string Sweep::sweep_folder() const
  {
    return parameters.sweep.folder.empty() ? parameters.output.folder + "/sweep"
                                           : parameters.sweep.folder;
  }

  /// Its name, and the unit that all its entries have.
  std::string Sweep::title_of(const SweptParameter &parameter) const
  {
    const std::string unit = parameters.unit_of(parameter.entries[0]);
    const bool has_unit =
        !unit.empty() &&
        std::all_of(parameter.entries.begin(), parameter.entries.end(),
                    [&](const std::string &entry) { return parameters.unit_of(entry) == unit; });
    return parameter.name + (has_unit ? " [" + unit + "]" : "");
  }

  /// Column names from the scene in the file.
  void Sweep::name_columns()
  {
    header = csv_cell("case");
    for (const SweptParameter &parameter : swept)
      header += "," + csv_cell(title_of(parameter));
    for (const NamedQuantity &quantity : runner.quantities())
    {
      names.push_back(title(quantity));
      header += "," + csv_cell(names.back());
    }
    header += ",complementarity [1],balance [1],warnings,message\n";
  }

  void Sweep::prepare_folder()
  {
    const fs::path folder = sweep_folder();
    const std::string table = (folder / table_name).string(),
                      entries = (folder / entries_name).string();
    std::error_code error;
    const bool has_table = fs::exists(table, error);
    if (has_table && !overwrite && !resume)
      throw EntryError("Sweep/Folder", "'" + folder.string() +
                                           "' holds a sweep; name another folder, go on with it "
                                           "with --resume, or run with --overwrite");
    fs::create_directories(folder, error);
    if (error)
      throw EntryError("Sweep/Folder", "cannot make '" + folder.string() + "': " + error.message() +
                                           "; name another folder, or make room for this one");
    if (resume && has_table)
    {
      if (!parameters.has_entries_of(entries))
        throw EntryError("Sweep/Folder", "'" + folder.string() +
                                             "' holds a sweep with other entries: resume it as it "
                                             "was, or run with --overwrite");
      is_resumed = true;
      keep_data_files();
      continue_table(table);
      return;
    }
    fs::remove(table, error);
    std::ostringstream used;
    parameters.print(used);
    keep_data_files();
    replace_file(entries, used.str());
    write_file(table, header);
  }

  /// Copies what the runs read into the folder, each file once. A resumed sweep has copies of what
  /// was read before.
  void Sweep::keep_data_files()
  {
    const fs::path folder = sweep_folder();
    const std::size_t n_kept = kept.size();
    for (const auto &[name, text] : data_files())
    {
      if (!kept.emplace(name, text).second)
        continue;
      std::error_code error;
      if (is_resumed && fs::exists(folder / copied_name(name), error) &&
          !changed_copy({{name, text}}, folder.string()).empty())
        throw UserError("the file '" + name + "' is not what it was when the sweep in '" +
                        folder.string() +
                        "' began: put back the copy that is there, or run with --overwrite");
    }
    if (kept.size() > n_kept)
      copy_data_files(kept, folder.string());
  }

  /// Counts the complete lines of the table and drops the bytes behind them.
  void Sweep::continue_table(const std::string &table)
  {
    std::ifstream in(table, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    in.close();
    if (text.compare(0, header.size(), header) != 0)
      throw EntryError("Sweep/Folder", "'" + table +
                                           "' has other columns: resume it as it was, or run with "
                                           "--overwrite");
    const std::size_t end = text.rfind('\n') + 1;
    n_done = std::count(text.begin() + header.size(), text.begin() + end, '\n');
    GrowingFile lines;
    lines.resume(table, end);
    lines.close();
    log << n_done << " of " << cases.size() << " cases are done\n";
  }

  void Sweep::run()
  {
    try
    {
      workers.agree(
          [&]
          {
            if (!workers.is_root())
              return;
            name_columns();
            prepare_folder();
          });
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters.explain(e));
    }
    share_columns();

    const std::size_t n = cases.size();
    log << n << " cases on " << workers.size() << (workers.size() == 1 ? " worker" : " workers")
        << ", random numbers from seed " << parameters.sweep.seed << '\n';
    int signal = 0;
    std::size_t n_each = 1;
    while (n_done < n && signal == 0)
    {
      const auto begin = std::chrono::steady_clock::now();
      const std::size_t n_before = n_done;
      n_done += run_batch(n_each);
      const double seconds = workers.max(
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      if (seconds < .5 * batch_seconds)
        n_each *= 2;
      else if (seconds > 2. * batch_seconds && n_each > 1)
        n_each /= 2;
      // A line a hundredth of the sweep.
      if (100 * n_done / n > 100 * n_before / n || n_done == n)
        log << "  " << n_done << " of " << n << " cases" << std::endl;
      signal = static_cast<int>(workers.max(stop_asked ? stop_asked() : 0));
    }
    if (n_done < n)
      throw Interrupted(signal, "sweep ended by " + signal_name(signal) + " with " +
                                    std::to_string(n_done) + " of " + std::to_string(n) +
                                    " cases done; go on with --sweep --resume");
    log << "Sweep in " << sweep_folder() << '\n';
  }

  /// Gives all workers the data of the table that the root has.
  void Sweep::share_columns()
  {
    std::string shared = std::to_string(n_done) + (is_resumed ? " resumed" : "");
    for (const std::string &name : names)
      shared += '\n' + name;
    workers.broadcast(shared);
    std::istringstream lines(shared);
    std::string first;
    std::getline(lines, first);
    n_done = std::stoul(first);
    is_resumed = first.find(' ') != std::string::npos;
    names.clear();
    for (std::string name; std::getline(lines, name);)
      names.push_back(name);
  }

  /// The next cases, up to @p n_each for each worker. Returns how many lines were written.
  std::size_t Sweep::run_batch(const std::size_t n_each)
  {
    std::string own;
    workers.agree(
        [&]
        {
          for (std::size_t i = 0; i < n_each; ++i)
          {
            const std::size_t number = n_done + i * workers.size() + workers.rank();
            const std::string line = number < cases.size() ? run_case(number) : "";
            if (line.empty())
              break;
            keep_data_files();
            own += line + '\n';
          }
        });
    const std::vector<std::string> lines = in_order(workers.gather(own));
    std::string complete;
    for (const std::string &line : lines)
      complete += line + '\n';
    workers.agree(
        [&]
        {
          if (workers.is_root())
            append(complete);
        });
    return lines.size();
  }

  /// The line of a case; empty if the run was asked to stop. A full disk is no fault of the case
  /// and ends the sweep; --resume goes on from here when there is room.
  std::string Sweep::run_case(const std::size_t number)
  {
    std::string text = std::to_string(number + 1);
    for (const std::string &value : cases[number])
      text += "," + csv_cell(value);
    std::string message;
    try
    {
      return text + numbers_of(number) + ",";
    }
    catch (const Interrupted &)
    {
      return "";
    }
    catch (const NotWritten &)
    {
      throw;
    }
    catch (const UserError &e)
    {
      message = e.what();
    }
    catch (const std::exception &e)
    {
      if (!is_memory_shortage(e))
        throw;
      message = too_large;
    }
    std::replace(message.begin(), message.end(), '\n', ' ');
    return text + std::string(names.size() + 3, ',') + "," + csv_cell(message);
  }

  /// Quantities, residuals and kinds of the warnings of a case.
  std::string Sweep::numbers_of(const std::size_t number)
  {
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < swept.size(); ++i)
      for (const std::string &entry : swept[i].entries)
        entries.push_back(entry + "=" + cases[number][i]);
    const CaseResult result = runner.run(entries);
    bool is_same = result.quantities.size() == names.size();
    std::string text;
    for (std::size_t i = 0; is_same && i < names.size(); ++i)
    {
      is_same = title(result.quantities[i]) == names[i];
      text += "," + csv_number(result.quantities[i].value);
    }
    if (!is_same)
      throw UserError("the scene of this case has other contacts, links, probes, supports or spans "
                      "than the parameter file: its quantities have no columns");
    std::string warnings;
    for (const Warning &warning : result.warnings)
      warnings += (warnings.empty() ? "" : "; ") + warning.kind;
    return text + "," + csv_number(result.worst.complementarity) + "," +
           csv_number(result.worst.balance) + "," + csv_cell(warnings);
  }

  /// A sweep that is killed in this function leaves an incomplete last line.
  void Sweep::append(const std::string &lines) const
  {
    const std::string path = sweep_folder() + "/" + table_name;
    std::error_code error;
    const auto length = fs::file_size(path, error);
    GrowingFile table;
    table.resume(path, error ? 1 : length);
    table.append(lines);
    table.close();
  }
} // namespace taut
