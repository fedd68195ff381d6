// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_body_type_h
#define taut_body_type_h

#include <taut/base/coordinates.h>
#include <taut/base/registry.h>

#include <cstddef>
#include <memory>
#include <string>
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

  /// What a scene says to a body that it makes.
  struct BodySetting
  {
    std::string name;
    std::string origin;  ///< path of its section in the parameter file, for messages
    Coordinates gravity; ///< [m/s^2]
  };

  /**
   * A kind of body that a parameter file names, `Body <name>/Type`: registered by a plugin with
   * Register<BodyType, ...>, one object for each body of that type.
   */
  class BodyType
  {
  public:
    virtual ~BodyType() = default;

    /// Declares its entries, in the section of the body.
    virtual void declare_parameters(dealii::ParameterHandler &) {}

    /// About how many DoFs the body will have, by which ranks share the work; 0: not known before
    /// it is made.
    virtual std::size_t n_dofs() const { return 0; }

    /**
     * The body of the entries read. Called on the rank that owns it, several times if the scene
     * needs it (for the lengths of droppers, say); what is returned may refer to this object, which
     * lives as long as the scene. Throws EntryError about an entry below setting.origin.
     */
    virtual std::unique_ptr<Substructure> make(const BodySetting &setting) const = 0;

    /**
     * The surface that the body shows to contacts, all of it if @p boundaries is empty, otherwise
     * the faces with these ids; its nodes are those of Substructure::node_displacement() in either
     * case. Called on all ranks, with the same result. Throws EntryError; so do types without one.
     */
    virtual ContactSurface surface(const BodySetting &setting,
                                   const std::vector<unsigned int> &boundaries) const;

    /// The turn of a part of its surface that ends a run, for bodies whose equations are those of
    /// small turns [rad]; 0: the turns of its surface are not watched.
    virtual double largest_turn() const { return 0.; }

    /// How the body can be cut; none: it stays whole. Called on all ranks, with the same result.
    /// Throws EntryError.
    virtual std::shared_ptr<const DivisibleBody> division(const BodySetting &) const
    {
      return nullptr;
    }
  };

  /// A body of a scene whose type is not one of Taut's own.
  struct CustomBody
  {
    std::string name;
    std::string origin; ///< path of its section in the parameter file, for messages; may be empty
    std::string type_name;
    std::shared_ptr<const BodyType> type; ///< nullptr: of a program that has no scene
  };

  /// The bodies that a parameter file lists in `Bodies`, each with a section `Body <name>`. Three
  /// passes: the names, then the types, then all entries.
  class BodyParameters
  {
  public:
    void declare_names(dealii::ParameterHandler &prm);

    /// Before the third pass; throws EntryError for a name that cannot be one.
    void declare_types(dealii::ParameterHandler &prm);

    /// Makes an object of each type. Throws EntryError for a type that is not registered.
    void create_types();

    void declare_parameters(dealii::ParameterHandler &prm);

    /// After the entries were read.
    std::vector<CustomBody> bodies() const;

  private:
    std::string title(std::size_t i) const { return "Body " + names[i]; }

    std::vector<std::string> names, type_names;
    std::vector<std::shared_ptr<BodyType>> types;
  };
} // namespace taut

#endif
