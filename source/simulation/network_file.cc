// SPDX-License-Identifier: LGPL-2.1-or-later
// The parameter file of a scene that is written out.
#include "simulation/entry_check.h"
#include "simulation/visit_entries.h"

#include "base/text.h"
#include "base/write_file.h"
#include "scene/network_entries.h"
#include "scene/scene_values.h"
#include "simulation/network_file.h"
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace taut
{
  namespace
  {
    using Path = std::vector<std::string>;

    bool begins(const Path &path, const Path &with)
    {
      return path.size() >= with.size() && std::equal(with.begin(), with.end(), path.begin());
    }

    /// Entries in .prm format; those of one section that come one after the other stand in one.
    std::string text_of(const std::vector<WrittenEntry> &entries)
    {
      std::string text;
      Path open;
      const auto line = [&](const std::size_t depth, const std::string &rest)
      { text += std::string(2 * depth, ' ') + rest + '\n'; };
      const auto go_to = [&](const Path &sections)
      {
        std::size_t common = 0;
        while (common < std::min(open.size(), sections.size()) && open[common] == sections[common])
          ++common;
        for (; open.size() > common; open.pop_back())
          line(open.size() - 1, "end");
        for (; open.size() < sections.size(); open.push_back(sections[open.size()]))
          line(open.size(), "subsection " + sections[open.size()]);
      };
      for (const WrittenEntry &entry : entries)
      {
        go_to({entry.path.begin(), entry.path.end() - 1});
        if (!entry.path.back().empty())
          line(open.size(), "set " + entry.path.back() + " = " + entry.value);
      }
      go_to({});
      return text;
    }

    /// Names of the sections and entries at the top that a generator declares.
    std::set<std::string> top_of(const std::string &generator)
    {
      dealii::ParameterHandler prm;
      Registry<SceneGenerator>::instance().create(generator)->declare_parameters(prm);
      std::set<std::string> names;
      visit_entries(listing_of(prm), [&](const std::string &path, const nlohmann::json &)
                    { names.insert(path.substr(0, path.find('/'))); });
      return names;
    }

    /// Takes out the parameters of studies and sweeps that vary entries of a generator.
    void leave_out_varied(const std::set<std::string> &own, std::vector<WrittenEntry> &entries,
                          std::vector<std::string> &left_out)
    {
      std::vector<Path> out;
      for (const WrittenEntry &entry : entries)
      {
        if (entry.path.size() != 3 || entry.path[2] != "Entries")
          continue;
        for (const std::string &path : split(entry.value, ','))
          if (own.count(path.substr(0, path.find('/'))))
          {
            out.push_back({entry.path[0], entry.path[1]});
            break;
          }
      }
      const auto is_out = [&](const WrittenEntry &entry)
      {
        return std::any_of(out.begin(), out.end(),
                           [&](const Path &section) { return begins(entry.path, section); });
      };
      entries.erase(std::remove_if(entries.begin(), entries.end(), is_out), entries.end());
      for (const Path &section : out)
      {
        left_out.push_back(section[0] + "/" + section[1]);
        for (WrittenEntry &entry : entries)
          if (entry.path == Path{section[0], "Parameters"})
          {
            std::string others;
            for (const std::string &name : split(entry.value, ','))
              if ("Parameter " + name != section[1])
                others += (others.empty() ? "" : ", ") + name;
            entry.value = others;
          }
      }
    }

    /// Entries and empty sections of a file that are not of its generator; a section is an entry
    /// without a name.
    std::vector<WrittenEntry> others(const ParameterFile &file, const std::set<std::string> &own)
    {
      std::vector<WrittenEntry> result;
      for (const ParameterFile::Entry &entry : file.entries())
        if (!own.count(entry.path[0]) && entry.path != Path{"Generator"})
          result.push_back({entry.path, entry.value});
      for (const ParameterFile::Entry &section : file.sections())
        if (!own.count(section.path[0]) &&
            std::none_of(file.entries().begin(), file.entries().end(),
                         [&](const ParameterFile::Entry &entry)
                         { return begins(entry.path, section.path); }))
        {
          Path path = section.path;
          path.push_back("");
          result.push_back({path, ""});
        }
      // Entries without a section come first, as deal.II cannot leave one otherwise.
      std::stable_partition(result.begin(), result.end(),
                            [](const WrittenEntry &entry) { return entry.path.size() == 1; });
      return result;
    }
    /// All data of a scene that decide its results.
    std::string essence_of(Scene scene)
    {
      const auto take_names = [](auto &items)
      {
        for (auto &item : items)
          item.name.clear();
      };
      const auto take_origins = [](auto &items)
      {
        for (auto &item : items)
          item.origin.clear();
      };
      take_names(scene.point_masses);
      take_names(scene.springs);
      take_names(scene.loads);
      take_origins(scene.wires);
      take_origins(scene.supports);
      take_origins(scene.point_masses);
      take_origins(scene.masses);
      take_origins(scene.springs);
      take_origins(scene.links);
      take_origins(scene.loads);
      take_origins(scene.probes);
      // They have sections of their own, which stay as they are.
      scene.bodies.clear();
      return values_of(scene);
    }

    /// The sections of bodies that a generator made, and their names.
    void add_bodies(const std::vector<CustomBody> &bodies, std::vector<WrittenEntry> &entries)
    {
      std::string names;
      for (const CustomBody &body : bodies)
      {
        names += (names.empty() ? "" : ", ") + body.name;
        if (body.entries.empty())
          continue;
        const std::string section = "Body " + body.name;
        entries.push_back({{section, "Type"}, body.type_name});
        for (const auto &[entry, value] : body.entries)
          entries.push_back({{section, entry}, value});
      }
      const auto is_list = [](const WrittenEntry &entry)
      { return entry.path == std::vector<std::string>{"Bodies"}; };
      entries.erase(std::remove_if(entries.begin(), entries.end(), is_list), entries.end());
      if (!names.empty())
        entries.insert(entries.begin(), {{"Bodies"}, names});
    }
  } // namespace

  std::string Parameters::as_network(std::vector<std::string> &left_out) const
  {
    const bool is_network = generator_name == "network";
    const std::set<std::string> own = is_network ? std::set<std::string>() : top_of(generator_name);
    std::vector<WrittenEntry> entries = others(file, own);
    leave_out_varied(own, entries, left_out);
    entries.insert(entries.begin(), {{"Generator"}, "network"});
    if (!is_network)
    {
      const Scene scene = generated_scene();
      add_bodies(scene.bodies, entries);
      for (WrittenEntry &entry : network_entries(scene))
        entries.push_back(std::move(entry));
    }
    return text_of(entries);
  }

  void write_network(const Parameters &parameters, const std::string &name,
                     std::vector<std::string> &left_out)
  {
    namespace fs = std::filesystem;
    if (fs::exists(name) && !parameters.output.overwrite)
      throw UserError("--write-network: there is a '" + name +
                      "' already; name another file, or add --overwrite");
    const Scene scene = parameters.generated_scene();
    write_file(name, "# The scene of " + parameters.file_name() +
                         ", each wire, support, mass, spring, link and load by its own\n" +
                         parameters.as_network(left_out));
    Parameters written;
    written.read(name);
    if (parameters.generator_name != "network" &&
        essence_of(scene) != essence_of(written.generated_scene()))
      throw UserError("--write-network: '" + name + "' does not say the scene of generator '" +
                      parameters.generator_name + "' again to the last bit; run its own file");
  }
} // namespace taut
