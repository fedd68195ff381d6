// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: the figures of EN 50318:2002 converge when time step and elements are halved together.
// Source: the finest runs. Prints the tables in Markdown.
#include <taut/base/exceptions.h>
#include <taut/simulation/parameters.h>
#include <taut/simulation/simulation.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{
  constexpr std::size_t n_figures = 8;
  using Figures = std::array<double, n_figures>;

  /// Columns of the tables, and the entries of "Expected ranges" that go with them.
  const char *const heads[n_figures] = {"mean N", "s N",   "mean+3s N", "mean-3s N",
                                        "max N",  "min N", "uplift mm", "loss %"};
  const std::string entries[] = {"Mean",
                                 "Standard deviation",
                                 "Mean + 3 standard deviations",
                                 "Mean - 3 standard deviations",
                                 "Maximum",
                                 "Minimum",
                                 "Uplift",
                                 "Contact loss"};

  /// A pantograph on a line.
  struct Case
  {
    std::string name, file;
    std::size_t contact; ///< counts the sliding contacts of the file
    Figures target;      ///< largest error of a converged value
    Figures converged;   ///< what earlier refinements found
  };

  Case case_of(const std::string &name, const std::string &file, const std::size_t contact,
               const double of_largest, const double of_loss, const Figures &converged)
  {
    return {name, file, contact, {.3, .5, 1.8, 1.8, of_largest, 2., .5, of_loss}, converged};
  }

  const Case cases[] = {case_of("250", "en50318_2002_250.prm", 0, 2., .1,
                                {116.86, 30.86, 209.45, 24.27, 192.6, 55.61, 54.36, 0.}),
                        case_of("300", "en50318_2002_300.prm", 0, 2., .1,
                                {115.84, 36.72, 226., 5.69, 206., 43.37, 62.56, 0.}),
                        case_of("leading", "en50318_2002_250_two.prm", 0, 2., .1,
                                {115.71, 30.42, 206.95, 24.46, 185.8, 58.23, 53.66, 0.}),
                        case_of("trailing", "en50318_2002_250_two.prm", 1, 2., .2,
                                {116.97, 54.2, 279.6, -45.64, 235.3, -10.2, 53.66, 2.89}),
                        case_of("space", "en50318_in_space.prm", 0, 3., .1,
                                {116.71, 30.6, 208.49, 24.92, 188.01, 52.11, 55.16, 0.})};

  struct Level
  {
    double step, size; ///< [s], [m]
  };

  /// Counts how often the unilateral fixed links open or close.
  class Switches : public taut::Observer
  {
  public:
    void record(const taut::StepView &step) override
    {
      const std::vector<double> &N = step.state.multiplier;
      for (std::size_t i = 0; i < last.size(); ++i)
        if (step.constraints[i].cone.may_open() && !step.constraints.slides(i))
          count += (N[i] == 0.) != (last[i] == 0.);
      last = N;
    }
    long count = 0;

  private:
    std::vector<double> last;
  };

  struct Run
  {
    std::vector<Figures> figures; ///< by sliding contact
    long n_switches = 0;
    double seconds = 0.;
    std::map<std::string, std::vector<double>> expected;
  };

  Run run(const std::string &file, const std::string &scheme, const Level &level,
          const std::string &folder, std::vector<std::string> overrides)
  {
    const auto set = [&](const std::string &entry, const auto &value)
    {
      std::ostringstream text;
      text << entry << '=' << std::setprecision(15) << value;
      overrides.push_back(text.str());
    };
    set("Time.Scheme", scheme);
    set("Time.Step", level.step);
    set("Catenary.Contact wire.Element size", level.size);
    set("Catenary.Messenger wire.Element size", level.size);
    set("Output.Folder", folder);
    set("Output.Interval", 1e9);
    set("Output.Link interval", 1e9);
    set("Output.Field interval", 0);

    const auto begin = std::chrono::steady_clock::now();
    taut::Parameters parameters;
    parameters.read(file, overrides);
    parameters.output.overwrite = true;
    std::ostringstream log;
    taut::Simulation simulation(parameters, log);
    Switches switches;
    simulation.observe(switches);
    simulation.run();

    const taut::Statistics &statistics = simulation.statistics();
    Run result;
    double uplift = 0.;
    for (std::size_t i = 0; i < simulation.scene().probes.size(); ++i)
      uplift = std::max(uplift, 1e3 * statistics.largest_displacement(i));
    for (std::size_t i = 0; i < statistics.n_contacts(); ++i)
    {
      const auto f = statistics.contact_quantities(i);
      const taut::Moments &m = f.filtered;
      result.figures.push_back({m.mean, m.deviation, m.mean + 3. * m.deviation,
                                m.mean - 3. * m.deviation, m.maximum, m.minimum, uplift,
                                100. * f.loss});
    }
    result.n_switches = switches.count;
    result.expected = parameters.statistics.expected;
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

  struct Estimate
  {
    double value, error;
    double order; ///< observed; not a number: the last changes do not fall like a power
  };

  /**
   * The limit of a sequence whose parameters are halved from one entry to the next. If the last two
   * changes have one sign and fall at least like order 1/2: Richardson's, with the observed order,
   * at most 2. Its error is the largest of the correction, the last change, and what order 2 would
   * have left of the change before it: a last change that is much smaller is two errors that
   * cancel, that of the step and that of the elements. Otherwise the last value, and the error is
   * the spread of the last three.
   */
  Estimate extrapolate(const std::vector<double> &f)
  {
    const std::size_t n = f.size();
    Estimate e = {f.back(), 0., std::numeric_limits<double>::quiet_NaN()};
    if (n < 2)
      return {f.back(), std::numeric_limits<double>::infinity(), e.order};
    const double last = f[n - 1] - f[n - 2];
    if (n == 2)
      return {f.back(), std::fabs(last), e.order};
    const double before = f[n - 2] - f[n - 3];
    const double order = std::log2(before / last);
    if (before * last > 0. && order >= .5)
    {
      const double correction = last / (std::exp2(std::min(order, 2.)) - 1.);
      return {f.back() + correction,
              std::max({std::fabs(last), std::fabs(correction), std::fabs(before) / 4.}), order};
    }
    const auto range = std::minmax_element(f.end() - 3, f.end());
    e.error = *range.second - *range.first;
    return e;
  }

  /// Collects what does not hold.
  class Claims
  {
  public:
    void check(const bool holds, const std::string &claim)
    {
      ++n;
      if (!holds)
        failed.push_back(claim);
    }
    int report() const
    {
      for (const std::string &claim : failed)
        std::cout << "FAILED: " << claim << '\n';
      std::cout << n - failed.size() << " of " << n << " claims hold\n";
      return failed.empty() ? 0 : 1;
    }

  private:
    std::size_t n = 0;
    std::vector<std::string> failed;
  };

  std::string number(const double x, const int digits)
  {
    std::ostringstream text;
    // No minus before zeros.
    text << std::fixed << std::setprecision(digits)
         << (std::fabs(x) < .5 * std::pow(10., -digits) ? 0. : x);
    return text.str();
  }

  /// A line of a table: a cell of each figure, and more at its end.
  void print_row(const std::string &first, const std::function<std::string(std::size_t)> &cell,
                 const std::string &more = " | ")
  {
    std::cout << "| " << first;
    for (std::size_t i = 0; i < n_figures; ++i)
      std::cout << " | " << cell(i);
    std::cout << " | " << more << " |\n";
  }

  /// The refinement of one scheme for one pantograph, and its limit.
  struct Refinement
  {
    std::vector<Figures> figures;
    std::array<Estimate, n_figures> limit;
  };

  Refinement print_ladder(const std::string &scheme, const std::size_t contact,
                          const std::vector<Level> &levels, const std::vector<Run> &runs)
  {
    Refinement refinement;
    for (std::size_t l = 0; l < runs.size(); ++l)
    {
      const Figures &now = runs[l].figures[contact];
      refinement.figures.push_back(now);
      std::ostringstream first;
      first << scheme << ", " << 1e3 * levels[l].step << " ms, " << levels[l].size << " m";
      print_row(
          first.str(), [&](const std::size_t i) { return number(now[i], 3); },
          std::to_string(runs[l].n_switches) + " | " + number(runs[l].seconds, 0));
    }
    for (std::size_t l = 1; l < runs.size(); ++l)
      print_row("change " + std::to_string(l),
                [&](const std::size_t i)
                {
                  const double change = refinement.figures[l][i] - refinement.figures[l - 1][i];
                  return (change >= 5e-4 ? "+" : "") + number(change, 3);
                });
    for (std::size_t i = 0; i < n_figures; ++i)
    {
      std::vector<double> f;
      for (const Figures &figures : refinement.figures)
        f.push_back(figures[i]);
      refinement.limit[i] = extrapolate(f);
    }
    const auto &limit = refinement.limit;
    print_row("observed order", [&](const std::size_t i)
              { return std::isnan(limit[i].order) ? "-" : number(limit[i].order, 1); });
    print_row("limit", [&](const std::size_t i)
              { return "**" + number(limit[i].value, 3) + "** +- " + number(limit[i].error, 3); });
    return refinement;
  }

  /// The limit of the first scheme, its error no less than the distance to the second's limit; how
  /// far the levels of the others are from it.
  void print_comparison(const Refinement *a, const Refinement *b, const Refinement *first,
                        const std::vector<Level> &levels)
  {
    if (a != nullptr && b != nullptr)
      print_row("converged",
                [&](const std::size_t i)
                {
                  const Estimate &x = a->limit[i], &y = b->limit[i];
                  return "**" + number(x.value, 2) + "** +- " +
                         number(std::max(x.error, std::fabs(x.value - y.value)), 2);
                });
    for (std::size_t l = 0; a != nullptr && first != nullptr && l < levels.size(); ++l)
    {
      std::ostringstream step;
      step << "backward Euler's deviation, " << 1e3 * levels[l].step << " ms";
      print_row(step.str(), [&](const std::size_t i)
                { return number(first->figures[l][i] - a->limit[i].value, 2); });
    }
  }

  void print_ranges(const std::map<std::string, std::vector<double>> &expected)
  {
    print_row("range of the standard",
              [&](const std::size_t i)
              {
                const auto range = expected.find(entries[i]);
                std::ostringstream text;
                if (range != expected.end() && range->second.size() == 2)
                  text << range->second[0] << " to " << range->second[1];
                return text.str();
              });
  }

  /**
   * Each change is smaller than the one before it, or below a tenth of the target. The BDF2 of the
   * coarsest levels damps visibly, so its claim is for the last change only.
   */
  void check_changes(const Case &c, const std::string &scheme, const Refinement &refinement,
                     Claims &claims)
  {
    const std::size_t n = refinement.figures.size();
    for (std::size_t i = 0; i < n_figures; ++i)
      for (std::size_t l = scheme == "generalised-alpha" ? 2 : std::max<std::size_t>(n - 1, 2);
           l < n; ++l)
      {
        const double before =
                         std::fabs(refinement.figures[l - 1][i] - refinement.figures[l - 2][i]),
                     last = std::fabs(refinement.figures[l][i] - refinement.figures[l - 1][i]);
        claims.check(last < before || last <= .1 * c.target[i],
                     c.name + ", " + scheme + ": " + heads[i] + " changes by " + number(before, 4) +
                         ", then by " + number(last, 4));
      }
  }

  void check_limit(const Case &c, const std::string &scheme, const Refinement &refinement,
                   Claims &claims)
  {
    for (std::size_t i = 0; i < n_figures; ++i)
    {
      const Estimate &e = refinement.limit[i];
      const std::string what = c.name + ", " + scheme + ": " + heads[i] + " " + number(e.value, 3) +
                               " +- " + number(e.error, 3);
      claims.check(e.error <= c.target[i], what + ", target " + number(c.target[i], 2));
      claims.check(std::fabs(e.value - c.converged[i]) <= c.target[i],
                   what + ", converged value " + number(c.converged[i], 3));
    }
  }

  void check_agreement(const Case &c, const Refinement &a, const Refinement &b, Claims &claims)
  {
    for (std::size_t i = 0; i < n_figures; ++i)
      for (const auto &[x, y] : {std::make_pair(a.figures.back()[i], b.figures.back()[i]),
                                 std::make_pair(a.limit[i].value, b.limit[i].value)})
        claims.check(std::fabs(x - y) <= c.target[i], c.name + ": " + heads[i] +
                                                          " of two schemes " + number(x, 3) +
                                                          " and " + number(y, 3));
  }

  /// The deviation of a first-order scheme's standard deviation from the limit falls at each level.
  void check_first_order(const Case &c, const Refinement &first, const Refinement &reference,
                         Claims &claims)
  {
    const double limit = reference.limit[1].value;
    for (std::size_t l = 1; l < first.figures.size(); ++l)
    {
      const double before = std::fabs(first.figures[l - 1][1] - limit),
                   now = std::fabs(first.figures[l][1] - limit);
      claims.check(now < .75 * before, c.name + ", backward Euler: deviation of s from the limit " +
                                           number(before, 3) + ", then " + number(now, 3));
    }
  }

  Level level(const std::string &text)
  {
    std::istringstream in(text);
    Level l{};
    char colon = 0;
    if (!(in >> l.step >> colon >> l.size) || colon != ':')
      throw taut::UserError("a level is written step:size, e.g. 1e-3:0.5");
    return l;
  }
} // namespace

