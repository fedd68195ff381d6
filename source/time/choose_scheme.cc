// SPDX-License-Identifier: LGPL-2.1-or-later
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
  } // namespace

  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             const double step)
  {
    bool one_sided = false;
    for (std::size_t i = 0; i < rows.size(); ++i)
      one_sided = one_sided || rows[i].unilateral;
    if (!one_sided)
      return {"generalised-alpha", "no one-sided links"};

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
        }
    processes.sum(flexibility);

    double courant = std::numeric_limits<double>::infinity();
    std::string rigid;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      if (!rows[i].unilateral)
        continue;
      const double compliance = 1. / (rows[i].stiffness + c.velocity * rows[i].damping);
      if (compliance >= flexibility[i])
        continue;
      if (rigid.empty())
        rigid = rows[i].name;
      const Link &link = scene.links[rows[i].link];
      courant = std::min({courant, courant_number(scene, link.from, link.direction, step),
                          courant_number(scene, link.to, link.direction, step)});
    }
    if (rigid.empty())
      return {"generalised-alpha",
              "all one-sided links are more compliant than the bodies in one step"};
    std::ostringstream reason;
    reason << "one-sided link '" << rigid << "' acts as rigid; waves cross " << courant
           << " elements a step";
    return {courant >= least_courant_number ? "BDF2" : "backward Euler", reason.str()};
  }
} // namespace taut
