// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/checkpoint.h"

#include "base/write_file.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

namespace taut
{
  namespace
  {
    /// First line of the file. The version changes with the stored data.
    const std::string first_line = "Taut checkpoint, version 12\n";
    const std::string any_first_line = "Taut checkpoint, version ";

    std::string checksum(const std::string &bytes)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data(), bytes.size());
      char text[16];
      std::snprintf(text, sizeof text, "%08x\n", crc.checksum());
      return text;
    }

    /// Reads a file and returns its error, or nothing.
    std::string problem_of(const std::string &path, Checkpoint &checkpoint)
    {
      std::ifstream file(path, std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(file), {});
      if (!file)
        return "cannot be read";
      if (bytes.compare(0, any_first_line.size(), any_first_line) != 0)
        return "is no checkpoint of Taut";
      if (bytes.compare(0, first_line.size(), first_line) != 0)
        return "was written by another version of Taut";
      const std::size_t n_sum = checksum("").size();
      const std::string sum = bytes.substr(first_line.size(), n_sum),
                        content = bytes.substr(std::min(bytes.size(), first_line.size() + n_sum));
      if (sum != checksum(content))
        return "is damaged: its checksum is wrong";
      try
      {
        unarchive(content, [&](InputArchive &archive) { archive >> checkpoint; });
      }
      catch (const boost::archive::archive_exception &e)
      {
        return std::string("cannot be read by this build: ") + e.what();
      }
      return "";
    }
  } // namespace

  void write_checkpoint(const Checkpoint &checkpoint, const std::string &folder)
  {
    const std::string content = archived([&](OutputArchive &archive) { archive << checkpoint; });
    const std::string path = folder + "/" + checkpoint_names[0];
    // Between both renames only the old checkpoint exists, which is enough. A damaged one must not
    // replace a good one.
    Checkpoint last;
    const std::string before = folder + "/" + checkpoint_names[1];
    if (problem_of(path, last).empty() && std::rename(path.c_str(), before.c_str()) != 0)
      throw NotWritten("cannot write '" + before + "': " + std::strerror(errno) +
                       "; check that its folder is writable and the disk not full");
    replace_file(path, first_line + checksum(content) + content);
  }

  std::optional<Checkpoint> read_checkpoint(const std::string &folder, std::ostream &log)
  {
    std::string problems;
    for (const char *const name : checkpoint_names)
    {
      const std::string path = folder + "/" + name;
      if (!std::filesystem::exists(path))
        continue;
      Checkpoint checkpoint;
      const std::string problem = problem_of(path, checkpoint);
      if (problem.empty())
      {
        if (!problems.empty())
          log << "Warning: " << problems << "; the one before it is used\n";
        return checkpoint;
      }
      problems += (problems.empty() ? "'" : "; '") + path + "' " + problem;
    }
    if (problems.empty())
      return {};
    throw UserError("cannot resume: " + problems +
                    ". Run with --overwrite to begin from the start");
  }
} // namespace taut
