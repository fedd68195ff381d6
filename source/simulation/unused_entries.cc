// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries without effect because of another entry: a run reports them.
#include "simulation/file_text.h"

#include "time/named_scheme.h"
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <functional>

namespace taut
{
  namespace
  {
    /// Value of another entry of the same section, or with "../" of that above; empty: no such
    /// entry.
    using ValueOf = std::function<std::string(const std::string &entry)>;

    /// Entries of sections whose paths begin alike, and why they have no effect; empty: they have.
    struct Rule
    {
      std::string section;
      std::vector<std::string> entries;
      std::function<std::string(const ValueOf &value, const std::string &start)> reason;
    };

    std::string without_given_start(const ValueOf &, const std::string &start)
    {
      return start == "given" ? "" : "without Start = given";
    }

    /// Another entry takes the place of these.
    std::function<std::string(const ValueOf &, const std::string &)>
    beside(const std::string &entry)
    {
      return [entry](const ValueOf &value, const std::string &)
      {
        const std::string given = value(entry);
        return given.empty() ? "" : "beside " + entry.substr(entry.rfind('/') + 1) + " = " + given;
      };
    }

    /// For a contact, unless its Obstacle is one of these.
    std::function<std::string(const ValueOf &, const std::string &)>
    unless_obstacle_is(const std::vector<std::string> &obstacles)
    {
      return [obstacles](const ValueOf &value, const std::string &)
      {
        const std::string obstacle = value("Obstacle");
        return std::find(obstacles.begin(), obstacles.end(), obstacle) != obstacles.end()
                   ? ""
                   : "with Obstacle = " + obstacle;
      };
    }

    const std::vector<Rule> &rules()
    {
      static const std::vector<Rule> all = {
          {"Body ",
           {"Velocity", "Angular velocity", "Start direction", "Initial velocity"},
           without_given_start},
          {"Network/Mass ", {"Initial displacement", "Initial velocity"}, without_given_start},
          {"Network/Wire ",
           {"Initial axial displacement", "Initial axial velocity",
            "Initial transverse displacement", "Initial transverse velocity",
            "Initial lateral displacement", "Initial lateral velocity"},
           without_given_start},
          {"Catenary",
           {"Number of spans", "Span length", "Span lengths", "Heights", "Stitch lengths",
            "Mid-points"},
           beside("Line")},
          {"Catenary/Droppers", {"Positions", "Pre-sag", "Lengths"}, beside("../Line")},
          {"Catenary/Contact wire", {"Stagger"}, beside("../Line")},
          {"Catenary/Messenger wire", {"Stagger"}, beside("../Line")},
          {"Catenary/Tension length ",
           {"Positions", "Pre-sag", "Lengths", "Stagger"},
           beside("../Line")},
          {"Catenary", {"Number of spans", "Span length"}, beside("Span lengths")},
          {"Contact ", {"Radius", "Encloses body"}, unless_obstacle_is({"cylinder", "sphere"})},
          {"Contact ", {"Height", "Height difference"}, unless_obstacle_is({"height"})},
          {"Contact ", {"Point"}, unless_obstacle_is({"plane", "cylinder", "sphere"})},
          {"Contact ", {"Direction"}, unless_obstacle_is({"plane", "cylinder", "height"})},
          {"Contact ", {"Method"}, unless_obstacle_is({"none"})}};
      return all;
    }

    /// Equal as texts or number by number.
    bool is_same(const std::string &a, const std::string &b)
    {
      const std::vector<std::string> p = split(a, ','), q = split(b, ',');
      const dealii::Patterns::Double number;
      return p.size() == q.size() &&
             std::equal(p.begin(), p.end(), q.begin(),
                        [&](const std::string &x, const std::string &y)
                        {
                          return x == y || (number.match(x) && number.match(y) &&
                                            dealii::Utilities::string_to_double(x) ==
                                                dealii::Utilities::string_to_double(y));
                        });
    }
  } // namespace

  std::vector<std::string>
  Parameters::unused_scheme_entries(const std::string &name,
                                    const std::map<std::string, std::string> &entries) const
  {
    std::vector<std::string> unused;
    for (const std::string &scheme : Registry<TimeIntegrator>::instance().list())
    {
      dealii::ParameterHandler prm;
      const auto integrator = Registry<TimeIntegrator>::instance().create(scheme);
      integrator->declare_parameters(prm);
      for (const auto &[path, value] : entries_below("Time/"))
      {
        if (!set_declared_entry(path, value, prm))
          continue;
        const auto other = entries.find(path);
        const bool has_part =
            scheme == name && (other == entries.end() || is_same(other->second, value));
        if (!has_part && !is_same(value, declared.defaults.at("Time/" + path)))
          unused.push_back("Time/" + path + " = " + value);
      }
    }
    return unused;
  }

  std::vector<std::string> Parameters::unused_entries() const
  {
    std::vector<std::string> unused;
    for (const auto &[path, value] : entry_values)
    {
      const std::size_t slash = path.rfind('/');
      if (slash == std::string::npos)
        continue;
      const std::string section = path.substr(0, slash), entry = path.substr(slash + 1);
      const ValueOf value_of = [&](const std::string &other)
      {
        const bool is_above = other.compare(0, 3, "../") == 0;
        const auto found =
            entry_values.find((is_above ? section.substr(0, section.rfind('/')) : section) + "/" +
                              (is_above ? other.substr(3) : other));
        return found == entry_values.end() ? std::string() : found->second;
      };
      for (const Rule &rule : rules())
      {
        if (section.compare(0, rule.section.size(), rule.section) != 0 ||
            std::find(rule.entries.begin(), rule.entries.end(), entry) == rule.entries.end() ||
            is_same(value, declared.defaults.at(path)))
          continue;
        const std::string reason = rule.reason(value_of, start);
        if (!reason.empty())
          unused.push_back(path + " = " + value + " (" + reason + ")");
      }
    }
    return unused;
  }
} // namespace taut
