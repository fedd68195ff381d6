// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cable_elements_h
#define taut_cable_elements_h

#include <taut/base/coordinates.h>
#include <taut/base/linear_form.h>
#include <taut/substructure/symmetric_matrix.h>

#include <array>
#include <memory>
#include <vector>

namespace taut
{
  /// How the positions of a cable are interpolated.
  enum class CableElement
  {
    ancf, ///< cubic Hermite polynomials of position and derivative: bends
    bar   ///< Lagrange polynomials of degree 2: axial force only
  };

  struct ElementBatch;
  struct NodeBatch;

  /// A cross section of a cable; lengths are unstressed.
  struct CableSection
  {
    double axial_stiffness = 0.;   ///< EA [N]
    double bending_stiffness = 0.; ///< EI [N m^2]; bars have none
    double mass_per_length = 0.;   ///< [kg/m]
    double axial_damping = 0.;     ///< eta in the axial force EA eps + eta eps' [N s]
  };

  /**
   * Elements of a cable in space with positions r(s) over the unstressed arc length s in [0, L].
   * Use them without a scene, with find_shape(), or through Cable. All functions take absolute
   * positions q. Node i has the DoFs 6 i to 6 i + 5, in this order:
   *
   * - ANCF: x, y, z [m] and the derivatives x', y', z' with respect to s [1];
   * - bar: x, y, z of the node and of the middle of the next element [m]. The last node has no next
   *   element: its last three DoFs do not exist (unused_dofs()) and must be held.
   *
   * The axial strain is eps = |r'| - 1, the curvature kappa = |r' x r''| / |r'|^2, the energy per
   * unstressed length EA eps^2 / 2 + EI kappa^2 / 2. The beam without shear by absolute nodal
   * coordinates (ANCF) is that of Shabana (Multibody System Dynamics 1, 1997, 339-348) and
   * Gerstmayr & Shabana (Nonlinear Dynamics 45, 2006, 109-130); with |r'|^2 instead of |r'|^3 in
   * kappa, EI kappa is the moment conjugate to the angle per unstressed length. The integrals have
   * few points on purpose: with more points axial forces and bending moments lock.
   */
  class CableElements
  {
  public:
    static constexpr unsigned int dofs_per_node = 6;

    /// A cable of unstressed length @p length [m] in equal elements.
    CableElements(CableElement element, double length, unsigned int n_elements,
                  const CableSection &section);

    /// A cable whose nodes are at these unstressed arc lengths, from 0 on, sorted [m].
    CableElements(CableElement element, const std::vector<double> &nodes,
                  const CableSection &section);

    CableElement element() const { return kind; }
    const CableSection &section() const { return material; }
    double length() const { return nodes.empty() ? h * n : nodes.back(); }
    unsigned int n_elements() const { return n; }
    unsigned int n_dofs() const { return dofs_per_node * (n + 1); }

    /// Mean length of the elements, and the shortest one [m].
    double element_length() const { return h; }
    double shortest_element() const { return shortest; }

    /// The unstressed arc length of a place that is counted in elements [m]: node i is at i, the
    /// middle of the element after it at i + 1/2.
    double place(double count) const;

    /// DoFs that no element has, sorted.
    std::vector<unsigned int> unused_dofs() const;

    /// DoFs of the position of the node at the first or last end.
    std::array<unsigned int, 3> end_dofs(bool last) const;

    /// The same nodes with another section or axial stiffness [N].
    CableElements with_section(const CableSection &section) const;
    CableElements with_axial_stiffness(double EA) const;

    /// The integral of the energy above [J].
    double strain_energy(const std::vector<double> &q) const;

    /// The gradient of the energy, and the force of the damping at the velocities @p v [m/s, 1/s];
    /// an empty v is a cable at rest. In equilibrium it equals the external force. @p f is resized
    /// [N, N m].
    void internal_force(const std::vector<double> &q, const std::vector<double> &v,
                        std::vector<double> &f) const;

    /**
     * A mean force over a step [s] from q0 to q1 with f . (q1 - q0) equal to the change of the
     * energy and to the work that the damping takes, the integral of eta (eps1 - eps0)^2 / step.
     * The part of eps is the secant stress EA (1 - 2/(lambda0 + lambda1)), lambda = |r'|, on the
     * mean r'. The part of kappa is the discrete gradient in the invariants r'.r', r'.r'', r''.r'',
     * which keeps angular momentum, too: Gonzalez (Journal of Nonlinear Science 6, 1996, 449-467).
     * @p f is resized [N, N m].
     */
    void mean_force(const std::vector<double> &q0, const std::vector<double> &q1, double step,
                    std::vector<double> &f) const;

    /// A += the Hessian of the energy [N/m, N, N m]. @p definite adds a semidefinite part of it,
    /// without the geometric stiffness of compression and of moments.
    void add_tangent(const std::vector<double> &q, bool definite, SymmetricMatrix &A) const;

