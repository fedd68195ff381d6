// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/compiled_formula.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace taut
{
  namespace
  {
    // What deal.II adds to the functions of muParser, with its rounding of conditions.
    int rounded(const double value)
    {
      return static_cast<int>(value + (value >= 0. ? .5 : -.5));
    }
    bool is_true(const double value)
    {
      return rounded(value) != 0;
    }
    double choose(const double condition, const double a, const double b)
    {
      return is_true(condition) ? a : b;
    }
    double any_of(const double a, const double b)
    {
      return is_true(a) || is_true(b);
    }
    double all_of(const double a, const double b)
    {
      return is_true(a) && is_true(b);
    }
    double to_integer(const double x)
    {
      return rounded(x);
    }
    double ceiling(const double x)
    {
      return std::ceil(x);
    }
    double floor_of(const double x)
    {
      return std::floor(x);
    }
    double cotangent(const double x)
    {
      return 1. / std::tan(x);
    }
    double cosecant(const double x)
    {
      return 1. / std::sin(x);
    }
    double secant(const double x)
    {
      return 1. / std::cos(x);
    }
    double logarithm(const double x)
    {
      return std::log(x);
    }
    double power(const double a, const double b)
    {
      return std::pow(a, b);
    }
    double square(const double x)
    {
      return x * x;
    }
    double error_function(const double x)
    {
      return std::erf(x);
    }
    double complementary_error_function(const double x)
    {
      return std::erfc(x);
    }

    void define_functions(mu::Parser &parser)
    {
      constexpr int of_or = 1, of_and = 2; // precedences
      parser.DefineConst("pi", dealii::numbers::PI);
      parser.DefineFun("if", choose, true);
      parser.DefineOprt("|", any_of, of_or);
      parser.DefineOprt("&", all_of, of_and);
      parser.DefineFun("int", to_integer, true);
      parser.DefineFun("ceil", ceiling, true);
      parser.DefineFun("cot", cotangent, true);
      parser.DefineFun("csc", cosecant, true);
      parser.DefineFun("floor", floor_of, true);
      parser.DefineFun("sec", secant, true);
      parser.DefineFun("log", logarithm, true);
      parser.DefineFun("pow", power, true);
      parser.DefineFun("square", square, true);
      parser.DefineFun("erf", error_function, true);
      parser.DefineFun("erfc", complementary_error_function, true);
    }

    /// muParser accepts no blanks between a function and its arguments, deal.II does.
    std::string without_blanks_after_functions(std::string text)
    {
      for (const char *const name :
           {"sin",   "cos",   "tan",   "asin",  "acos",  "atan",  "sinh", "cosh", "tanh",
            "asinh", "acosh", "atanh", "atan2", "log2",  "log10", "log",  "ln",   "exp",
            "sqrt",  "sign",  "rint",  "abs",   "min",   "max",   "sum",  "avg",  "if",
            "int",   "ceil",  "cot",   "csc",   "floor", "sec",   "pow",  "erf",  "erfc"})
      {
        const std::size_t length = std::string(name).size();
        for (std::size_t at = text.find(name); at != std::string::npos;
             at = text.find(name, at + length))
        {
          const std::size_t end = std::min(text.find_first_not_of(" \t", at + length), text.size());
          text.erase(at + length, end - at - length);
        }
      }
      return text;
    }

    /// "square(x)" for "(x)^2", and for "sin(x)^2" "square(sin(x))": a general power takes ten
    /// times as long.
    std::string with_squares(std::string text)
    {
      const std::string mark = ")^2";
      for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
      {
        const std::size_t behind = at + mark.size();
        std::size_t begin = at;
        for (int depth = 1; depth > 0 && begin > 0;)
          depth += text[--begin] == ')' ? 1 : text[begin] == '(' ? -1 : 0;
        while (begin > 0 && (std::isalnum(static_cast<unsigned char>(text[begin - 1])) ||
                             text[begin - 1] == '_'))
          --begin;
        at = behind;
        // Longer exponents, and towers of powers, stay as they are.
        if (text.find_first_of("0123456789.^eE", behind) == behind || text[begin] == ')' ||
            (begin > 0 && text[begin - 1] == '^'))
          continue;
        const std::string base = text.substr(begin, behind - mark.size() + 1 - begin);
        text.replace(begin, behind - begin, "square(" + base + ")");
        at = begin + std::string("square(").size();
      }
      return text;
    }

    /// As muParser reads it. Lists of formulas, which deal.II separates by ';', are refused.
    std::string one_formula(const std::string &text)
    {
      const std::vector<std::string> parts = dealii::Utilities::split_string_list(text, ';');
      if (parts.size() != 1)
        throw FormulaError("it is not one formula");
      return with_squares(without_blanks_after_functions(parts.front()));
    }

    /// The first line of what muParser says, without its full stop.
    std::string reason(const mu::ParserError &error)
    {
      std::string line = error.GetMsg();
      line.erase(std::min(line.find('\n'), line.size()));
      while (!line.empty() && (line.back() == '>' || line.back() == '.'))
        line.pop_back();
      return line;
    }
  } // namespace

  /// The formula with its own variables.
  class CompiledFormula::Program
  {
  public:
    Program(const std::string &text, const std::vector<std::string> &variables,
            const Tables &tables)
    try
    {
      uses.reserve(tables.size());
      for (const auto &table : tables)
      {
        uses.push_back({*table, is_compiled});
        parser.DefineFunUserData("table_" + std::to_string(uses.size() - 1), value_of, &uses.back(),
                                 false);
      }
      for (std::size_t i = 0; i < variables.size(); ++i)
        parser.DefineVar(variables[i], &values[i]);
      define_functions(parser);
      parser.SetExpr(text);
      parser.Eval(); // compiles it
      is_compiled = true;
    }
    catch (const mu::ParserError &error)
    {
      throw FormulaError(reason(error));
    }

    double operator()(const Values &at)
    {
      values = at;
      return parser.Eval();
    }

  private:
    struct Use
    {
      const TabulatedFunction &table;
      const bool &is_compiled;
    };

    /// A table has a value at zero or not: the compiler does not ask.
    static double value_of(void *use, const double x)
    {
      const Use &own = *static_cast<const Use *>(use);
      return own.is_compiled ? own.table(x) : 0.;
    }

    bool is_compiled = false;
    std::vector<Use> uses;
    mu::Parser parser;
    Values values = {};
  };

  CompiledFormula::CompiledFormula(const std::string &text,
                                   const std::vector<std::string> &variables, const Tables &tables)
      : tables(tables), program(std::make_unique<Program>(one_formula(text), variables, tables))
  {
  }

  CompiledFormula::~CompiledFormula() = default;

  double CompiledFormula::operator()(const Values &values)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return (*program)(values);
  }

  void CompiledFormula::evaluate(const std::vector<double> &s, const double t,
                                 std::vector<double> &result)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    for (std::size_t i = 0; i < s.size(); ++i)
      result[i] = (*program)({s[i], t});
  }
} // namespace taut
