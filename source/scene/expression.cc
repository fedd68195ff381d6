// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/compiled_formula.h"
#include "scene/table_calls.h"

#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/scene/expression.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <regex>
#include <sstream>

namespace taut
{
  namespace
  {
    bool mentions(const std::string &formula, const std::string &word)
    {
      return std::regex_search(formula, std::regex("\\b" + word + "\\b"));
    }

    /// "Write a formula in s (...), e.g. '...'."
    std::string advice(const Expression::Variables variables)
    {
      const std::string s = "s (position along the wire [m])", t = "t (time [s])";
      switch (variables)
      {
      case Expression::Variables::position:
        return "Write a formula in " + s + ", e.g. '0.001*sin(2*pi*s/1.2)'.";
      case Expression::Variables::time:
        return "Write a formula in " + t + ", e.g. '0.02*sin(2*pi*t)'.";
      case Expression::Variables::elongation:
        return "Write a formula in d (elongation [m]), e.g. '1e4*d + 2e8*d^3'.";
      case Expression::Variables::space:
        return "Write a formula in x, y, z (a point [m]) and " + t + ", e.g. '1e5*x*sin(2*pi*t)'.";
      default:
        return "Write a formula in " + s + " and " + t + ", e.g. '120*sin(2*pi*t)'.";
      }
    }

    /// What tables of a formula may be of.
    std::vector<std::string> abscissae(const Expression::Variables variables)
    {
      switch (variables)
      {
      case Expression::Variables::position:
        return {"s"};
      case Expression::Variables::time:
        return {"t"};
      case Expression::Variables::elongation:
        return {"d"};
      case Expression::Variables::space:
        return {"x", "y", "z", "t"};
      default:
        return {"s", "t"};
      }
    }

    /// The fault of a formula of this entry; empty if there is none.
    std::string objection(const std::string &formula, const Expression::Variables variables)
    {
      if (std::regex_search(formula, std::regex("^[^()+*,]*\\.[A-Za-z]{2}[A-Za-z0-9]*$")))
        return "it looks like the name of a file; a column of a file is 'table(FILE.csv, column)'";
      for (const std::string random : {"rand", "rand_seed"})
        if (mentions(formula, random))
          return "'" + random +
                 "' is random: a formula is evaluated more than once at a time, and has to give "
                 "the same each time and in each run";
      if ((variables == Expression::Variables::position ||
           variables == Expression::Variables::elongation) &&
          mentions(formula, "t"))
        return "it does not depend on t";
      if (variables == Expression::Variables::time && mentions(formula, "s"))
        return "it does not depend on s";
      return "";
    }
  } // namespace

  Expression::Expression() = default;

  Expression::Expression(const double value) : constant(value)
  {
    text = to_text(std::setprecision(17), value);
  }

  Expression::Expression(const std::string &formula, const std::string &entry,
                         const Variables variables)
      : text(formula), entry(entry)
  {
    char *end = nullptr;
    constant = std::strtod(text.c_str(), &end);
    const bool is_number = end != text.c_str() &&
                           text.find_first_not_of(" \t", end - text.c_str()) == std::string::npos;
    if (is_number && std::isfinite(constant))
      return;

    const auto bad = [&](const std::string &reason)
    {
      return EntryError(entry,
                        "cannot evaluate '" + text + "': " + reason + ". " + advice(variables));
    };
    if (is_number)
      throw bad("the number is out of range");
    const TableCalls calls(text, abscissae(variables), entry);
    tables = calls.tables;
    const std::string wrong = objection(calls.formula, variables);
    if (!wrong.empty())
      throw bad(wrong);
    names = variables == Variables::space        ? std::vector<std::string>{"x", "y", "z", "t"}
            : variables == Variables::elongation ? std::vector<std::string>{"d", "t"}
                                                 : std::vector<std::string>{"s", "t"};
    try
    {
      compiled = std::make_shared<CompiledFormula>(calls.formula, names, tables);
    }
    catch (const std::exception &e)
    {
      throw bad(e.what());
    }
    time_dependent = mentions(calls.formula, "t");
    if (!calls.alone.empty())
      variable_alone =
          static_cast<int>(std::find(names.begin(), names.end(), calls.alone) - names.begin());
    if (!tables.empty())
    {
      varies = true;
      return;
    }
    constant = (*compiled)({});
    varies = !std::isfinite(constant) || // an error when it is evaluated
             std::any_of(names.begin(), names.end(),
                         [&](const std::string &name) { return mentions(text, name); });
  }

  double Expression::evaluate(const Coordinates &x, const double t) const
  {
    // A formula in s or d takes the first coordinate.
    const CompiledFormula::Values values = names.size() == 2
                                               ? CompiledFormula::Values{x.x, t}
                                               : CompiledFormula::Values{x.x, x.y, x.z, t};
    double value = 0.;
    try
    {
      value = variable_alone >= 0 ? (*tables.front())(values[variable_alone]) : (*compiled)(values);
    }
    catch (const TabulatedFunction::Outside &e)
    {
      throw EntryError(entry, "'" + text + "' has no value at " + place(values) + ": " + e.what() +
                                  ", or the formula may choose, e.g. 'condition ? a : b'");
    }
    if (!std::isfinite(value))
      fail(values);
    return value;
  }

  std::string Expression::content() const
  {
    std::string result = text;
    for (const auto &table : tables)
      result += " [" + table->content() + "]";
    return result;
  }

  /// "s = 3 m, t = 0.5 s"
  std::string Expression::place(const std::array<double, 4> &values) const
  {
    std::ostringstream out;
    const std::size_t n = names.size() - 1;
    for (std::size_t i = 0; i < n; ++i)
      out << names[i] << (i + 1 < n ? ", " : " = ");
    for (std::size_t i = 0; i < n; ++i)
      out << values[i] << (i + 1 < n ? ", " : " m, t = ");
    out << values[n] << " s";
    return out.str();
  }

  void Expression::fail(const std::array<double, 4> &values) const
  {
    throw EntryError(entry, "'" + text + "' is not finite at " + place(values) +
                                ". Restrict the formula to where it is defined, e.g. with "
                                "if(condition, a, b).");
  }
} // namespace taut