int main(int argc, char **argv)
{
  namespace po = boost::program_options;
  using Strings = std::vector<std::string>;
  po::options_description options("Options");
  options.add_options()("help,h", "print this text")("prm", po::value<std::string>()->required(),
                                                     "folder of the parameter files")(
      "case",
      po::value<Strings>()->multitoken()->default_value(
          {"250", "300", "leading", "trailing", "space"}, "all"),
      "250, 300, leading, trailing, space")(
      "level",
      po::value<Strings>()->multitoken()->default_value(
          {"1e-3:0.5", "5e-4:0.25", "2.5e-4:0.125", "1.25e-4:0.0625"}, "four, from 1e-3:0.5"),
      "steps [s] and element sizes [m], each half of the one before")(
      "scheme",
      po::value<Strings>()->multitoken()->default_value(
          {"generalised-alpha", "BDF2", "backward Euler"},
          "generalised-alpha BDF2 'backward Euler'"),
      "time integration")("set", po::value<Strings>()->composing()->default_value({}, ""),
                          "changes of the parameter files, as of the program taut")(
      "folder", po::value<std::string>()->default_value("en50318_convergence"),
      "where the results of the runs go")("tables-only", "check no claims");
  try
  {
    po::variables_map arguments;
    po::store(po::parse_command_line(argc, argv, options), arguments);
    if (arguments.count("help"))
    {
      std::cout << options;
      return 0;
    }
    po::notify(arguments);
    std::vector<Level> levels;
    for (const std::string &text : arguments["level"].as<Strings>())
      levels.push_back(level(text));
    const Strings names = arguments["case"].as<Strings>(),
                  schemes = arguments["scheme"].as<Strings>();

    Claims claims;
    std::map<std::string, std::vector<Run>> done; // the two pantographs of one line share the runs
    for (const Case &c : cases)
    {
      if (std::find(names.begin(), names.end(), c.name) == names.end())
        continue;
      std::map<std::string, Refinement> refinements;
      std::cout << "\n### " << c.name << " (" << c.file << ")\n\n";
      print_row(
          "scheme, step, elements", [](const std::size_t i) { return heads[i]; }, "switches | s");
      print_row(
          "---", [](std::size_t) { return "---"; }, "--- | ---");
      for (const std::string &scheme : schemes)
      {
        std::vector<Run> &runs = done[c.file + scheme];
        for (std::size_t l = runs.size(); l < levels.size(); ++l)
          runs.push_back(run(arguments["prm"].as<std::string>() + "/" + c.file, scheme, levels[l],
                             arguments["folder"].as<std::string>(),
                             arguments["set"].as<Strings>()));
        refinements[scheme] = print_ladder(scheme, c.contact, levels, runs);
        std::cout << std::flush;
      }
      const auto find = [&](const std::string &scheme)
      { return refinements.count(scheme) > 0 ? &refinements[scheme] : nullptr; };
      const Refinement *const a = find("generalised-alpha"), *const b = find("BDF2"),
                              *const first = find("backward Euler");
      print_comparison(a, b, first, levels);
      print_ranges(done[c.file + schemes.front()].front().expected);
      if (arguments.count("tables-only"))
        continue;
      for (const auto &[scheme, refinement] : refinements)
        if (scheme != "backward Euler")
        {
          check_changes(c, scheme, refinement, claims);
          check_limit(c, scheme, refinement, claims);
        }
      if (a != nullptr && b != nullptr)
        check_agreement(c, *a, *b, claims);
      if (a != nullptr && first != nullptr)
        check_first_order(c, *first, *a, claims);
    }
    std::cout << '\n';
    return arguments.count("tables-only") ? 0 : claims.report();
  }
  catch (const std::exception &e)
  {
    std::cerr << "en50318_convergence: " << e.what() << '\n';
  }
  return 2;
}
