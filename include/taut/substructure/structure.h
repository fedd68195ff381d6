// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_structure_h
#define taut_structure_h

#include <taut/base/communicator.h>
#include <taut/substructure/substructure.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A linear form on the displacements of one substructure of this rank: a summand of a
  /// constraint.
  struct Term
  {
    std::size_t substructure = 0;
    LinearForm form;

    /// The substructure, set by System::displacement() to detect a form on another system. The
    /// pointer is only compared; nullptr: not known.
    const Substructure *body = nullptr;
  };

  /// One vector of DoFs for each substructure.
  using BodyVectors = std::vector<std::vector<double>>;

  /**
   * The substructures of a system, each on one rank. Every rank knows the names and sizes of all
   * substructures, and nothing else of a substructure on another rank. A point on such a
   * substructure has no terms here.
   */
  class Structure
  {
  public:
    explicit Structure(const Communicator &processes = Communicator()) : processes(processes) {}
    virtual ~Structure() = default;

    /// Makes a substructure; called on its owner alone. A substructure without state may be in
    /// several structures.
    using Factory = std::function<std::shared_ptr<Substructure>()>;

    /// Index of a substructure that is on another rank.
    static constexpr std::size_t elsewhere = -1;

    /// A substructure to be made.
    struct NewBody
    {
      std::string name;
      unsigned int owner; ///< rank
      Factory make;
    };

    /**
     * Adds substructures, which their owners make at the same time. Called by all ranks together.
     * Returns the index of each of them on its owner, and `elsewhere` on other ranks. Throws on all
     * ranks what a `make` of the first rank with an error throws, and UserError for no body or a
     * body that is not consistent, see Substructure::check_consistency(); then none is added.
     */
    std::vector<std::size_t> add(const std::vector<NewBody> &made);

    /// One substructure. The ranks wait for its owner: add many of them together.
    std::size_t add(const std::string &name, const unsigned int owner, const Factory &make)
    {
      return add(std::vector<NewBody>{{name, owner, make}}).front();
    }

    const Communicator &communicator() const { return processes; }

    /// Substructures of this rank.
    std::size_t size() const { return substructures.size(); }
    const Substructure &operator[](std::size_t k) const { return *substructures[k]; }
    std::size_t n_dofs() const;

    /// Replaces bodies of this rank by the bodies that SlenderBody::linearised() makes for the
    /// displacements U. Returns for each of all_bodies() whether it was replaced. Called by all
    /// ranks together; all ranks throw what one rank throws.
    std::vector<char> linearise(const BodyVectors &U);

    /// The largest EA of the slender bodies of this rank that are not linear; 0: there are none
    /// [N].
    double largest_axial_stiffness() const;

    /// Replaces slender bodies of this rank that are not linear and have a larger EA by copies with
    /// @p EA [N], see SlenderBody::with_axial_stiffness().
    void limit_axial_stiffness(double EA);

    /// Substructure::load() of a substructure of this rank.
    void load(std::size_t k, InputArchive &archive) { substructures[k]->load(archive); }

    /// A substructure of any rank.
    struct Body
    {
      std::string name;
      std::size_t n_dofs = 0;
    };

    /// The substructures of all ranks, in the order of their addition.
    const std::vector<Body> &all_bodies() const { return bodies; }

    /// The index in all_bodies() of a substructure of this rank.
    std::size_t number(std::size_t k) const { return numbers[k]; }

    /// Zero vectors of the right sizes.
    BodyVectors zero() const;

  private:
    Communicator processes;
    std::vector<std::shared_ptr<Substructure>> substructures;
    std::vector<Body> bodies;
    std::vector<std::size_t> numbers; ///< of the substructures here
  };

  /// Sum of the absolute values of the terms applied to U: the size of the rounding error of
  /// evaluate().
  double magnitude(const std::vector<Term> &terms, const BodyVectors &U);

  /// Sum of the forms of @p terms applied to U.
  double evaluate(const std::vector<Term> &terms, const BodyVectors &U);
} // namespace taut

#endif
