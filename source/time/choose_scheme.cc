// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/interface/schur_complement.h>
#include <taut/time/choose_scheme.h>
#include <taut/time/integrator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace taut
{
  namespace
  {
    /// Courant number below which BDF2's multipliers oscillate.
    constexpr double least_courant_number = .25;

    /// Wave speed times step over element size, of the wire that an attachment is on, for motion
    /// along a direction.
    double courant_number(const Scene &scene, const Attachment &end, const Point &direction,
                          const double step)
    {
      if (end.kind != Attachment::Kind::wire)
        return std::numeric_limits<double>::infinity();
      const Wire &wire = scene.wires[end.index];
      const Point t = wire.tangent(), n = wire.normal();
      double squared = std::numeric_limits<double>::infinity();
      if (wire.has_axial && std::fabs(direction.x * t.x + direction.y * t.y) > 1e-12)
        squared = wire.axial_stiffness;
      if (wire.transverse != TransverseKind::none &&
          std::fabs(direction.x * n.x + direction.y * n.y) > 1e-12)
      {
        const double wave_number = std::acos(-1.) / wire.element_size;
        squared =
            std::min(squared, wire.tension + wire.bending_stiffness * wave_number * wave_number);
      }
      return std::sqrt(squared / wire.mass_per_length) * step / wire.element_size;
    }

    /// An end of a one-sided row that acts as rigid.
    struct RigidContact
    {
      std::size_t row;
      double courant; ///< elements that waves of its wire cross in a step
      MassMatrix matrix;
      bool exactly_rigid;
    };

    /// True if the wire's node under a rigid link carries no mass: its force then is that of the
    /// elements beside it.
    bool is_massless(const Link &link)
    {
      return link.contact_mass != ContactMass::stays &&
             (link.from.kind == Attachment::Kind::wire || link.to.kind == Attachment::Kind::wire);
    }

    std::vector<RigidContact> find_rigid_contacts(const Scene &scene, const Structure &structure,
                                                  const ContactRows &rows,
                                                  const SolverParameters &parameters,
                                                  const double step)
    {
      const StepCoefficients c = generalised_alpha(step, .8);
      FactoredStructure solvers(structure, parameters.local_solver);
      const Communicator &processes = structure.communicator();
      processes.agree([&] { solvers.factor(c.mass_factor(), c.velocity); });
      std::vector<double> flexibility(rows.size(), 0.);
      WindowedVector column;
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (const Term &term : rows[i].terms)
          if (rows[i].unilateral)
          {
            solvers[term.substructure].column(term.form, column);
            flexibility[i] += column.dot(term.form);
            const auto &motions = solvers.free_motions()[term.substructure];
            for (std::size_t v = 0; v < motions.vectors.size(); ++v)
            {
              const double motion = term.form.dot(motions.vectors[v]);
              flexibility[i] += motion * motion / motions.resistance[v];
            }
          }
      processes.sum(flexibility);

      std::vector<RigidContact> result;
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (!rows[i].unilateral)
          continue;
        const Link &link = scene.links[rows[i].link];
        const double compliance = 1. / (rows[i].stiffness + c.velocity * rows[i].damping);
        if (compliance >= flexibility[i] || is_massless(link))
          continue;
        for (const Attachment *end : {&link.from, &link.to})
          if (end->kind != Attachment::Kind::ground)
            result.push_back({i, courant_number(scene, *end, link.direction, step),
                              end->kind == Attachment::Kind::wire
                                  ? scene.wires[end->index].mass_matrix
                                  : MassMatrix::lumped,
                              compliance == 0.});
      }
      return result;
    }

    bool may_fail(const TimeIntegrator &integrator)
    {
      for (const MassMatrix matrix :
           {MassMatrix::consistent, MassMatrix::lumped, MassMatrix::reduced})
        for (const bool rigid : {true, false})
          if (integrator.least_courant_number(matrix, rigid) > 0.)
            return true;
      return false;
    }

    bool has_one_sided_rows(const ContactRows &rows)
    {
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].unilateral)
          return true;
      return false;
    }
  } // namespace

  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             const double step)
  {
    if (!has_one_sided_rows(rows))
      return {"generalised-alpha", "no one-sided links"};
    const std::vector<RigidContact> rigid =
        find_rigid_contacts(scene, structure, rows, parameters, step);
    if (rigid.empty())
      return {"generalised-alpha",
              "all one-sided links are more compliant than the bodies in one step"};
    const RigidContact &worst = *std::min_element(rigid.begin(), rigid.end(),
                                                  [](const RigidContact &a, const RigidContact &b)
                                                  { return a.courant < b.courant; });
    std::ostringstream reason;
    reason << "one-sided link '" << rows[worst.row].name << "' acts as rigid; waves cross "
           << worst.courant << " elements a step";
    return {worst.courant >= least_courant_number ? "BDF2" : "backward Euler", reason.str()};
  }

  void check_scheme(const TimeIntegrator &integrator, const Scene &scene,
                    const Structure &structure, const ContactRows &rows,
                    const SolverParameters &parameters, const double step)
  {
    const std::string anyway = ", or set 'Time/Allow unsuitable scheme'";
    const StepCoefficients c = integrator.coefficients(step);
    for (const Link &link : scene.links)
      if (c.velocity_level && c.alpha_f == .5 && is_massless(link))
        throw EntryError("Time/Massless contact",
                         "Moreau-Jean with Theta 1/2 never damps the force of a node without mass, "
                         "here at link '" +
                             link.name + "'; take Theta > 1/2, another scheme" + anyway);
    if (!has_one_sided_rows(rows) || !may_fail(integrator))
      return;
    for (const RigidContact &contact :
         find_rigid_contacts(scene, structure, rows, parameters, step))
    {
      const double least = integrator.least_courant_number(contact.matrix, contact.exactly_rigid);
      if (!(contact.courant < (1. - 1e-6) * least))
        continue;
      std::ostringstream out;
      out << integrator.description() << " fails at one-sided links that act as rigid, here '"
          << rows[contact.row].name << "'";
      if (contact.matrix == MassMatrix::reduced)
        out << " on a wire with the mass matrix 'reduced'";
      out << ": its forces ring. Waves cross " << contact.courant << " elements a step there";
      if (std::isfinite(least))
        out << " and would have to cross " << least;
      out << ". Take 'automatic' or more dissipation, give the link a Stiffness, set "
             "'Time/Massless contact'"
          << anyway;
      throw EntryError("Time/Scheme", out.str());
    }
  }
} // namespace taut
