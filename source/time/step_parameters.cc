// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/time/step_parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  SolverParameters::SolverParameters() = default;

  void SolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii;
    prm.enter_subsection("Solver");
    prm.add_parameter(
        "Local solver", local_solver,
        "Factorisation of the matrix of each body. 'block tridiagonal': LDL^T along a "
        "wire, fastest. 'sparse direct': CHOLMOD. Mechanisms always use CHOLMOD.",
        Patterns::Selection("block tridiagonal|sparse direct"));
    prm.add_parameter(
        "Interface operator", interface.form,
        "Contact Schur complement F. 'automatic': by number of constraints and step; the log "
        "names it. 'assembled dense': fastest up to some hundred constraints, of solids up to some "
        "thousand. 'assembled sparse': for many constraints that act on each other only near by: "
        "small steps, many bodies. 'matrix-free': applied through the factors of the bodies, "
        "solved by conjugate gradients: least memory.",
        Patterns::Selection("automatic|assembled dense|assembled sparse|matrix-free"));
    prm.add_parameter("Preconditioner", interface.preconditioner,
                      "Of the matrix-free operator. 'diagonal': 1/F_ii. 'Dirichlet': the Schur "
                      "complements of the "
                      "bodies at the constraints, fewest iterations.",
                      Patterns::Selection("diagonal|Dirichlet"));
    prm.add_parameter(
        "Coarse space", interface.coarse_space,
        "Of the matrix-free operator. 'rigid body modes': those of floating bodies are solved "
        "for directly, so that the iterations do not grow with the number of bodies or the step. "
        "'none': the operator alone.",
        Patterns::Selection("rigid body modes|none"));
    prm.add_parameter("Largest whole factor", interface.largest_whole_factor,
                      "Of the matrix-free operator on several ranks: entries up to which each rank "
                      "has the factor of the coarse problem, or of the stiffnesses with springs, "
                      "whole. MUMPS shares larger ones out [1]",
                      Patterns::Integer(0));
    prm.add_parameter(
        "Complementarity", complementarity,
        "Search for the closed links. 'semismooth Newton': starts from the last step; "
        "where it cycles, MPRGP takes over if F is matrix-free, else energy-ordered. "
        "'energy-ordered': one link at a time, the energy falls at each change; "
        "finite, slower; hands over if it misses the tolerance. 'MPRGP': gradient "
        "projections, which take products with F alone.",
        Patterns::Selection("semismooth Newton|energy-ordered|MPRGP"));
    prm.add_parameter("Contact tolerance", contact_tolerance,
                      "A step whose certificate, the relative residual of its equations, is larger "
                      "than this ends the run with an error [1]",
                      Patterns::Double(1e-15, 1.));
    prm.leave_subsection();
  }
} // namespace taut
