// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_mechanism_h
#define taut_mechanism_h

#include <taut/scene/scene.h>
#include <taut/substructure/substructure.h>

#include <vector>

namespace taut
{
  /// A mechanism: lumped masses that springs and dampers connect, for example a pantograph. Each
  /// motion of a mass has one DoF [m, rad]. Motions are in the order x, y, rotation and z, as far
  /// as the mass has them; masses are in the order of the members.
  class Mechanism : public Substructure
  {
  public:
    /// @p members are indices of scene.masses.
    Mechanism(const Scene &scene, const std::vector<std::size_t> &members);

    /// Name for messages and files: the name of the first mass, "... and others".
    static std::string name_of(const Scene &scene, const std::vector<std::size_t> &members);

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override;
    bool is_lumped() const override { return true; }

    /// Displacement of a mass; place[0] is the number of the mass in this body, counted from 0.
    /// Throws UserError for a number without a mass.
    LinearForm displacement(const Coordinates &place, const Coordinates &direction) const override;
    NullSpace null_space() const override;

    /// Displacement along @p direction [m], or the rotation about z [rad], of a mass of the scene:
    /// result . U. Motions that the mass lacks are zero. @p arm is the place from its centre, which
    /// small rotations move [m].
    void motion(std::size_t mass, bool rotational, const Coordinates &direction, LinearForm &result,
                const Coordinates &arm = {}) const;

  private:
    /// One scalar motion: 0 x, 1 y, 2 rotation, 3 z of a mass.
    struct Dof
    {
      std::size_t mass;
      unsigned int motion;
      double displacement, velocity; ///< at t = 0
    };

    void add_springs(const Scene &scene);
    void add_loads(const Scene &scene);
    void prescribe_motions(const Scene &scene);
    static void check_start(const Mass &mass, const Dof &dof, const ConstrainedDof &prescribed);

    std::vector<Dof> dofs;
  };

  /// Groups of masses that springs connect, each in ascending order.
  std::vector<std::vector<std::size_t>> connected_masses(const Scene &scene);
} // namespace taut

#endif
