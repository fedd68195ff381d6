// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "scene/compiled_formula.h"
#include "scene/formula_terms.h"
#include "scene/tabulated_function.h"
#include <taut/base/exceptions.h>
#include <taut/scene/expression.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace taut
{
  /// A formula with functions table_0(s), table_1(t), ... in the place of its calls
  /// 'table(FILE.csv, column, s, cubic)'.
  struct TableCalls
  {
    /// A formula without tables stays as it is. @p variables are what the formula may depend on;
    /// the word for one of them may be left out if there is one only. Throws EntryError on @p
    /// entry.
    TableCalls(const std::string &formula, const std::vector<std::string> &variables,
               const std::string &entry);

    std::string formula;
    std::vector<std::shared_ptr<const TabulatedFunction>> tables;
    std::string alone; ///< variable of a formula that is one table and nothing else; or empty
  };

  namespace
  {
    /// What stands in the brackets of 'table(...)'.
    struct Call
    {
      std::string variable;
      std::shared_ptr<const TabulatedFunction> table;
    };

    std::string join(const std::vector<std::string> &words)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : ", ") + word;
      return text;
    }

    Call make_call(const std::string &arguments, const std::vector<std::string> &variables,
                   const std::string &entry)
    {
      const std::string call = "'table(" + arguments + ")'";
      const std::vector<std::string> words = split(arguments, ',');
      if (words.size() < 2 || words[0].empty() || words[1].empty())
        throw EntryError(entry, call + " does not name a file and a column; write "
                                       "table(FILE.csv, column)");
      Call result;
      if (variables.size() == 1)
        result.variable = variables.front();
      Interpolation kind = Interpolation::linear;
      static const std::regex with_offset("(\\w+)\\s*([+-]\\s*[0-9.]+(?:[eE][+-]?[0-9]+)?)?");
      std::smatch parts;
      for (std::size_t i = 2; i < words.size(); ++i)
        if (words[i] == "cubic")
          kind = Interpolation::cubic;
        else if (std::regex_match(words[i], parts, with_offset) &&
                 std::find(variables.begin(), variables.end(), parts.str(1)) != variables.end())
          result.variable = words[i];
        else
          throw EntryError(entry, call + ": '" + words[i] +
                                      "' is no word for a table here; after file and column come " +
                                      join(variables) + " (its abscissa) or cubic");
      if (result.variable.empty())
        throw EntryError(entry, call + " does not say what its first column is: one of " +
                                    join(variables) + ", as in table(" + words[0] + ", " +
                                    words[1] + ", " + variables.back() + ")");
      result.table = shared_table(words[0], words[1], kind, entry);
      return result;
    }

    /// Behind the bracket that closes the one in front of @p begin.
    std::size_t end_of_call(const std::string &text, const std::size_t begin,
                            const std::string &entry)
    {
      int depth = 1;
      for (std::size_t i = begin; i < text.size(); ++i)
        if ((depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0) == 0)
          return i + 1;
      throw EntryError(entry, "the bracket of 'table(' in '" + text + "' is never closed");
    }
  } // namespace

  TableCalls::TableCalls(const std::string &text, const std::vector<std::string> &variables,
                         const std::string &entry)
  {
    static const std::regex opening("\\btable\\s*\\(");
    std::size_t at = 0;
    for (std::smatch match; std::regex_search(text.begin() + at, text.end(), match, opening);)
    {
      const std::size_t found = at + match.position(), begin = found + match.length(),
                        end = end_of_call(text, begin, entry);
      const Call call = make_call(text.substr(begin, end - 1 - begin), variables, entry);
      const bool is_all = trim(text.substr(0, found) + text.substr(end)).empty();
      const bool is_variable = std::find(variables.begin(), variables.end(), call.variable) !=
                               variables.end(); // without an offset
      alone = is_all && is_variable ? call.variable : "";
      formula += text.substr(at, found - at) + "table_" + std::to_string(tables.size()) + "(" +
                 call.variable + ")";
      tables.push_back(call.table);
      at = end;
    }
    formula += text.substr(at);
  }

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

  /// What is written, and what it means.
  struct Expression::Text
  {
    std::string formula, entry;
    std::shared_ptr<const std::string> whole = {};  ///< what it is a part of; null: nothing
    std::shared_ptr<CompiledFormula> compiled = {}; ///< null for a number
    std::vector<std::shared_ptr<const TabulatedFunction>> tables = {};
    int variable_alone = -1;             ///< of a formula that is a table; -1 for others
    std::vector<std::string> names = {}; ///< of its variables, the last is t
    bool depends_on_time = false;

    /// What messages quote.
    const std::string &written() const { return whole ? *whole : formula; }

    /// "s = 3 m, t = 0.5 s"
    std::string place(const CompiledFormula::Values &values) const
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

    [[noreturn]] void fail(const CompiledFormula::Values &values) const
    {
      throw EntryError(entry, "'" + written() + "' is not finite at " + place(values) +
                                  ". Restrict the formula to where it is defined, e.g. with "
                                  "if(condition, a, b).");
    }
  };

  Expression::Expression() = default;

  Expression::Expression(const double value)
      : text(std::make_shared<const Text>(Text{to_text(std::setprecision(17), value), ""})),
        constant(value)
  {
  }

  Expression::Expression(const std::string &formula, const std::string &entry,
                         const Variables variables)
  {
    const auto own = std::make_shared<Text>(Text{formula, entry});
    parse(*own, variables);
    text = own;
  }

  Expression::Expression(const std::string &formula, const Expression &whole)
  {
    const auto own = std::make_shared<Text>(Text{formula, whole.text->entry, whole.text->whole});
    if (!own->whole)
      own->whole = std::shared_ptr<const std::string>(whole.text, &whole.text->formula);
    parse(*own, Variables::both);
    text = own;
  }

  void Expression::parse(Text &own, const Variables variables)
  {
    const std::string &formula = own.formula;
    char *end = nullptr;
    constant = std::strtod(formula.c_str(), &end);
    is_number = end != formula.c_str() &&
                formula.find_first_not_of(" \t", end - formula.c_str()) == std::string::npos;
    if (is_number && std::isfinite(constant))
      return;

    const auto bad = [&](const std::string &reason)
    {
      return EntryError(own.entry, "cannot evaluate '" + own.written() + "': " + reason + ". " +
                                       advice(variables));
    };
    if (is_number)
      throw bad("the number is out of range");
    const TableCalls calls(formula, abscissae(variables), own.entry);
    own.tables = calls.tables;
    const std::string wrong = objection(calls.formula, variables);
    if (!wrong.empty())
      throw bad(wrong);
    std::vector<std::string> &names = own.names;
    names = variables == Variables::space        ? std::vector<std::string>{"x", "y", "z", "t"}
            : variables == Variables::elongation ? std::vector<std::string>{"d", "t"}
                                                 : std::vector<std::string>{"s", "t"};
    try
    {
      own.compiled = std::make_shared<CompiledFormula>(calls.formula, names, own.tables);
    }
    catch (const std::exception &e)
    {
      throw bad(e.what());
    }
    own.depends_on_time = mentions(calls.formula, "t");
    if (!calls.alone.empty())
      own.variable_alone =
          static_cast<int>(std::find(names.begin(), names.end(), calls.alone) - names.begin());
    if (!own.tables.empty())
    {
      varies = true;
      return;
    }
    constant = (*own.compiled)({});
    varies = !std::isfinite(constant) || // an error when it is evaluated
             std::any_of(names.begin(), names.end(),
                         [&](const std::string &name) { return mentions(formula, name); });
  }

  const std::string &Expression::formula() const
  {
    static const std::string zero = "0";
    return text ? text->formula : zero;
  }

  bool Expression::depends_on_time() const
  {
    return text && text->depends_on_time;
  }

  double Expression::evaluate(const Coordinates &x, const double t) const
  {
    // A formula in s or d takes the first coordinate.
    const CompiledFormula::Values values = text->names.size() == 2
                                               ? CompiledFormula::Values{x.x, t}
                                               : CompiledFormula::Values{x.x, x.y, x.z, t};
    double value = 0.;
    try
    {
      value = text->variable_alone >= 0 ? (*text->tables.front())(values[text->variable_alone])
                                        : (*text->compiled)(values);
    }
    catch (const TabulatedFunction::Outside &e)
    {
      throw EntryError(text->entry, "'" + text->written() + "' has no value at " +
                                        text->place(values) + ": " + e.what() +
                                        ", or the formula may choose, e.g. 'condition ? a : b'");
    }
    if (!std::isfinite(value))
      text->fail(values);
    return value;
  }

  void Expression::evaluate(const std::vector<double> &s, const double t,
                            std::vector<double> &result) const
  {
    result.resize(s.size());
    if (!varies || text->variable_alone >= 0 || !text->tables.empty())
    {
      for (std::size_t i = 0; i < s.size(); ++i)
        result[i] = (*this)(s[i], t);
      return;
    }
    text->compiled->evaluate(s, t, result);
    for (std::size_t i = 0; i < s.size(); ++i)
      if (!std::isfinite(result[i]))
        text->fail({s[i], t});
  }

  Expression::Separated Expression::separated() const
  {
    Separated result;
    if (!text)
      return result;
    FormulaTerms terms = terms_of(formula());
    const auto part = [&](const std::string &formula) { return Expression(formula, *this); };
    for (const FormulaTerms::Product &product : terms.products)
      result.products.push_back({part(product.of_place), part(product.of_time)});
    for (const FormulaTerms::Travelling &term : terms.travelling)
      try
      {
        Separated::Travelling own{{}, part(term.of_time), part(term.whole)};
        bool is_known = true;
        for (const FormulaTerms::Shape &shape : term.factors)
        {
          own.factors.push_back({part(shape.formula), part(shape.a), part(shape.b)});
          is_known &= std::isfinite(1. / own.factors.back().a(0., 0.)) &&
                      std::isfinite(own.factors.back().b(0., 0.));
        }
        if (is_known)
          result.travelling.push_back(std::move(own));
        else
          terms.rest += term.whole;
      }
      catch (const UserError &)
      {
        terms.rest += term.whole; // a sum has no value at the start
      }
    if (terms.rest.empty())
      return result;
    result.rest = terms.products.empty() && terms.travelling.empty() ? *this : part(terms.rest);
    return result;
  }

  std::string Expression::content() const
  {
    std::string result = formula();
    if (text)
      for (const auto &table : text->tables)
        result += " [" + table->content() + "]";
    return result;
  }
} // namespace taut
