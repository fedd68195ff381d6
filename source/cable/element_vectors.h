// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_element_vectors_h
#define taut_element_vectors_h

#include <taut/base/coordinates.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>

/// Vectors in space of the elements of a cable.
namespace taut
{
  using Vector = dealii::Tensor<1, 3>;
  using Matrix = dealii::Tensor<2, 3>;

  /// The DoFs of several elements, side by side: loops over them become vector instructions.
  struct ElementBatch
  {
    static constexpr unsigned int size = 8;
    std::array<std::array<double, size>, 12> dof; ///< not set: zeros for each batch take time

    /// The second half of the DoFs of the first node: r' of ANCF.
    Coordinates derivative(const unsigned int l) const { return {dof[3][l], dof[4][l], dof[5][l]}; }
  };

  /// Forces on the derivatives r' of the first nodes of these elements.
  struct NodeBatch
  {
    std::array<std::array<double, ElementBatch::size>, 3> dof;

    void set(const unsigned int l, const Coordinates &g)
    {
      dof[0][l] = g.x;
      dof[1][l] = g.y;
      dof[2][l] = g.z;
    }
  };

  /// sum of shape[a] times the vector a of an element.
  template <typename Local>
  inline Vector combine(const std::array<double, 4> &shape, const Local &x)
  {
    Vector r;
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        r[c] += shape[a] * x[3 * a + c];
    return r;
  }

  /// The vector of element l of a batch, whose first node is the origin. It is written by
  /// components: with loops over arrays the loop over l would not be vectorised.
  inline Coordinates combine(const std::array<double, 4> &shape, const ElementBatch &x,
                             const unsigned int l)
  {
    const auto component = [&](const unsigned int c) {
      return shape[1] * x.dof[3 + c][l] + shape[2] * x.dof[6 + c][l] + shape[3] * x.dof[9 + c][l];
    };
    return {component(0), component(1), component(2)};
  }

  inline Coordinates operator+(const Coordinates &a, const Coordinates &b)
  {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }

  inline Coordinates operator*(const double s, const Coordinates &a)
  {
    return {s * a.x, s * a.y, s * a.z};
  }

  inline Coordinates cross_product(const Coordinates &a, const Coordinates &b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }

  /// The vector a of an element += shape[a] g.
  template <typename Local>
  inline void distribute(const std::array<double, 4> &shape, const Vector &g, Local &f)
  {
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        f[3 * a + c] += shape[a] * g[c];
  }

  /// As above for element l of a batch without its first node: no force moves the element as a
  /// whole. Without @p adds, = instead of +=.
  template <bool adds = true>
  inline void distribute(const std::array<double, 4> &shape, const Coordinates &g, ElementBatch &f,
                         const unsigned int l)
  {
    const auto put = [l](std::array<double, ElementBatch::size> &row, const double value)
    {
      if constexpr (adds)
        row[l] += value;
      else
        row[l] = value;
    };
    for (unsigned int a = 1; a < 4; ++a)
    {
      put(f.dof[3 * a], shape[a] * g.x);
      put(f.dof[3 * a + 1], shape[a] * g.y);
      put(f.dof[3 * a + 2], shape[a] * g.z);
    }
  }
} // namespace taut

#endif
