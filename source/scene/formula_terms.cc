// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/formula_terms.h"

#include <taut/base/exceptions.h>
#include <taut/scene/expression.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <utility>

namespace taut
{
  namespace
  {
    /// Of a sum that is computed in another order.
    constexpr double rounding_of_sum = 16. * std::numeric_limits<double>::epsilon();

    struct Piece
    {
      char sign; ///< the operator in front of it
      std::string text;
    };

    /// Where a number, a name or a single character ends that begins at @p i.
    std::size_t end_of_token(const std::string &text, const std::size_t i)
    {
      static const std::regex token("[0-9.]+([eE][+-]?[0-9]+)?|[A-Za-z_][A-Za-z_0-9]*");
      std::smatch found;
      const bool is_long = std::regex_search(text.begin() + i, text.end(), found, token,
                                             std::regex_constants::match_continuous);
      return i + (is_long ? found.length() : 1);
    }

    /// The parts of a formula between these operators outside of brackets; signs stay.
    std::vector<Piece> split_at(const std::string &text, const std::string &operators)
    {
      std::vector<Piece> pieces = {{operators[0], ""}};
      int depth = 0;
      bool is_behind_operand = false;
      for (std::size_t i = 0, end = 0; i < text.size(); i = end)
      {
        end = end_of_token(text, i);
        const char c = text[i];
        if (depth == 0 && is_behind_operand && operators.find(c) != std::string::npos)
        {
          pieces.push_back({c, ""});
          is_behind_operand = false;
          continue;
        }
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        pieces.back().text.append(text, i, end - i);
        if (!std::isspace(static_cast<unsigned char>(c)))
          is_behind_operand =
              std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == ')';
      }
      return pieces;
    }

    bool has_word(const std::string &text, const char *const word)
    {
      return std::regex_search(text, std::regex("\\b(" + std::string(word) + ")\\b"));
    }

    /// Whether the formula is a sum of products at all.
    bool is_sum(const std::string &text)
    {
      for (const char c : {'<', '>', '=', '!', '&', '|', '?', ':', ',', ';'})
        if (split_at(text, std::string(1, c)).size() > 1)
          return false;
      return !has_word(text, "and|or|xor|not");
    }

    std::string in_brackets(const Piece &piece)
    {
      return piece.sign + ("(" + piece.text + ")");
    }

    /// A sum a(t)*s + b(t).
    struct Linear
    {
      std::string a, b = "0";
    };

    /// The place of the bracket that closes the one at @p begin; the end if there is none.
    std::size_t closing(const std::string &text, const std::size_t begin)
    {
      int depth = 0;
      for (std::size_t i = begin; i < text.size(); ++i)
        if ((depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0) == 0)
          return i;
      return text.size();
    }

    bool is_linear(const std::string &text, Linear &sum);

    /// Whether a factor is s, or a linear sum in brackets, with signs in front.
    bool is_linear_factor(const std::string &factor, Linear &sum)
    {
      const std::size_t begin = factor.find_first_not_of("+- \t"),
                        end = factor.find_last_not_of(" \t");
      if (begin > end)
        return false;
      const std::string body = factor.substr(begin, end + 1 - begin);
      if (body == "s")
        sum.a = "1";
      else if (body[0] != '(' || closing(body, 0) + 1 != body.size() ||
               !is_linear(body.substr(1, body.size() - 2), sum))
        return false;
      for (std::size_t i = 0; i < begin; ++i)
        if (factor[i] == '-')
          sum = {"-(" + sum.a + ")", "-(" + sum.b + ")"};
      return true;
    }

    /// Whether a term is linear, and which multiple of a linear factor it is.
    bool is_linear_term(const Piece &term, Linear &sum)
    {
      bool is_found = false;
      std::string multiple = std::string(1, term.sign) + "1";
      for (const Piece &factor : split_at(term.text, "*/"))
        if (has_word(factor.text, "s"))
        {
          if (is_found || factor.sign == '/' || !is_linear_factor(factor.text, sum))
            return false;
          is_found = true;
        }
        else
          multiple += in_brackets(factor);
      sum = {"(" + multiple + ")*(" + sum.a + ")", "(" + multiple + ")*(" + sum.b + ")"};
      return true;
    }

    bool is_linear(const std::string &text, Linear &sum)
    {
      sum = {};
      if (!is_sum(text))
        return false;
      for (const Piece &term : split_at(text, "+-"))
      {
        Linear own;
        if (!has_word(term.text, "s"))
          sum.b += in_brackets(term);
        else if (sum.a.empty() && is_linear_term(term, own))
          sum = {own.a, sum.b + "+" + own.b};
        else
          return false;
      }
      return !sum.a.empty();
    }

    /// Whether both sums are functions of the same one but for constants, to rounding, however they
    /// are written: of (a*s + b - b(0)) / a(0).
    bool is_multiple(const Linear &x, const Linear &y)
    {
      if (x.a == y.a && x.b == y.b)
        return true;
      const auto formula = [](const std::string &text)
      { return Expression(text, "sum", Expression::Variables::time); };
      try
      {
        const Expression ax = formula(x.a), bx = formula(x.b), ay = formula(y.a), by = formula(y.b);
        const auto is_same = [](const double first, const double second)
        {
          return std::fabs(first - second) <=
                 rounding_of_sum * std::max(std::fabs(first), std::fabs(second));
        };
        for (const double t : {.37, 1.9, 7.3, 103.})
          if (!is_same(ax(0., t) * ay(0., 0.), ay(0., t) * ax(0., 0.)) ||
              !is_same((bx(0., t) - bx(0., 0.)) * ay(0., 0.),
                       (by(0., t) - by(0., 0.)) * ax(0., 0.)))
            return false;
        return true;
      }
      catch (const UserError &)
      {
        return false; // one of them has no value there
      }
    }

