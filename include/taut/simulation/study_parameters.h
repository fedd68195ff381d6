// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_study_parameters_h
#define taut_study_parameters_h

#include <taut/scene/named_items.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Entries of a scene that take successive values together, in the sections of a study or sweep.
  struct VariedEntries
  {
    std::string entries, values; ///< as written

    void declare(dealii::ParameterHandler &prm);

    /// Paths of the entries, each in @p scene, all entries by path, and not in @p taken; adds them
    /// to @p taken. Throws EntryError on an entry of section @p title.
    std::vector<std::string> paths(const std::string &title,
                                   const std::map<std::string, std::string> &scene,
                                   std::set<std::string> &taken) const;

    /// The values, with all values of ranges "first:step:last", at most @p most of one range.
    /// Throws EntryError on an entry of section @p title for no value or an empty one.
    std::vector<std::string> value_list(const std::string &title, std::size_t most) const;
  };

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

  /// Where and how `taut --elasticity` measures a line.
  struct ElasticityParameters
  {
    double force = 100.;       ///< upwards [N]
    double spacing = 1.;       ///< of the places [m]
    std::vector<double> range; ///< first and last x [m]; empty: all of each wire
    bool slackening = false;   ///< links may open and close under the force

    /// Declares the members in subsection "Elasticity".
    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// Entries of a scene that a study changes together, and their successive values.
  struct ParameterList
  {
    std::string name;
    std::vector<std::string> entries; ///< paths, "Section/Entry"
    std::vector<std::string> values;
    std::string reference; ///< value in the reference
    bool refined = false;  ///< the reference takes halves of the least value
  };

  /// Parameters of a study, and the accuracy that a run asks of a stored study.
  struct StudyParameters
  {
    std::string folder;
    double accuracy = 0.; ///< relative; 0: the scene runs as written
    std::vector<double> accuracies = {0.05, 0.01, 0.001};
    unsigned int repeats = 3, reference_levels = 5;
    double budget = 600.; ///< wall time of a search for an accuracy [s]

    struct ParameterListItem
    {
      VariedEntries varied;
      std::string reference;
      bool refined = false;
      void declare(dealii::ParameterHandler &prm);
    };
    NamedItems<ParameterListItem> parameter_list_items{"Study", "Parameters", "Parameter",
                                                       "lists of values to try"};

    struct QuantityItem
    {
      std::string of, quantity, exact;
      double scale = 0.;
      void declare(dealii::ParameterHandler &prm);
    };
    NamedItems<QuantityItem> quantities{"Study", "Quantities", "Quantity",
                                        "quantities of interest, whose error is measured"};

    void declare_names(dealii::ParameterHandler &prm);

    /// Declares the members in subsection "Study".
    void declare_parameters(dealii::ParameterHandler &prm);

    /// The parameter lists, checked against all entries of the scene by path. Throws EntryError.
    std::vector<ParameterList>
    parameter_lists(const std::map<std::string, std::string> &scene) const;
  };
} // namespace taut

#endif
