// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_formula_terms_h
#define taut_formula_terms_h

#include <string>
#include <vector>

namespace taut
{
  /// A formula in s and t as a sum of products of a formula in s and one in t, and of a rest.
  struct FormulaTerms
  {
    struct Product
    {
      std::string of_place, of_time;
    };
    std::vector<Product> products;
    std::string rest; ///< terms that are no products; empty: there is none
  };

  /// Takes a formula apart at its outermost + and -, and the terms at their * and /. What is
  /// compared or chosen at the outermost level is one term.
  FormulaTerms terms_of(const std::string &formula);
} // namespace taut

#endif
