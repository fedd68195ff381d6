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
   * Takes the mass from the nodes of wires at rigid stops, as Massless contact = mass does, if that
   * was measured to be best at a step [s] (doc/accuracy.md, "What automatic chooses"): if the rigid
   * one-sided links of the scene are such stops, on bars or strings, at least two elements apart,
   * whose fastest waves cross at most four elements a step, and no link with a stiffness acts as
   * rigid; not if waves cross just one element on reduced mass matrices, where Moreau-Jean with
   * conditions on gaps is exact. Throws an EntryError if a body cannot be factored.
   */
  void take_contact_mass(Scene &scene, const SolverParameters &parameters, double step);

  /**
   * The scheme that suits the rows of a scene at a step [s]. A one-sided row behaves as compliant
   * when its S_ii is at least its (B^T A^-1 B)_ii, or when the wire's node there carries no mass.
   * doc/accuracy.md has the rules and what they were measured by. Throws an EntryError if a @p
   * restitution [1] is asked for where no scheme has it.
   */
  SchemeChoice choose_scheme(const Scene &scene, const Structure &structure,
                             const ContactRows &rows, const SolverParameters &parameters,
                             double step, double restitution);

  /**
   * Throws an EntryError if a scheme is known to fail on a row of the scene: on Time/Scheme at a
   * rigid one-sided row on a wire whose slowest waves cross fewer elements a step than the scheme
   * needs there, on Time/Massless contact where Moreau-Jean of velocities without damping meets a
   * node without mass.
   */
  void check_scheme(const TimeIntegrator &integrator, const Scene &scene,
                    const Structure &structure, const ContactRows &rows,
                    const SolverParameters &parameters, double step);
} // namespace taut

#endif
