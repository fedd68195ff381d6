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

    /// A one-sided row that acts as rigid, and the least Courant number of all of them.
    struct RigidRow
    {
      std::size_t row = 0;
      double courant = std::numeric_limits<double>::infinity();
      bool exists = false;
    };

    /// True if the wire's node under a rigid link carries no mass: its force then is that of the
    /// elements beside it.
    bool is_massless(const Link &link)
    {
      return link.contact_mass != ContactMass::stays &&
             (link.from.kind == Attachment::Kind::wire || link.to.kind == Attachment::Kind::wire);
    }

    /// True if a rigid one-sided link is on a wire whose mass matrix leaves every second node's
    /// motion without inertia.
    bool is_on_reduced_mass(const Scene &scene, const Link &link)
    {
      if (!link.unilateral() || !link.rigid() || link.axial_stiffness != 0.)
        return false;
      for (const Attachment *end : {&link.from, &link.to})
        if (end->kind == Attachment::Kind::wire &&
            scene.wires[end->index].mass_matrix == MassMatrix::reduced)
          return true;
      return false;
    }

    RigidRow find_rigid_row(const Scene &scene, const Structure &structure, const ContactRows &rows,
                            const SolverParameters &parameters, const double step)
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

      RigidRow result;
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (!rows[i].unilateral)
          continue;
        const Link &link = scene.links[rows[i].link];
        const double compliance = 1. / (rows[i].stiffness + c.velocity * rows[i].damping);
        if (compliance >= flexibility[i] || is_massless(link))
          continue;
        const double courant = std::min(courant_number(scene, link.from, link.direction, step),
                                        courant_number(scene, link.to, link.direction, step));
        if (!result.exists || courant < result.courant)
          result.row = i;
        result.courant = std::min(result.courant, courant);
        result.exists = true;
      }
      return result;
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
    const RigidRow rigid = find_rigid_row(scene, structure, rows, parameters, step);
    if (!rigid.exists)
      return {"generalised-alpha",
              "all one-sided links are more compliant than the bodies in one step"};
    std::ostringstream reason;
    reason << "one-sided link '" << rows[rigid.row].name << "' acts as rigid; waves cross "
           << rigid.courant << " elements a step";
    return {rigid.courant >= least_courant_number ? "BDF2" : "backward Euler", reason.str()};
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
    for (const Link &link : scene.links)
      if (c.velocity_level && c.alpha_f == .5 && is_on_reduced_mass(scene, link))
        throw EntryError("Time/Scheme",
                         "Moreau-Jean with Theta 1/2 rings or is unstable at rigid one-sided links "
                         "to wires with the mass matrix 'reduced', here link '" +
                             link.name +
                             "'; take Theta = 0.6, the mass matrix 'consistent' or 'lumped', "
                             "another scheme" +
                             anyway);
    const double least = integrator.least_courant_number();
    if (!(least > 0.) || !has_one_sided_rows(rows))
      return;
    const RigidRow rigid = find_rigid_row(scene, structure, rows, parameters, step);
    if (!rigid.exists || rigid.courant >= (1. - 1e-6) * least)
      return;
    std::ostringstream out;
    out << integrator.description() << " fails at one-sided links that act as rigid, here '"
        << rows[rigid.row].name << "': its forces ring. Waves cross " << rigid.courant
        << " elements a step there";
    if (std::isfinite(least))
      out << " and would have to cross " << least;
    out << ". Take 'automatic', give the link a Stiffness, set 'Time/Massless contact'" << anyway;
    throw EntryError("Time/Scheme", out.str());
  }
} // namespace taut
