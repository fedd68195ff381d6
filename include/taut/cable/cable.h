// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_cable_h
#define taut_cable_h

#include <taut/base/coordinates.h>
#include <taut/cable/cable_elements.h>
#include <taut/cable/find_shape.h>
#include <taut/substructure/body_traits.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  class EndFrames;

  /// How the geometry of a cable changes with its motion.
  enum class CableGeometry
  {
    nonlinear,  ///< motions of any size
    linearised, ///< nonlinear until the start is found, then small motions about the start
    linear      ///< small motions of a straight wire from end to end with the same tension
  };

  /// The data of a cable.
  struct CableData
  {
    std::string name;
    std::string origin;   ///< path of its section in the parameter file, for messages; may be empty
    Coordinates from, to; ///< places of the ends of its found shape [m]
    double length = 0.;   ///< unstressed, more than zero [m]
    CableSection section;
    double mass_damping = 0.;     ///< a in C = a M [1/s]
    Coordinates gravity;          ///< [m/s^2]
    Coordinates force;            ///< per unstressed length, beside the weight [N/m]
    unsigned int n_elements = 16; ///< no element is longer than this part of the cable
    CableElement element = CableElement::ancf;

    /// Unstressed arc lengths that are nodes, as those of loads and links have to be, in any order
    /// [m].
    std::vector<double> places = {};

    bool holds_from = true, holds_to = true; ///< these ends do not move
    bool clamped = false;                    ///< held ends keep their direction, too

    /// With Start = given a run begins with the unstressed cable in a straight line from `from`
    /// along start_direction, not with the found shape.
    bool starts_straight = false;
    Coordinates start_direction;

    CableGeometry geometry = CableGeometry::nonlinear;
    double largest_strain = .02; ///< at rest; a larger strain is an error [1]

    /// By how much the forces of a step see a straight piece that is compressed moved across its
    /// line, over the length of the cable: without that it would push. 0: it pushes [1].
    double disturbance = 1e-3;
  };

  /// The force per unstressed length on a cable, weight included [N/m].
  Coordinates force_per_length(const CableData &data);

  /**
   * The elements of a cable with the unstressed length @p length [m]. Without places they are
   * equal. Otherwise each piece from place to place is divided into equal ones. Elements of ANCF
   * are smooth at nodes, and a force makes a kink in a cable that hardly bends: it gets two nodes
   * more, close beside the place.
   */
  CableElements make_elements(const CableData &data, double length);

  /**
   * A cable in space that moves by large amounts, slack or taut. Take a wire for small motions of a
   * straight taut wire.
   *
   * U is the displacement from the found shape: the equilibrium under weight and constant force
   * with both ends held at `from` and `to`, whatever is held later, see hang(). If the ends are
   * above each other, the cable is slack and one end is free, the found shape is that of
   * hang_freely(). Positions are counted from `from`, so that a scene far from the origin rounds
   * like a scene near it.
   *
   * - A nonlinear cable has the internal force of CableElements at the positions found + U, and the
   *   whole load as external force. At U = 0 both balance on all DoFs but those of the ends, where
   *   their difference is the force that holds the cable.
   * - A linearised cable is nonlinear until linearised() makes a linear cable from it. The linear
   *   cable has the tangent at a displacement U* as K, the axial damping there in C, and the
   *   internal force f(U*) + K (U - U*). U counts from the same found shape, and the load is the
   *   same.
   * - A linear cable has K and axial damping of the straight line between `from` and `to`, with the
   *   unstressed length of the cable. Along the line it has EA, across it the tension of the found
   *   shape along this line. The internal force is K U. The load is zero but at the ends, where it
   *   is the load without the internal force of the found shape. The stiffness from the sag is left
   *   out.
   *
   * In all cases the forces that hold an end are complete, and an end that nothing holds starts to
   * move. The DoFs of r' at a clamped end are components along the cable and across it, not along
   * x, y, z; use displacement() and positions().
   */
  class Cable : public Substructure, public SlenderBody
  {
  public:
    /// Throws EntryError for data that make no cable, or that have no stable equilibrium.
    explicit Cable(const CableData &data);
    ~Cable() override;

    const CableElements &elements() const { return element; }

    /// The found shape; positions count from `from` [m, 1].
    const CableShape &shape() const { return found; }

    /// Positions at the displacement U, counted from `from`, in the order of CableElements [m, 1].
    std::vector<double> positions(const std::vector<double> &U) const;

    /// The displacement at place[0], the unstressed arc length from `from`, along any direction in
    /// space.
    LinearForm displacement(const Coordinates &place, const Coordinates &direction) const override;

    /// The position in space of a place on the found shape.
    Coordinates position(const Coordinates &place) const override;

    LinearForm slope(double place, const Coordinates &direction) const override;

    bool is_linear() const override
    {
      return data.geometry == CableGeometry::linear || !linear_at.empty();
    }

    /// Replaces a cable with CableGeometry::linearised.
    std::shared_ptr<Substructure> linearised(const std::vector<double> &U) const override;

    bool is_to_be_linearised() const override
    {
      return data.geometry == CableGeometry::linearised && !is_linear();
    }

    /// True if K is the tangent at the start of a run.
    bool is_linearised() const { return !linear_at.empty(); }

    /// Translations, if no end is held: they change no strain, whatever the shape.
    NullSpace null_space() const override;

    /// The place of the largest compression, beyond rounding. A linear cable never is slack.
    bool is_slack(const std::vector<double> &U, Slack &slack) const override;

    void disturb(std::vector<double> &U) const override;
    bool is_in_tension(const std::vector<double> &U) const override;

    /// What a section of the cable carries, without what axial damping adds.
    struct Section
    {
      Coordinates place;   ///< displaced, in the scene [m]
      double tension = 0.; ///< [N]
      double moment = 0.;  ///< EI kappa; 0 for bars [N m]
    };

    /// Number of the sections: all nodes and middles of elements.
    std::size_t n_sections() const { return 2 * element.n_elements() + 1; }

    /// At a displacement U, from `from` to `to`.
    std::vector<Section> sections(const std::vector<double> &U) const;

    void check_at_rest(const std::vector<double> &U) const override;

    double axial_stiffness() const override { return data.section.axial_stiffness; }
    std::unique_ptr<Substructure> with_axial_stiffness(double EA) const override;

    /// The energy, zero in the unstressed cable unless the cable is linear.
    double strain_energy(const std::vector<double> &U) const override;
    void internal_force(const std::vector<double> &U, const std::vector<double> &V,
                        std::vector<double> &f) const override;
    double rounding_of_force(unsigned int kind) const override;
    void mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                             double step, std::vector<double> &f) const override;
    std::unique_ptr<SymmetricMatrix> tangent(const std::vector<double> &U,
                                             const std::vector<double> &V, double rate,
                                             bool definite) const override;

    std::unique_ptr<SymmetricMatrix> mean_tangent(const std::vector<double> &U0,
                                                  const std::vector<double> &U1, double rate,
                                                  bool definite) const override;
    void take_back(std::unique_ptr<SymmetricMatrix> tangent) const override
    {
      spare = std::move(tangent);
    }

    /// Node k of the surface is the node between elements k - 1 and k.
    LinearForm node_displacement(unsigned int node, const Coordinates &direction) const override;

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override;

    /// A line at the displaced positions with displacement, tension and unstressed arc length.
    bool has_fields() const override { return true; }
    void write_vtu(const std::string &path, const std::vector<double> &U) const override;

  private:
    Cable(const CableData &data, const CableElements &elements, const CableShape &found);
    Cable(const Cable &nonlinear, const std::vector<double> &U);
    void check() const;
    bool hangs_freely() const;
    void find();
    void check_free_end(const std::vector<double> &q, bool last) const;
    bool hangs_from_last() const;
    void find_pieces();
    bool is_straight(const std::vector<double> &q, unsigned int piece) const;
    bool pushes(const std::vector<double> &q, unsigned int piece) const;
    void hold();
    void assemble();
    void straighten();
    std::vector<double> straight_line() const;
    const std::vector<double> &linear_from() const;
    std::function<double(double)> tension_at(const std::vector<double> &q) const;
    void set_positions(const std::vector<double> &U, std::vector<double> &q) const;
    void set_way(const std::vector<double> &U) const;
    std::unique_ptr<SymmetricMatrix> zero_matrix() const;

    CableData data;
    CableElements element;
    CableShape found;
    std::vector<unsigned int> piece_ends; ///< nodes at the ends and at `places`
    std::vector<double> tangent_at;       ///< positions whose tangent is K

    /// For a linearised cable: its displacement, internal force [N, N m] and strain energy [J] at
    /// the start.
    std::vector<double> linear_at, force_there;
    double energy_there = 0.;
    std::unique_ptr<EndFrames> frames;
    mutable std::vector<double> work_0, work;       ///< positions, and displacements
    mutable std::unique_ptr<SymmetricMatrix> spare; ///< a tangent that came back
  };
} // namespace taut

#endif
