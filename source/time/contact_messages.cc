// SPDX-License-Identifier: LGPL-2.1-or-later
// What the log says of the measures of contacts: warnings, the error and its remedy.
#include "base/text.h"
#include <taut/time/contact_measures.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace taut
{
  /// States the constraint, its energy and the duration of its contacts.
  std::string ContactMeasures::energy_message(const Summary &s) const
  {
    std::ostringstream out;
    out.precision(3);
    const bool took = s.taken > .5 * s.contact_energy;
    out << "unilateral links " << (took ? "took " : "gave ") << s.contact_energy << " J, "
        << s.relative_energy << " of the energy of what they are connected with, "
        << (took ? "which neither their springs nor their dampers account for"
                 : "where they can only take it")
        << ": most at '" << label(s.energy_constraint).name << "' between t = " << s.energy_begin
        << " and " << s.energy_end << " s";
    if (s.step > 0.)
      out << "; its shortest contact lasts " << s.contact_time << " s, " << s.contact_time / s.step
          << " steps";
    return out.str();
  }

  std::string ContactMeasures::remedy() const
  {
    if (!is_automatic)
      return "Set 'Time/Scheme' to 'automatic', or take a smaller step";
    return is_adaptive ? "Take a smaller Tolerance"
                       : "Take a smaller Step, or 'Step control = adaptive'";
  }

  std::string ContactMeasures::error() const
  {
    const Summary s = summary();
    const std::string wrong =
        s.relative_energy > wrong_energy ? energy_message(s)
        : s.relative_motion_energy > wrong_energy
            ? to_text("bodies that move by large amounts gained ", s.motion_energy, " J, ",
                      s.relative_motion_energy, " of the energy that moves, from nowhere")
            : "";
    return wrong.empty()
               ? ""
               : wrong + ". The motion is wrong. " + remedy() + ", or set 'Time/Allow energy gain'";
  }

  std::string ContactMeasures::error_origin() const
  {
    const Summary s = summary();
    return s.relative_energy > wrong_energy ? label(s.energy_constraint).origin : "";
  }

  std::vector<Warning> ContactMeasures::warnings() const
  {
    const Summary s = summary();
    std::vector<Warning> result;
    const auto add = [&](const std::string &kind, const double value, const double limit,
                         const double time, const auto &...parts) {
      result.push_back({kind, to_text(std::setprecision(3), parts...), value, limit, "1", time});
    };
    if (s.relative_energy > suspicious_energy)
      add("contact_energy", s.relative_energy, suspicious_energy,
          std::isfinite(s.energy_end) ? s.energy_end : s.energy_begin, energy_message(s), ". ",
          remedy());
    else if (s.relative_momentum > suspicious_momentum)
      add("contact_momentum", s.relative_momentum, suspicious_momentum, 0., "the impulse of '",
          label(s.momentum_constraint).name, "' may be off by ", 100. * s.relative_momentum,
          " % of the largest of a contact, by the energy that its contacts gave or took beside its "
          "spring and damper: the step does not resolve them. ",
          remedy());
    if (s.relative_motion_energy > suspicious_energy)
      add("motion_energy", s.relative_motion_energy, suspicious_energy, 0.,
          "bodies that move by large amounts gained ", s.motion_energy, " J from nowhere. ",
          remedy());
    if (s.drifting_row != no_link)
    {
      const bool turns = s.drift_is_rotation;
      const double gap = s.drifting_gap;
      result.push_back({"contact_gap",
                        to_text(std::setprecision(3), "'", label(s.drifting_row).name,
                                "' presses across a gap of ", gap, turns ? " rad" : " m",
                                ", or penetrates as far: more than the motion of two steps. Set "
                                "'Time/Scheme' to 'automatic', or 'Moreau-Jean/Conditions' to "
                                "'gaps then velocities'"),
                        gap, 0., turns ? "rad" : "m", 0.});
    }
    for (std::size_t i = 0; i < forces.size(); ++i)
      if (forces[i].end.force > pressed_at_end * forces[i].peak)
        result.push_back({"pressed_wire_end",
                          to_text(std::setprecision(3), "'", constraints[i].name,
                                  "' slid off the end of its wire at t = ", forces[i].end.time,
                                  " s while ", forces[i].end.force,
                                  " N pressed it: this force "
                                  "vanished within a step, and ",
                                  forces[i].end.energy,
                                  " J in its contact spring with it. Raise this end of the wire"),
                          forces[i].end.force, pressed_at_end * forces[i].peak, "N",
                          forces[i].end.time});
    if (s.resolution > unresolved)
      add("peak_over_mean", s.resolution, unresolved, 0., "the largest force of '",
          label(s.resolution_row).name, "', ", s.peak,
          " N, is an impulse over a step; its largest mean over ", s.mean_time, " s is ",
          s.mean_peak, " N: report that, or the impulse, or set 'Time/Mass redistribution'");
    return result;
  }

  std::string ContactMeasures::report() const
  {
    const Summary s = summary();
    std::ostringstream out;
    out.precision(2);
    if (energy.has_large_motions())
      out << "Large motions: gain of energy " << s.relative_motion_energy << " of the largest\n";
    if (constraints.n_of_all() > 0)
      out << "Contacts: energy " << s.relative_energy << " of the largest, gap " << s.gap
          << " m, peak over mean " << s.resolution << '\n';
    return out.str();
  }
} // namespace taut
