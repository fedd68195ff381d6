// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/output/table_file.h>
#include <taut/simulation/sweep_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut
{
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
} // namespace taut
