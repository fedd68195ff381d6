// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_compiled_formula_h
#define taut_compiled_formula_h

#include "scene/tabulated_function.h"

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace taut
{
  /// The reason why a text is no formula.
  class FormulaError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A formula in the syntax of deal.II's FunctionParser, compiled once by muParser with its
   * constants folded. Use it where a formula is evaluated in each step: an evaluation allocates
   * nothing. Threads wait for one another.
   */
  class CompiledFormula
  {
  public:
    static constexpr std::size_t most_variables = 4;
    using Values = std::array<double, most_variables>;

    using Tables = std::vector<std::shared_ptr<const TabulatedFunction>>;

    /// @p variables are the names of the first values, and table_0, table_1, ... functions of the
    /// formula. Throws FormulaError.
    CompiledFormula(const std::string &text, const std::vector<std::string> &variables,
                    const Tables &tables = {});
    ~CompiledFormula();

    /// Value of the formula; not finite where it is not defined. Throws
    /// TabulatedFunction::Outside.
    double operator()(const Values &values);

    /// Values at first values @p s and the second value @p t, without tables.
    void evaluate(const std::vector<double> &s, double t, std::vector<double> &result);

  private:
    class Program;

    const Tables tables; ///< which the program uses
    std::unique_ptr<Program> program;
    std::mutex mutex;
  };
} // namespace taut

#endif
