// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_network_file_h
#define taut_network_file_h

#include <string>
#include <vector>

namespace taut
{
  class Parameters;

  /**
   * Writes Parameters::as_network() to the file @p name, reads it back and compares the scenes.
   * @p left_out gets the sections of studies and sweeps that are not in the file. Throws UserError
   * if there is such a file already, unless results may be overwritten, if no entries say the
   * scene, or if the file does not say it to the last bit.
   */
  void write_network(const Parameters &parameters, const std::string &name,
                     std::vector<std::string> &left_out);
} // namespace taut

#endif
