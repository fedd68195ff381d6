// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_block_elimination_h
#define taut_block_elimination_h

#include "blocks.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <vector>

/// The steps of a block-tridiagonal elimination, node by node.
namespace taut
{
  /// The DoFs of one node, by value: they stay in registers.
  template <int b>
  class Node
  {
  public:
    void read(const double *x) { std::copy(x, x + b, v); }
    void write(double *x) const { std::copy(v, v + b, x); }

    /// += A^T x
    void add_transposed(const Block<b> &A, const Node &x)
    {
      for (int c = 0; c < b; ++c)
        for (int r = 0; r < b; ++r)
          v[r] += A[c * b + r] * x.v[c];
    }

    /// -= A^T x
    void subtract_transposed(const Block<b> &A, const Node &x)
    {
      taut::subtract_transposed<b>(A, x.v, v);
    }

  private:
    double v[b];
  };

  /// Two DoFs: beams, and strings of degree 2. The vectors of GCC and Clang; deal.II's have one
  /// number in Debian's build.
  template <>
  class Node<2>
  {
  public:
    void read(const double *x) { v = pair(x); }
    void write(double *x) const { std::memcpy(x, &v, sizeof(v)); }
    void add_transposed(const Block<2> &A, const Node &x)
    {
      v += Pair{x.v[0], x.v[0]} * pair(A.data());
      v += Pair{x.v[1], x.v[1]} * pair(A.data() + 2);
    }
    void subtract_transposed(const Block<2> &A, const Node &x)
    {
      v -= Pair{x.v[0], x.v[0]} * pair(A.data());
      v -= Pair{x.v[1], x.v[1]} * pair(A.data() + 2);
    }

  private:
    using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
    static Pair pair(const double *x)
    {
      Pair result;
      std::memcpy(&result, x, sizeof(result));
      return result;
    }

    Pair v;
  };

  /// x -= A y; returns x: one node of the elimination. @p transposed is A^T.
  template <int b>
  inline Node<b> eliminate(const Block<b> &transposed, const Node<b> &y, double *x)
  {
    Node<b> sum;
    sum.read(x);
    sum.subtract_transposed(transposed, y);
    sum.write(x);
    return sum;
  }

  /// x = D x - A^T y with a symmetric D; returns x: one node of the substitution.
  template <int b>
  inline Node<b> substitute(const Block<b> &D, const Block<b> &A, const Node<b> &y, double *x)
  {
    constexpr double zero[b] = {};
    Node<b> before, sum;
    before.read(x);
    sum.read(zero);
    sum.add_transposed(D, before);
    sum.subtract_transposed(A, y);
    sum.write(x);
    return sum;
  }

  /// What the elimination from one end leaves at a node.
  template <int b>
  struct Elimination
  {
    Block<b> multiplier; ///< from the node before: G or H below
    Block<b> transposed; ///< multiplier
    Block<b> pivot, inverse;
  };

  /**
   * The eliminations of all nodes. Where elements are alike, their recurrence comes to rest:
   * equal neighbours are stored once, and a solve reads them from the nearest cache.
   */
  template <int b>
  class Eliminations
  {
  public:
    void reinit(const std::size_t n)
    {
      distinct.clear();
      of_node.resize(n);
    }

    /// Neighbours one after the other, from either end.
    void set(const std::size_t node, const Elimination<b> &e)
    {
      if (distinct.empty() || distinct.back().multiplier != e.multiplier ||
          distinct.back().inverse != e.inverse)
        distinct.push_back(e);
      of_node[node] = &distinct.back();
    }

    const Elimination<b> &operator[](const std::size_t node) const { return *of_node[node]; }

    /// Of all nodes.
    const Elimination<b> *const *data() const { return of_node.data(); }

  private:
    std::deque<Elimination<b>> distinct;
    std::vector<const Elimination<b> *> of_node;
  };
} // namespace taut

#endif
