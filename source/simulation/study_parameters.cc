// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/nearest_name.h"
#include "simulation/file_text.h"
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>
#include <taut/simulation/study_parameters.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace taut
{
  namespace
  {
    using namespace dealii::Patterns;

    bool is_positive_number(const std::string &text)
    {
      std::istringstream in(text);
      double value = 0.;
      return in >> value && in.eof() && std::isfinite(value) && value > 0.;
    }
  } // namespace

  void StudyParameters::ParameterListItem::declare(dealii::ParameterHandler &prm)
  {
    varied.declare(prm);
    prm.add_parameter("Refined", refined,
                      "Whether a smaller value is a finer model: the reference then starts from "
                      "the least value and halves it, together with those of the other refined "
                      "parameters");
    prm.add_parameter("Reference", reference,
                      "Value in the reference if it is not refined; empty: that of the scene",
                      Anything());
  }

  void StudyParameters::QuantityItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Of", of,
        "Name of a sliding contact or strip, another link, a probe or a support, with "
        "its number if it has several positions, or an item of an observer",
        Anything());
    prm.add_parameter(
        "Quantity", quantity,
        "Of a sliding contact: 'mean', 'standard deviation', 'maximum', 'minimum', 'contact "
        "loss', 'standard deviation over mean', 'mean + 3 standard deviations' (also -), of the "
        "filtered force in the window of the statistics, 'standard deviation 0 to 2 Hz' (also 0 to "
        "5, 5 to 20, 0 to 20), 'losses over "
        "5 ms' and 'share of losses over 5 ms' (also 10, 20), 'height range'; of a wire of a strip "
        "'mean share', 'largest share'. Of another link: 'open time', 'closed time', 'largest "
        "force', 'impulse', 'largest impulse'; of a dropper also 'smallest force', 'mean force', "
        "'standard deviation of the force', 'slackenings'. Of a probe: 'largest', 'smallest', "
        "'last'. Of a support, by its force in the window: 'smallest reaction', 'largest "
        "reaction', "
        "'mean reaction', and 'reaction at the start'. Of each: 'history', the root mean square "
        "over the run of the difference to the "
        "reference, of force or displacement",
        Anything());
    prm.add_parameter("Exact", exact,
                      "The exact value, a formula in t for a history; empty: from a reference "
                      "that is refined [the quantity's unit]",
                      Anything());
    prm.add_parameter("Scale", scale,
                      "Errors are relative to it; 0: to the reference, of a history to its root "
                      "mean square [the quantity's unit]",
                      Double(0., Double::max_double_value));
  }

  void StudyParameters::declare_names(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    parameter_list_items.declare_names(prm);
    quantities.declare_names(prm);
    prm.leave_subsection();
  }

  void StudyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Study");
    prm.add_parameter(
        "Folder", folder,
        "Where 'taut --study' and '--accuracy' write and where Accuracy looks for study.json; "
        "empty: the folder 'study' in that of the results",
        Anything());
    prm.add_parameter("Accuracy", accuracy,
                      "Largest relative error wanted of the quantities: the run takes the cheapest "
                      "setting of the stored study of this scene that has it; 0: as written [1]",
                      Double(0., 1.));
    prm.add_parameter("Accuracies", accuracies,
                      "Relative errors for which a study names the cheapest setting [1]",
                      List(Double(0., 1.)));
    prm.add_parameter("Repeats", repeats, "Runs of each setting; the fastest counts [1]",
                      Integer(1, 1000));
    prm.add_parameter("Reference levels", reference_levels,
                      "Most refinements of the reference; it ends earlier when its error is below "
                      "a tenth of the least of Accuracies [1]",
                      Integer(1, 20));
    prm.add_parameter("Budget", budget,
                      "Longest wall time that 'taut --accuracy' takes to find a setting [s]",
                      Double(0., Double::max_double_value));
    parameter_list_items.declare_parameters(prm);
    quantities.declare_parameters(prm);
    prm.leave_subsection();
  }

  std::vector<ParameterList>
  StudyParameters::parameter_lists(const std::map<std::string, std::string> &scene) const
  {
    // A study runs each value several times.
    constexpr std::size_t most_values = 10000;
    std::vector<ParameterList> result;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < parameter_list_items.names.size(); ++i)
    {
      const ParameterListItem &item = parameter_list_items.items[i];
      const std::string title = parameter_list_items.title(i);
      ParameterList parameter_list;
      parameter_list.name = parameter_list_items.names[i];
      parameter_list.entries = item.varied.paths(title, scene, taken);
      parameter_list.values = item.varied.value_list(title, most_values);
      parameter_list.refined = item.refined;
      if (parameter_list.refined)
        for (const std::string &value : parameter_list.values)
          if (!is_positive_number(value))
            throw EntryError(title + "/Values", "'" + value +
                                                    "' is no positive number, so it cannot be "
                                                    "halved; set Refined = false");
      parameter_list.reference =
          item.reference.empty() ? scene.at(parameter_list.entries[0]) : item.reference;
      result.push_back(parameter_list);
    }
    return result;
  }

  namespace
  {
    std::optional<double> number(const std::string &text)
    {
      double value = 0.;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
      return result.ec == std::errc() && result.ptr == text.data() + text.size() &&
                     std::isfinite(value)
                 ? std::optional<double>(value)
                 : std::nullopt;
    }

    /// A value, or all values of "first:step:last".
    std::vector<std::string> expanded(const std::string &text, const std::string &entry,
                                      const std::size_t most)
    {
      const std::vector<std::string> parts = split(text, ':');
      std::vector<double> numbers;
      for (const std::string &part : parts)
        if (const auto value = number(part))
          numbers.push_back(*value);
      if (parts.size() != 3 || numbers.size() != 3)
        return {text};
      const double n = (numbers[2] - numbers[0]) / numbers[1];
      constexpr double rounding = 1e-9;
      if (!(n >= -rounding) || !(n < most))
        throw EntryError(entry, "'" + text +
                                    "' never gets from its first to its last value, or "
                                    "has too many; write first:step:last");
      std::vector<std::string> values;
      for (std::size_t i = 0; i <= n + rounding; ++i)
        values.push_back(time_text(numbers[0] + i * numbers[1]));
      return values;
    }

    bool begins(const std::string &path, const std::string &head)
    {
      return path.compare(0, head.size(), head) == 0;
    }

    /// Whether an entry is about results or the use of the scene.
    bool is_outside_of_scene(const std::string &path)
    {
      return begins(path, "Study/") || begins(path, "Sweep/") ||
             (begins(path, "Output/") && !begins(path, "Output/Probe"));
    }
  } // namespace

  void VariedEntries::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    prm.add_parameter("Entries", entries,
                      "Paths of the entries that take each value together, 'Section/Entry', "
                      "separated by commas",
                      Anything());
    prm.add_parameter("Values", values,
                      "Separated by commas, or by semicolons if a value is itself a list; a range "
                      "is first:step:last, with its ends",
                      Anything());
  }

  std::vector<std::string> VariedEntries::paths(const std::string &title,
                                                const std::map<std::string, std::string> &scene,
                                                std::set<std::string> &taken) const
  {
    const std::string entry = title + "/Entries";
    const std::vector<std::string> paths = split(entries, ',');
    if (paths.empty())
      throw EntryError(entry, "name the entries that take the values");
    for (const std::string &path : paths)
    {
      if (scene.count(path) == 0)
      {
        std::vector<std::string> known;
        for (const auto &[name, value] : scene)
          known.push_back(name);
        throw EntryError(entry, "there is no entry '" + path +
                                    "'; write its sections and its name, 'Time/Step'" +
                                    suggestion(path, known));
      }
      if (is_outside_of_scene(path))
        throw EntryError(entry, "'" + path +
                                    "' is not part of the scene or of how it is solved; take "
                                    "another entry");
      if (!taken.insert(path).second)
        throw EntryError(entry,
                         "'" + path + "' is varied twice; remove it from one of the parameters");
    }
    return paths;
  }

  std::vector<std::string> VariedEntries::value_list(const std::string &title,
                                                     const std::size_t most) const
  {
    const std::string entry = title + "/Values";
    std::vector<std::string> list;
    for (const std::string &value :
         split(values, values.find(';') != std::string::npos ? ';' : ','))
      for (std::string &one : expanded(value, entry, most))
        list.push_back(std::move(one));
    if (list.empty() || std::count(list.begin(), list.end(), std::string()) > 0)
      throw EntryError(entry, "give one or more values, none of them empty");
    return list;
  }

  namespace
  {
    constexpr std::size_t most_cases = 10000000;

    /// Throws EntryError unless the range has one or more pairs that suit the distribution.
    void check_range(const SweepParameters::Item &item, const std::string &entry)
    {
      const bool is_uniform = item.distribution == "uniform";
      bool is_good = !item.range.empty() && item.range.size() % 2 == 0;
      for (std::size_t i = 0; is_good && i < item.range.size(); i += 2)
        is_good = item.range[i + 1] >= (is_uniform ? item.range[i] : 0.);
      if (!is_good)
        throw EntryError(
            entry, is_uniform ? "give the least and the largest value"
                              : "give the mean and a standard deviation that is not negative");
    }

    /// A random number for each pair of the range, separated by commas.
    std::string drawn(const SweepParameters::Item &item, boost::random::mt19937_64 &generator)
    {
      std::string text;
      for (std::size_t i = 0; i < item.range.size(); i += 2)
      {
        const double first = item.range[i], second = item.range[i + 1];
        const double value =
            item.distribution == "normal"
                ? boost::random::normal_distribution<double>(first, second)(generator)
                : boost::random::uniform_real_distribution<double>(
                      first, second > first ? second : std::nextafter(first, HUGE_VAL))(generator);
        text += (i > 0 ? ", " : "") + csv_number(value);
      }
      return text;
    }
  } // namespace

  void SweepParameters::Item::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    varied.declare(prm);
    prm.add_parameter("Distribution", distribution,
                      "'values': those of the list. 'uniform': drawn at random between the two "
                      "numbers of Range. 'normal': drawn with these as mean and standard deviation",
                      Selection("values|uniform|normal"));
    prm.add_parameter("Range", range,
                      "Least and largest value, or mean and standard deviation; for an entry that "
                      "is a list, two for each of its numbers [the entry's unit]",
                      List(Double()));
  }

  void SweepParameters::declare_names(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Sweep");
    items.declare_names(prm);
    prm.leave_subsection();
  }

  void SweepParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    declare_names(prm);
    prm.enter_subsection("Sweep");
    prm.add_parameter("Folder", folder,
                      "Where 'taut --sweep' writes sweep.csv; empty: the folder 'sweep' in that "
                      "of the results",
                      Anything());
    prm.add_parameter("Combination", combination,
                      "Of the lists of values: 'product', each with each, the first one fastest; "
                      "'zipped', the first values together, then the second ones, and so on",
                      Selection("product|zipped"));
    prm.add_parameter("Samples", samples,
                      "How often the parameters with a distribution are drawn, for each "
                      "combination of the others [1]",
                      Integer(0, static_cast<int>(most_cases)));
    prm.add_parameter("Seed", seed, "Of the random numbers [1]", Integer(0, 2147483647));
    items.declare_parameters(prm);
    prm.leave_subsection();
  }

  std::vector<SweptParameter>
  SweepParameters::parameters(const std::map<std::string, std::string> &scene) const
  {
    std::vector<SweptParameter> result;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < items.names.size(); ++i)
      result.push_back({items.names[i], items.items[i].varied.paths(items.title(i), scene, taken)});
    return result;
  }

  /// Values of each parameter; empty for random ones.
  std::vector<std::vector<std::string>> SweepParameters::value_lists() const
  {
    std::vector<std::vector<std::string>> lists;
    for (std::size_t i = 0; i < items.items.size(); ++i)
    {
      const Item &item = items.items[i];
      const std::string title = items.title(i);
      if (item.is_random())
      {
        check_range(item, title + "/Range");
        lists.emplace_back();
      }
      else
        lists.push_back(item.varied.value_list(title, most_cases));
    }
    return lists;
  }

  /// Bounded by most_cases + 1.
  std::size_t
  SweepParameters::n_combinations(const std::vector<std::vector<std::string>> &lists) const
  {
    std::size_t n = 1;
    bool is_first = true;
    for (std::size_t i = 0; i < lists.size(); ++i)
    {
      const std::size_t own = lists[i].size();
      if (items.items[i].is_random())
        continue;
      if (combination == "product")
        n = std::min(n * own, most_cases + 1);
      else if (!is_first && own != n)
        throw EntryError(items.title(i) + "/Values",
                         "it has " + std::to_string(own) + " values and the list before it " +
                             std::to_string(n) +
                             ": zipped lists are equally long. Add some, or set Combination = "
                             "product");
      else
        n = own;
      is_first = false;
    }
    return n;
  }

  /// Number of samples for each combination.
  std::size_t SweepParameters::n_samples() const
  {
    if (std::none_of(items.items.begin(), items.items.end(),
                     [](const Item &item) { return item.is_random(); }))
      return 1;
    if (samples == 0)
      throw EntryError("Sweep/Samples", "a parameter is drawn at random: say how often");
    return samples;
  }

  std::vector<std::vector<std::string>> SweepParameters::cases() const
  {
    const std::vector<std::vector<std::string>> lists = value_lists();
    const std::size_t n = n_combinations(lists), n_draws = n_samples();
    if (n > most_cases || n * n_draws > most_cases)
      throw EntryError("Sweep/Parameters", "they make more than " + std::to_string(most_cases) +
                                               " cases; take fewer values or samples");
    boost::random::mt19937_64 generator(seed);
    std::vector<std::vector<std::string>> result(n * n_draws);
    for (std::size_t c = 0; c < result.size(); ++c)
    {
      std::size_t rest = c / n_draws;
      for (std::size_t i = 0; i < lists.size(); ++i)
        if (items.items[i].is_random())
          result[c].push_back(drawn(items.items[i], generator));
        else if (combination == "zipped")
          result[c].push_back(lists[i][rest]);
        else
        {
          result[c].push_back(lists[i][rest % lists[i].size()]);
          rest /= lists[i].size();
        }
    }
    return result;
  }

  void ElasticityParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const double most = Double::max_double_value;
    prm.enter_subsection("Elasticity");
    prm.add_parameter("Force", force,
                      "'taut --elasticity': static force on the contact wire, upwards [N]",
                      Double(1e-6, most));
    prm.add_parameter("Spacing", spacing, "Of the places along the wire [m]", Double(1e-6, most));
    prm.add_parameter("Range", range, "First and last x; empty: all of each wire [m]",
                      List(Double(), 0, 2));
    prm.add_parameter("Slackening", slackening,
                      "Whether links open and close under the force; otherwise those that carry a "
                      "force at rest stay closed, and the elasticity is linear");
    prm.leave_subsection();
  }
} // namespace taut
