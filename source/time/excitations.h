// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_excitations_h
#define taut_excitations_h

#include <taut/interface/constraints.h>
#include <taut/substructure/structure.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A function of time that acts on the bodies: a load, a prescribed place, or the height under a
  /// sliding constraint.
  struct Excitation
  {
    std::string name;   ///< "the load on 'mast'"
    std::string origin; ///< section of its body or constraint in the parameter file; may be empty
    bool is_load;       ///< acts by its impulse; else a place [m, rad]
    bool is_costly;     ///< a value costs as much as all forces of the load
    std::function<double(double)> at; ///< value at a time [s]; of a load in space a sum of samples

    /// Of a load in space the same sum at so many places; else empty.
    std::function<double(double, std::size_t)> at_places = nullptr;

    /// Of a load in space the sum of all its forces, with weights that grow from DoF to DoF, or
    /// that of their sizes; else empty. And the number of DoFs.
    std::function<double(double, bool)> of_all_forces = nullptr;
    unsigned int n_dofs = 0;
  };

  /// The excitations of the bodies of this rank, then, the same on all ranks, those of the
  /// constraints. The arguments are kept by reference.
  std::vector<Excitation> excitations(const Structure &structure, const Constraints &constraints);
} // namespace taut

#endif
