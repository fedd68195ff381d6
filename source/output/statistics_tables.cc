// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables beside statistics.json, of the force in the window.
#include "base/write_file.h"
#include "output/signals.h"
#include <taut/output/contact_quantities.h>
#include <taut/output/statistics.h>
#include <taut/output/table_file.h>

namespace taut
{
  namespace
  {
    std::string histogram_text(const std::vector<double> &force, const double width)
    {
      std::string text = "from [N],to [N],samples [1],share [1],low-passed at [Hz] (0: not)\n";
      const Histogram all = histogram(force, width);
      for (std::size_t i = 0; i < all.number.size(); ++i)
        text += csv_number(all.begin + i * width) + "," + csv_number(all.begin + (i + 1) * width) +
                "," + csv_number(all.number[i]) + "," +
                csv_number(static_cast<double>(all.number[i]) / force.size()) + ",0\n";
      return text;
    }

    std::string spectrum_text(const std::vector<double> &force, const double step)
    {
      std::string text = "frequency [Hz],power spectral density [N^2/Hz]\n";
      const PowerSpectrum spectrum = power_spectrum(force, step);
      for (std::size_t i = 0; i < spectrum.frequency.size(); ++i)
        text += csv_number(spectrum.frequency[i]) + "," + csv_number(spectrum.density[i]) + "\n";
      return text;
    }
  } // namespace

  void Statistics::write_tables(const std::string &folder) const
  {
    for (const Contact &contact : contacts)
    {
      if (!(parameters.has_table("histogram") || parameters.has_table("spectrum")))
        break;
      const ContactRecord record = sum(contact).at_equal_steps(times);
      const std::vector<double> force = record.in_window(record.force, parameters);
      const std::string stem = folder + "/contact_" + contact.of.name;
      if (parameters.has_table("histogram"))
        write_file(stem + "_histogram.csv", histogram_text(force, parameters.class_width));
      if (parameters.has_table("spectrum") && record.force.size() > 1)
        write_file(stem + "_spectrum.csv", spectrum_text(force, (times.back() - times.front()) /
                                                                    (record.force.size() - 1)));
    }
    if (!parameters.has_table("cycles"))
      return;
    std::string text = "dropper,range [N],mean [N],count [1]\n";
    constexpr double rounding = 1e-9; // over the largest force
    for (const LinkQuantities &link : links)
      for (const LoadCycle &cycle : rainflow(link.dropper.reversals))
        if (cycle.range > rounding * link.dropper.largest)
          text += csv_cell(link.name) + "," + csv_number(cycle.range) + "," +
                  csv_number(cycle.mean) + "," + csv_number(cycle.count) + "\n";
    write_file(folder + "/dropper_cycles.csv", text);
  }
} // namespace taut
