// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verdict.h"

#include "verification/run.h"

#include <taut/base/exceptions.h>

#include <cmath>

namespace hunt
{
  namespace
  {
    /// Remarks about what a force means, which say nothing of the accuracy of a motion.
    constexpr const char *remarks[] = {"is an impulse over a step"};

    /// The warnings of a log that name something and speak of the step.
    std::string warnings(const std::string &log)
    {
      std::istringstream lines(log);
      std::string result;
      for (std::string line; std::getline(lines, line);)
      {
        bool counts =
            line.find("Warning: ") != std::string::npos &&
            (line.find("step") != std::string::npos || line.find("Step") != std::string::npos) &&
            line.find('\'') != std::string::npos;
        for (const char *remark : remarks)
          counts = counts && line.find(remark) == std::string::npos;
        if (counts)
          result += line + "\n";
      }
      return result;
    }

    /// A run of the program.
    struct Run
    {
      explicit Run(const HuntScene &scene) : recorder(scene.frequency)
      {
        try
        {
          verification::Session session(scene.text,
                                        {"Time.Step=" + verification::number(scene.step)});
          try
          {
            session.run(std::ref(recorder));
            ended = true;
          }
          catch (const taut::UserError &e)
          {
            refusal = e.what();
          }
          log = session.log();
          at_end = session.simulation().n_steps();
        }
        catch (const taut::UserError &e)
        {
          refusal = e.what();
        }
        catch (const std::exception &e)
        {
          crash = e.what();
        }
        if (!ended && refusal.empty() && crash.empty())
          crash = "an error without a reason";
      }

      Recorder recorder;
      bool ended = false;
      long at_end = 0;
      std::string refusal, crash, log;
    };

    bool within(const Difference &d, const bool compares_places)
    {
      // Not-a-number is not within.
      return (!compares_places || d.place <= place_bound) && d.impulse <= impulse_bound &&
             d.energy <= energy_bound;
    }
  } // namespace

  const char *name(const Verdict verdict)
  {
    constexpr const char *names[n_verdicts] = {"agreed",       "but warned", "but refused",
                                               "warned wrong", "refused",    "SILENT WRONG",
                                               "crashed",      "undecided"};
    return names[static_cast<std::size_t>(verdict)];
  }

  Finding judge(const HuntScene &original, const double parts)
  {
    HuntScene scene = original;
    scene.step /= parts;
    Finding result;
    Run run(scene);
    result.log = run.log;
    result.what = run.crash;
    if (!run.crash.empty())
      return result;
    const History &history = run.recorder.history;
    if (!run.ended && (history.empty() ||
                       history.back().time < scene.step * (static_cast<double>(run.at_end) - .5)))
    {
      result.verdict = Verdict::refused;
      result.what = run.refusal;
      return result;
    }
    std::vector<double> times;
    for (const Sample &sample : history)
      times.push_back(sample.time);
    const Reference reference = make_reference(scene, run.recorder.model.get(), times, run.log);
    if (!reference.has_sums)
    {
      result.verdict = Verdict::not_decidable;
      result.what = reference.missing;
      return result;
    }
    result.difference = difference(reference.history, history);
    result.compares_places = reference.has_places;
    const bool agrees = within(result.difference, reference.has_places);
    const std::string warned = warnings(run.log);
    result.what = run.refusal.empty() ? warned : run.refusal;
    if (!run.ended)
      result.verdict = agrees ? Verdict::agreed_but_refused : Verdict::refused;
    else if (warned.empty())
      result.verdict = agrees ? Verdict::agreed : Verdict::silent_and_wrong;
    else
      result.verdict = agrees ? Verdict::agreed_but_warned : Verdict::warned_and_wrong;
    return result;
  }
} // namespace hunt
