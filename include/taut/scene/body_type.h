// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_type_h
#define taut_body_type_h

#include <taut/base/communicator.h>
#include <taut/base/coordinates.h>
#include <taut/base/registry.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  class DivisibleBody;
  class Substructure;
  struct ContactSurface;

  /// What a BodyType gets from the scene to make a body.
  struct BodySetting
  {
    std::string name;
    std::string origin;  ///< path of its section in the parameter file, for messages
    Coordinates gravity; ///< [m/s^2]
  };

  /**
   * A type of body that a parameter file names in `Body <name>/Type`. Derive from it in a plugin,
   * and register it with Register<BodyType, ...>, to bring a body of your own into scenes. There is
   * one object for each body of the type.
   */
  class BodyType
  {
  public:
    virtual ~BodyType() = default;

    /// Declares the entries of the type, in the section of the body.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /**
     * Called by all ranks of a run together, before anything else is asked for, if the ranks may
     * share the mesh of the body, for a mesh that is too large for a rank: division() then has the
     * cells of this rank, see DivisibleBody::processes(). Of more than 0 @p least_dofs only a body
     * in space with as many DoFs is shared. With one process every rank has the whole body,
     * whatever an earlier run did. Does nothing by default. Throws EntryError on all ranks.
     */
    virtual void distribute(const BodySetting &, const Communicator &,
                            std::size_t /*least_dofs*/) const
    {
    }

    /// The cells that a rank keeps of a body.
    struct OwnCells
    {
      std::shared_ptr<const DivisibleBody> body; ///< as division() from now on; none: all are kept
      std::vector<unsigned int> numbers;         ///< of its cells before
    };

    /**
     * Called by all ranks of a run together, after division(), if each of them has cells of the
     * body: leaves each rank the cells that @p rank_of_cell gives it. A type that does nothing
     * keeps the whole body on every rank.
     */
    virtual OwnCells keep_own_cells(const BodySetting &, const Communicator &,
                                    const std::vector<unsigned int> & /*rank_of_cell*/) const
    {
      return {};
    }

    /// Estimated number of DoFs, by which ranks share the work; 0: not known before the body is
    /// made.
    virtual std::size_t n_dofs() const { return 0; }

    /**
     * Makes the body from the entries. Called on the rank that owns the body, several times if the
     * scene needs it, such as for the lengths of droppers. The body may refer to this object, which
     * lives as long as the scene. Throws EntryError about an entry below setting.origin.
     */
    virtual std::unique_ptr<Substructure> make(const BodySetting &setting) const = 0;

    /**
     * The surface of the body for contacts: the faces with the ids @p boundaries, or all faces if
     * @p boundaries is empty. In both cases the nodes are those of
     * Substructure::node_displacement(). Called on all ranks, with the same result. Throws
     * EntryError, also for types without a surface.
     */
    virtual ContactSurface surface(const BodySetting &setting,
                                   const std::vector<unsigned int> &boundaries) const;

    /// The rotation of a part of the surface that ends a run [rad], for bodies whose equations hold
    /// for small rotations; 0: rotations of the surface are not watched.
    virtual double largest_turn() const { return 0.; }

    /// How the partition can cut the body; none: the body is not cut. Called by all ranks together.
    /// Throws EntryError.
    virtual std::shared_ptr<const DivisibleBody> division(const BodySetting &) const
    {
      return nullptr;
    }
  };

  /// A body of a scene that a BodyType makes.
  struct CustomBody
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::string type_name;
    std::shared_ptr<const BodyType> type; ///< nullptr: of a program that has no scene

    /// Names and values of a body that a scene generator made; empty: the parameter file has them.
    std::vector<std::pair<std::string, std::string>> entries = {};
  };

  /// A body of a scene generator, of a registered type. Throws what the type says about its
  /// entries.
  CustomBody make_body(const std::string &name, const std::string &origin,
                       const std::string &type_name,
                       const std::vector<std::pair<std::string, std::string>> &entries);

  /// The bodies that a parameter file lists in `Bodies`, each with a section `Body <name>`. They
  /// are read in three passes: names, types, all entries.
  class BodyParameters
  {
  public:
    void declare_names(dealii::ParameterHandler &prm);

    /// Call it before the third pass. Throws EntryError for a name that is not allowed.
    void declare_types(dealii::ParameterHandler &prm);

    /// Makes an object of each type. Throws EntryError for a type that is not registered.
    void create_types();

    void declare_parameters(dealii::ParameterHandler &prm);

    /// The bodies, after the entries were read.
    std::vector<CustomBody> bodies() const;

  private:
    std::string title(std::size_t i) const { return "Body " + names[i]; }

    std::vector<std::string> names, type_names;
    std::vector<std::shared_ptr<BodyType>> types;
  };
} // namespace taut

#endif
