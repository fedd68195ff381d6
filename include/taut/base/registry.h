// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_registry_h
#define taut_registry_h

#include <taut/base/exceptions.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * Named implementations of one interface, such as bodies, observers, schemes and generators. An
   * implementation, in this library or in a plugin, registers itself with one static object:
   *
   *     static const taut::Register<SceneGenerator, MyGenerator> entry("my name", "one line for the
   * help");
   */
  template <typename Interface>
  class Registry
  {
  public:
    using Factory = std::function<std::unique_ptr<Interface>()>;

    /// The one registry of this interface in the process.
    static Registry &instance()
    {
      static Registry registry;
      return registry;
    }

    /// Adds an implementation. A name that is taken throws std::logic_error: it is a mistake of the
    /// author of the plugin.
    void add(const std::string &name, const std::string &description, Factory factory)
    {
      if (!entries.emplace(name, std::make_pair(description, std::move(factory))).second)
        throw std::logic_error("'" + name + "' is registered twice");
    }

    bool knows(const std::string &name) const { return entries.count(name) > 0; }

    /// A new object of the named implementation; an unknown name is a UserError that lists the
    /// known names.
    std::unique_ptr<Interface> create(const std::string &name) const
    {
      const auto entry = entries.find(name);
      if (entry == entries.end())
        throw UserError("unknown name '" + name + "'; known are: " + names(", "));
      return entry->second.second();
    }

    /// The names in alphabetical order.
    std::vector<std::string> list() const
    {
      std::vector<std::string> result;
      for (const auto &entry : entries)
        result.push_back(entry.first);
      return result;
    }

    /// The names in alphabetical order, e.g. as the list of a deal.II Patterns::Selection ("|").
    std::string names(const std::string &separator = "|") const
    {
      std::string list;
      for (const auto &entry : entries)
        list += (list.empty() ? "" : separator) + entry.first;
      return list;
    }

    /// One line "name: description" per entry.
    std::string descriptions() const
    {
      std::string text;
      for (const auto &entry : entries)
        text += (text.empty() ? "" : "\n") + ("'" + entry.first + "': ") + entry.second.first;
      return text;
    }

  private:
    std::map<std::string, std::pair<std::string, Factory>> entries;
  };

  /// Registers Implementation under a name when the library that holds the object is loaded.
  template <typename Interface, typename Implementation>
  struct Register
  {
    Register(const std::string &name, const std::string &description)
    {
      Registry<Interface>::instance().add(name, description,
                                          [] { return std::make_unique<Implementation>(); });
    }
  };
} // namespace taut

#endif
