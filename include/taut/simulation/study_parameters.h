// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_study_parameters_h
#define taut_study_parameters_h

#include <taut/scene/named_items.h>
#include <taut/simulation/varied_entries.h>

#include <map>
#include <string>
#include <vector>

namespace taut
{
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
