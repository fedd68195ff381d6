// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/end_frames.h"

#include <taut/base/coordinates.h>

namespace taut
{
  void EndFrames::add(const unsigned int first_dof, const Coordinates &direction)
  {
    // Across the mirror plane: from x to the direction.
    const Coordinates across =
        add_scaled(add_scaled({}, 1. / norm(direction), direction), -1., {1., 0., 0.});
    const double squared = dot(across, across);
    Mirror H{};
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        H[r][c] = (r == c ? 1. : 0.) - (squared == 0. ? 0. : 2. * across[r] * across[c] / squared);
    mirrors[first_dof] = H;
  }

  EndFrames::Turned EndFrames::turned(const unsigned int i) const
  {
    auto mirror = mirrors.upper_bound(i);
    if (mirror == mirrors.begin() || i >= (--mirror)->first + 3)
      return {i, 1, {{1., 0., 0.}}};
    const Mirror &H = mirror->second;
    const unsigned int column = i - mirror->first;
    return {mirror->first, 3, {{H[0][column], H[1][column], H[2][column]}}};
  }

  void EndFrames::turn(std::vector<double> &x) const
  {
    for (const auto &[first, H] : mirrors)
    {
      const double old[3] = {x[first], x[first + 1], x[first + 2]};
      for (unsigned int r = 0; r < 3; ++r)
        x[first + r] = H[r][0] * old[0] + H[r][1] * old[1] + H[r][2] * old[2];
    }
  }

  LinearForm EndFrames::turn(LinearForm form) const
  {
    if (empty())
      return form;
    std::size_t n = 0;
    for (const unsigned int i : form.index)
      n += turned(i).n;
    LinearForm result;
    result.index.reserve(n);
    result.value.reserve(n);
    for (std::size_t k = 0; k < form.index.size(); ++k)
    {
      const Turned part = turned(form.index[k]);
      for (unsigned int l = 0; l < part.n; ++l)
        result.add(part.first + l, form.value[k] * part.value[l]);
    }
    return result;
  }

  std::unique_ptr<SymmetricMatrix> EndFrames::turn(std::unique_ptr<SymmetricMatrix> A) const
  {
    if (empty())
      return A;
    auto B = make_block_tridiagonal(A->block_size(), A->size());
    const auto add = [&](const unsigned int i, const unsigned int j, const double value)
    {
      const Turned rows = turned(i), columns = turned(j);
      for (unsigned int k = 0; k < rows.n; ++k)
        for (unsigned int l = 0; l < columns.n; ++l)
          if (columns.first + l <= rows.first + k)
            B->add(rows.first + k, columns.first + l, value * rows.value[k] * columns.value[l]);
    };
    A->visit(
        [&](const unsigned int i, const unsigned int j, const double value)
        {
          add(i, j, value);
          if (i != j)
            add(j, i, value);
        });
    return B;
  }
} // namespace taut