    /**
     * A += a symmetric matrix close to twice the derivative of mean_force() with respect to q1: the
     * secant stress of the step acts on the middle of the step. The stress of the middle itself
     * would be a compression, as rotation shortens the middle.
     */
    void add_mean_tangent(const std::vector<double> &q0, const std::vector<double> &q1,
                          bool definite, SymmetricMatrix &A) const;

    /// A += @p factor [1/s] times the derivative of the damping force with respect to velocities.
    void add_damping(const std::vector<double> &q, double factor, SymmetricMatrix &A) const;

    /// A += @p factor times the consistent mass matrix.
    void add_mass(double factor, SymmetricMatrix &A) const;

    /// f += a force per unstressed length [N/m] along the whole cable.
    void add_load(const Coordinates &force, std::vector<double> &f) const;

    /// The component of r(s) or r'(s) along @p direction; s in [0, L].
    LinearForm position(double s, const Coordinates &direction) const;
    LinearForm tangent(double s, const Coordinates &direction) const;
    Coordinates position(const std::vector<double> &q, double s) const;
    Coordinates tangent(const std::vector<double> &q, double s) const;

    /// EA eps at s [N], interpolated between the integration points, where it is most accurate;
    /// negative: compression.
    double tension(const std::vector<double> &q, double s) const;

    /// Largest and smallest eps of all integration points [1], and the place of the smallest [m].
    double largest_strain(const std::vector<double> &q) const;
    double smallest_strain(const std::vector<double> &q, double *place = nullptr) const;

    /// kappa at s [1/m]; zero for bars.
    double curvature(const std::vector<double> &q, double s) const;

    /// Positions q from functions r(s) and, for ANCF, r'(s).
    template <typename Position, typename Derivative>
    std::vector<double> interpolate(const Position &r, const Derivative &dr) const
    {
      std::vector<double> q(n_dofs(), 0.);
      for (unsigned int i = 0; i <= n; ++i)
      {
        set(q, dofs_per_node * i, r(place(i)));
        if (kind == CableElement::ancf)
          set(q, dofs_per_node * i + 3, dr(place(i)));
        else if (i < n)
          set(q, dofs_per_node * i + 3, r(place(i + .5)));
      }
      return q;
    }

  private:
    static constexpr unsigned int element_dofs = 12; ///< bars use the first nine

    /// Values for the four shape functions of an element; bars have three, and a zero.
    using Shape = std::array<double, 4>;

    struct Shapes
    {
      Shape value, slope, curvature; ///< derivatives with respect to s
    };

    /// Over the mean length of an element: the length of one; what takes positions, and what takes
    /// the second vector of a node, from it to an element of mean length [1].
    struct Ratios
    {
      std::vector<double> length, of_position, of_middle;
    };

    /// An integration point of an element.
    struct Point
    {
      double weight; ///< [m]
      double xi;     ///< in [0, 1]
      Shape slope, curvature;
    };

    using Local = std::array<double, element_dofs>;
    using LocalMatrix = std::array<Local, element_dofs>;

    Shapes shapes(double xi) const;
    Shapes shapes(double xi, unsigned int e) const;
    Point in_element(const Point &p, unsigned int e) const;
    void set_points();
    Local local(const std::vector<double> &q, unsigned int e) const;
    ElementBatch batch(const std::vector<double> &q, unsigned int first) const;
    std::array<double, 8> end_weights(unsigned int first) const;
    template <typename Force>
    void set_axial_forces(unsigned int first, const ElementBatch &x, const ElementBatch &y,
                          const Force &axial, ElementBatch &sum, NodeBatch &of_nodes) const;
    template <typename Integrand>
    void integrate_force(std::vector<double> &f, const Integrand &integrand) const;
    void add(const LocalMatrix &K, unsigned int e, SymmetricMatrix &A) const;
    void add_axial_tangent(const Local &x, unsigned int e, bool definite, LocalMatrix &K) const;
    void add_bending_tangent(const Local &x, unsigned int e, bool definite, LocalMatrix &K) const;
    std::pair<unsigned int, double> find(double s) const;
    LinearForm form(double s, const Coordinates &direction, bool slope) const;
    Coordinates vector(const std::vector<double> &q, double s, bool slope) const;
    static void set(std::vector<double> &q, const unsigned int i, const Coordinates &r)
    {
      q[i] = r.x;
      q[i + 1] = r.y;
      q[i + 2] = r.z;
    }

    CableElement kind;
    unsigned int n;
    double h, shortest; ///< [m]
    CableSection material;
    std::vector<double> nodes; ///< empty if the elements are equal [m]
    Ratios ratios;             ///< with ones behind the last element, for a batch
    std::vector<Point> axial_points, bending_points;
    std::vector<Point> inner_axial_points; ///< not at the ends of elements
    double end_weight = 0.;                ///< of an axial point at an end, if there is one [m]
  };
} // namespace taut

#endif
