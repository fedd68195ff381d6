// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_extremes_extended_model_h
#define taut_extremes_extended_model_h

#include "common.h"

#include <taut/scene/scene.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <valarray>

namespace extremes
{
  /// 120 decimal digits: room for the artificial springs of ExtendedRun below all ratios of scenes.
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>,
                                               boost::multiprecision::et_off>;
  using Vector = std::valarray<Number>;

  /// Symmetric, dense.
  class Matrix
  {
  public:
    explicit Matrix(std::size_t n = 0) : n(n), entries(Number(0), n * n) {}
    std::size_t size() const { return n; }
    Number &operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }
    const Number &operator()(std::size_t i, std::size_t j) const { return entries[i * n + j]; }
    Vector times(const Vector &x) const;

  private:
    std::size_t n;
    Vector entries;
  };

  /// L L^T = A. Rows with a zero pivot relative to their diagonal make it singular.
  class Cholesky
  {
  public:
    bool factor(const Matrix &A); ///< false if A is singular to 1e-80
    Vector solve(Vector b) const;

  private:
    std::size_t n = 0;
    Matrix L;
    Vector inverse_pivot;
  };

  using Form = std::vector<std::pair<std::size_t, Number>>; ///< a linear form on the DoFs
  Number dot(const Form &form, const Vector &x);
  Number dot(const Vector &x, const Vector &y);

  /// M, C, K and P of a small scene, and where its constraints act.
  class ExtendedModel
  {
  public:
    virtual ~ExtendedModel() = default;

    std::size_t n_dofs() const { return M.size(); }
    /// A motion along a direction, or a slope or rotation, as Structure::motion.
    virtual Form motion(const taut::Attachment &point, bool rotational,
                        const taut::Coordinates &direction) const = 0;
    /// B of a link at time t, without the gap.
    virtual Form constraint(const taut::Link &link, const Number &t) const = 0;
    /// What the motion of the place of a moving link adds to D' = B^T V: a form on U.
    virtual Form convection(const taut::Link &link, const Number &t) const = 0;
    virtual Vector load(const Number &t) const = 0;
    /// True if the row of M is zero; and that of C, too.
    bool is_massless(std::size_t i) const { return is_zero_row(M, i); }
    bool is_quasi_static(std::size_t i) const { return is_zero_row(M, i) && is_zero_row(C, i); }
    std::vector<char> held; ///< true if the DoF is held; its value is in given
    Vector given;
    Vector initial_U, initial_V;
    std::vector<char> is_rotation;
    Matrix M, C, K;

  protected:
    void resize(std::size_t n_dofs); ///< all zero, nothing held

  private:
    static bool is_zero_row(const Matrix &matrix, std::size_t i);
  };

  /// A scene of wires and masses, assembled from its values alone: shape functions as polynomials,
  /// integrals exact. Of the library only the positions of the nodes are used, grid(). Expressions
  /// are constants here; elements of strings and bars have degree 1 or 2.
  class ExtendedWires : public ExtendedModel
  {
  public:
    explicit ExtendedWires(const taut::Scene &scene);
    Form motion(const taut::Attachment &point, bool rotational,
                const taut::Coordinates &direction) const override;
    Form constraint(const taut::Link &link, const Number &t) const override;
    Form convection(const taut::Link &link, const Number &t) const override;
    Vector load(const Number &t) const override;

  private:
    struct Component
    {
      bool axial = false;
      unsigned int degree = 1; ///< 3: Hermite
      std::size_t first = 0;
      bool exists = false;
      std::size_t dof(std::size_t element, unsigned int i) const
      {
        return first + (degree == 3 ? 2 : degree) * element + i;
      }
    };

    Form shape(std::size_t wire, const Component &component, const Number &s, bool slope) const;
    Form sliding(const taut::Link &link, const Number &t, bool slope) const;
    void add_component(std::size_t wire, Component &component);
    void add_masses();

    const taut::Scene scene;
    std::vector<std::vector<double>> nodes;
    std::vector<Component> axial, transverse;
    std::vector<std::size_t> first_of_mass;
    std::size_t n = 0;
    Vector constant;
  };
} // namespace extremes

#endif
