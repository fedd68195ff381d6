// SPDX-License-Identifier: LGPL-2.1-or-later
#include "simulation/checkpoint.h"

#include "base/write_file.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/base/growing_file.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <ostream>

namespace taut
{
  namespace
  {
    /// First line of the file. The version changes with the stored data.
    const std::string first_line = "Taut checkpoint, version 14\n";
    const std::string any_first_line = "Taut checkpoint, version ";

    /// What follows are blocks: a line with the number of the body, the length of its data and
    /// their checksum, and the data. The first block is the checkpoint without bodies, the last one
    /// is empty.
    const std::string of_checkpoint = "run", of_end = "end";

    std::string checksum(const std::string &name, const std::string &data)
    {
      boost::crc_32_type crc;
      crc.process_bytes(name.data(), name.size());
      crc.process_bytes(data.data(), data.size());
      char text[16];
      std::snprintf(text, sizeof text, "%08x", crc.checksum());
      return text;
    }

    std::string block(const std::string &name, const std::string &data)
    {
      return name + ' ' + std::to_string(data.size()) + ' ' + checksum(name, data) + '\n' + data;
    }

    /// Reads the blocks of a file behind its first line.
    class Blocks
    {
    public:
      explicit Blocks(const std::string &path) : file(path, std::ios::binary)
      {
        std::error_code error;
        left = static_cast<std::size_t>(std::filesystem::file_size(path, error));
        is_a_file = !error;
        if (error)
          left = 0;
        std::string line(std::min(left, first_line.size()), ' ');
        file.read(line.data(), static_cast<std::streamsize>(line.size()));
        start = line;
        left -= line.size();
      }

      bool is_open() const { return file.is_open() && is_a_file; }

      /// The first line, or as much of the file as this has.
      const std::string &first() const { return start; }

      /// Goes to the next block. False if there is none, or it is longer than the file.
      bool next()
      {
        constexpr std::size_t most = 64; // name, length, checksum
        std::string line;
        for (int c; line.size() < most && (c = file.get()) != EOF && c != '\n';)
          line += static_cast<char>(c);
        left -= std::min(left, line.size() + 1);
        std::istringstream words(line);
        if (!(words >> own_name >> length >> sum) || length > left)
          return false;
        left -= length;
        return true;
      }
      const std::string &name() const { return own_name; }
      const std::string &stored_sum() const { return sum; }

      /// Its data; skip() or this is called for each block.
      std::string data()
      {
        std::string bytes(length, ' ');
        file.read(bytes.data(), static_cast<std::streamsize>(length));
        return bytes;
      }
      void skip() { file.seekg(static_cast<std::streamoff>(length), std::ios::cur); }

      bool is_undamaged(const std::string &data) const
      {
        return file && checksum(own_name, data) == sum;
      }
      bool is_at_end() const { return left == 0; }

    private:
      std::ifstream file;
      std::string start, own_name, sum;
      std::size_t length = 0, left = 0;
      bool is_a_file = false;
    };

    /// Reads a file and returns its error, or nothing. @p digest: of the first block.
    std::string problem_of(const std::string &path, Checkpoint &checkpoint, std::string &digest)
    {
      const std::string damaged = "is damaged: its checksum is wrong";
      Blocks blocks(path);
      if (!blocks.is_open())
        return "cannot be read";
      if (blocks.first().compare(0, any_first_line.size(), any_first_line) != 0)
        return "is no checkpoint of Taut";
      if (blocks.first() != first_line)
        return "was written by another version of Taut";
      std::size_t n_bodies = 0;
      for (bool is_first = true; blocks.next(); is_first = false)
      {
        const std::string data = blocks.data();
        if (!blocks.is_undamaged(data) || is_first != (blocks.name() == of_checkpoint))
          return damaged;
        if (blocks.name() == of_end)
          return blocks.is_at_end() && n_bodies == checkpoint.n_bodies ? "" : damaged;
        if (!is_first)
        {
          ++n_bodies;
          continue;
        }
        digest = blocks.stored_sum();
        try
        {
          unarchive(data, [&](InputArchive &archive) { archive >> checkpoint; });
        }
        catch (const boost::archive::archive_exception &e)
        {
          return std::string("cannot be read by this build: ") + e.what();
        }
      }
      return damaged;
    }

