// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/memory.h"
#include "base/write_file.h"
#include <taut/output/table_file.h>
#include <taut/output/vtu_file.h>

#include <cstring>
#include <filesystem>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Bytes of numbers in memory order, for the file.
    template <typename Number>
    std::string bytes_of(const std::vector<Number> &values)
    {
      std::string bytes(values.size() * sizeof(Number), '\0');
      if (!values.empty())
        std::memcpy(&bytes[0], values.data(), bytes.size());
      return bytes;
    }

    const char *byte_order()
    {
      const std::uint16_t one = 1;
      unsigned char first;
      std::memcpy(&first, &one, 1);
      return first == 1 ? "LittleEndian" : "BigEndian";
    }

    const char *section(const VtuFile::Location location)
    {
      return location == VtuFile::Location::points ? "PointData" : "CellData";
    }

    /// Names of the components of a vector, and units, which readers of VTK pass over.
    std::string attributes(const unsigned int n_components, const std::string &units)
    {
      std::string text;
      for (unsigned int c = 0; c < n_components && n_components == 3; ++c)
        text += "ComponentName" + std::to_string(c) + "=\"" + "xyz"[c] + "\" ";
      return units.empty() ? text : text + "units=\"" + units + "\" ";
    }

    const std::string tail = "</Collection>\n</VTKFile>\n"; ///< of a collection

    constexpr std::uint8_t vertex = 1, poly_line = 4; ///< types of cells in VTK
  }                                                   // namespace

  VtuFile::VtuFile(const std::size_t n_points, const std::vector<std::vector<std::int32_t>> &cells)
      : n_points(n_points), n_cells(cells.size())
  {
    std::vector<std::int32_t> connectivity, offsets;
    std::vector<std::uint8_t> types;
    for (const std::vector<std::int32_t> &cell : cells)
    {
      connectivity.insert(connectivity.end(), cell.begin(), cell.end());
      offsets.push_back(connectivity.size());
      types.push_back(cell.size() == 1 ? vertex : poly_line);
    }
    arrays.push_back(
        {"Points", "positions", "Float32", 3, bytes_of(std::vector<float>(3 * n_points)), "m"});
    arrays.push_back({"Cells", "connectivity", "Int32", 1, bytes_of(connectivity)});
    arrays.push_back({"Cells", "offsets", "Int32", 1, bytes_of(offsets)});
    arrays.push_back({"Cells", "types", "UInt8", 1, bytes_of(types)});
  }

  std::size_t VtuFile::add(const Location location, const std::string &name,
                           const unsigned int n_components, const std::string &units)
  {
    const std::size_t n = (location == Location::points ? n_points : n_cells) * n_components;
    arrays.push_back(
        {section(location), name, "Float32", n_components, bytes_of(std::vector<float>(n)), units});
    return arrays.size() - 1;
  }

  void VtuFile::add(const Location location, const std::string &name,
                    const std::vector<std::int32_t> &values)
  {
    arrays.push_back({section(location), name, "Int32", 1, bytes_of(values)});
  }

  void VtuFile::add(const Location location, const std::string &name,
                    const std::vector<std::string> &values)
  {
    // Strings are numbers of characters, each ended by a zero.
    std::ostringstream text;
    for (const std::string &value : values)
    {
      for (const unsigned char c : value)
        text << static_cast<int>(c) << ' ';
      text << "0\n";
    }
    arrays.push_back({section(location), name, "String", 1, whole_text(text)});
  }

  void VtuFile::set(const std::size_t array, const std::vector<float> &values)
  {
    arrays[array].bytes = bytes_of(values);
  }

  void VtuFile::write(const std::string &path) const
  {
    std::string text =
        std::string("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"") +
        byte_order() + "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
        std::to_string(n_points) + "\" NumberOfCells=\"" + std::to_string(n_cells) + "\">\n";
    std::uint64_t offset = 0;
    for (const char *wanted : {"Points", "Cells", "PointData", "CellData"})
    {
      text += std::string("<") + wanted + ">\n";
      for (const Array &array : arrays)
      {
        if (array.section != wanted)
          continue;
        const bool is_text = array.type == "String";
        text += std::string(is_text ? "<Array" : "<DataArray") + " type=\"" + array.type +
                "\" Name=\"" + array.name + "\" NumberOfComponents=\"" +
                std::to_string(array.n_components) + "\" " +
                attributes(array.n_components, array.units) + "format=\"";
        if (is_text)
          text += "ascii\">\n" + array.bytes + "</Array>\n";
        else
        {
          text += "appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
          offset += sizeof offset + array.bytes.size();
        }
      }
      text += std::string("</") + wanted + ">\n";
    }
    text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

    // All data in one write.
    text.reserve(text.size() + offset + 64);
    for (const char *wanted : {"Points", "Cells", "PointData", "CellData"})
      for (const Array &array : arrays)
        if (array.section == wanted && array.type != "String")
        {
          const std::uint64_t size = array.bytes.size();
          text.append(reinterpret_cast<const char *>(&size), sizeof size);
          text += array.bytes;
        }
    text += "\n</AppendedData>\n</VTKFile>\n";
    write_file(path, text);
  }

  std::string make_fields_folder(const std::string &results)
  {
    const std::string folder = results + "/fields";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw NotWritten("cannot make '" + folder + "': " + error.message() +
                       "; name another folder in Output/Folder, or make room for this one");
    return folder + "/";
  }

  void PvdFile::resume(const std::size_t n, const std::size_t length)
  {
    n_entries = n;
    if (n == 0)
      return;
    // Writes the end of the collection again, which may be overwritten.
    stream.resume(path, length);
    stream.insert("", tail);
  }

  void PvdFile::add(const double time, const std::string &file, const std::size_t part)
  {
    const std::string entry = "<DataSet timestep=\"" + time_text(time) +
                              (part > 0 ? "\" part=\"" + std::to_string(part) : "") + "\" file=\"" +
                              file + "\"/>\n";
    if (n_entries > 0)
      stream.insert(entry, tail);
    else
    {
      // Writes the whole text: an empty file is no collection.
      const std::string text = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                                           "version=\"1.0\" byte_order=\"") +
                               byte_order() + "\">\n<Collection>\n" + entry + tail;
      write_file(path, text);
      stream.resume(path, text.size());
    }
    ++n_entries;
  }
} // namespace taut
