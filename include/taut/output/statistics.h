// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_statistics_h
#define taut_statistics_h

#include <taut/base/warning.h>
#include <taut/output/contact_quantities.h>
#include <taut/output/observer.h>
#include <taut/output/sliding_contacts.h>
#include <taut/output/spans.h>
#include <taut/output/support_figures.h>

#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

namespace taut
{
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

  /// Statistics of a run: contact forces of sliding contacts, of a strip the sum over its wires,
  /// raw and low-passed, in a window; contact loss; the same of sums of contacts; uplift of the
  /// probes; open time, largest force and impulse of the fixed links; forces of supports while a
  /// sliding contact is in the window, or in the whole run without such contacts; certificates.
  class Statistics : public Observer
  {
  public:
    /// Throws the errors of contact_sums().
    Statistics(const StatisticsParameters &parameters, const Scene &scene, const Constraints &rows);

    /// Measures the sags of the spans at the displacements @p rest of the line alone; without it
    /// they are 0. Called by all ranks together.
    void find_sags(const Scene &scene, const SceneBodies &bodies, const BodyVectors &rest);

    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

    std::size_t n_contacts() const { return contacts.size(); }

    /// @p contact counts the sliding contacts in the order of the scene; a strip is one.
    ContactQuantities contact_quantities(std::size_t contact) const
    {
      return measure(contacts[contact]);
    }

    /// Force of one of the wires of a strip, at the times when the strip is in the window. Its loss
    /// is the share of the samples in which the wire is not touched.
    ContactQuantities share(std::size_t contact, std::size_t wire) const
    {
      return measure(contacts[contact], contacts[contact].wires[wire]);
    }

    /// Links of the scene whose forces a sum adds up; empty: there is no such sum.
    std::vector<std::size_t> links_of_sum(const std::string &name) const;

    /// Largest displacement of a probe [m, rad].
    double largest_displacement(std::size_t probe) const { return probes[probe].largest; }

    /// All quantities that are one number; sliding contacts count with their filtered force.
    std::vector<NamedQuantity> named_quantities() const;

    /// Largest residuals of all steps.
    const Residuals &worst_residuals() const { return worst; }

    /// Prints the table of quantities with their expected ranges.
    void report(std::ostream &log, bool failed) const override;

    /// Writes the table as JSON, with the quantities of @p others. Throws UserError if the file
    /// cannot be written.
    void write(const std::string &path, const RunDescription &run,
               const std::vector<NamedQuantity> &others = {}) const;

    /// Writes the tables of StatisticsParameters::tables into a folder. Throws UserError if a file
    /// cannot be written.
    void write_tables(const std::string &folder) const;

    /// Time of the last recorded step, or 0 [s].
    double until() const { return times.empty() ? 0. : times.back(); }

  private:
    /// Record of one sliding contact: a link, or a strip with its wires.
    struct Contact
    {
      SlidingContact of;
      std::vector<double> places = {}; ///< position and height of each step, in turn [m]
      std::size_t wire = ground; ///< whose positions count; none for a contact on another body
      bool has_height = false;
      std::vector<Term> foot = {};           ///< displacement of its `from` end along its direction
      std::vector<ContactRecord> wires = {}; ///< without positions
    };
    /// Quantities of a fixed link.
    struct LinkQuantities
    {
      std::size_t link; ///< index
      std::string name;
      bool unilateral = false, rotates = false;
      double open_time = 0., closed_time = 0., largest_force = 0., impulse = 0.;
      double largest_impulse = 0., last_force = 0.;
      bool is_dropper = false;
      LinkForce dropper = {};
    };

    /// Displacement of a probe from rest, or its velocity or acceleration.
    struct ProbeQuantities
    {
      std::string name, unit;
      double largest = 0., smallest = 0., last = 0.;
    };

