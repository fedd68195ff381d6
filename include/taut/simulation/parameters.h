// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_parameters_h
#define taut_parameters_h

#include <taut/base/exceptions.h>
#include <taut/output/observer.h>
#include <taut/output/statistics.h>
#include <taut/partition/make_partition.h>
#include <taut/scene/named_items.h>
#include <taut/scene/scene_generator.h>
#include <taut/simulation/parameter_file.h>
#include <taut/simulation/study_parameters.h>
#include <taut/simulation/sweep_parameters.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>
#include <taut/time/step_control.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace taut
{
  /// Where results go, and how often.
  struct OutputParameters
  {
    std::string folder = "results", tables = "csv";
    double interval = 0., link_interval = 0.01, field_interval = 0.1;
    double checkpoint_interval = 0.;
    unsigned int subdivisions = 1;
    std::vector<std::string> observers; ///< registered names
    bool overwrite = false;             ///< from the command line, not from the file
    bool resume = false;                ///< from the command line
    bool writes = true;                 ///< false: a run leaves nothing on the disk

    /// A probe by name.
    struct ProbeItem
    {
      std::string point;
      std::vector<double> direction, axis;
      bool rotational = false;
      void declare(dealii::ParameterHandler &prm);
    };
    NamedItems<ProbeItem> probes{"Output", "Probes", "Probe", "points whose motion is recorded"};

    void declare_names(dealii::ParameterHandler &prm);
    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// Everything a parameter file says. Members hold the defaults until read() has run.
  class Parameters
  {
  public:
    Parameters();
    ~Parameters();

    /**
     * Reads a .prm file; @p overrides are "Section.Entry=value" and replace entries of the
     * file. With Study/Accuracy, entries that the stored study varied get the values it recommends.
     * Only the root of @p processes reads, and hands on to all ranks. Throws UserError with file,
     * line, entry, value and what is allowed.
     */
    void read(const std::string &file, const std::vector<std::string> &overrides = {},
              const Communicator &processes = Communicator());

    /**
     * Replaces entries of what was read on this process, "Section/Entry=value": the result is that
     * of read() with these overrides besides, for a small part of its cost. False where only read()
     * gets there: an entry decides which others there are, a value is not allowed, or a stored
     * study was asked. Entries may then be changed in part. Throws UserError as read() does.
     */
    bool change(const std::vector<std::string> &overrides);

    /// Leaves all entries at their defaults, for print().
    void set_defaults();

    /// Writes all entries with their present values and help, as a .prm file; after read() or
    /// set_defaults().
    void print(std::ostream &out) const;

    /// True if a file that print() wrote has the same entries, but for folders.
    bool has_entries_of(const std::string &printed) const;

    /// The scene of the generator with gravity, start and probes, checked.
    Scene scene() const;

    /// The message of an error about an entry, with file, line and value.
    std::string explain(const EntryError &error) const
    {
      return file.locate(error.entry()) + ": " + error.message();
    }

    std::vector<std::string> shared_libraries;
    BodyParameters bodies;
    ContactParameters contacts;
    std::string generator_name = "catenary";
    std::vector<double> gravity = {0., -9.81};
    std::string start = "equilibrium";

    std::string scheme = "automatic";
    double step = 1e-3, end_time = 6.912;
    std::string mass_redistribution = "automatic";
    bool allow_unsuitable_scheme = false;
    std::string check_steps = "automatic"; ///< or "yes", "no"
    bool allow_energy_gain = false;
    StepParameters step_parameters;

    SolverParameters solver;
    PartitionParameters partition;
    OutputParameters output;
    StatisticsParameters statistics;
    StudyParameters study;
    SweepParameters sweep;

    /// Where the stored study is, or goes.
    std::string study_folder() const
    {
      return study.folder.empty() ? output.folder + "/study" : study.folder;
    }

    /// All entries by path, "Section/Entry", with their values as text; after read().
    const std::map<std::string, std::string> &values() const { return entry_values; }

    /// What a stored study chose for Study/Accuracy; empty if that was not asked for.
    const std::string &accuracy_choice() const { return choice; }

    /// The scheme of this name with its parameters.
    const TimeIntegrator &integrator(const std::string &name) const
    {
      return *integrators.at(name);
    }

    /// The largest that a scheme has in the file, taken or not: a law of the contacts for whatever
    /// 'automatic' takes [1].
    double restitution() const;

    /// A scheme with the parameters that the file gives it, but for these entries of its section.
    std::unique_ptr<TimeIntegrator>
    integrator(const std::string &name, const std::map<std::string, std::string> &entries) const;

    /// A new observer of this name with the entries that the file gives it.
    std::unique_ptr<Observer> make_observer(const std::string &name) const;

    /// "Time/Newmark/Beta = 0.3" of each entry of a scheme that is not at its default and has no
    /// part in this one.
    std::vector<std::string>
    unused_scheme_entries(const std::string &name,
                          const std::map<std::string, std::string> &entries) const;

    /// "Body bar/Velocity = 1, 0, 0 (without Start = given)" of each entry of a body, contact, mass
    /// or wire that is not at its default and has no part in a scene like this one.
    std::vector<std::string> unused_entries() const;

    /// The parameter file, without its folder.
    std::string file_name() const;

    /// True if Time/Mass redistribution leaves to the choice of the scheme which nodes have mass.
    bool chooses_contact_mass() const
    {
      return scheme == "automatic" && mass_redistribution == "automatic" && end_time > 0.;
    }

  private:
    void read_entries(const std::string &file, const std::vector<std::string> &overrides,
                      const Communicator &processes);
    void read_structure(const std::string &text);
    void check_values() const;
    void begin_entries();
    void keep_values();
    void create_integrators();
    void create_observers();
    void declare_observers(dealii::ParameterHandler &prm);
    void declare(dealii::ParameterHandler &prm);
    void declare_time(dealii::ParameterHandler &prm);

    std::string choice;
    /// All entries with the members that they set: an object stays where it is.
    std::unique_ptr<dealii::ParameterHandler> entries;
    std::set<std::string> structural_entries; ///< those that decide which others there are
    std::map<std::string, std::string> entry_values, entry_defaults;
    ParameterFile file;
    std::unique_ptr<SceneGenerator> generator;
    std::map<std::string, std::unique_ptr<TimeIntegrator>> integrators;
    std::map<std::string, std::unique_ptr<Observer>> observers; ///< those that declare the entries
  };
} // namespace taut

#endif
