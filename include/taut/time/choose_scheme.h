// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_choose_scheme_h
#define taut_choose_scheme_h

#include <taut/interface/contact_rows.h>
#include <taut/time/integrator.h>
#include <taut/time/solver_parameters.h>

#include <map>
#include <string>

namespace taut
{
  /// A time integration scheme by name, values of its own entries, and why.
  struct SchemeChoice
  {
    std::string name;
    std::map<std::string, std::string> entries;
    std::string reason;
  };

  /// True if the wire's node under a rigid link carries no mass: its force then is that of the
  /// elements beside it.
  bool is_massless(const Link &link);

  /**
   * Takes the mass from the nodes of wires at rigid stops, as Massless contact = mass does (mass
   * redistribution), if the elements beside them then are a spring that the step [s] resolves
   * (doc/accuracy.md): if the rigid one-sided links of the scene are such stops, on bars or
   * strings, at least two elements apart, whose fastest waves cross at most four elements a step,
   * and no other link acts as rigid. Throws an EntryError if a body cannot be factored.
   */
  void take_contact_mass(Scene &scene, const SolverParameters &parameters, double step);

  /**
   * The scheme that suits the rows of a scene at a step [s], the shortest of a run. A one-sided row
   * acts as rigid when its S_ii is less than its (B^T A^-1 B)_ii, unless it acts on DoFs without
   * mass. Without such rows generalised-alpha with spectral radius 0.8, otherwise Moreau-Jean with
   * conditions on gaps, then velocities, or on gaps alone where a mass matrix has no inverse.
   * Throws an EntryError if a @p restitution [1] is asked for that no row could have.
   */
  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             double step, double restitution);

  /**
   * Throws an EntryError if a scheme is known to fail on a row: on Time/Scheme if its forces ring
   * (StepCoefficients::ringing) at a one-sided row that acts as rigid, on
   * Time/Moreau-Jean/Conditions if gaps of a moving rigid row would drift, on Time/Massless contact
   * where conditions on velocities without damping meet a node without mass.
   */
  void check_scheme(const TimeIntegrator &integrator, const Structure &structure,
                    const ContactRows &rows, const SolverParameters &parameters, double step);

  /// Throws an EntryError if a scheme projects velocities and a mass matrix has no inverse.
  void check_mass(const TimeIntegrator &integrator, const Structure &structure, double step);
} // namespace taut

#endif
