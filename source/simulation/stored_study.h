// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stored_study_h
#define taut_stored_study_h

#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// Whether a study of a scene holds for any value of this entry, which is about the place of
  /// results, their expected ranges or the method of the study.
  bool is_irrelevant_for_study(const std::string &path);

  /// A setting of a stored study.
  struct StudyChoice
  {
    std::vector<std::string> overrides; ///< "Section/Entry=value"
    std::string description;            ///< the choice, its cost and its error
  };

  /**
   * The cheapest setting in @p file, a study.json, whose error plus that of its reference is at
   * most @p accuracy (relative). @p scene, all entries by path, must have the values of the studied
   * scene, except those that the study varied; numbers compare as numbers. Throws EntryError on
   * "Study/Accuracy" with the difference, or the possible accuracy.
   */
  StudyChoice choose_setting(const std::string &file, double accuracy,
                             const std::map<std::string, std::string> &scene);
} // namespace taut

#endif
