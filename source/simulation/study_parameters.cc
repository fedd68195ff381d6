// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/simulation/study_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <set>
#include <sstream>

namespace taut
{
  namespace
  {
    using namespace dealii::Patterns;

    bool is_positive_number(const std::string &text)
    {
      std::istringstream in(text);
      double value = 0.;
      return in >> value && in.eof() && std::isfinite(value) && value > 0.;
    }
  } // namespace

  void StudyParameters::ParameterListItem::declare(dealii::ParameterHandler &prm)
  {
    varied.declare(prm);
    prm.add_parameter("Refined", refined,
                      "Whether a smaller value is a finer model: the reference then starts from "
                      "the least value and halves it, together with those of the other refined "
                      "parameters");
    prm.add_parameter("Reference", reference,
                      "Value in the reference if it is not refined; empty: that of the scene",
                      Anything());
  }

  void StudyParameters::QuantityItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Of", of,
        "Name of a sliding contact or strip, another link, a probe or a support, with "
        "its number if it has several positions, or an item of an observer",
        Anything());
    prm.add_parameter(
        "Quantity", quantity,
        "Of a sliding contact: 'mean', 'standard deviation', 'maximum', 'minimum', 'contact "
        "loss', 'standard deviation over mean', of the filtered force in the window of the "
        "statistics, 'standard deviation 0 to 2 Hz' (also 0 to 5, 5 to 20, 0 to 20), 'losses over "
        "5 ms' and 'share of losses over 5 ms' (also 10, 20), 'height range'; of a wire of a strip "
        "'mean share', 'largest share'. Of another link: 'open time', 'closed time', 'largest "
        "force', 'impulse', 'largest impulse'; of a dropper also 'smallest force', 'mean force', "
        "'standard deviation of the force', 'slackenings'. Of a probe: 'largest', 'smallest', "
        "'last'. Of a support, by its force in the window: 'smallest reaction', 'largest "
        "reaction', "
        "'mean reaction', and 'reaction at the start'. Of each: 'history', the root mean square "
        "over the run of the difference to the "
        "reference, of force or displacement",
        Anything());
    prm.add_parameter("Exact", exact,
                      "The exact value, a formula in t for a history; empty: from a reference "
                      "that is refined [the quantity's unit]",
                      Anything());
    prm.add_parameter("Scale", scale,
                      "Errors are relative to it; 0: to the reference, of a history to its root "
                      "mean square [the quantity's unit]",
                      Double(0., Double::max_double_value));
  }

  void StudyParameters::declare_names(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    parameter_list_items.declare_names(prm);
    quantities.declare_names(prm);
    prm.leave_subsection();
  }

  void StudyParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Study");
    prm.add_parameter(
        "Folder", folder,
        "Where 'taut --study' and '--accuracy' write and where Accuracy looks for study.json; "
        "empty: the folder 'study' in that of the results",
        Anything());
    prm.add_parameter("Accuracy", accuracy,
                      "Largest relative error wanted of the quantities: the run takes the cheapest "
                      "setting of the stored study of this scene that has it; 0: as written [1]",
                      Double(0., 1.));
    prm.add_parameter("Accuracies", accuracies,
                      "Relative errors for which a study names the cheapest setting [1]",
                      List(Double(0., 1.)));
    prm.add_parameter("Repeats", repeats, "Runs of each setting; the fastest counts [1]",
                      Integer(1, 1000));
    prm.add_parameter("Reference levels", reference_levels,
                      "Most refinements of the reference; it ends earlier when its error is below "
                      "a tenth of the least of Accuracies [1]",
                      Integer(1, 20));
    prm.add_parameter("Budget", budget,
                      "Longest wall time that 'taut --accuracy' takes to find a setting [s]",
                      Double(0., Double::max_double_value));
    parameter_list_items.declare_parameters(prm);
    quantities.declare_parameters(prm);
    prm.leave_subsection();
  }

  std::vector<ParameterList>
  StudyParameters::parameter_lists(const std::map<std::string, std::string> &scene) const
  {
    // A study runs each value several times.
    constexpr std::size_t most_values = 10000;
    std::vector<ParameterList> result;
    std::set<std::string> taken;
    for (std::size_t i = 0; i < parameter_list_items.names.size(); ++i)
    {
      const ParameterListItem &item = parameter_list_items.items[i];
      const std::string title = parameter_list_items.title(i);
      ParameterList parameter_list;
      parameter_list.name = parameter_list_items.names[i];
      parameter_list.entries = item.varied.paths(title, scene, taken);
      parameter_list.values = item.varied.value_list(title, most_values);
      parameter_list.refined = item.refined;
      if (parameter_list.refined)
        for (const std::string &value : parameter_list.values)
          if (!is_positive_number(value))
            throw EntryError(title + "/Values", "'" + value +
                                                    "' is no positive number, so it cannot be "
                                                    "halved; set Refined = false");
      parameter_list.reference =
          item.reference.empty() ? scene.at(parameter_list.entries[0]) : item.reference;
      result.push_back(parameter_list);
    }
    return result;
  }
} // namespace taut
