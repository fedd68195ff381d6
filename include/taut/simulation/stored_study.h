// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_stored_study_h
#define taut_stored_study_h

#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// Whether a study of a scene is a study of every scene with another value of this entry: where
  /// results go, what is expected of them and how the study is made.
  bool is_irrelevant_for_study(const std::string &path);

  /// A setting of a stored study.
  struct StudyChoice
  {
    std::vector<std::string> overrides; ///< "Section/Entry=value"
    std::string description;            ///< what was chosen and what it costs and loses
  };

  /**
   * The cheapest setting in @p file, a study.json, whose error and that of its reference are
   * together at most @p accuracy (relative). @p scene, all entries by path, must have the values of
   * the studied scene but for those that the study varied; numbers compare as numbers. Throws
   * EntryError on "Study/Accuracy" that says what differs or what could be had.
   */
  StudyChoice choose_setting(const std::string &file, double accuracy,
                             const std::map<std::string, std::string> &scene);
} // namespace taut

#endif
