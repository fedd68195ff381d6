// SPDX-License-Identifier: LGPL-2.1-or-later
// A system of one body, and the options of a stepper in one line.
#ifndef taut_tests_one_body_h
#define taut_tests_one_body_h

#include "common.h"

#include <taut/interface/system.h>
#include <taut/time/stepper.h>

namespace verification
{
  /// The body is made from some arguments; it is number 0, to which constraints may be added.
  template <typename Made>
  struct OneBody
  {
    template <typename... Arguments>
    explicit OneBody(const std::string &name, Arguments &&...arguments)
    {
      system.add(name,
                 [&]
                 {
                   auto made = std::make_unique<Made>(arguments...);
                   body = made.get();
                   return made;
                 });
    }

    Made *body = nullptr;
    taut::System system;
  };

  inline taut::StepperOptions steps_of(const double step, const taut::Start start,
                                       const std::string &scheme = "automatic")
  {
    taut::StepperOptions options;
    options.step = step;
    options.start = start;
    options.scheme = scheme;
    return options;
  }
} // namespace verification

#endif
