// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_parameters_h
#define taut_parameters_h

#include <taut/base/exceptions.h>
#include <taut/output/observer.h>
#include <taut/output/statistics.h>
#include <taut/scene/named_items.h>
#include <taut/scene/scene_generator.h>
#include <taut/simulation/parameter_file.h>
#include <taut/simulation/study_parameters.h>
#include <taut/time/integrator.h>
#include <taut/time/step_parameters.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  struct Scene;
  /// Place and interval of results.
  struct OutputParameters
  {
    std::string folder = "results", tables = "csv";
    double interval = 0., link_interval = 0.01, field_interval = 0.1;
    double checkpoint_interval = 0.;
    unsigned int subdivisions = 1;
    std::vector<std::string> observers; ///< registered names
    bool overwrite = false;             ///< from the command line, not from the file
    bool resume = false;                ///< from the command line
    bool writes = true;                 ///< false: a run writes no files

    NamedItems<ProbeItem> probes{"Output", "Probes", "Probe", "points whose motion is recorded"};

    void declare_names(dealii::ParameterHandler &prm);
    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// Parameters of time integration.
  struct TimeParameters
  {
    std::string scheme = "automatic";
    double step = 1e-3;        ///< [s]
    std::string end = "6.912"; ///< as in the file
    double end_time = 6.912;   ///< that follows from it [s]
    std::string mass_redistribution = "automatic";
    bool allow_unsuitable_scheme = false;
    std::string check_steps = "automatic"; ///< or "yes", "no"
    bool allow_energy_gain = false;
    StepParameters step_parameters;

    /// Declares the members in the current subsection.
    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// All parameters of a file; members have default values before read().
  class Parameters : public TimeParameters
  {
  public:
    Parameters();
    ~Parameters();

    /**
     * Reads a .prm file; @p overrides are "Section.Entry=value" and replace its entries. With
     * Study/Accuracy, entries that the stored study varied get its recommended values. Only the
     * root of @p processes reads, and sends the entries to all ranks. Throws UserError with file,
     * line, entry, value and allowed values.
     */
    void read(const std::string &file, const std::vector<std::string> &overrides = {},
              const Communicator &processes = Communicator());

    /**
     * Replaces entries on this process, "Section/Entry=value", with the result of read() with
     * additional overrides for a small part of its cost. False if only read() can do this: an entry
     * decides which others exist, a value is not allowed, or a stored study was used. Entries may
     * then be changed in part. Throws UserError as read() does.
     */
    bool change(const std::vector<std::string> &overrides);

    /// For messages: overrides of @p entry in later calls of read() and change() are from @p place,
    /// not from the command line.
    void set_origin(const std::string &entry, const std::string &place)
    {
      file.set_origin(entry, place);
    }

    /// "file:line" of an entry, "--set", or the file if it does not set the entry.
    std::string place_of(const std::string &entry) const { return file.place_of(entry); }

    /// Unit of an entry, what its help has in brackets at its end; empty without one. After read().
    std::string unit_of(const std::string &entry) const;

    /// Sets all entries to their defaults, for print().
    void set_defaults();

    /// Writes all entries with present values and help, as a .prm file; after read() or
    /// set_defaults().
    void print(std::ostream &out) const;

    /// True if a file from print() has the same entries, except for folders.
    bool has_entries_of(const std::string &printed) const;

    /// The scene of the generator with gravity, start and probes, checked.
    Scene scene() const;

    /// Of the generator, see SceneGenerator::warnings().
    std::vector<std::string> scene_warnings() const { return generator->warnings(); }

    /// The scene as the generator fills it, without what other sections add, and not checked.
    Scene generated_scene() const;

    /**
     * The parameter file with the scene of its generator written out: `Generator = network`, an
     * item for each wire, support, mass, spring, link, load and probe, and all other entries as
     * given. Parameters of studies and sweeps that vary entries of the generator are left out; @p
     * left_out gets their sections. A file for the generator `network` remains as it is, with its
     * includes and overrides. Throws UserError for what no entry says.
     */
    std::string as_network(std::vector<std::string> &left_out) const;

    /// Message of an error about an entry, with file, line and value.
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

    SolverParameters solver;
    PartitionParameters partition;
    OutputParameters output;
    StatisticsParameters statistics;
    StudyParameters study;
    SweepParameters sweep;
    ElasticityParameters elasticity;

    /// Folder of the stored study.
    std::string study_folder() const
    {
      return study.folder.empty() ? output.folder + "/study" : study.folder;
    }

    /// All entries by path, "Section/Entry", with their values as text; after read().
    const std::map<std::string, std::string> &values() const { return entry_values; }

    /// Choice of a stored study for Study/Accuracy; empty: not used.
    const std::string &accuracy_choice() const { return choice; }

    const TimeIntegrator &integrator(const std::string &name) const
    {
      return *integrators.at(name);
    }

    /// Largest restitution of all schemes in the file, used or not: a law of the contacts for any
    /// choice of 'automatic' [1].
    double restitution() const;

    /// Values of all entries with a path "Section/...", by the rest of the path.
    std::map<std::string, std::string> entries_below(const std::string &section) const;

    /// For runs that write nothing: no fields, no checkpoints, and only observers with quantities
    /// and without files.
    void write_nothing();

    /// New observer of this name with its entries from the file.
    std::unique_ptr<Observer> make_observer(const std::string &name) const;

    /// "Time/Newmark/Beta = 0.3" for each entry of a scheme that is not at its default and has no
    /// effect in this scheme.
    std::vector<std::string>
    unused_scheme_entries(const std::string &name,
                          const std::map<std::string, std::string> &entries) const;

    /// "Body bar/Velocity = 1, 0, 0 (without Start = given)" for each entry of a body, contact,
    /// mass or wire that is not at its default and has no effect in this scene.
    std::vector<std::string> unused_entries() const;

    /// The parameter file, without its folder.
    std::string file_name() const;

    /// The text of the parameter file as it stands there, without those that it includes; empty if
    /// it cannot be read again.
    std::string file_text() const;

    /// True if the choice of the scheme decides which nodes have mass (Time/Mass redistribution).
    bool chooses_contact_mass() const
    {
      return scheme == "automatic" && mass_redistribution == "automatic" && end_time > 0.;
    }

  private:
    void read_entries(const std::string &file, const std::vector<std::string> &overrides,
                      const Communicator &processes);
    void check_values() const;
    double find_end_time() const;
    void begin_entries();
    void load_registered();
    void declare_in_passes(const std::string &text);
    void declare(dealii::ParameterHandler &prm);

    std::string choice;

    /// All entries with the members that they set: addresses of objects are fixed.
    struct Declared
    {
      std::unique_ptr<dealii::ParameterHandler> entries;
      std::set<std::string> structural; ///< entries that decide which others exist
      std::map<std::string, std::string> defaults;
    } declared;
    std::map<std::string, std::string> entry_values;
    ParameterFile file;
    std::unique_ptr<SceneGenerator> generator;
    std::map<std::string, std::unique_ptr<TimeIntegrator>> integrators;
    std::map<std::string, std::unique_ptr<Observer>> observers; ///< declare the entries
  };
} // namespace taut

#endif
