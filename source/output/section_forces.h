// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_section_forces_h
#define taut_section_forces_h

#include <taut/output/observer.h>

#include <string>
#include <vector>

namespace taut
{
  /**
   * The largest section forces of wires and cables, over all steps and all nodes, of wires:
   *
   *     N = T + EA u'    M = EI w"    sigma = N / A + |M| d / (2 I),   I = pi d^4 / 64
   *
   * with the tension T of the wire, its axial displacement u and its displacement w across; in
   * space M is sqrt(M_y^2 + M_z^2). A string has no M. sigma is that of a round section of diameter
   * d and area A. u' is the mean of an element, w" that at its ends: under a distributed load q the
   * error of M is q h^2 / 12 with the length h of the element. Those of cables are of
   * Cable::sections(), in the middles of elements, too.
   *
   * The quantities of a wire or cable are numbers of statistics.json and of sweeps.
   */
  class SectionForces : public Observer
  {
  public:
    void declare_parameters(dealii::ParameterHandler &prm) override;
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;
    std::vector<NamedQuantity> quantities() const override;
    void report(std::ostream &log, bool failed) const override;

  private:
    /// A value with its place and time.
    struct Peak
    {
      double value = 0., x = 0., time = 0.; ///< [N, N m, N/m^2; m; s]
      void take(double candidate, double x, double time);

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &value &x &time;
      }
    };

    /// A motion of all nodes of a wire.
    struct Motion
    {
      std::vector<std::vector<Term>> at_nodes;
      std::vector<double> values; ///< in the step [m, 1]
    };

    struct Section
    {
      bool is_cable = false;
      std::size_t index = 0;        ///< of the wire or body
      std::vector<double> nodes, x; ///< s and x [m]
      Motion axial, across, slope, lateral, lateral_slope;
      double tension = 0., EA = 0., EI = 0., area = 0., diameter = 0.;
      Peak force, moment, stress;
    };

    void find_sections(const StepView &step);
    Section section_of(std::size_t i, const StepView &step) const;
    void set_motions(Section &section, const StepView &step) const;
    void measure_wire(Section &section, const StepView &step);
    void measure_cable(Section &section, const StepView &step);
    void take(Section &section, double N, double M, double x, double time);

    std::vector<std::string> wires;
    std::vector<double> areas, diameters; ///< [mm^2, mm]
    std::vector<Section> sections;        ///< empty before the first step
    std::vector<double> of_cable, U; ///< x, N and M of each section, and a displacement [m, N, N m]
  };
} // namespace taut

#endif
