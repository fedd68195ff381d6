// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mesh_arguments_h
#define taut_mesh_arguments_h

#include <taut/base/exceptions.h>

#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace taut
{
  /// Largest number of cells; a mesh with more cells is a mistake.
  constexpr double most_cells = 1e7;

  /// The arguments of a generator of meshes: lists of numbers with colons between them, read one
  /// after the other. deal.II checks none of them in Release.
  template <int dim>
  class MeshArguments
  {
  public:
    /// All functions throw an EntryError about @p entry.
    MeshArguments(const std::string &text, const std::string &entry)
        : text(text), entry(entry), parts(dealii::Utilities::split_string_list(text, ':'))
    {
    }

    /// The next list of @p n finite numbers.
    std::vector<double> numbers(const std::size_t n, const std::string &what)
    {
      if (next == parts.size())
        throw error("it lacks the " + what);
      const std::string &part = parts[next++];
      std::vector<double> result;
      try
      {
        result =
            dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(part, ','));
      }
      catch (const std::exception &)
      {
        throw error("'" + part + "' are no numbers for the " + what);
      }
      if (result.size() != n ||
          !std::all_of(result.begin(), result.end(), [](double x) { return std::isfinite(x); }))
        throw error("the " + what + " takes " + std::to_string(n) + " numbers, not '" + part + "'");
      return result;
    }

    double positive(const std::string &what)
    {
      const double value = numbers(1, what)[0];
      if (!(value > 0.))
        throw error("the " + what + " must be positive");
      return value;
    }

    dealii::Point<dim> point(const std::string &what)
    {
      const std::vector<double> x = numbers(dim, what);
      dealii::Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = x[d];
      return result;
    }

    /// Numbers of cells along the axes.
    std::vector<unsigned int> cells()
    {
      std::vector<unsigned int> result;
      double product = 1.;
      for (const double n : numbers(dim, "number of cells"))
      {
        product *= n;
        if (!(n >= 1. && n <= most_cells && n == std::floor(n)))
          throw error("numbers of cells are whole numbers of at least 1");
        result.push_back(static_cast<unsigned int>(n));
      }
      if (product > most_cells)
        throw error("these are more than 1e7 cells");
      return result;
    }

    /// Checks that no argument is left.
    void finish() const
    {
      if (next != parts.size())
        throw error("'" + parts[next] + "' is more than it takes");
    }

    EntryError error(const std::string &reason) const
    {
      return EntryError(entry, "cannot make a mesh of '" + text + "': " + reason);
    }

  private:
    const std::string text, entry;
    const std::vector<std::string> parts;
    std::size_t next = 0;
  };
} // namespace taut

#endif
