// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_growing_file_h
#define taut_growing_file_h

#include <cstddef>
#include <string>

namespace taut
{
  /**
   * A file that grows by whole pieces: a table, a collection, the lines of a sweep. Bytes that
   * cannot be written completely are not written at all: the file keeps its earlier length, and the
   * call may be repeated. All functions but the destructor throw UserError with the reason of a
   * failure.
   */
  class GrowingFile
  {
  public:
    GrowingFile() = default;
    GrowingFile(GrowingFile &&other) noexcept;
    GrowingFile &operator=(GrowingFile &&) = delete;
    ~GrowingFile();

    /// Makes an empty file, in the place of an existing one.
    void create(const std::string &name);

    /// Opens a file at this length and drops the bytes behind it. For a shorter file the error says
    /// that a run cannot go on there.
    void resume(const std::string &name, std::size_t length);

    /// Opens a file that another process left with this length.
    void go_on(const std::string &name, std::size_t length);

    void append(const std::string &bytes);

    /// Inserts @p bytes before @p tail, the end of the file.
    void insert(const std::string &bytes, const std::string &tail);

    /// Brings all bytes to the disk.
    void sync();

    void close();

    bool is_open() const { return descriptor >= 0; }
    std::size_t length() const { return n_bytes; }

  private:
    void open(const std::string &name, int flags);
    bool write(const std::string &bytes);
    [[noreturn]] void fail(int error) const;

    std::string path;
    int descriptor = -1;
    std::size_t n_bytes = 0;
  };
} // namespace taut

#endif
