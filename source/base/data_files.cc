// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/data_files.h"
#include "base/text.h"
#include "base/write_file.h"
#include <taut/base/exceptions.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <mutex>

namespace taut
{
  namespace
  {
    namespace fs = std::filesystem;

    struct Files
    {
      std::mutex mutex;
      std::string folder;
      DataFiles known;
    };

    Files &files()
    {
      static Files all;
      return all;
    }

    bool leaves_folder(const fs::path &name)
    {
      return name.is_absolute() || std::any_of(name.begin(), name.end(),
                                               [](const fs::path &part) { return part == ".."; });
    }

    bool is_file(const fs::path &path)
    {
      std::error_code error;
      return fs::exists(path, error) && !fs::is_directory(path, error);
    }

    /// Of a file or, where it is missing, of its copy.
    fs::path path_of(const std::string &name)
    {
      const fs::path folder = files().folder, path = folder / name,
                     beside = folder / copied_name(name);
      return !is_file(path) && is_file(beside) ? beside : path;
    }
  } // namespace

  void set_data_folder(const std::string &folder)
  {
    const std::lock_guard<std::mutex> lock(files().mutex);
    files().folder = folder;
    files().known.clear();
  }

  bool has_data_file(const std::string &name)
  {
    const std::lock_guard<std::mutex> lock(files().mutex);
    return is_file(path_of(name));
  }

  std::shared_ptr<const std::string> read_data_file(const std::string &name,
                                                    const std::string &entry)
  {
    const std::lock_guard<std::mutex> lock(files().mutex);
    std::shared_ptr<const std::string> &text = files().known[name];
    if (text)
      return text;
    const fs::path path = path_of(name);
    std::ifstream in(path, std::ios::binary);
    std::string content;
    if (in && is_file(path))
      content.assign(std::istreambuf_iterator<char>(in), {});
    if (!in || !is_file(path) || in.bad())
    {
      files().known.erase(name);
      throw EntryError(entry, "cannot read the file '" + path.string() +
                                  "'; names of files are relative to the folder of the parameter "
                                  "file");
    }
    return text = std::make_shared<const std::string>(std::move(content));
  }

  DataFiles data_files()
  {
    const std::lock_guard<std::mutex> lock(files().mutex);
    return files().known;
  }

  std::string digest(const std::string &bytes)
  {
    // The polynomial of ECMA-182.
    boost::crc_optimal<64, 0x42F0E1EBA9EA3693ULL, 0, 0, false, false> crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return to_text(bytes.size(), " bytes, CRC ", std::hex,
                   static_cast<std::uint64_t>(crc.checksum()));
  }

  namespace
  {
    bool has_copy(const std::string &name, const std::string &text, const std::string &folder)
    {
      const fs::path path = fs::path(folder) / copied_name(name);
      std::ifstream in(path, std::ios::binary);
      return is_file(path) && std::string(std::istreambuf_iterator<char>(in), {}) == text;
    }
  } // namespace

  std::string changed_copy(const DataFiles &files, const std::string &folder)
  {
    for (const auto &[name, text] : files)
      if (!has_copy(name, *text, folder))
        return name;
    return "";
  }

  void copy_data_files(const DataFiles &files, const std::string &folder)
  {
    DataFiles copies;
    for (const auto &[name, text] : files)
    {
      const auto [known, is_new] = copies.emplace(copied_name(name), text);
      if (!is_new && *known->second != *text)
        throw UserError("two files have the name '" + known->first +
                        "' in the folder of results; rename one, or put it into a folder below "
                        "that of the parameter file");
      if (has_copy(name, *text, folder))
        continue;
      const fs::path path = fs::path(folder) / known->first;
      std::error_code error;
      fs::create_directories(path.parent_path(), error);
      write_file(path.string(), *text);
    }
  }

  std::string copied_name(const std::string &name)
  {
    const fs::path path(name);
    if (!leaves_folder(path))
      return path.string();
    if (path.filename() != "droppers.csv")
      return path.filename().string();
    // All runs have a table of droppers: its folder says of which run.
    const fs::path folder = path.lexically_normal().parent_path().filename();
    return ((folder.empty() || folder == ".." ? "earlier_run" : folder) / path.filename()).string();
  }
} // namespace taut
