// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_errors_of_runs_h
#define taut_errors_of_runs_h

#include "verification/scene_tests.h"

/// "entry: message" of the error that a run ends with; empty: none.
inline std::string error_of(const std::string &scene, const verification::Overrides &overrides = {})
{
  try
  {
    verification::run_scene(scene, overrides, {});
  }
  catch (const taut::EntryError &e)
  {
    return e.entry() + ": " + e.message();
  }
  catch (const std::exception &e)
  {
    return e.what();
  }
  return "";
}

inline void expect(const std::string &text, const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    EXPECT_TRUE(verification::has(text, part)) << "'" << part << "' in\n" << text;
}

#endif
