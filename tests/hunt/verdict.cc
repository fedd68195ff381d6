// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verdict.h"

#include "common.h"
#include "verification/run.h"

using verification::has;

namespace hunt
{
  namespace
  {
    /// The warnings of a log that name something and speak of the step, or of a contact at the end.
    std::string warnings(const std::string &log)
    {
      std::istringstream lines(log);
      std::string result;
      // What a force means says nothing of the accuracy of a motion.
      for (std::string line; std::getline(lines, line);)
        if (has(line, "Warning: ") && has(line, "'") && !has(line, "is an impulse over a step") &&
            (has(line, "step") || has(line, "Step") || has(line, "until the end of the run")))
          result += line + "\n";
      return result;
    }

    struct Run
    {
      explicit Run(const HuntScene &scene) : recorder(scene.frequency, scene.pulse)
      {
        try
        {
          verification::Session session(scene.text,
                                        {"Time.Step=" + verification::number(scene.step)});
          refusal = verification::error_of(
              [&]
              {
                session.run(std::ref(recorder));
                ended = true;
              });
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
    const double last = scene.step * (static_cast<double>(run.at_end) - .5);
    if (!run.ended && (history.empty() || history.back().time < last))
    {
      result.verdict = Verdict::refused;
      result.what = run.refusal;
      return result;
    }
    std::vector<double> times;
    for (const Sample &sample : history)
      times.push_back(sample.time);
    Reference reference = make_reference(scene, run.recorder.model.get(), times, run.log);
    if (!reference.has_sums)
    {
      result.verdict = Verdict::not_decidable;
      result.what = reference.missing;
      return result;
    }
    join_repeated(*run.recorder.model, reference.history);
    join_repeated(*run.recorder.model, run.recorder.history);
    result.difference = difference(reference.history, history);
    if (scene.is_driven)
      result.difference.energy = 0.;
    result.compares_places = reference.has_places;
    const bool agrees = within(result.difference, reference.has_places);
    const std::string warned = warnings(run.log);
    result.what = run.refusal.empty() ? warned : run.refusal;
    // Nobody knows whether a warning is right where only sums are compared.
    if (agrees && !reference.has_places && run.refusal.empty() && !warned.empty())
      result.verdict = Verdict::not_decidable;
    else if (!run.ended)
      result.verdict = agrees ? Verdict::agreed_but_refused : Verdict::refused;
    else if (warned.empty())
      result.verdict = agrees ? Verdict::agreed : Verdict::silent_and_wrong;
    else
      result.verdict = agrees ? Verdict::agreed_but_warned : Verdict::warned_and_wrong;
    return result;
  }
} // namespace hunt
