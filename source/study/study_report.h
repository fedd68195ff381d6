// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_study_report_h
#define taut_study_report_h

#include "study/study.h"

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// Makes the folder of a study. Throws EntryError on Study/Folder if it cannot be made, or holds
  /// a study and @p overwrite is false.
  void prepare_study_folder(const std::string &folder, bool overwrite);

  /// The settings on the front from cheap to accurate, how many failed and why, and the cheapest
  /// setting for each accuracy; a Markdown table.
  void print_study(const StudyResult &result, const std::vector<double> &accuracies,
                   std::ostream &out);

  /// All settings as a table. Throws UserError if the file cannot be written.
  void write_work_precision(const StudyResult &result, const std::string &path);

  /// The study with @p scene, all entries by path, for Study/Accuracy. Throws UserError.
  void write_study(const StudyResult &result, const std::map<std::string, std::string> &scene,
                   const std::string &path);
} // namespace taut

#endif
