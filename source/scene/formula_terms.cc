// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/formula_terms.h"

#include <cctype>
#include <regex>

namespace taut
{
  namespace
  {
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

    /// False if a factor depends on both.
    bool separate(const Piece &term, FormulaTerms::Product &product)
    {
      product = {term.sign == '-' ? "-1" : "1", "1"};
      for (const Piece &factor : split_at(term.text, "*/"))
      {
        const bool in_place = has_word(factor.text, "s"), in_time = has_word(factor.text, "t");
        if (in_place && in_time)
          return false;
        std::string &own = in_time ? product.of_time : product.of_place;
        own += factor.sign + ("(" + factor.text + ")");
      }
      return true;
    }
  } // namespace

  FormulaTerms terms_of(const std::string &formula)
  {
    FormulaTerms result;
    if (!is_sum(formula))
    {
      if (has_word(formula, "s"))
        result.rest = formula;
      else
        result.products.push_back({"1", formula});
      return result;
    }
    for (const Piece &term : split_at(formula, "+-"))
    {
      FormulaTerms::Product product;
      if (separate(term, product))
        result.products.push_back(product);
      else
        result.rest += term.sign + ("(" + term.text + ")");
    }
    return result;
  }
} // namespace taut