    void record_links(const StepView &step, double dt);
    void record_residuals(const StepView &step);
    bool is_in_window() const;
    template <typename Archive>
    void store(Archive &archive);
    void record_contacts(const StepView &step);
    static double height_of(Contact &contact, const StepView &step);
    static void add_places(const Contact &contact, ContactRecord &record);
    ContactRecord sum(const Contact &contact) const;
    ContactRecord judged(const Contact &contact) const;
    ContactQuantities measure(const Contact &contact) const;
    ContactQuantities measure(const Contact &contact, ContactRecord wire) const;
    ContactQuantities measure(const ContactSum &sum) const;

    /// A figure of an item: one entry for log, file, studies and sweeps.
    struct Figure
    {
      std::string name, unit;                                ///< SI, or "share"
      double value;                                          ///< not a number: there is none
      double raw = std::numeric_limits<double>::quiet_NaN(); ///< of the unfiltered force
      std::vector<double> expected = {};                     ///< range in unit_shown(); empty: none
      bool shown_if_zero = true;                             ///< in the log

      /// In the log, and for ranges, displacements are in mm and mrad, shares in %.
      double factor() const
      {
        return unit == "share" ? 100. : unit == "m" || unit == "rad" ? 1e3 : 1.;
      }
      std::string unit_shown() const
      {
        return unit == "share" ? "%" : factor() > 1. ? "m" + unit : unit;
      }
      double shown() const { return factor() * value; }
      std::string unit_in_files() const { return unit == "share" ? "1" : unit; }
    };

    /// What has figures: a contact, sum, wire of a strip, probe, link, support or span.
    struct Item
    {
      std::vector<std::string> path; ///< keys in the file; the last one is the name of the item
      std::vector<Figure> figures;
      bool is_force = false; ///< of a contact or a sum, raw and filtered
    };

    /// All items, always the same ones with the same figures. What has a new figure says it in its
    /// figures_of(), which log, file, studies and sweeps print.
    std::vector<Item> items() const;

    /// Of a contact force or a sum, with expected ranges if @p compared.
    std::vector<Figure> figures_of(const ContactQuantities &force, bool compared) const;
    std::vector<Figure> figures_of(const ProbeQuantities &probe) const;
    static std::vector<Figure> figures_of(const LinkQuantities &link);
    static std::vector<Figure> figures_of(const SupportFigures::Figures &support);
    static std::vector<Figure> figures_of(const LineConstants &line);
    static std::vector<Figure> figures_of_share(const ContactQuantities &share);

    /// Bands of frequency, losses by duration and the height of a contact.
    std::vector<Figure> details_of(const Contact &contact) const;

    /// Sag, slackenings of the droppers that hold it, and forces of the contacts on its wire from
    /// the judged() record of each contact.
    std::vector<Figure> figures_of(const SpannedWire &wire, const Span &span,
                                   const std::vector<ContactRecord> &records) const;

    std::vector<double> expected_range(const std::string &quantity) const;

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
    void print_head(const std::string &of, const ContactQuantities &quantities,
                    std::ostream &out) const;
    static void print_rows(const std::vector<Figure> &rows, double size, bool judged,
                           std::ostream &out);
    void print_contact(const Contact &contact, std::ostream &out) const;
    void print_shares(const Contact &contact, double size, std::ostream &out) const;
    void print_sum(const ContactSum &sum, std::ostream &out) const;
    void print_links(std::ostream &out) const;

    StatisticsParameters parameters;
    std::vector<LineConstants> lines;
    std::vector<SpannedWire> spanned;
    std::vector<Contact> contacts;
    std::vector<ContactSum> sums;
    std::vector<LinkQuantities> links;
    std::vector<std::size_t> index_of_link; ///< among them, of each link
    std::vector<double> of_links;           ///< of one step
    std::vector<ProbeQuantities> probes;
    SupportFigures supports;
    std::vector<double> times;
    Residuals worst;
    const ContactMeasures *measures = nullptr; ///< of the last step
    const Constraints *rows = nullptr;
    double worst_complementarity_time = 0., worst_balance_time = 0.;
    std::size_t n_steps = 0, n_iterations = 0, n_fallbacks = 0;
  };
} // namespace taut

#endif
