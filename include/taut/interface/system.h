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
  /// The displacement of a place of a body along a direction, as linear forms on the bodies of this
  /// rank [m].
  using Displacement = std::vector<Term>;

  /**
   * One scalar condition between two displacements a and b along one direction, with the multiplier
   * N: its gap is D = a - b + gap + N / stiffness, and N > 0 pushes a forwards and b backwards.
   * Unilateral: N >= 0, D >= 0, N D = 0. Bilateral: D = 0. The ground is an empty displacement.
   */
  class Constraint
  {
  public:
    static Constraint unilateral(const std::string &name, const Displacement &a,
                                 const Displacement &b = {});
    static Constraint bilateral(const std::string &name, const Displacement &a,
                                const Displacement &b = {});

    /// One whose displacement and gap @p place gives anew at each time. Throws UserError for
    /// nullptr.
    static Constraint unilateral(const std::string &name, std::shared_ptr<MovingPlace> place);

    /**
     * Constraints along the line from end @p a to end @p b at each time, however far these move.
     * With their distance and a @p length [m], N in N:
     *
     *     rope:  D = length - distance >= 0, N > 0 pulls the ends together
     *     prop:  D = distance - length >= 0, N > 0 pushes them apart
     *     rod:   distance = length,          N > 0 pushes them apart
     *
     * with the spring of stiffness() or law() in series; the length is that without force. At least
     * one end is on a body. Throws UserError if the length is not positive, or if both ends are at
     * one place at U = 0.
     */
    static Constraint rope(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                           double length);
    static Constraint prop(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                           double length);
    static Constraint rod(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                          double length);

    // What does not fit is a UserError at once where a function says so, and otherwise of
    // System::add().

    /// D at U = 0, N = 0 [m]. Throws UserError for ropes, props and rods, whose length says it.
    Constraint &gap(double value);

    /// Of a spring in series, rigid without it, and of a damper beside the spring [N/m; N s/m]: the
    /// first positive, the second not negative.
    Constraint &stiffness(double value);
    Constraint &damping(double value);

    /// The law of that spring instead of a stiffness, D = a - b + gap + u with N = f(u). Throws
    /// UserError for nullptr, or if the constraint is bilateral.
    Constraint &law(std::shared_ptr<const ForceLaw> value);

    const ConstraintData &constraint() const { return data; }

  private:
    Constraint(const std::string &name, bool unilateral, const Displacement &a,
               const Displacement &b);
    static Constraint turning(const std::string &name, bool unilateral, double push,
                              const LinkEnd &a, const LinkEnd &b, double length);
    ConstraintData data;
  };

  /**
   * Bodies and the constraints between them. Bodies may be Taut's own or any other Substructure;
   * each lives on one rank, and all ranks add the same bodies and constraints in the same order.
   */
  class System
  {
  public:
    /// On one rank alone, or on the ranks of the communicator.
    explicit System(const Communicator &processes = Communicator());

    /// Adds the body that @p make returns on its owner, the rank with the fewest DoFs so far unless
    /// one is named; other ranks do not call it. Returns the number of the body, the same on all
    /// ranks. Called by all ranks together; throws on all of them what @p make throws, and
    /// UserError for a rank that there is not, no body, or one that is not consistent.
    std::size_t add(const std::string &name, const Structure::Factory &make);
    std::size_t add(const std::string &name, unsigned int owner, const Structure::Factory &make);

    /// The displacement of a place of a body along a direction, see Substructure::displacement().
    /// Called by all ranks together; throws UserError on all of them if there is no such body, or
    /// the place is not on it.
    Displacement displacement(std::size_t body, const Coordinates &place,
                              const Coordinates &direction) const;

    /// A place of a body as an end of a rope, prop or rod. Without @p position it is where the body
    /// says that the place is at U = 0, see Substructure::position(); masses, whose places are
    /// numbers, need one [m]. An end that stands is LinkEnd{{x, y, z}}. Called by all ranks
    /// together; throws on all of them if the place is not on the body.
    LinkEnd link_end(std::size_t body, const Coordinates &place) const;
    LinkEnd link_end(std::size_t body, const Coordinates &place, const Coordinates &position) const;

    /// Adds a constraint and returns its number among them. A Stepper knows those that were there
    /// when it was made. Called by all ranks together; throws UserError, which names the
    /// constraint, for numbers that are not possible and forms that are not on bodies of this
    /// system.
    std::size_t add(const Constraint &constraint);

    std::size_t n_bodies() const { return index.size(); }
    std::size_t n_constraints() const { return list.size(); }

    /// A body if it is on this rank, otherwise nullptr; and its index among the bodies of this
    /// rank. Throws UserError for a number that no body has.
    const Substructure *body(std::size_t number) const;
    std::size_t index_here(std::size_t body) const;

    const Communicator &communicator() const { return bodies.communicator(); }
    const Structure &structure() const { return bodies; }

    /// The constraints for a Stepper, the moving ones last: number i of add() is index_of_link(i)
    /// there. They keep a reference to the system, or to another structure of the same bodies.
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
