// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_boundary_mass_h
#define taut_boundary_mass_h

#include <taut/solid/solid_mesh.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/sparse_matrix.h>

#include <set>
#include <vector>

namespace taut
{
  /**
   * Mass redistribution: takes the mass from the nodes of parts of the boundary (H. B. Khenous, P.
   * Laborde, Y. Renard, European Journal of Mechanics A/Solids 27 (2008)). M becomes D M D,
   * semidefinite like M, with the diagonal D that is returned. D is 0 at these nodes and larger
   * than 1 next to them, so that the total mass is kept. With @p keeps_inertia D is a quadratic
   * polynomial at the nodes of the next four layers of cells, so that the centre of mass and the
   * moments of inertia are kept, too. If this is not possible with positive entries of D, two
   * layers keep the mass and its centre, or one layer keeps the mass alone.
   *
   * @p hanging are the constraints of hanging nodes; hanging nodes that depend on a node without
   * mass lose their mass, too. Throws UserError if no node of the next layer has a mass.
   */
  template <int dim>
  std::vector<double> factors_without_mass(const SolidMesh<dim> &mesh,
                                           const std::set<dealii::types::boundary_id> &boundaries,
                                           const dealii::AffineConstraints<double> &hanging,
                                           bool keeps_inertia,
                                           const dealii::SparseMatrix<double> &M);
} // namespace taut

#endif
