// SPDX-License-Identifier: LGPL-2.1-or-later
#include "courant_numbers.h"

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
    /// Elements a step from which on BDF2 is the better choice at rigid links; from its own
    /// least_courant_number() on it is merely not refused.
    constexpr double preferred_courant_number = .25;

    /// Elements a step up to which nodes without mass were measured.
    constexpr double most_courant_number = 4.;

    /// Of elements that shall be equal, and of steps written in decimals.
    constexpr double rounding = 1e-6;

    bool is_one(const CourantRange &courant)
    {
      return courant.least > 1. - rounding && courant.most < 1. + rounding;
    }

    /// An end on a wire of a one-sided row that acts as rigid, or such a row without wires.
    struct RigidContact
    {
      std::size_t row;
      CourantRange courant;
      MassMatrix matrix;
      bool exactly_rigid;
      bool on_wire, on_beam;
    };

    bool is_on_wire(const Link &link)
    {
      return link.from.kind == Attachment::Kind::wire || link.to.kind == Attachment::Kind::wire;
    }

    /// True if the wires at a link are bars or strings whose waves cross at most four elements a
    /// step: the elements beside a node without mass then are a spring that no scheme rings on.
    bool is_springy(const Scene &scene, const CourantNumbers &courant, const Link &link)
    {
      for (const Attachment *end : {&link.from, &link.to})
        if (end->kind == Attachment::Kind::wire &&
            (link.rotational || bends(scene.wires[end->index], link.direction) ||
             !(courant.at(link, *end).most <= (1. + rounding) * most_courant_number)))
          return false;
      return true;
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
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (const Term &term : rows[i].terms)
          if (rows[i].unilateral)
          {
            flexibility[i] += solvers[term.substructure].flexibility(term.form);
            const auto &motions = solvers.free_motions()[term.substructure];
            for (std::size_t v = 0; v < motions.vectors.size(); ++v)
            {
              const double motion = term.form.dot(motions.vectors[v]);
              flexibility[i] += motion * motion / motions.resistance[v];
            }
          }
      processes.sum(flexibility);

      const CourantNumbers courant(scene, step);
      constexpr double infinity = std::numeric_limits<double>::infinity();
      std::vector<RigidContact> result;
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        if (!rows[i].unilateral)
          continue;
        const Link &link = scene.links[rows[i].link];
        const double compliance = 1. / (rows[i].stiffness + c.velocity * rows[i].damping);
        if (compliance >= flexibility[i] || is_massless(link))
          continue;
        const bool exactly_rigid = compliance == 0.;
        for (const Attachment *end : {&link.from, &link.to})
          if (end->kind == Attachment::Kind::wire)
          {
            const Wire &wire = scene.wires[end->index];
            result.push_back({i, courant.at(link, *end), wire.mass_matrix, exactly_rigid, true,
                              link.rotational || bends(wire, link.direction)});
          }
        if (!is_on_wire(link))
          result.push_back(
              {i, {infinity, infinity}, MassMatrix::lumped, exactly_rigid, false, false});
      }
      return result;
    }

    /// The exactly rigid one-sided links, if nodes without mass suit all of them; otherwise none.
    std::vector<std::size_t> find_springy_stops(const Scene &scene, const double step)
    {
      const CourantNumbers courant(scene, step);
      bool carries_fronts = true;
      std::vector<std::size_t> stops;
      std::vector<std::pair<std::size_t, std::size_t>> nodes; // wire and node
      for (std::size_t i = 0; i < scene.links.size(); ++i)
      {
        const Link &link = scene.links[i];
        if (!link.unilateral() || !link.rigid() || link.axial_stiffness != 0.)
          continue;
        if (link.kind != LinkKind::stop || !is_on_wire(link) || !is_springy(scene, courant, link))
          return {};
        for (const Attachment *end : {&link.from, &link.to})
          if (end->kind == Attachment::Kind::wire)
          {
            if (courant.n_elements(end->index) < 2)
              return {};
            nodes.emplace_back(end->index, courant.node(*end));
            carries_fronts = carries_fronts && is_one(courant.at(link, *end)) &&
                             scene.wires[end->index].mass_matrix == MassMatrix::reduced;
          }
        stops.push_back(i);
      }
      std::sort(nodes.begin(), nodes.end());
      const bool are_close =
          std::adjacent_find(nodes.begin(), nodes.end(),
                             [](const auto &a, const auto &b) {
                               return a.first == b.first && b.second - a.second < 2;
                             }) != nodes.end();
      return carries_fronts || are_close ? std::vector<std::size_t>() : stops;
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

    SchemeChoice smooth(const std::string &reason)
    {
      return {"generalised-alpha", {{"Spectral radius", "0.8"}}, reason};
    }

    SchemeChoice impulses(const std::string &reason)
    {
      return {"Moreau-Jean", {{"Theta", "0.5"}, {"Conditions", "velocities"}}, reason};
    }

    SchemeChoice choose_for_restitution(const Scene &scene, const ContactRows &rows,
                                        const std::vector<RigidContact> &rigid)
    {
      const std::string entry = "Time/Moreau-Jean/Restitution";
      bool any_rigid = false;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].unilateral && std::isinf(rows[i].stiffness))
        {
          if (is_on_wire(scene.links[rows[i].link]))
            throw EntryError(entry, "a wire rebounds by its own waves, and with restitution its "
                                    "node would bounce at the rigid link '" +
                                        rows[i].name + "'. Set it to 0");
          any_rigid = true;
        }
      if (!any_rigid)
        throw EntryError(entry, "restitution is a law of rigid one-sided links, and the scene has "
                                "none. Set it to 0, or a link's Stiffness to 'rigid'");
      for (const RigidContact &contact : rigid)
        if (!contact.exactly_rigid)
          throw EntryError(entry, "restitution is a law of rigid one-sided links, and link '" +
                                      rows[contact.row].name +
                                      "' acts as rigid with a Stiffness. Set it to 0, or that "
                                      "Stiffness to 'rigid'");
      return impulses("only it knows the restitution asked for");
    }

    SchemeChoice choose_for_rigid(const Scene &scene, const ContactRows &rows,
                                  const std::vector<RigidContact> &rigid)
    {
      const auto all = [&](const auto &property)
      { return std::all_of(rigid.begin(), rigid.end(), property); };
      const auto between_masses = std::find_if(rigid.begin(), rigid.end(),
                                               [](const RigidContact &c) { return !c.on_wire; });
      if (between_masses != rigid.end())
      {
        const std::string name = "'" + rows[between_masses->row].name + "'";
        if (!between_masses->exactly_rigid)
          return {"backward Euler",
                  {},
                  "masses collide at one-sided link " + name +
                      ", stiffer than the step resolves, and other schemes let them rebound at "
                      "random; without its Stiffness, Moreau-Jean would suit"};
        const std::string reason = "masses collide at the rigid one-sided link " + name +
                                   ", and other schemes let them rebound";
        if (all([](const RigidContact &c)
                { return c.exactly_rigid && c.matrix != MassMatrix::reduced; }) &&
            std::none_of(scene.links.begin(), scene.links.end(), is_massless))
          return impulses(reason);
        return {"backward Euler", {}, reason};
      }

      const RigidContact &worst = *std::min_element(rigid.begin(), rigid.end(),
                                                    [](const RigidContact &a, const RigidContact &b)
                                                    { return a.courant.least < b.courant.least; });
      const std::string name = rows[worst.row].name;
      if (all(
              [](const RigidContact &c) {
                return c.exactly_rigid && c.matrix == MassMatrix::reduced && !c.on_beam &&
                       is_one(c.courant);
              }))
        return {"Moreau-Jean",
                {{"Theta", "0.5"}, {"Conditions", "gaps"}},
                "with the mass matrix 'reduced', waves cross one element a step, undistorted, at "
                "the rigid one-sided link '" +
                    name + "'"};
      std::ostringstream reason;
      reason << "one-sided link '" << name << "' acts as rigid; waves cross " << worst.courant.least
             << " elements a step";
      if (worst.courant.least >= (1. - rounding) * preferred_courant_number)
        return {"BDF2", {}, reason.str()};
      if (all([](const RigidContact &c) { return c.on_beam; }))
        return {"generalised-alpha",
                {{"Spectral radius", "0"}},
                reason.str() + ", and bend what they cross"};
      return {"backward Euler", {}, reason.str()};
    }
  } // namespace

  bool is_massless(const Link &link)
  {
    return link.contact_mass != ContactMass::stays && is_on_wire(link);
  }

  void take_contact_mass(Scene &scene, const SolverParameters &parameters, const double step)
  {
    const std::vector<std::size_t> stops = find_springy_stops(scene, step);
    if (stops.empty())
      return;
    Scene lighter = scene;
    for (const std::size_t i : stops)
      lighter.links[i].contact_mass = ContactMass::keeps_total;
    // Links with a stiffness may act as rigid, too: that depends on the bodies.
    if (std::any_of(lighter.links.begin(), lighter.links.end(),
                    [](const Link &link) { return link.unilateral() && !is_massless(link); }))
    {
      const Structure structure(lighter);
      const ContactRows rows(lighter, structure);
      if (!find_rigid_contacts(lighter, structure, rows, parameters, step).empty())
        return;
    }
    scene = std::move(lighter);
  }

  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             const double step, const double restitution)
  {
    if (!has_one_sided_rows(rows) && !(restitution > 0.))
      return smooth("no one-sided links");
    const std::vector<RigidContact> rigid =
        find_rigid_contacts(scene, structure, rows, parameters, step);
    if (restitution > 0.)
      return choose_for_restitution(scene, rows, rigid);
    if (!rigid.empty())
      return choose_for_rigid(scene, rows, rigid);

    const std::vector<Link> &links = scene.links;
    if (std::none_of(links.begin(), links.end(), is_massless))
      return smooth("all one-sided links are more compliant than the bodies in one step");
    const CourantNumbers courant(scene, step);
    const std::string reason =
        "nodes of wires at rigid one-sided links gave their mass to their neighbours";
    if (std::all_of(links.begin(), links.end(),
                    [&](const Link &link)
                    { return !is_massless(link) || is_springy(scene, courant, link); }))
      return smooth(reason);
    return {"BDF2", {}, reason};
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
      if (!(contact.courant.least < (1. - rounding) * least))
        continue;
      std::ostringstream out;
      out << integrator.description() << " fails at one-sided links that act as rigid, here '"
          << rows[contact.row].name << "'";
      if (contact.matrix == MassMatrix::reduced)
        out << " on a wire with the mass matrix 'reduced'";
      out << ": its forces ring. Waves cross " << contact.courant.least << " elements a step there";
      if (std::isfinite(least))
        out << " and would have to cross " << least;
      out << ". Take 'automatic' or more dissipation, give the link a Stiffness, set "
             "'Time/Massless contact'"
          << anyway;
      throw EntryError("Time/Scheme", out.str());
    }
  }
} // namespace taut
