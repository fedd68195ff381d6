// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_rows_h
#define taut_contact_rows_h

#include <taut/scene/scene.h>
#include <taut/substructure/structure.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace taut
{
  /// Index of the link of a row that holds the pieces of a cut wire together.
  constexpr std::size_t no_link = std::numeric_limits<std::size_t>::max();

  /// One multiplier: a link of the scene, or a cut of a wire, as a linear form B_i on the
  /// displacements.
  struct Row
  {
    std::string name;
    std::size_t link = no_link; ///< index in the scene
    bool unilateral = false;
    bool moving = false;
    bool rotational = false; ///< slopes and moments
    double stiffness = 0.;   ///< [N/m, N m/rad]; infinite: rigid
    double damping = 0.;     ///< [N s/m, N m s/rad]
    double gap = 0.;         ///< D at U = 0, N = 0 [m, rad]
    std::vector<Term> terms; ///< B_i: D = terms . U + gap + S N

    bool is_cut() const { return link == no_link; }
  };

  /// The rows of a scene: the fixed links in their order, then the cuts of wires, then the moving
  /// links.
  class ContactRows
  {
  public:
    /// @p scene is kept by reference; @p structure was made from it.
    ContactRows(const Scene &scene, const Structure &structure);

    std::size_t size() const { return rows.size(); }
    std::size_t n_fixed() const { return fixed; }
    const Row &operator[](std::size_t i) const { return rows[i]; }

    /// Puts the moving rows where they are at time t [s]. Throws UserError when one leaves its
    /// wire.
    void update(double t);

    /// Position on its wire of a moving row at time t [m].
    double position(std::size_t i, double t) const;

    /// B^T U of each row: the motion of the rows, summed over all ranks [m, rad].
    std::vector<double> motions(const BlockVector &U) const;

    /// The share of this rank's bodies in it, into @p motion of length size().
    void share_of_motions(const BlockVector &U, std::vector<double> &motion) const;

    /// The same, and the sums of the absolute terms, which it rounds with, into @p terms_size.
    void share_of_motions(const BlockVector &U, std::vector<double> &motion,
                          std::vector<double> &terms_size) const;

    /**
     * Rate at which a moving row's place changes its gap at time @p t [s], in D' = B^T V + this:
     * its speed times the slope of the displacements, this rank's share of it [m/s].
     */
    double share_of_convection(std::size_t i, double t, const BlockVector &reference,
                               const BlockVector &U) const;

    /// The same of the height profile under a moving row, from differences within a part of a step
    /// [s]; the same on all ranks [m/s].
    double profile_rate(std::size_t i, double t, double step) const;

    /// Of each row: not 0 where it is fixed and acts on a DoF without mass.
    std::vector<char> without_mass() const;

    /// P += B N.
    void add_forces(const std::vector<double> &N, BlockVector &P) const;

    /// Largest force [N] and moment [N m] of a single row on each body, |B_i| |N_i|: their sum may
    /// cancel.
    void largest_forces(const std::vector<double> &N,
                        std::vector<std::array<double, 2>> &result) const;

    /// Index of the row of a link.
    std::size_t row_of_link(std::size_t link) const { return row_index[link]; }

    /// Path in the parameter file of the link of a row, for messages; empty for a cut.
    std::string origin(std::size_t i) const
    {
      return rows[i].is_cut() ? "" : scene.links[rows[i].link].origin;
    }

    /// Names of rows for a message: "a, b and 3 more".
    std::string names(const std::vector<std::size_t> &indices) const;

  private:
    /// One number of B.
    struct Entry
    {
      double value;
      unsigned int body, dof;
    };

    void set_terms(Row &row, double t) const;
    void append(std::size_t i);

    const Scene &scene;
    const Structure &structure;
    std::vector<Row> rows;
    std::vector<std::size_t> row_index;
    std::size_t fixed = 0;

    std::vector<Entry> entries;     ///< of all rows, one row after the other
    std::vector<std::size_t> begin; ///< of each row; one number more

    /// The largest |B_i| of a row on a body, of one kind.
    struct Size
    {
      double value;
      unsigned int body, kind, row;
    };
    std::vector<Size> sizes; ///< of the fixed rows by body and kind, then of the moving ones
    std::size_t n_fixed_sizes = 0;
  };
} // namespace taut

#endif
