// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/nearest_name.h>
#include <taut/output/csv_file.h>
#include <taut/simulation/sweep_parameters.h>
#include <taut/simulation/text_lists.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

namespace taut
{
  namespace
  {
    constexpr std::size_t most_cases = 10000000;

    std::optional<double> number(const std::string &text)
    {
      double value = 0.;
      const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
      return result.ec == std::errc() && result.ptr == text.data() + text.size() &&
                     std::isfinite(value)
                 ? std::optional<double>(value)
                 : std::nullopt;
    }

    /// A value, or all of "first:step:last".
    std::vector<std::string> expanded(const std::string &text, const std::string &entry)
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
      if (!(n >= -rounding) || !(n < most_cases))
        throw EntryError(entry, "'" + text +
                                    "' never gets from its first to its last value, or "
                                    "has too many; write first:step:last");
      std::vector<std::string> values;
      for (std::size_t i = 0; i <= n + rounding; ++i)
        values.push_back(time_text(numbers[0] + i * numbers[1]));
      return values;
    }
  } // namespace

  void SweepParameters::Item::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Entries", entries,
                      "Paths of the entries that take each value together, 'Section/Entry', "
                      "separated by commas",
                      Anything());
    prm.add_parameter("Values", values,
                      "Separated by commas, or by semicolons if a value is itself a list; a range "
                      "is first:step:last, with its ends",
                      Anything());
    prm.add_parameter("Distribution", distribution,
                      "'values': those of the list. 'uniform': drawn at random between the two "
                      "numbers of Range. 'normal': drawn with these as mean and standard deviation",
                      Selection("values|uniform|normal"));
    prm.add_parameter("Range", range,
                      "Least and largest value, or mean and standard deviation [the entry's unit]",
                      List(Double(), 0, 2));
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
    std::vector<std::string> known;
    for (const auto &[path, value] : scene)
      known.push_back(path);
    std::vector<SweptParameter> result;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < items.names.size(); ++i)
    {
      const std::string entry = items.title(i) + "/Entries";
      SweptParameter swept{items.names[i], split(items.items[i].entries, ',')};
      if (swept.entries.empty())
        throw EntryError(entry, "name the entries that take the values");
      for (const std::string &path : swept.entries)
      {
        if (scene.count(path) == 0)
          throw EntryError(entry, "there is no entry '" + path +
                                      "'; write its sections and its name, 'Time/Step'" +
                                      suggestion(path, known));
        for (const char *section : {"Study/", "Sweep/", "Output/Folder"})
          if (path.compare(0, std::string(section).size(), section) == 0)
            throw EntryError(entry, "'" + path +
                                        "' is not part of the scene or of how it is "
                                        "solved; take another entry");
        if (!taken.insert(path).second)
          throw EntryError(entry, "'" + path +
                                      "' is varied twice; remove it from one of the "
                                      "parameters");
      }
      result.push_back(std::move(swept));
    }
    return result;
  }

  std::vector<std::vector<std::string>> SweepParameters::cases() const
  {
    const std::size_t n_items = items.items.size();
    std::vector<std::vector<std::string>> lists(n_items);
    bool has_random = false;
    std::size_t n_combinations = 1, zipped = 0;
    for (std::size_t i = 0; i < n_items; ++i)
    {
      const Item &item = items.items[i];
      const std::string title = items.title(i);
      if (item.distribution != "values")
      {
        has_random = true;
        if (item.range.size() != 2 ||
            !(item.range[1] >= (item.distribution == "uniform" ? item.range[0] : 0.)))
          throw EntryError(title + "/Range",
                           item.distribution == "uniform"
                               ? "give the least and the largest value"
                               : "give the mean and a standard deviation that is not negative");
        continue;
      }
      for (const std::string &value :
           split(item.values, item.values.find(';') != std::string::npos ? ';' : ','))
        for (const std::string &one : expanded(value, title + "/Values"))
          lists[i].push_back(one);
      if (lists[i].empty() || std::count(lists[i].begin(), lists[i].end(), std::string()) > 0)
        throw EntryError(title + "/Values", "give one or more values, none of them empty");
      if (combination == "product")
        n_combinations = std::min(n_combinations * lists[i].size(), most_cases + 1);
      else if (zipped != 0 && lists[i].size() != zipped)
        throw EntryError(title + "/Values",
                         "it has " + std::to_string(lists[i].size()) +
                             " values and the list "
                             "before it " +
                             std::to_string(zipped) +
                             ": zipped lists are equally long. Add some, or set Combination = "
                             "product");
      else
        n_combinations = zipped = lists[i].size();
    }
    if (has_random && samples == 0)
      throw EntryError("Sweep/Samples", "a parameter is drawn at random: say how often");
    const std::size_t n_samples = has_random ? samples : 1;
    if (n_combinations > most_cases || n_combinations * n_samples > most_cases)
      throw EntryError("Sweep/Parameters", "they make more than " + std::to_string(most_cases) +
                                               " cases; take fewer values or samples");

    boost::random::mt19937_64 generator(seed);
    std::vector<std::vector<std::string>> result;
    for (std::size_t c = 0; c < n_combinations * n_samples; ++c)
    {
      std::vector<std::string> values;
      std::size_t rest = c / n_samples;
      for (std::size_t i = 0; i < n_items; ++i)
      {
        const Item &item = items.items[i];
        if (item.distribution == "uniform")
          values.push_back(csv_number(boost::random::uniform_real_distribution<double>(
              item.range[0], item.range[1] > item.range[0]
                                 ? item.range[1]
                                 : std::nextafter(item.range[0], HUGE_VAL))(generator)));
        else if (item.distribution == "normal")
          values.push_back(csv_number(
              boost::random::normal_distribution<double>(item.range[0], item.range[1])(generator)));
        else if (combination == "zipped")
          values.push_back(lists[i][rest]);
        else
        {
          values.push_back(lists[i][rest % lists[i].size()]);
          rest /= lists[i].size();
        }
      }
      result.push_back(std::move(values));
    }
    return result;
  }
} // namespace taut
