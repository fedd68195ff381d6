// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/nearest_name.h"
#include "base/patterns.h"
#include "base/text.h"
#include "scene/entries.h"
#include <taut/base/archive.h>
#include <taut/cable/cable.h>
#include <taut/output/observer.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <ostream>
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
      std::vector<double> EA_of_elements, EI_at_nodes; ///< of a wire, worn as it is
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

  namespace
  {
    constexpr const char *path = "Output/section forces";
    constexpr double per_mm = 1e-3, per_mm2 = 1e-6, per_MPa = 1e6;

    [[noreturn]] void fail_unknown(const Scene &scene, const std::string &name)
    {
      std::vector<std::string> known;
      for (const Wire &wire : scene.wires)
        known.push_back(wire.name);
      for (const CustomBody &body : scene.bodies)
        if (body.type_name == "cable")
          known.push_back(body.name);
      throw EntryError(std::string(path) + "/Wires",
                       "there is no wire or cable '" + name + "'" + suggestion(name, known));
    }

    /// The cable of a body; null on ranks without it.
    const Cable *cable_of(const StepView &step, const std::size_t body, std::size_t &k)
    {
      k = step.structure.indices_of_body(body)[0];
      return k == Structure::elsewhere ? nullptr : dynamic_cast<const Cable *>(&step.structure[k]);
    }
  } // namespace

  void SectionForces::Peak::take(const double candidate, const double at, const double t)
  {
    if (std::fabs(candidate) > std::fabs(value))
      *this = {candidate, at, t};
  }

  void SectionForces::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Wires", wires, "Names of wires and cables, separated by commas",
                      List(Anything(), 0));
    prm.add_parameter("Section areas", areas,
                      "Of each of these wires, for stresses; empty: no stresses [mm^2]",
                      List(not_negative(), 0));
    prm.add_parameter("Diameters", diameters,
                      "Of each of these wires, taken as round, for stresses; empty: no stresses "
                      "[mm]",
                      List(not_negative(), 0));
  }

  void SectionForces::find_sections(const StepView &step)
  {
    if (wires.empty())
      throw EntryError(std::string(path) + "/Wires", "name the wires whose forces are wanted");
    for (const auto &[list, entry] :
         {std::pair(&areas, "Section areas"), std::pair(&diameters, "Diameters")})
      if (!list->empty() && list->size() != wires.size())
        throw EntryError(std::string(path) + "/" + entry,
                         to_text("it has ", list->size(), " values for ", wires.size(),
                                 " wires; give one for each"));
    if (areas.empty() != diameters.empty())
      throw EntryError(path, "stresses need both Section areas and Diameters");
    std::vector<Section> all;
    for (std::size_t i = 0; i < wires.size(); ++i)
      all.push_back(section_of(i, step));
    sections = std::move(all);
  }

  SectionForces::Section SectionForces::section_of(const std::size_t i, const StepView &step) const
  {
    Section section;
    section.area = areas.empty() ? 0. : areas[i] * per_mm2;
    section.diameter = diameters.empty() ? 0. : diameters[i] * per_mm;
    section.index = find_name(step.scene.wires, wires[i]);
    if (section.index != ground)
    {
      set_motions(section, step);
      return section;
    }
    section.is_cable = true;
    section.index = find_name(step.scene.bodies, wires[i]);
    if (section.index == ground || step.scene.bodies[section.index].type_name != "cable")
      fail_unknown(step.scene, wires[i]);
    return section;
  }

  void SectionForces::set_motions(Section &section, const StepView &step) const
  {
    const Wire &wire = step.scene.wires[section.index];
    section.tension = wire.tension;
    section.EA = wire.has_axial ? wire.axial_stiffness : 0.;
    section.EI = wire.transverse == TransverseKind::beam ? wire.bending_stiffness : 0.;
    section.nodes = grid(step.scene, section.index);
    for (std::size_t i = 0; i < section.nodes.size(); ++i)
    {
      const double s = section.nodes[i];
      section.x.push_back(wire.at(s).x);
      section.EI_at_nodes.push_back(section.EI *
                                    Wire::Remaining::share(wire.remaining.bending_stiffness, s));
      if (i > 0)
        section.EA_of_elements.push_back(section.EA *
                                         Wire::Remaining::share(wire.remaining.axial_stiffness,
                                                                .5 * (section.nodes[i - 1] + s)));
    }
    const auto find = [&](const WireMotion motion, Motion &forms)
    {
      for (const double s : section.nodes)
      {
        forms.at_nodes.emplace_back();
        step.structure.motion(section.index, s, motion, forms.at_nodes.back());
      }
      forms.values.resize(section.nodes.size());
    };
    if (section.EA > 0.)
      find(WireMotion::axial, section.axial);
    if (section.EI > 0.)
    {
      find(WireMotion::transverse, section.across);
      find(WireMotion::slope, section.slope);
    }
    if (section.EI > 0. && wire.has_lateral)
    {
      find(WireMotion::lateral, section.lateral);
      find(WireMotion::lateral_slope, section.lateral_slope);
    }
  }

  void SectionForces::record(const StepView &step)
  {
    if (sections.empty())
      step.structure.communicator().agree([&] { find_sections(step); });
    for (Section &section : sections)
      if (section.is_cable)
        measure_cable(section, step);
      else
        measure_wire(section, step);
  }

  void SectionForces::take(Section &section, const double N, const double M, const double x,
                           const double time)
  {
    const double d = section.diameter,
                 modulus = dealii::numbers::PI * d * d * d / 32.; // I / (d / 2)
    section.force.take(N, x, time);
    section.moment.take(M, x, time);
    if (section.area > 0. && modulus > 0.)
      section.stress.take(N / section.area + M / modulus, x, time);
  }

  void SectionForces::measure_cable(Section &section, const StepView &step)
  {
    std::size_t k;
    const Cable *const cable = cable_of(step, section.index, k);
    double n = cable ? cable->n_sections() : 0.;
    step.structure.communicator().sum(&n, 1);
    of_cable.assign(3 * static_cast<std::size_t>(n), 0.);
    if (cable)
    {
      U = step.state.U[k];
      for (std::size_t i = 0; i < U.size(); ++i)
        U[i] += step.reference.displacement[k][i];
      std::size_t i = 0;
      for (const Cable::Section &at : cable->sections(U))
        for (const double value : {at.place.x, at.tension, at.moment})
          of_cable[i++] = value;
    }
    step.structure.communicator().sum(of_cable);
    for (std::size_t i = 0; i < of_cable.size(); i += 3)
      take(section, of_cable[i + 1], of_cable[i + 2], of_cable[i], step.state.time);
  }

  void SectionForces::measure_wire(Section &section, const StepView &step)
  {
    const Wire &wire = step.scene.wires[section.index];
    for (Motion *const motion : {&section.axial, &section.across, &section.slope, &section.lateral,
                                 &section.lateral_slope})
    {
      for (std::size_t i = 0; i < motion->at_nodes.size(); ++i)
        motion->values[i] = evaluate(motion->at_nodes[i], step.reference.displacement) +
                            evaluate(motion->at_nodes[i], step.state.U);
      step.structure.communicator().sum(motion->values);
    }
    for (std::size_t i = 0; i + 1 < section.nodes.size(); ++i)
    {
      const double h = section.nodes[i + 1] - section.nodes[i];
      double N = section.tension;
      for (const TensionChange &change : wire.tension_changes)
        if (.5 * (section.nodes[i] + section.nodes[i + 1]) > change.from &&
            .5 * (section.nodes[i] + section.nodes[i + 1]) < change.to)
          N += change.change;
      if (section.EA > 0.)
        N +=
            section.EA_of_elements[i] * (section.axial.values[i + 1] - section.axial.values[i]) / h;
      // Of the cubic of Hermite between two nodes, at its first and its second end.
      const auto curvature = [&](const Motion &w, const Motion &theta, const bool second)
      {
        if (w.values.empty())
          return 0.;
        const double difference = 6. * (w.values[i + 1] - w.values[i]) / (h * h),
                     a = theta.values[i], b = theta.values[i + 1];
        return second ? -difference + (2. * a + 4. * b) / h : difference - (4. * a + 2. * b) / h;
      };
      for (const bool second : {false, true})
        take(section, N,
             section.EI_at_nodes[second ? i + 1 : i] *
                 std::hypot(curvature(section.across, section.slope, second),
                            curvature(section.lateral, section.lateral_slope, second)),
             section.x[second ? i + 1 : i], step.state.time);
    }
  }

  std::vector<NamedQuantity> SectionForces::quantities() const
  {
    std::vector<NamedQuantity> result;
    for (std::size_t i = 0; i < wires.size(); ++i)
    {
      const Section section = sections.empty() ? Section() : sections[i];
      const auto add =
          [&](const std::string &what, const Peak &peak, const std::string &unit, const double size)
      {
        result.push_back({wires[i], "largest " + what, peak.value / size, unit});
        result.push_back({wires[i], "x of the largest " + what, peak.x, "m"});
        result.push_back({wires[i], "time of the largest " + what, peak.time, "s"});
      };
      add("tension", section.force, "N", 1.);
      add("bending moment", section.moment, "N m", 1.);
      if (!areas.empty())
        add("stress", section.stress, "Pa", 1.);
    }
    return result;
  }

  void SectionForces::report(std::ostream &log, bool) const
  {
    for (std::size_t i = 0; i < sections.size(); ++i)
    {
      const Section &s = sections[i];
      const auto text = [](const Peak &peak, const double size, const char *const unit)
      {
        return to_text(std::setprecision(4), peak.value / size, unit, " at x = ", peak.x,
                       " m, t = ", peak.time, " s");
      };
      log << "Section of " << (s.is_cable ? "cable" : "wire") << " '" << wires[i]
          << "': largest tension " << text(s.force, 1., " N") << "; bending moment "
          << text(s.moment, 1., " N m");
      if (!areas.empty())
        log << "; stress " << text(s.stress, per_MPa, " N/mm^2");
      log << '\n';
    }
  }

  void SectionForces::save(OutputArchive &archive)
  {
    for (const Section &section : sections)
      archive << section.force << section.moment << section.stress;
  }

  void SectionForces::resume(InputArchive &archive, const StepView &step)
  {
    step.structure.communicator().agree([&] { find_sections(step); });
    for (Section &section : sections)
      archive >> section.force >> section.moment >> section.stress;
  }

  namespace
  {
    const Register<Observer, SectionForces> register_section_forces(
        "section forces",
        "largest tension, bending moment and stress of wires and cables, with place and "
        "time, in the log, statistics.json and sweeps");
  }
} // namespace taut