    /// All linear sums with s in a formula. False if s or t are elsewhere, too.
    bool find_sums(const std::string &text, std::vector<Linear> &sums)
    {
      static const std::string separators = ",<>=!&|?:";
      for (const char c : separators)
        if (const std::vector<Piece> parts = split_at(text, std::string(1, c)); parts.size() > 1)
        {
          for (const Piece &part : parts)
            if (!find_sums(part.text, sums))
              return false;
          return true;
        }
      if (Linear sum; is_linear(text, sum))
      {
        sums.push_back(sum);
        return true;
      }
      std::string outside;
      for (std::size_t i = 0; i < text.size(); ++i)
      {
        outside += text[i];
        if (text[i] != '(')
          continue;
        const std::size_t end = closing(text, i);
        if (!find_sums(text.substr(i + 1, end - i - 1), sums))
          return false;
        i = end;
      }
      return !has_word(outside, "s|t");
    }

    /// A term as a product of factors.
    struct Factors
    {
      FormulaTerms::Product of_one; ///< those of s, and those of t
      std::vector<FormulaTerms::Shape> travelling;
      bool is_travelling = true; ///< all factors of both

      Factors(const Piece &term, const bool is_product) : of_one{term.sign == '-' ? "-1" : "1", "1"}
      {
        const std::vector<Piece> all =
            is_product ? split_at(term.text, "*/") : std::vector<Piece>{{'*', term.text}};
        for (const Piece &factor : all)
          if (has_word(factor.text, "s") && has_word(factor.text, "t"))
            add(factor);
          else
            (has_word(factor.text, "t") ? of_one.of_time : of_one.of_place) += in_brackets(factor);
      }

    private:
      /// Factors of one sum are one.
      void add(const Piece &factor)
      {
        std::vector<Linear> sums;
        is_travelling = is_travelling && find_sums(factor.text, sums);
        for (const Linear &sum : sums)
          is_travelling = is_travelling && is_multiple(sum, sums.front());
        if (!is_travelling)
          return;
        for (FormulaTerms::Shape &shape : travelling)
          if (is_multiple({shape.a, shape.b}, sums.front()))
          {
            shape.formula += in_brackets(factor);
            return;
          }
        travelling.push_back({"1" + in_brackets(factor), sums.front().a, sums.front().b});
      }
    };

    /// Adds a term; one shape alone joins those of the same sum.
    void add_term(const Piece &term, const bool is_product, FormulaTerms &result)
    {
      const Factors factors(term, is_product);
      if (!factors.is_travelling)
      {
        result.rest += in_brackets(term);
        return;
      }
      if (factors.travelling.empty())
      {
        result.products.push_back(factors.of_one);
        return;
      }
      FormulaTerms::Travelling own{factors.travelling, factors.of_one.of_time, in_brackets(term)};
      if (has_word(factors.of_one.of_place, "s"))
        own.factors.push_back({factors.of_one.of_place, "1", "0"});
      else
        own.factors.front().formula =
            factors.of_one.of_place + "*(" + own.factors.front().formula + ")";
      const auto is_alone = [](const FormulaTerms::Travelling &t)
      { return t.factors.size() == 1 && t.of_time == "1"; };
      for (FormulaTerms::Travelling &other : result.travelling)
        if (FormulaTerms::Shape &first = other.factors[0], &second = own.factors[0];
            is_alone(own) && is_alone(other) &&
            is_multiple({first.a, first.b}, {second.a, second.b}))
        {
          first.formula += "+" + second.formula;
          other.whole += own.whole;
          return;
        }
      result.travelling.push_back(std::move(own));
    }
  } // namespace

  FormulaTerms terms_of(const std::string &formula)
  {
    FormulaTerms result;
    if (split_at(formula, ",").size() + split_at(formula, ";").size() > 2)
      result.rest = formula; // a list, of which muParser takes the last entry
    else if (!is_sum(formula))
      add_term({'+', formula}, false, result);
    else
      for (const Piece &term : split_at(formula, "+-"))
        add_term(term, true, result);
    return result;
  }

  bool is_smooth(const std::string &formula)
  {
    static const std::set<std::string> smooth = {
        "s",     "t",    "x",    "y",    "z",    "d",     "pi",    "sin",   "cos",  "tan", "asin",
        "acos",  "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "log2", "log", "ln",
        "log10", "exp",  "sqrt", "cot",  "csc",  "sec",   "pow",   "erf",   "erfc"};
    static const std::string operators = "+-*/^(), \t";
    for (std::size_t i = 0, end = 0; i < formula.size(); i = end)
    {
      end = end_of_token(formula, i);
      const std::string token = formula.substr(i, end - i);
      const bool is_number = std::isdigit(static_cast<unsigned char>(token[0])) || token[0] == '.';
      if (!is_number && operators.find(token) == std::string::npos && smooth.count(token) == 0)
        return false;
    }
    return true;
  }
} // namespace taut
