// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_equilibrium_search_h
#define taut_equilibrium_search_h

#include <taut/cable/cable_elements.h>
#include <taut/substructure/local_solver.h>

#include <memory>
#include <vector>

namespace taut
{
  /// Newton's method for the equilibrium of one cable under dead loads, see find_shape().
  class EquilibriumSearch
  {
  public:
    /// @p held: DoFs; @p load [N, N m] is kept by reference.
    EquilibriumSearch(const CableElements &cable, const std::vector<unsigned int> &held,
                      const std::vector<double> &load);

    /// Searches from @p q on. Returns false, with q unchanged, if there is no stable equilibrium
    /// within reach.
    bool solve(const CableElements &cable, double relative_tolerance, std::vector<double> &q);

    unsigned int iterations() const { return n_iterations; }
    double residual() const { return last_residual; }

    /// True if the last search ended in an equilibrium, stable or not.
    bool is_balanced() const { return balanced; }

  private:
    bool iterate(const CableElements &cable, double relative_tolerance, bool downhill,
                 std::vector<double> &q);
    bool step(const CableElements &cable, bool downhill, double &size, std::vector<double> &q);
    void polish(const CableElements &cable, double size, std::vector<double> &q);
    double find_residual(const CableElements &cable, const std::vector<double> &q);
    double energy(const CableElements &cable, const std::vector<double> &q) const;
    bool factor(const CableElements &cable, const std::vector<double> &q, bool definite, double mu);

    std::vector<unsigned int> held;
    const std::vector<double> &load;
    std::unique_ptr<LocalSolver> solver;
    std::unique_ptr<SymmetricMatrix> M; ///< of 1 kg/m
    std::vector<double> r;
    unsigned int n_iterations = 0;
    double last_residual = 0.;
    bool balanced = false;
  };
} // namespace taut

#endif
