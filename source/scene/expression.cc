// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
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
    /// deal.II's parser says what is wrong on std::cerr, and only there: "Message:  <...>".
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
  } // namespace

  struct Expression::Parser
  {
    // FunctionParser::value is const but parses lazily, one copy a thread.
    dealii::FunctionParser<1> function;
  };

  Expression::Expression() = default;

  Expression::Expression(const double value) : constant(value)
  {
    std::ostringstream out;
    out.precision(17);
    out << value;
    text = out.str();
  }

  Expression::Expression(const std::string &formula, const std::string &entry)
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
      return EntryError(
          entry, "cannot evaluate '" + text + "': " + reason +
                     ". Write a formula in s (position along the wire [m]) and t (time [s]), e.g. "
                     "'120*sin(2*pi*t)'.");
    };
    if (is_number)
      throw bad("the number is out of range");
    auto fresh = std::make_shared<Parser>();
    const CaughtErrorOutput said;
    try
    {
      fresh->function.initialize("s,t", text, {{"pi", dealii::numbers::PI}}, true);
      // The formula is compiled at the first evaluation: do it here, where the mistake is.
      fresh->function.set_time(0.);
      fresh->function.value(dealii::Point<1>(0.));
    }
    catch (const dealii::ExceptionBase &)
    {
      throw bad(said.reason());
    }
    catch (const std::exception &e)
    {
      throw bad(e.what());
    }
    parser = fresh;
    time_dependent = std::regex_search(text, std::regex("\\bt\\b"));
  }

  double Expression::operator()(const double s, const double t) const
  {
    if (!parser)
      return constant;
    // The time is the second variable; deal.II keeps it as a state of the function.
    const_cast<dealii::FunctionParser<1> &>(parser->function).set_time(t);
    const double value = parser->function.value(dealii::Point<1>(s));
    if (!std::isfinite(value))
    {
      std::ostringstream out;
      out << "'" << text << "' is not finite at s = " << s << " m, t = " << t
          << " s. Restrict the formula to where it is defined, e.g. with if(condition, a, b).";
      throw EntryError(entry, out.str());
    }
    return value;
  }
} // namespace taut
