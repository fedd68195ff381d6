// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_statistics_h
#define taut_statistics_h

#include <taut/output/model_limits.h>
#include <taut/output/observer.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// Parameters of the statistics, with expected ranges.
  struct StatisticsParameters
  {
    std::vector<double> window;    ///< positions of a sliding contact [m]; empty: whole run
    double filter_frequency = 20.; ///< [Hz]

    /// Lower and upper bound by quantity; empty: no bounds.
    std::map<std::string, std::vector<double>> expected;

    /// Declares the members in subsection "Statistics".
    void declare_parameters(dealii::ParameterHandler &prm);

    /// Throws an EntryError if no sliding contact enters the window before @p end_time [s].
    void check_window(const Scene &scene, double end_time) const;
  };

  /// Description of the run in the file of statistics.
  struct RunDescription
  {
    std::string scene;          ///< name of the parameter file
    std::string generator;      ///< of the scene
    std::string scheme;         ///< of the time integration, with its parameters
    double step = 0., end = 0.; ///< [s]
    bool is_partial = false;    ///< the run ended early
    std::vector<Warning> warnings;
  };

  /// Mean, standard deviation and extremes of a record.
  struct Moments
  {
    double mean = 0., deviation = 0., minimum = 0., maximum = 0.;
    static Moments of(const std::vector<double> &record);
  };

  /// Statistics of a run: contact forces of sliding contacts, raw and low-passed, in a window;
  /// contact loss; uplift of the probes; open time, largest force and impulse of the fixed links;
  /// extremes of the forces of supports; certificates.
  class Statistics : public Observer
  {
  public:
    Statistics(const StatisticsParameters &parameters, const Scene &scene, const Constraints &rows);

    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    /// Contact force of one sliding contact in the window.
    struct ContactQuantities
    {
      Moments raw, filtered;
      double loss = 0.;
      std::size_t n_samples = 0;
      bool is_filtered = false;
      bool is_complete = true;     ///< the contact passed the whole window
      double begin = 0., end = 0.; ///< positions of the first and last sample [m]
      double longest_step = 0.;    ///< that resolves the filter frequency; 0: no filter [s]

      /// Whether expected ranges apply, which are for the filtered force.
      bool are_judged() const { return n_samples > 0 && (is_filtered || longest_step == 0.); }
    };
    std::size_t n_contacts() const { return contacts.size(); }

    /// @p contact counts the sliding contacts in the order of the scene.
    ContactQuantities contact_quantities(std::size_t contact) const
    {
      return quantities(contacts[contact]);
    }

    /// Largest displacement of a probe [m, rad].
    double largest_displacement(std::size_t probe) const { return probes[probe].largest; }

    /// A quantity of a sliding contact, another link or a probe.
    struct NamedQuantity
    {
      std::string item, quantity;
      double value;
      std::string unit;
    };

    /// All quantities that are one number; sliding contacts count with their filtered force.
    std::vector<NamedQuantity> named_quantities() const;

    /// Largest residuals of all steps.
    const Certificate &worst_certificate() const { return worst; }

    /// Prints the table of quantities with their expected ranges.
    void report(std::ostream &log, bool failed) const override;

    /// Writes the table as JSON. Throws UserError if the file cannot be written.
    void write(const std::string &path, const RunDescription &run) const;

    /// Time of the last recorded step, or 0 [s].
    double until() const { return times.empty() ? 0. : times.back(); }

  private:
    /// Record of one sliding contact.
    struct Contact
    {
      std::string name;
      std::size_t link; ///< of the scene
      std::vector<double> position, force;
      std::vector<double> mean_force = {}; ///< over the time that the element resolves
    };
    /// Quantities of a fixed link.
    struct LinkQuantities
    {
      std::string name;
      bool unilateral = false, rotates = false;
      double open_time = 0., closed_time = 0., largest_force = 0., impulse = 0.;
      double largest_impulse = 0.;
    };

    /// Displacement of a probe from rest.
    struct ProbeQuantities
    {
      std::string name;
      bool rotates = false;
      double largest = 0., smallest = 0., last = 0.;
    };

    /// Force of a support.
    struct SupportQuantities
    {
      std::string name;
      bool is_moment = false;
      double start = 0., largest = 0., smallest = 0.;
    };

    void record_links(const StepView &step, double dt);
    void record_certificate(const StepView &step);
    template <typename Archive>
    void store(Archive &archive);
    ContactQuantities quantities(const Contact &contact) const;

    /// A row of a table.
    struct Quantity
    {
      std::string name, unit;
      double value;
      const std::vector<double> *expected = nullptr; ///< range in the same unit
    };

    /// Rows of a sliding contact: raw force if @p raw, otherwise filtered force and loss.
    std::vector<Quantity> table(const ContactQuantities &quantities, bool raw) const;

    /// Rows with the largest and smallest displacement of a probe.
    std::vector<Quantity> table(const ProbeQuantities &probe) const;

    const std::vector<double> *expected_range(const std::string &quantity) const;

    /// Comparison of the quantities with their expected ranges.
    struct Verdict
    {
      std::size_t n_inside = 0, n_outside = 0;
      bool is_complete = true; ///< all expected quantities were compared
      std::string text() const;
    };
    Verdict verdict() const;
    class Json; ///< parts of the file
    std::string window_text(const ContactQuantities &quantities) const;
    void print_contact(const Contact &contact, std::ostream &out) const;
    void print_links(std::ostream &out) const;

    StatisticsParameters parameters;
    std::vector<Contact> contacts;
    std::vector<LinkQuantities> links;
    std::vector<ProbeQuantities> probes;
    std::vector<SupportQuantities> supports;
    std::vector<double> times;
    Certificate worst;
    const ContactMeasures *measures = nullptr; ///< of the last step
    const Constraints *rows = nullptr;
    double worst_complementarity_time = 0., worst_balance_time = 0.;
    std::size_t n_steps = 0, n_iterations = 0, n_fallbacks = 0;
  };
} // namespace taut

#endif
