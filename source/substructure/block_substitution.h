// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_block_substitution_h
#define taut_block_substitution_h

#include "substructure/block_elimination.h"

#include <cstddef>

/// Both halves of a block-tridiagonal solve, from both ends to the middle node and back.
namespace taut
{
  /// @p n nodes, with eliminations from the left and from the right, each up to node @p middle or
  /// further.
  template <typename AnyBlock>
  struct BothEliminations
  {
    const Elimination<AnyBlock> *const *from_left, *const *from_right;
    std::ptrdiff_t n, middle;
  };

  /// The first half of a solve: elimination from both ends to the middle.
  template <typename AnyBlock>
  class Inwards
  {
    static constexpr int b = AnyBlock::n_dofs;

  public:
    Inwards(const BothEliminations<AnyBlock> &s, double *x)
        : from_left(s.from_left), from_right(s.from_right + (s.n - 1)), l(x), r(x + b * (s.n - 1)),
          n_left(s.middle), n_right(s.n - 1 - s.middle)
    {
      left.read(l);
      right.read(r);
    }

    /// Steps of both ends, from step 1 on, without the middle.
    std::ptrdiff_t n_steps() const { return std::min(n_left, n_right) - 1; }

    void step(const std::ptrdiff_t k)
    {
      left = eliminate(from_left[k]->transposed, left, l + b * k);
      right = eliminate(from_right[-k]->transposed, right, r - b * k);
    }

    /// The steps from @p k on, and those of one end only.
    void finish(std::ptrdiff_t k)
    {
      for (; k <= n_steps(); ++k)
        step(k);
      for (std::ptrdiff_t i = k; i < n_left; ++i)
        left = eliminate(from_left[i]->transposed, left, l + b * i);
      for (std::ptrdiff_t j = k; j < n_right; ++j)
        right = eliminate(from_right[-j]->transposed, right, r - b * j);
    }

  private:
    const Elimination<AnyBlock> *const *from_left, *const *from_right;
    double *l, *r;
    std::ptrdiff_t n_left, n_right;
    NodeOf<AnyBlock> left, right; ///< the last node of each end
  };

  /// The second half: substitution from the middle to both ends.
  template <typename AnyBlock>
  class Outwards
  {
    static constexpr int b = AnyBlock::n_dofs;

  public:
    Outwards(const BothEliminations<AnyBlock> &s, double *x)
        : from_left(s.from_left + s.middle), from_right(s.from_right + s.middle),
          m(x + b * s.middle), n_left(s.middle), n_right(s.n - 1 - s.middle)
    {
      left.read(m);
      right = left;
    }

    /// Steps of both ends, from step 1 on.
    std::ptrdiff_t n_steps() const { return std::min(n_left, n_right); }

    void step(const std::ptrdiff_t k)
    {
      leftwards(k);
      rightwards(k);
    }

    /// The steps from @p k on, and those of one end only.
    void finish(std::ptrdiff_t k)
    {
      for (; k <= n_steps(); ++k)
        step(k);
      for (std::ptrdiff_t i = k; i <= n_left; ++i)
        leftwards(i);
      for (std::ptrdiff_t j = k; j <= n_right; ++j)
        rightwards(j);
    }

  private:
    void leftwards(const std::ptrdiff_t k)
    {
      left = substitute(from_left[-k]->inverse, from_left[1 - k]->multiplier, left, m - b * k);
    }
    void rightwards(const std::ptrdiff_t k)
    {
      right = substitute(from_right[k]->inverse, from_right[k - 1]->multiplier, right, m + b * k);
    }

    const Elimination<AnyBlock> *const *from_left, *const *from_right;
    double *m;
    std::ptrdiff_t n_left, n_right;
    NodeOf<AnyBlock> left, right;
  };
} // namespace taut

#endif
