// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_parameter_file_h
#define taut_parameter_file_h

#include <taut/base/communicator.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /// The entries of a parameter file and their places, before interpretation. Reads deal.II's .prm
  /// format (subsection, set, end, include, comments, continued lines). An included file is sought
  /// beside the including file, which may set entries of it again after the include.
  class ParameterFile
  {
  public:
    struct Entry
    {
      std::vector<std::string> path; ///< sections, then the entry's own name
      std::string value;
      std::string place; ///< "file:line", "--set" on the command line, or as set_origin() says

      std::string name() const; ///< the path joined with '/'
    };

    /// Throws UserError with file and line if the text has another structure, names an entry twice
    /// or has none, and for a .json file.
    void read(const std::string &file);

    /// Sets "A.B.Entry=value" or "A/B/Entry=value" from the command line, in place of an existing
    /// entry. Returns the entry. Between dots, sections of the file may have names with dots.
    const Entry &set(const std::string &assignment);

    /// Says for later set() of an entry where its value is from, in place of the command line.
    void set_origin(const std::string &name, const std::string &place) { origins[name] = place; }

    /// Place of an entry, or the file if it does not set the entry.
    std::string place_of(const std::string &name) const;

    /// Sends the data of the root to all ranks.
    void broadcast(const Communicator &processes);

    const std::vector<Entry> &entries() const { return list; }

    /// Opened sections, empty or not, with the places of their first lines.
    const std::vector<Entry> &sections() const { return section_list; }

    /// All entries in .prm format.
    std::string text() const;

    /// Name of the file, as given.
    const std::string &name() const { return main_file; }

    /// "file:line: Section/Entry = 'value'", or the known part for a path joined with '/'.
    std::string locate(const std::string &name) const;

  private:
    void read_prm(const std::string &file, std::vector<std::string> &path);
    std::vector<std::string> split_at_dots(const std::string &text) const;
    void add(Entry entry);
    void add_section(const std::vector<std::string> &path, const std::string &place);

    std::vector<Entry> list, section_list;
    std::map<std::string, std::size_t> index, section_index; ///< by name, in the lists
    std::map<std::string, std::string> origins;              ///< places by name
    std::string main_file;
    std::vector<std::string> open_files;          ///< during reading, to detect a loop of includes
    std::vector<std::vector<std::string>> set_in; ///< files open at each entry of the list
  };
} // namespace taut

#endif
