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
  /**
   * The entries of a parameter file with the places where they stand, before anyone knows what they
   * mean. Reads deal.II's .prm format (subsection, set, end, include, comments, continued lines; an
   * include is sought beside the file that includes it).
   */
  class ParameterFile
  {
  public:
    struct Entry
    {
      std::vector<std::string> path; ///< sections, then the entry's own name
      std::string value;
      std::string place; ///< "file:line", or "--set" on the command line

      std::string name() const; ///< the path joined with '/'
    };

    /// Throws UserError with file and line if the text has no such structure, names an entry twice
    /// or none at all, and for a .json file.
    void read(const std::string &file);

    /// Adds "A.B.Entry=value" or "A/B/Entry=value" from the command line; replaces the entry if it
    /// is there. Returns it.
    const Entry &set(const std::string &assignment);

    /// What the root has read becomes what all ranks have.
    void broadcast(const Communicator &processes);

    const std::vector<Entry> &entries() const { return list; }

    /// Sections that were opened, empty or not, with the place of their first line.
    const std::vector<Entry> &sections() const { return section_list; }

    /// All entries in .prm format.
    std::string text() const;

    /// The file that was read, as named.
    const std::string &name() const { return main_file; }

    /// "file:line: Section/Entry = 'value'", or as much of it as is known of a path joined with
    /// '/'.
    std::string locate(const std::string &name) const;

  private:
    void read_prm(const std::string &file, std::vector<std::string> &path);
    void add(Entry entry);
    void add_section(const std::vector<std::string> &path, const std::string &place);

    std::vector<Entry> list, section_list;
    std::map<std::string, std::size_t> index, section_index; ///< by name, of the lists
    std::string main_file;
    std::vector<std::string> open_files; ///< while they are read, to find a loop of includes
  };
} // namespace taut

#endif
