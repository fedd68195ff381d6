// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_vtu_file_h
#define taut_vtu_file_h

#include <taut/base/growing_file.h>

#include <cstdint>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Points and lines with data on them as a VTK unstructured grid, written again and again with
   * other values. VTK XML format 1.0 with raw appended data, 4-byte floats and integers in the
   * byte order of the machine: nothing is compressed or turned into text, because a run writes such
   * files by the hundred; arrays that do not change are put together once.
   */
  class VtuFile
  {
  public:
    enum class Location
    {
      points,
      cells
    };

    /// @p cells: the points of each; one point is a vertex, more are a line through them.
    VtuFile(std::size_t n_points, const std::vector<std::vector<std::int32_t>> &cells);

    /// Adds an array of zeros with @p n_components a point or cell, and returns its number.
    std::size_t add(Location location, const std::string &name, unsigned int n_components);

    /// Adds an array that stays as it is.
    void add(Location location, const std::string &name, const std::vector<std::int32_t> &values);
    void add(Location location, const std::string &name, const std::vector<std::string> &values);

    /// Number of the array of positions, three components a point.
    static constexpr std::size_t positions = 0;

    /// Sets all values of an array of floats.
    void set(std::size_t array, const std::vector<float> &values);

    /// Throws UserError if the file cannot be written.
    void write(const std::string &path) const;

  private:
    struct Array
    {
      std::string section, name, type;
      unsigned int n_components;
      std::string bytes; ///< raw; of strings, the codes of their characters as text
    };

    std::size_t n_points, n_cells;
    std::vector<Array> arrays;
  };

  /**
   * A ParaView collection: files with their times. Complete after each call, so that what a run
   * wrote before it was killed opens.
   */
  class PvdFile
  {
  public:
    /// The file is made when the first entry is added.
    explicit PvdFile(std::string path) : path(std::move(path)) {}

    /// @p time [s]; @p file is relative to the folder of this one; several files of one time are
    /// the parts of what is shown. Throws UserError if it cannot be written.
    void add(double time, const std::string &file, std::size_t part = 0);

    std::size_t size() const { return n_entries; }

    /// Length of the file with @p n entries; resume() goes on there and drops what follows. Throws
    /// UserError if the file is shorter.
    std::size_t length() const { return stream.length(); }
    void resume(std::size_t n, std::size_t length);

    /// Throws UserError if what was written did not reach the file after all.
    void close() { stream.close(); }

  private:
    std::string path;
    GrowingFile stream;
    std::size_t n_entries = 0;
  };
} // namespace taut

#endif
