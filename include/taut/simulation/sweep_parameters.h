// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_sweep_parameters_h
#define taut_sweep_parameters_h

#include <taut/scene/named_items.h>
#include <taut/simulation/varied_entries.h>

#include <map>
#include <string>
#include <vector>

namespace taut
{
  /// An entry, or several entries with one value, that a sweep varies.
  struct SweptParameter
  {
    std::string name;
    std::vector<std::string> entries; ///< paths
  };

  /// The cases of a sweep, section "Sweep".
  struct SweepParameters
  {
    std::string folder;
    std::string combination = "product";
    unsigned int samples = 0, seed = 1;

    struct Item
    {
      VariedEntries varied;
      std::string distribution = "values";
      std::vector<double> range; ///< a pair for each random number
      void declare(dealii::ParameterHandler &prm);
      bool is_random() const { return distribution != "values"; }
    };
    NamedItems<Item> items{"Sweep", "Parameters", "Parameter", "entries that a sweep varies"};

    void declare_names(dealii::ParameterHandler &prm);

    /// Declares the members in subsection "Sweep".
    void declare_parameters(dealii::ParameterHandler &prm);

    /// Varied parameters, checked against all entries of the scene by path. Throws EntryError.
    std::vector<SweptParameter> parameters(const std::map<std::string, std::string> &scene) const;

    /// A value for each parameter in each case, the same on every machine. Throws EntryError.
    std::vector<std::vector<std::string>> cases() const;

  private:
    std::vector<std::vector<std::string>> value_lists() const;
    std::size_t n_combinations(const std::vector<std::vector<std::string>> &lists) const;
    std::size_t n_samples() const;
  };
} // namespace taut

#endif
