// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_statistics_h
#define taut_statistics_h

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
  /// What is evaluated, and what is expected of it.
  struct StatisticsParameters
  {
    std::vector<double> window;    ///< positions of a sliding contact [m]; empty: the whole run
    double filter_frequency = 20.; ///< [Hz]

    /// Lower and upper bound by figure; empty: none.
    std::map<std::string, std::vector<double>> expected;

    /// Declares the members in subsection "Statistics".
    void declare_parameters(dealii::ParameterHandler &prm);
  };

  /// Mean, standard deviation and extremes of a record.
  struct Moments
  {
    double mean = 0., deviation = 0., minimum = 0., maximum = 0.;
    static Moments of(const std::vector<double> &record);
  };

  /**
   * Statistics of a run: contact forces of sliding contacts, raw and low-passed, in a window;
   * contact loss; uplift of the probes; open time, largest force and impulse of the fixed links;
   * extremes of the forces of supports; certificates.
   */
  class Statistics : public Observer
  {
  public:
    Statistics(const StatisticsParameters &parameters, const Scene &scene, const ContactRows &rows);

    void record(const StepView &step) override;

    /// Contact force of one sliding contact in the window.
    struct ContactFigures
    {
      Moments raw, filtered;
      double loss = 0.;
      std::size_t n_samples = 0;
      bool is_filtered = false;
    };
    std::size_t n_contacts() const { return contacts.size(); }

    /// @p contact counts the sliding contacts in the order of the scene.
    ContactFigures contact_figures(std::size_t contact) const { return figures(contacts[contact]); }

    /// Largest displacement of a probe [m, rad].
    double largest_displacement(std::size_t probe) const { return uplift[probe]; }

    /// A figure of a sliding contact, another link or a probe.
    struct NamedFigure
    {
      std::string item, quantity;
      double value; ///< [N, N m, m, rad, s, N s, N m s]; contact loss [1]
    };

    /// All figures that are one number; of a sliding contact of its filtered force.
    std::vector<NamedFigure> named_figures() const;

    /// Largest residuals of all steps.
    const Certificate &worst_certificate() const { return worst; }

    /// The table, with the expected ranges beside the figures.
    void print(std::ostream &out) const;

    /// The same as JSON. @p is_partial marks a run that ended before its end. Throws UserError if
    /// the file cannot be written.
    void write(const std::string &path, bool is_partial = false) const;

    /// Time of the last step recorded, 0 without one [s].
    double until() const { return times.empty() ? 0. : times.back(); }

  private:
    /// Record of one sliding contact.
    struct Contact
    {
      std::string name;
      std::size_t row;
      std::vector<double> position, force;
      std::vector<double> mean_force = {}; ///< over the time that the element resolves
    };
    /// What a fixed link did.
    struct LinkFigures
    {
      double open_time = 0., closed_time = 0., largest_force = 0., impulse = 0.;
      double largest_impulse = 0.;
    };

    /// Force of a support.
    struct SupportFigures
    {
      double start = 0., largest = 0., smallest = 0.;
    };

    ContactFigures figures(const Contact &contact) const;

    /// Expected range of the largest displacement of a probe [mm]; none for a rotation.
    const std::vector<double> *uplift_range(std::size_t probe) const;

    /// Rows of the table: figure, unit, value.
    struct Figure
    {
      std::string name, unit;
      double value;
    };
    std::vector<Figure> table(const ContactFigures &figures) const;

    StatisticsParameters parameters;
    std::vector<Contact> contacts;
    std::vector<std::string> link_names, probe_names;
    std::vector<char> link_unilateral;
    std::vector<LinkFigures> link_figures;
    std::vector<char> probe_rotates;
    std::vector<double> uplift, lowering, last; ///< of the probes, from rest
    std::vector<std::string> support_names;
    std::vector<SupportFigures> support_figures;
    std::vector<double> times;
    Certificate worst;
    const ContactMeasures *measures = nullptr; ///< of the last step
    const ContactRows *rows = nullptr;
    double worst_complementarity_time = 0., worst_balance_time = 0.;
    std::size_t n_steps = 0, n_iterations = 0, n_fallbacks = 0;
  };
} // namespace taut

#endif
