// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_verification_run_h
#define taut_verification_run_h

#include "common.h"
#include "scene_builder.h"

#include <taut/simulation/simulation.h>

#include <nlohmann/json.hpp>

namespace verification
{
  using Overrides = std::vector<std::string>;
  inline Overrides operator+(Overrides a, const Overrides &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  using Callback = std::function<void(const taut::StepView &)>;

  /// Path of a scene of the folder prm/, by its name without extension.
  std::string scene_file(const std::string &name);

  /**
   * A scene read from a parameter file and ready to run, with its results in a folder that is
   * removed again. Only the first and the last line of each table are written unless an override
   * says otherwise.
   */
  class Session
  {
  public:
    /// @p file_or_text is the path of a .prm file, or if it has more than one line the text of one
    /// or a scene in the lines of SceneBuilder.
    /// All ranks of @p processes make and run it together.
    explicit Session(const std::string &file_or_text, const Overrides &overrides = {},
                     const taut::Communicator &processes = taut::Communicator());

    /// Runs to the end; @p callback sees the start and each step.
    void run(const Callback &callback = {});

    taut::Simulation &simulation() { return *runner; }
    const taut::Parameters &parameters() const { return values; }
    const std::string &folder() const { return values.output.folder; }
    std::string log() const { return text.str(); }

    /// What statistics.json says.
    nlohmann::json statistics() const;

    /// Writes all entries to a parameter file beside the results; returns its path.
    std::string write_scene() const;

  private:
    Folder scratch;
    taut::Parameters values;
    std::ostringstream text;
    std::unique_ptr<taut::Simulation> runner;
  };

  /// Runs a scene once.
  void run_scene(const std::string &file_or_text, const Overrides &overrides,
                 const Callback &callback = {});

  /// The log of a run.
  std::string log_of(const std::string &file_or_text, const Overrides &overrides = {},
                     const Callback &callback = {});

  /// What a run says: statistics.json, the log, and the table of contacts that slide.
  struct Said
  {
    nlohmann::json json;
    std::string log;
    std::map<std::string, std::vector<double>> sliding;
  };
  Said say(const std::string &file_or_text, const Overrides &overrides = {},
           const Callback &callback = {});

  /// The number of a quantity of statistics.json.
  inline double value(const nlohmann::json &quantity)
  {
    return quantity.at("value").get<double>();
  }
  inline double value(const nlohmann::json &of, const std::string &name)
  {
    return value(of.at(name));
  }

  /// What @p value gives at the start and after each step.
  std::vector<double> history_of(const std::string &file_or_text, const Overrides &overrides,
                                 const std::function<double(const taut::StepView &)> &value);

  /// Linear forms of the displacement, or slope, of a point of a wire or of a mass.
  std::vector<taut::Term> point_on_wire(const taut::StepView &view, std::size_t wire, double s,
                                        const taut::Coordinates &direction = {0., 1.},
                                        bool rotational = false);

  /// The same of a mass.
  std::vector<taut::Term> point_of_mass(const taut::StepView &view, std::size_t mass,
                                        const taut::Coordinates &direction = {0., 1.});

  /// Displacement from the undeformed structure.
  double displacement(const taut::StepView &view, const std::vector<taut::Term> &terms);

  /// The same of a point of a wire.
  double displacement(const taut::StepView &view, std::size_t wire, double s,
                      const taut::Coordinates &direction = {0., 1.}, bool rotational = false);

  /// Slope of the line that fits log(error) over log(step) best.
  double fitted_order(const std::vector<double> &steps, const std::vector<double> &errors);

  /// With all the digits that it takes to read @p x back.
  std::string number(double x);

  /// A beam that falls on stops that stiffen, and hangs in droppers that soften.
  extern const char *const beam_under_laws;

  /// Raises @p largest to the magnitude of @p value, and for good to not-a-number.
  inline void raise(double &largest, const double value)
  {
    if (std::isnan(value) || std::fabs(value) > largest)
      largest = std::fabs(value);
  }

  /// Prints a figure for the ledger, "figure | <name> | <value> <unit>", and returns the value.
  double figure(const std::string &name, double value, const std::string &unit = "1");
} // namespace verification

#endif
