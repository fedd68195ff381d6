// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_element_vectors_h
#define taut_element_vectors_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>

/// Vectors in space of the elements of a cable.
namespace taut
{
  using Vector = dealii::Tensor<1, 3>;
  using Matrix = dealii::Tensor<2, 3>;

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
} // namespace taut

#endif
