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
   * A VTK unstructured grid of points and lines with data, for repeated writing with other values.
   * The format is VTK XML 1.0 with raw appended data, 4-byte floats and integers in the byte order
   * of the machine. Nothing is compressed or converted to text, as a run writes hundreds of files;
   * constant arrays are assembled once.
   */
  class VtuFile
  {
  public:
    enum class Location
    {
      points,
      cells
    };

    /// @p cells: the points of each cell. One point is a vertex, more points are a line.
    VtuFile(std::size_t n_points, const std::vector<std::vector<std::int32_t>> &cells);

    /// Adds an array of zeros with @p n_components a point or cell, and returns its number. Three
    /// components are x, y, z; @p units is for readers.
    std::size_t add(Location location, const std::string &name, unsigned int n_components,
                    const std::string &units);

    /// Adds a constant array.
    void add(Location location, const std::string &name, const std::vector<std::int32_t> &values);
    void add(Location location, const std::string &name, const std::vector<std::string> &values);

    /// Index of the array of positions, three components a point.
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
      std::string bytes; ///< raw; for strings, the codes of their characters as text
      std::string units = "";
    };

    std::size_t n_points, n_cells;
    std::vector<Array> arrays;
  };

  /// The folder of the fields in a folder of results, with '/' at its end; made if it is missing.
  /// Throws UserError if it cannot be made.
  std::string make_fields_folder(const std::string &results);

  /// A ParaView collection: files with their times. It is complete after each call, so that it can
  /// be opened after a run was killed.
  class PvdFile
  {
  public:
    /// The first add() makes the file.
    explicit PvdFile(std::string path) : path(std::move(path)) {}

    /// @p time [s]; @p file is relative to the folder of the collection; several files at one time
    /// are parts of one picture. Throws UserError if it cannot be written.
    void add(double time, const std::string &file, std::size_t part = 0);

    std::size_t size() const { return n_entries; }

    /// Length of the file. resume() continues a file of @p n entries at this length and drops the
    /// rest. Throws UserError if the file is shorter.
    std::size_t length() const { return stream.length(); }
    void resume(std::size_t n, std::size_t length);

    /// Throws UserError if data did not reach the file.
    void close() { stream.close(); }

  private:
    std::string path;
    GrowingFile stream;
    std::size_t n_entries = 0;
  };
} // namespace taut

#endif
