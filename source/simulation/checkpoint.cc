// SPDX-License-Identifier: LGPL-2.1-or-later
#include "checkpoint.h"

#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/base/write_file.h>

#include <boost/crc.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

namespace taut
{
  namespace
  {
    /// First line of the file. The number changes with what is stored.
    const std::string first_line = "Taut checkpoint, version 1\n";
    const std::string any_first_line = "Taut checkpoint, version ";

    std::string checksum(const std::string &bytes)
    {
      boost::crc_32_type crc;
      crc.process_bytes(bytes.data(), bytes.size());
      char text[16];
      std::snprintf(text, sizeof text, "%08x\n", crc.checksum());
      return text;
    }

    /// Throws UserError, saying what is wrong with the bytes.
    Checkpoint parse(const std::string &bytes)
    {
      if (bytes.compare(0, any_first_line.size(), any_first_line) != 0)
        throw UserError("it is no checkpoint of Taut");
      if (bytes.compare(0, first_line.size(), first_line) != 0)
        throw UserError("it was written by another version of Taut");
      const std::size_t n_sum = checksum("").size();
      if (bytes.size() < first_line.size() + n_sum)
        throw UserError("it is incomplete");
      const std::string sum = bytes.substr(first_line.size(), n_sum),
                        content = bytes.substr(first_line.size() + n_sum);
      if (sum != checksum(content))
        throw UserError("it is damaged: its checksum is wrong");
      Checkpoint checkpoint;
      unarchive(content, [&](InputArchive &archive) { archive >> checkpoint; });
      return checkpoint;
    }
  } // namespace

  void write_checkpoint(const Checkpoint &checkpoint, const std::string &folder)
  {
    const std::string content = archived([&](OutputArchive &archive) { archive << checkpoint; });
    const std::string path = folder + "/" + checkpoint_names[0];
    // Between the two renames there is the old one only, which is enough.
    std::rename(path.c_str(), (folder + "/" + checkpoint_names[1]).c_str());
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
      try
      {
        std::ifstream file(path, std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(file), {});
        if (!file)
          throw UserError("it cannot be read");
        Checkpoint checkpoint = parse(bytes);
        if (!problems.empty())
          log << "Warning: " << problems << "; the one before it is used\n";
        return checkpoint;
      }
      catch (const std::exception &e)
      {
        problems += (problems.empty() ? "" : "; ") + ("'" + path + "': ") + e.what();
      }
    }
    if (problems.empty())
      return {};
    throw UserError("cannot resume: " + problems +
                    ". Run with --overwrite to begin from the start");
  }
} // namespace taut
