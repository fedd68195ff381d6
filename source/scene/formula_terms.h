// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_formula_terms_h
#define taut_formula_terms_h

#include <string>
#include <vector>

namespace taut
{
  /// A formula in s and t as a sum of products of a formula in s and one in t, of products with
  /// factors that travel, and of a rest.
  struct FormulaTerms
  {
    struct Product
    {
      std::string of_place, of_time;
    };

    /// A formula of a(t)*s + b(t) alone.
    struct Shape
    {
      std::string formula, a, b;
    };
    struct Travelling
    {
      std::vector<Shape> factors; ///< of s alone have a = 1, b = 0
      std::string of_time, whole; ///< the other factor, and the term
    };
    std::vector<Product> products;
    std::vector<Travelling> travelling;
    std::string rest; ///< other terms; empty: there is none
  };

  /// Takes a formula apart at its outermost + and -, and the terms at their * and /. What is
  /// compared or chosen at the outermost level is one term. A factor travels if it has s
  /// and t in linear sums of s alone, all of them multiples of one, as (s - 20*t - 100) / (30 + t).
  FormulaTerms terms_of(const std::string &formula);

  /// Whether a formula is written with functions alone that have all derivatives wherever they have
  /// a value: without comparisons, choices, absolute and rounded values, and tables.
  bool is_smooth(const std::string &formula);
} // namespace taut

#endif
