// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_growing_file_h
#define taut_growing_file_h

#include <cstddef>
#include <string>

namespace taut
{
  /**
   * A file to whose end bytes are added. What cannot be written as a whole is not written at all:
   * the file keeps its earlier length, and the same bytes may be tried again. All functions but the
   * destructor throw UserError with the reason if they fail.
   */
  class GrowingFile
  {
  public:
    GrowingFile() = default;
    GrowingFile(GrowingFile &&other) noexcept;
    GrowingFile &operator=(GrowingFile &&) = delete;
    ~GrowingFile();

    /// Makes an empty file, or one of what is there.
    void create(const std::string &name);

    /// Opens a file at this length and drops what follows. Says that a run cannot go on there if it
    /// is shorter.
    void resume(const std::string &name, std::size_t length);

    void append(const std::string &bytes);

    /// Puts @p bytes before @p tail, with which the file ends.
    void insert(const std::string &bytes, const std::string &tail);

    /// Brings all to the disk.
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
