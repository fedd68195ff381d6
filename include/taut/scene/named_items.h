// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_named_items_h
#define taut_named_items_h

#include <string>
#include <utility>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  struct Scene;

  /**
   * Throws an EntryError on @p list_entry if a name is unusable or repeated. Call it before the
   * names are declared again. The handler writes its default value and reads it back, which loses
   * an empty name, so that there would be more names than sections.
   */
  void check_item_names(const std::vector<std::string> &names, const std::string &list_entry);

  /// Declares the entry with the names of a list of items.
  void declare_item_names(dealii::ParameterHandler &prm, const std::string &list,
                          const std::string &section, const std::string &help,
                          std::vector<std::string> &names);

  /// Enters or leaves the section of an item.
  void enter_item(dealii::ParameterHandler &prm, const std::string &section,
                  const std::vector<std::string> &names, std::size_t i);
  void leave_item(dealii::ParameterHandler &prm);

  /**
   * The items of one kind in a parameter file: an entry with their names, and a section "<section>
   * <name>" for each. An Item has a function declare(ParameterHandler &).
   */
  template <typename Item>
  class NamedItems
  {
  public:
    /// @p parent is the path of the enclosing section, empty for none; @p list is the entry with
    /// the names, e.g. "Wires".
    NamedItems(std::string parent, std::string list, std::string section, std::string help)
        : parent(std::move(parent)), list(std::move(list)), section(std::move(section)),
          help(std::move(help))
    {
    }

    void declare_names(dealii::ParameterHandler &prm)
    {
      check_item_names(names, path(list));
      declare_item_names(prm, list, section, help, names);
    }

    void declare_parameters(dealii::ParameterHandler &prm)
    {
      items.resize(names.size());
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        enter_item(prm, section, names, i);
        items[i].declare(prm);
        leave_item(prm);
      }
    }

    std::vector<std::string> names;
    std::vector<Item> items; ///< in the order of the names, once declare_parameters() has run

    /// Path of the section of the i-th item.
    std::string title(std::size_t i) const { return path(section + " " + names[i]); }

  private:
    std::string path(const std::string &entry) const
    {
      return parent.empty() ? entry : parent + "/" + entry;
    }

    std::string parent, list, section, help;
  };

  /// A named probe of a parameter file: one point, or several of a wire or a body.
  struct ProbeItem
  {
    std::string point;
    std::vector<double> direction, axis;
    bool rotational = false;
    std::string quantity = "displacement";
    void declare(dealii::ParameterHandler &prm);

    /// Adds its probes to a scene with all wires, masses and bodies. @p title is the path of its
    /// section. Throws EntryError for a point that is not known.
    void add(const std::string &name, const std::string &title, Scene &scene) const;
  };
} // namespace taut

#endif
