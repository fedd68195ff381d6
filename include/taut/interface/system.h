// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_system_h
#define taut_system_h

#include <taut/interface/constraints.h>
#include <taut/substructure/structure.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Displacement of a place of a body along a direction: linear forms on bodies of this rank [m].
  using Displacement = std::vector<Term>;

  /**
   * One scalar condition between two displacements a and b along one direction, with the multiplier
   * N. Its gap is D = a - b + gap + N / stiffness; N > 0 pushes a forwards and b backwards.
   * Unilateral: N >= 0, D >= 0, N D = 0. Bilateral: D = 0. The ground is an empty displacement.
   */
  class Constraint
  {
  public:
    static Constraint unilateral(const std::string &name, const Displacement &a,
                                 const Displacement &b = {});
    static Constraint bilateral(const std::string &name, const Displacement &a,
                                const Displacement &b = {});

    /// Takes displacement and gap from @p place at each time. Throws UserError for nullptr.
    static Constraint unilateral(const std::string &name, std::shared_ptr<MovingPlace> place);

    /**
     * Constraints along the line from end @p a to end @p b at each time, for any motion of the
     * ends. With their distance and a @p length [m], N in N:
     *
     *     rope:  D = length - distance >= 0, N > 0 pulls the ends together
     *     prop:  D = distance - length >= 0, N > 0 pushes them apart
     *     rod:   distance = length,          N > 0 pushes them apart
     *
     * A spring of stiffness() or law() is in series; the length is the length without force. At
     * least one end is on a body. Throws UserError if the length is not positive, or if both ends
     * are at one place at U = 0.
     */
    static Constraint rope(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                           double length);
    /// A rope from the first of two places or more through rings without friction to the last one,
    /// as over pulleys: `distance` is the sum of the distances from place to place.
    static Constraint rope(const std::string &name, const std::vector<LinkEnd> &places,
                           double length);
    static Constraint prop(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                           double length);
    static Constraint rod(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                          double length);

    // Unsuitable values are a UserError at once where a function says so, else in System::add().

    /// D at U = 0, N = 0 [m]. Throws UserError for ropes, props and rods, which have a length.
    Constraint &gap(double value);

    /// Stiffness > 0 of a spring in series, rigid by default, and damping >= 0 of a damper parallel
    /// to it [N/m; N s/m].
    Constraint &stiffness(double value);
    Constraint &damping(double value);

    /// Law of the spring in place of a stiffness: D = a - b + gap + u with N = f(u). Throws
    /// UserError for nullptr, or if the constraint is bilateral.
    Constraint &law(std::shared_ptr<const ForceLaw> value);

    const ConstraintData &constraint() const { return data; }

  private:
    Constraint(const std::string &name, bool unilateral, const Displacement &a,
               const Displacement &b);
    static Constraint turning(const std::string &name, bool unilateral, double push,
                              std::vector<LinkEnd> places, double length);
    ConstraintData data;
  };

  /// Bodies and the constraints between them. Bodies are Taut's or any other Substructure. Each
  /// body lives on one rank; all ranks add the same bodies and constraints in the same order.
  class System
  {
  public:
    /// For one rank, or for the ranks of the communicator.
    explicit System(const Communicator &processes = Communicator());

    /// Adds the body that @p make returns on its owner; other ranks do not call @p make. The
    /// default owner is the rank with the fewest DoFs so far. Returns the number of the body, the
    /// same on all ranks. Throws on all ranks the exceptions of @p make, and UserError for an
    /// unknown rank, or for no body or an inconsistent one. Called by all ranks together.
    std::size_t add(const std::string &name, const Structure::Factory &make);
    std::size_t add(const std::string &name, unsigned int owner, const Structure::Factory &make);

    /// Displacement of a place of a body along a direction, see Substructure::displacement().
    /// Throws UserError on all ranks for an unknown body or place. Called by all ranks together.
    Displacement displacement(std::size_t body, const Coordinates &place,
                              const Coordinates &direction) const;

    /// A place of a body as an end of a rope, prop or rod. The default @p position is that of the
    /// body for the place at U = 0, see Substructure::position(); masses, whose places are numbers,
    /// require one [m]. A fixed end is LinkEnd{{x, y, z}}. Throws on all ranks if the place is not
    /// on the body. Called by all ranks together.
    LinkEnd link_end(std::size_t body, const Coordinates &place) const;
    LinkEnd link_end(std::size_t body, const Coordinates &place, const Coordinates &position) const;

    /// Adds a constraint and returns its number. A Stepper has the constraints that exist at its
    /// construction. Throws UserError with the name of the constraint for impossible numbers, or
    /// forms on bodies of other systems. Called by all ranks together.
    std::size_t add(const Constraint &constraint);

    std::size_t n_bodies() const { return index.size(); }
    std::size_t n_constraints() const { return list.size(); }

    /// A body, or nullptr on other ranks; and its index among the bodies of this rank. Throws
    /// UserError for an unknown number.
    const Substructure *body(std::size_t number) const;
    std::size_t index_here(std::size_t body) const;

    const Communicator &communicator() const { return bodies.communicator(); }
    const Structure &structure() const { return bodies; }

    /// Constraints for a Stepper, sliding ones last: number i of add() is index_of_link(i) there.
    /// They keep a reference to the system, or to another structure of the same bodies.
    Constraints constraints() const;
    Constraints constraints(const Structure &structure) const;

  private:
    Structure bodies;
    std::vector<std::size_t> index; ///< of each body on this rank, or Structure::elsewhere
    std::vector<std::size_t> load;  ///< DoFs of each rank
    std::vector<ConstraintData> list;
  };
} // namespace taut

#endif
