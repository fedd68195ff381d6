// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_archive_forward_h
#define taut_archive_forward_h

namespace boost
{
  namespace archive
  {
    class binary_oarchive;
    class binary_iarchive;
  } // namespace archive
} // namespace boost

namespace taut
{
  using OutputArchive = boost::archive::binary_oarchive;
  using InputArchive = boost::archive::binary_iarchive;
} // namespace taut

#endif
