// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/base/text.h>
#include <taut/scene/expression.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <regex>
#include <sstream>

namespace taut
{
  namespace
  {
    /// The parser of deal.II writes the error to std::cerr only: "Message: <...>".
    class CaughtErrorOutput
    {
    public:
      CaughtErrorOutput() : before(std::cerr.rdbuf(text.rdbuf())) {}
      ~CaughtErrorOutput() { std::cerr.rdbuf(before); }
      CaughtErrorOutput(const CaughtErrorOutput &) = delete;
      CaughtErrorOutput &operator=(const CaughtErrorOutput &) = delete;

      std::string reason() const
      {
        const std::string mark = "Message:  <", all = text.str();
        const std::size_t begin = all.find(mark);
        if (begin == std::string::npos)
          return "it is not one formula";
        std::string line = all.substr(begin + mark.size());
        line.erase(std::min(line.find('\n'), line.size()));
        while (!line.empty() && (line.back() == '>' || line.back() == '.'))
          line.pop_back();
        return line;
      }

    private:
      std::ostringstream text;
      std::streambuf *before;
    };

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

    /// The fault of a formula of this entry; empty if there is none.
    std::string objection(const std::string &formula, const Expression::Variables variables)
    {
      if (std::regex_search(formula, std::regex("^[^()+*,]*\\.[A-Za-z]{2}[A-Za-z0-9]*$")))
        return "it looks like the name of a file, and no file is read here";
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

  struct Expression::Parser
  {
    virtual ~Parser() = default;
    virtual double value(const Coordinates &x, double t) = 0;
  };

  namespace
  {
    /// A formula of dim coordinates and the time; deal.II keeps the time as a state of the
    /// function.
    template <int dim>
    class ParserOf : public Expression::Parser
    {
    public:
      ParserOf(const std::string &variables, const std::string &text)
      {
        function.initialize(variables, text, {{"pi", dealii::numbers::PI}}, true);
        // The formula is compiled at the first evaluation. This one reports a mistake at its entry.
        value({}, 0.);
      }
      double value(const Coordinates &x, const double t) override
      {
        dealii::Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[d];
        function.set_time(t);
        return function.value(point);
      }

    private:
      dealii::FunctionParser<dim> function;
    };
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
    const std::string wrong = objection(text, variables);
    if (!wrong.empty())
      throw bad(wrong);
    if (variables == Variables::elongation)
      of_one_number = "d";
    const CaughtErrorOutput said;
    try
    {
      if (variables == Variables::space)
        parser = std::make_shared<ParserOf<3>>("x,y,z,t", text);
      else
        parser = std::make_shared<ParserOf<1>>(of_one_number + ",t", text);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw bad(said.reason());
    }
    catch (const std::exception &e)
    {
      throw bad(e.what());
    }
    time_dependent = mentions(text, "t");
  }

  double Expression::operator()(const double s, const double t) const
  {
    return evaluate({s, 0., 0.}, t, of_one_number);
  }

  double Expression::operator()(const Coordinates &x, const double t) const
  {
    return evaluate(x, t, "x, y, z");
  }

  double Expression::evaluate(const Coordinates &x, const double t,
                              const std::string &variables) const
  {
    if (!parser)
      return constant;
    const double value = parser->value(x, t);
    if (!std::isfinite(value))
    {
      std::ostringstream out;
      out << "'" << text << "' is not finite at " << variables << " = " << x.x;
      if (variables != of_one_number)
        out << ", " << x.y << ", " << x.z;
      out << " m, t = " << t
          << " s. Restrict the formula to where it is defined, e.g. with if(condition, a, b).";
      throw EntryError(entry, out.str());
    }
    return value;
  }
} // namespace taut
