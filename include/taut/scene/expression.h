// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_expression_h
#define taut_expression_h

#include <taut/base/coordinates.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class CompiledFormula;
  class TabulatedFunction;

  /**
   * A scalar function of the position s [m] along a wire, of a point x, y, z [m], or of an
   * elongation d [m], and of the time t [s], written as a formula in the syntax of deal.II's
   * FunctionParser; pi is known. In it 'table(FILE.csv, column)' is a column of a file over its
   * first one: s or d or t, whichever the formula depends on; 'table(FILE.csv, column, t)' says
   * which where there are several. A further word 'cubic' takes monotone cubics in the place of
   * straight lines. The formula is compiled and its files are read once, and copies share all of
   * it. An evaluation allocates nothing; any thread may evaluate.
   */
  class Expression
  {
  public:
    /// The constant zero.
    Expression();

    /// What a formula may depend on.
    enum class Variables
    {
      position,
      time,
      both,      ///< s and t
      space,     ///< x, y, z and t
      elongation ///< d, in the place of s
    };

    /// @p entry names the parameter in error messages. A formula that cannot be parsed, that
    /// depends on other variables, that is random, or whose tables cannot be read is an EntryError.
    Expression(const std::string &formula, const std::string &entry,
               Variables variables = Variables::both);

    /// A constant.
    explicit Expression(double constant);

    /// Value at s [m], t [s]. A value that is not finite or outside of a table is an EntryError
    /// that names entry, s and t.
    double operator()(const double s, const double t) const
    {
      return varies ? evaluate({s, 0., 0.}, t) : constant;
    }

    /// Value at the point x [m], of a formula in space.
    double operator()(const Coordinates &x, const double t) const
    {
      return varies ? evaluate(x, t) : constant;
    }

    /// Values at positions @p s [m], t [s], into @p result, which is resized: cheaper than one by
    /// one. Throws as operator().
    void evaluate(const std::vector<double> &s, double t, std::vector<double> &result) const;

    /// The formula in s and t as a sum of products of a function of s and one of t, of products
    /// with shapes that travel, and of a rest, as it is written.
    struct Separated;
    Separated separated() const;

    const std::string &formula() const;

    /// The formula with digests of its tables: differs where values may differ.
    std::string content() const;

    /// The value of a constant; 0 for other formulas.
    double constant_part() const { return is_number ? constant : 0.; }

    /// True for a formula that is a number equal to zero.
    bool is_zero() const { return is_number && constant == 0.; }

    /// True for a formula that has one value: it may be written with functions, but has no
    /// variable.
    bool is_constant() const { return !varies; }

    /// True if the formula mentions t.
    bool depends_on_time() const;

  private:
    struct Text;

    /// A part of the formula @p whole, which messages quote.
    Expression(const std::string &formula, const Expression &whole);

    void parse(Text &own, Variables variables);
    double evaluate(const Coordinates &x, double t) const;

    std::shared_ptr<const Text> text; ///< null: 0
    double constant = 0.;             ///< value of a number, and of a formula without variables
    bool is_number = true;
    bool varies = false;
  };

  struct Expression::Separated
  {
    struct Product
    {
      Expression of_place, of_time;
    };

    /// A function of a(t)*s + b(t) alone: it travels along s and widens. Its value at s and t is
    /// form(x, 0) at the place x where this sum was at the start.
    struct Shape
    {
      Expression form, a, b;
    };
    struct Travelling
    {
      std::vector<Shape> factors; ///< one of which may stand
      Expression of_time, whole;  ///< a further factor, and the product
    };
    std::vector<Product> products;
    std::vector<Travelling> travelling;
    Expression rest; ///< zero: there is none
  };
} // namespace taut

#endif