    /// Between both renames only the old checkpoint exists, which is enough. A damaged one must not
    /// replace a good one.
    void put_in_place(const std::string &unfinished, const std::string &folder)
    {
      const std::string path = folder + "/" + checkpoint_names[0],
                        before = folder + "/" + checkpoint_names[1];
      Checkpoint last;
      std::string digest;
      if (problem_of(path, last, digest).empty() && std::rename(path.c_str(), before.c_str()) != 0)
        throw NotWritten("cannot write '" + before + "': " + std::strerror(errno) +
                         "; check that its folder is writable and the disk not full");
      finish_file(unfinished, path);
    }
  } // namespace

  void write_checkpoint(const Checkpoint &checkpoint, const std::vector<std::size_t> &numbers,
                        const BodyData &data, const std::string &folder,
                        const Communicator &processes)
  {
    std::string path = unfinished_name(folder + "/" + checkpoint_names[0]);
    processes.broadcast(path);
    double length = 0.; // as a number that ranks agree on
    const auto append = [&](const unsigned int rank, const std::function<void(GrowingFile &)> &work)
    {
      processes.agree(
          [&]
          {
            if (processes.rank() != rank)
              return;
            GrowingFile file;
            if (length > 0.)
              file.go_on(path, static_cast<std::size_t>(length));
            else
              file.create(path);
            work(file);
            file.sync();
            length = static_cast<double>(file.length());
            file.close();
          });
      length = processes.max(length);
    };
    try
    {
      append(0,
             [&](GrowingFile &file)
             {
               file.append(first_line + block(of_checkpoint, archived([&](OutputArchive &archive)
                                                                      { archive << checkpoint; })));
             });
      for (unsigned int rank = 0; rank < processes.size(); ++rank)
        append(rank,
               [&](GrowingFile &file)
               {
                 for (std::size_t k = 0; k < numbers.size(); ++k)
                   file.append(block(std::to_string(numbers[k]), data(k)));
               });
      append(0, [&](GrowingFile &file) { file.append(block(of_end, "")); });
      processes.agree(
          [&]
          {
            if (processes.is_root())
              put_in_place(path, folder);
          });
    }
    catch (...)
    {
      if (processes.is_root())
        std::remove(path.c_str());
      throw;
    }
  }

  std::optional<FoundCheckpoint> read_checkpoint(const std::string &folder, std::ostream &log)
  {
    std::string problems;
    for (const char *const name : checkpoint_names)
    {
      const std::string path = folder + "/" + name;
      if (!std::filesystem::exists(path))
        continue;
      FoundCheckpoint found{{}, path, ""};
      const std::string problem = problem_of(path, found.checkpoint, found.digest);
      if (problem.empty())
      {
        if (!problems.empty())
          log << "Warning: " << problems << "; the one before it is used\n";
        return found;
      }
      problems += (problems.empty() ? "'" : "; '") + path + "' " + problem;
    }
    if (problems.empty())
      return {};
    throw UserError("cannot resume: " + problems +
                    ". Run with --overwrite to begin from the start");
  }

  void read_bodies(const FoundCheckpoint &found, const std::function<bool(std::size_t)> &is_wanted,
                   const std::function<void(std::size_t, const std::string &)> &take)
  {
    const auto require = [&](const bool is_right)
    {
      if (!is_right)
        throw UserError("'" + found.path +
                        "' is not the same file on all ranks: put the results on a disk that they "
                        "share");
    };
    Blocks blocks(found.path);
    require(blocks.is_open() && blocks.next() && blocks.name() == of_checkpoint &&
            blocks.stored_sum() == found.digest);
    for (blocks.skip(); blocks.next() && blocks.name() != of_end;)
      if (const std::size_t number = std::stoul(blocks.name()); is_wanted(number))
      {
        const std::string data = blocks.data();
        require(blocks.is_undamaged(data));
        take(number, data);
      }
      else
        blocks.skip();
    require(blocks.name() == of_end);
  }
} // namespace taut
