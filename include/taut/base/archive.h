// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_archive_h
#define taut_archive_h

// Binary archives of Boost for checkpoints. Headers name them as OutputArchive and InputArchive of
// archive_forward.h. Include this file in sources that write or read an archive.

#include <taut/base/archive_forward.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/deque.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <new>
#include <sstream>
#include <string>

namespace taut
{
  /// The bytes that @p write stores in an archive.
  template <typename Write>
  std::string archived(const Write &write)
  {
    std::ostringstream out(std::ios::binary);
    {
      OutputArchive archive(out);
      write(archive);
    }
    if (!out) // a stream swallows it
      throw std::bad_alloc();
    return out.str();
  }

  /// Calls @p read with an archive of these bytes. Throws boost::archive::archive_exception if the
  /// archive is too short.
  template <typename Read>
  void unarchive(const std::string &text, const Read &read)
  {
    std::istringstream in(text, std::ios::binary);
    InputArchive archive(in);
    read(archive);
  }
} // namespace taut

#endif
