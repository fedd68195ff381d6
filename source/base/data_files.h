// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_data_files_h
#define taut_data_files_h

#include <map>
#include <memory>
#include <string>

namespace taut
{
  /// Texts of files by the names that entries give them.
  using DataFiles = std::map<std::string, std::shared_ptr<const std::string>>;

  /// The folder that names of files in entries are relative to: that of the parameter file. Empty
  /// at first: the working folder. Files are read anew after this.
  void set_data_folder(const std::string &folder);

  /**
   * Text of a file that an entry names, read once. A name with '..' or from the root of the disk
   * whose file is missing means the file of that name beside the parameter file, where runs put
   * copies. Throws EntryError on @p entry if it cannot be read.
   */
  std::shared_ptr<const std::string> read_data_file(const std::string &name,
                                                    const std::string &entry);

  /// Whether read_data_file() would find a file.
  bool has_data_file(const std::string &name);

  /// All files read since set_data_folder().
  DataFiles data_files();

  /// The size of some bytes with their 64-bit CRC, as text.
  std::string digest(const std::string &bytes);

  /// Where the copy of a file belongs in a folder of results: under its name, or beside the
  /// parameter file if the name leaves the folder.
  std::string copied_name(const std::string &name);

  /// Name of the first of these files whose copy in a folder is missing or has another text; empty:
  /// none.
  std::string changed_copy(const DataFiles &files, const std::string &folder);

  /// Writes copies of these files into a folder, so that a parameter file there finds them. Throws
  /// UserError if two of them have one name there and another text, or if one cannot be written.
  void copy_data_files(const DataFiles &files, const std::string &folder);
} // namespace taut

#endif
