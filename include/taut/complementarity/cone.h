// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cone_h
#define taut_cone_h

namespace taut
{
  /**
   * The multipliers N that a row admits, and the gaps D that complement them: N in K, D in the dual
   * cone of K, N D = 0. All conditions of rows are questions to their cones.
   *
   *     free:       any N, D = 0            (bilateral constraints)
   *     half_line:  0 <= N _|_ D >= 0       (unilateral constraints)
   *     zero:       N = 0, any D            (rows that take no part)
   */
  class Cone
  {
  public:
    static constexpr Cone free() { return Cone(Kind::free); }
    static constexpr Cone half_line() { return Cone(Kind::half_line); }
    static constexpr Cone zero() { return Cone(Kind::zero); }

    /// A half line, or free.
    static constexpr Cone unilateral_if(const bool unilateral)
    {
      return unilateral ? half_line() : free();
    }

    /// A row of this cone is open or closed, and a search decides which.
    constexpr bool may_open() const { return kind == Kind::half_line; }

    /// N is not bounded by zero: D = 0 whatever N.
    constexpr bool is_free() const { return kind == Kind::free; }

    /// The nearest admitted multiplier, or compression of a spring that may let go.
    constexpr double project(const double N) const
    {
      return kind == Kind::free || (kind == Kind::half_line && N > 0.) ? N : 0.;
    }

    /// True of a row that carries nothing and may stay so: N = 0 and D >= 0.
    constexpr bool rests_open(const double N, const double D) const
    {
      return kind != Kind::free && N == 0. && (kind == Kind::zero || D >= 0.);
    }

    /// Whether a row with this multiplier has D = 0.
    constexpr bool is_closed(const double N) const { return kind == Kind::free || N > 0.; }

    /// What the conditions lack, as a gap: w N minus the projection of w N - D, with a weight @p w
    /// that makes multipliers comparable with gaps; min(w N, D) on the half line.
    constexpr double violation(const double w, const double N, const double D) const
    {
      return kind == Kind::zero || (kind == Kind::half_line && w * N < D) ? w * N : D;
    }

    /// Newton's restitution of an impact: contacts alone have one.
    constexpr double restitution(const double e) const { return kind == Kind::half_line ? e : 0.; }

    friend constexpr bool operator==(const Cone a, const Cone b) { return a.kind == b.kind; }
    friend constexpr bool operator!=(const Cone a, const Cone b) { return !(a == b); }

  private:
    enum class Kind : unsigned char
    {
      free,
      half_line,
      zero
    };
    explicit constexpr Cone(const Kind kind) : kind(kind) {}

    Kind kind;
  };
} // namespace taut

#endif
