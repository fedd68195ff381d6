// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_block_elimination_h
#define taut_block_elimination_h

#include "substructure/blocks.h"

#include <algorithm>
#include <cstring>
#include <utility>
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
    double operator[](const int i) const { return v[i]; }

    /// += factor column
    void add(const double factor, const double *column)
    {
      for (int r = 0; r < b; ++r)
        v[r] += factor * column[r];
    }
    void subtract(const double factor, const double *column)
    {
      for (int r = 0; r < b; ++r)
        v[r] -= factor * column[r];
    }

  private:
    double v[b];
  };

  /// The DoFs of one node in a vector type of GCC and Clang; the vectors of deal.II have one number
  /// in Debian's build.
  template <typename Vector>
  class VectorNode
  {
  public:
    void read(const double *x) { std::memcpy(&v, x, sizeof(v)); }
    void write(double *x) const { std::memcpy(x, &v, sizeof(v)); }
    double operator[](const int i) const { return v[i]; }
    void add(const double factor, const double *column)
    {
      Vector values; // no function returns a vector: its register depends on the instruction set
      std::memcpy(&values, column, sizeof(values));
      v += factor * values;
    }
    void subtract(const double factor, const double *column)
    {
      Vector values;
      std::memcpy(&values, column, sizeof(values));
      v -= factor * values;
    }
    /// += x times @p row, one by one
    void add_products(const VectorNode &x, const double *row)
    {
      Vector values;
      std::memcpy(&values, row, sizeof(values));
      v += x.v * values;
    }

  private:
    Vector v;
  };
  using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
  using Quad [[gnu::vector_size(4 * sizeof(double))]] = double;

  /// Beams, and strings of degree 2.
  template <>
  class Node<2> : public VectorNode<Pair>
  {
  };

  /// Beams in space.
  template <>
  class Node<4> : public VectorNode<Quad>
  {
  };

  /// Cables.
  template <>
  class Node<6>
  {
  public:
    void read(const double *x)
    {
      front.read(x);
      back.read(x + 4);
    }
    void write(double *x) const
    {
      front.write(x);
      back.write(x + 4);
    }
    double operator[](const int i) const { return i < 4 ? front[i] : back[i - 4]; }
    void add(const double factor, const double *column)
    {
      front.add(factor, column);
      back.add(factor, column + 4);
    }
    void subtract(const double factor, const double *column)
    {
      front.subtract(factor, column);
      back.subtract(factor, column + 4);
    }

  private:
    Node<4> front;
    Node<2> back;
  };

  /// y += A^T x
  template <int b>
  inline void add_transposed(const Block<b> &A, const Node<b> &x, Node<b> &y)
  {
    for (int c = 0; c < b; ++c)
      y.add(x[c], A.data() + b * c);
  }

  /// y -= A^T x
  template <int b>
  inline void subtract_transposed(const Block<b> &A, const Node<b> &x, Node<b> &y)
  {
    for (int c = 0; c < b; ++c)
      y.subtract(x[c], A.data() + b * c);
  }

  /// The DoFs of a node that blocks of a kind act on.
  template <int b>
  Node<b> node_of(const Block<b> &);
  template <typename AnyBlock>
  using NodeOf = decltype(node_of(std::declval<AnyBlock>()));

  /// x -= A y; returns x: one node of the elimination. @p transposed is A^T.
  template <typename AnyBlock>
  inline NodeOf<AnyBlock> eliminate(const AnyBlock &transposed, const NodeOf<AnyBlock> &y,
                                    double *x)
  {
    NodeOf<AnyBlock> sum;
    sum.read(x);
    subtract_transposed(transposed, y, sum);
    sum.write(x);
    return sum;
  }

  /// x = D x - A^T y with a symmetric D; returns x: one node of the substitution.
  template <typename AnyBlock>
  inline NodeOf<AnyBlock> substitute(const AnyBlock &D, const AnyBlock &A,
                                     const NodeOf<AnyBlock> &y, double *x)
  {
    constexpr double zero[AnyBlock::n_dofs] = {};
    NodeOf<AnyBlock> before, sum;
    before.read(x);
    sum.read(zero);
    add_transposed(D, before, sum);
    subtract_transposed(A, y, sum);
    sum.write(x);
    return sum;
  }

  /// The data of the elimination from one end at a node, in whole cache lines.
  template <typename AnyBlock>
  struct alignas(64) Elimination
  {
    AnyBlock multiplier; ///< from the node before: G or H below
    AnyBlock transposed; ///< multiplier
    AnyBlock inverse;    ///< of the pivot
  };

  /**
   * The eliminations of all nodes. Where elements are alike, the recurrence becomes stationary.
   * Equal neighbours are stored once, and a solve reads them from the nearest cache.
   */
  template <typename AnyBlock>
  class Eliminations
  {
  public:
    void reinit(const std::size_t n)
    {
      distinct.clear();
      distinct.reserve(n); // so that they stay in their places
      of_node.resize(n);
    }

    /// Neighbours one after the other, from either end.
    void set(const std::size_t node, const Elimination<AnyBlock> &e)
    {
      if (distinct.empty() || distinct.back().multiplier != e.multiplier ||
          distinct.back().inverse != e.inverse)
        distinct.push_back(e);
      of_node[node] = &distinct.back();
    }

    const Elimination<AnyBlock> &operator[](const std::size_t node) const { return *of_node[node]; }

    /// Of all nodes.
    const Elimination<AnyBlock> *const *data() const { return of_node.data(); }

  private:
    std::vector<Elimination<AnyBlock>> distinct;
    std::vector<const Elimination<AnyBlock> *> of_node;
  };
} // namespace taut

#endif
