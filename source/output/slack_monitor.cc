// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/total_displacement.h"

#include <taut/base/archive.h>
#include <taut/output/slack_monitor.h>
#include <taut/substructure/body_traits.h>

#include <algorithm>
#include <ostream>
#include <sstream>
#include <string>

namespace taut
{
  void SlackMonitor::record(const StepView &step)
  {
    const SceneBodies &structure = step.structure;
    if (is_new)
    {
      is_new = false;
      bodies = structure.all_bodies();
      own.resize(n_entries * bodies.size(), 0.);
      for (std::size_t k = 0; k < structure.size(); ++k)
        if (dynamic_cast<const SlenderBody *>(&structure[k]) && !structure[k].is_linear() &&
            own[n_entries * structure.number(k)] == 0.)
          watched.push_back(k);
    }
    const auto is_slack = [&](const std::size_t k)
    {
      SlenderBody::Slack slack;
      set_total_displacement(step, k, U);
      if (!dynamic_cast<const SlenderBody &>(structure[k]).is_slack(U, slack))
        return false;
      double *const found = own.data() + n_entries * structure.number(k);
      found[is_found] = 1.;
      found[time] = step.state.time;
      found[place] = slack.place;
      found[bending_stiffness] = slack.bending_stiffness;
      found[axial_damping] = slack.axial_damping;
      found[is_straight] = slack.is_straight ? 1. : 0.;
      found[disturbance] = slack.disturbance;
      return true;
    };
    watched.erase(std::remove_if(watched.begin(), watched.end(), is_slack), watched.end());
  }

  std::vector<double> SlackMonitor::of_all_ranks() const
  {
    std::vector<double> all = own;
    processes.sum(all);
    return all;
  }

  void SlackMonitor::save(OutputArchive &archive)
  {
    const std::vector<double> all = of_all_ranks();
    archive << all;
  }

  void SlackMonitor::resume(InputArchive &archive, const StepView &step)
  {
    std::vector<double> all;
    archive >> all;
    own.assign(all.size(), 0.);
    for (std::size_t k = 0; k < step.structure.size(); ++k)
      std::copy_n(all.begin() + n_entries * step.structure.number(k), n_entries,
                  own.begin() + n_entries * step.structure.number(k));
  }

  void SlackMonitor::report(std::ostream &log, const bool failed) const
  {
    if (failed && processes.size() > 1)
      return;
    const std::vector<double> all = of_all_ranks();
    constexpr std::size_t most_named = 6;
    std::size_t n = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
      const double *const found = all.data() + n_entries * i;
      if (found[is_found] == 0. || ++n > most_named)
        continue;
      std::ostringstream line; // with its own digits
      line << "Slack: body '" << bodies[i].name << "' first at t = " << found[time] << " s, at "
           << found[place] << " m of its length; ";
      const bool bends = found[bending_stiffness] > 0., is_damped = found[axial_damping] > 0.;
      if (bends)
        line << "its Bending stiffness of " << found[bending_stiffness] << " N m^2";
      if (bends && is_damped)
        line << " and ";
      if (is_damped)
        line << "its Axial damping of " << found[axial_damping] << " N s";
      if (bends || is_damped)
        line << (bends && is_damped ? " keep" : " keeps") << " it in shape";
      else
        line
            << "nothing but inertia keeps it in shape, neither Bending stiffness nor Axial damping";
      if (found[is_straight] > 0. && found[disturbance] > 0.)
        line << ". It is straight there: moved by " << found[disturbance]
             << " m across its line (Disturbance), it gives way";
      else if (found[is_straight] > 0.)
        line << ". It is straight there, and pushes, as its Disturbance is 0";
      log << line.str() << '\n';
    }
    if (n > most_named)
      log << "Slack: " << n - most_named << " bodies more\n";
  }
} // namespace taut
