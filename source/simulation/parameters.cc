// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/data_files.h"
#include "base/nearest_name.h"
#include "scene/entries.h"
#include "scene/shared_places.h"
#include "scene/travel.h"
#include "simulation/entry_check.h"
#include "simulation/file_text.h"
#include "simulation/stored_study.h"
#include "simulation/visit_entries.h"
#include <taut/base/exceptions.h>
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace taut
{
  namespace
  {
    using namespace dealii::Patterns;

    /// A list of a lower and an upper bound, or nothing.
    void check_pair(const std::vector<double> &pair, const std::string &entry)
    {
      if (pair.empty())
        return;
      if (pair.size() != 2)
        throw EntryError(entry, "give two numbers, the first and the last, or leave it empty");
      if (pair[0] > pair[1])
        throw EntryError(entry, "the first number is the smaller one; swap them");
    }

    /// Values and defaults of all entries in a listing, by their paths.
    void keep_values(const nlohmann::json &listing, std::map<std::string, std::string> &values,
                     std::map<std::string, std::string> &defaults)
    {
      values.clear();
      defaults.clear();
      visit_entries(listing,
                    [&](const std::string &path, const nlohmann::json &entry)
                    {
                      values[path] = entry.at("value");
                      defaults[path] = entry.at("default_value");
                    });
    }

    /// The part of a deal.II exception for the user.
    std::string message(const std::exception &e)
    {
      const std::string what = e.what();
      const std::string mark = "Additional information:";
      const std::size_t at = what.find(mark);
      if (at == std::string::npos)
        return what;
      std::string text;
      std::istringstream lines(what.substr(at + mark.size()));
      for (std::string line; std::getline(lines, line);)
      {
        const std::size_t first = line.find_first_not_of(' ');
        if (line.compare(0, 5, "-----") == 0 || first == std::string::npos)
          continue;
        text += (text.empty() ? "" : " ") + line.substr(first);
      }
      return text;
    }
  } // namespace

  Parameters::Parameters() = default;
  Parameters::~Parameters() = default;

  void Parameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
        "Additional shared libraries", shared_libraries,
        "Paths of libraries that are loaded before anything else; what they register, "
        "generators, schemes, bodies and observers, has its entries here. A name without '/' is "
        "sought beside libtaut.so and where the system keeps libraries",
        List(Anything()));
    prm.add_parameter("Generator", generator_name,
                      "What fills the scene. " +
                          Registry<SceneGenerator>::instance().descriptions(),
                      Selection(Registry<SceneGenerator>::instance().names()));
    prm.add_parameter("Gravity", gravity, "'x, y' or 'x, y, z', y upwards [m/s^2]",
                      List(Double(), 2, 3));
    prm.add_parameter(
        "Start", start,
        "'equilibrium': at rest under the loads at t = 0. 'undeformed': straight wires, "
        "at rest, but for displacements of supports. 'given': initial displacements and velocities "
        "of the bodies",
        Selection("equilibrium|undeformed|given"));

    prm.enter_subsection("Time");
    TimeParameters::declare_parameters(prm);
    for (auto &[name, integrator] : integrators)
      integrator->declare_parameters(prm);
    prm.leave_subsection();

    solver.declare_parameters(prm);
    partition.declare_parameters(prm);
    output.declare_parameters(prm);
    prm.enter_subsection("Output");
    for (auto &[name, observer] : observers)
    {
      prm.enter_subsection(name);
      observer->declare_parameters(prm);
      prm.leave_subsection();
    }
    prm.leave_subsection();
    statistics.declare_parameters(prm);
    study.declare_parameters(prm);
    sweep.declare_parameters(prm);
    elasticity.declare_parameters(prm);
    bodies.declare_parameters(prm);
    contacts.declare_names(prm);
    contacts.declare_parameters(prm);
    generator->declare_parameters(prm);
  }

  namespace
  {
    /// Entries of a file from print(), without folders, which may have moved.
    std::vector<std::string> entries_in(std::istream &printed)
    {
      const std::string folder = "set Folder ";
      std::vector<std::string> entries;
      for (std::string line; std::getline(printed, line);)
      {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin != std::string::npos && line[begin] != '#' &&
            line.compare(begin, folder.size(), folder) != 0)
          entries.push_back(line);
      }
      return entries;
    }
  } // namespace

  bool Parameters::has_entries_of(const std::string &printed) const
  {
    std::ifstream in(printed);
    if (!in && std::filesystem::exists(printed))
      throw UserError(cannot_read(printed, errno));
    std::stringstream own;
    print(own);
    return in && entries_in(in) == entries_in(own);
  }

  void Parameters::read(const std::string &name, const std::vector<std::string> &overrides,
                        const Communicator &processes)
  {
    choice.clear();
    read_entries(name, overrides, processes);
    if (!(study.accuracy > 0.))
      return;
    std::string text; // choice, line by line
    processes.agree(
        [&]()
        {
          if (!processes.is_root())
            return;
          try
          {
            const StudyChoice chosen =
                choose_setting(study_folder() + "/study.json", study.accuracy, entry_values);
            text = chosen.description + '\n';
            for (const std::string &o : chosen.overrides)
              text += o + '\n';
          }
          catch (const EntryError &e)
          {
            throw UserError(explain(e));
          }
        });
    processes.broadcast(text);
    std::istringstream lines(text);
    std::string description;
    std::getline(lines, description);
    // The run then has the entries of the setting, so that a file with them gives the same run.
    std::vector<std::string> all = overrides;
    const std::string place = place_of("Study/Accuracy");
    for (std::string line; std::getline(lines, line);)
    {
      set_origin(line.substr(0, line.find('=')), place);
      all.push_back(line);
    }
    all.push_back("Study/Accuracy=0");
    read_entries(name, all, processes);
    choice = description;
  }

  void Parameters::read_entries(const std::string &name, const std::vector<std::string> &overrides,
                                const Communicator &processes)
  {
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
    processes.agree(
        [&]
        {
          if (!processes.is_root())
            return;
          file.read(name);
          for (const std::string &o : overrides)
            file.set(o);
        });
    file.broadcast(processes);
    set_data_folder(std::filesystem::path(file.name()).parent_path().string());
    try
    {
      declare_in_passes(file.text());
      const nlohmann::json listing = listing_of(*declared.entries);
      check_entries(file, listing);
      keep_values(listing, entry_values, declared.defaults);
      declared.entries->parse_input_from_string(file.text());
      // The file alone changes values.
      for (const ParameterFile::Entry &entry : file.entries())
        entry_values[entry.name()] =
            declared.entries->get({entry.path.begin(), entry.path.end() - 1}, entry.path.back());
      end_time = find_end_time();
      check_values();
    }
    catch (const EntryError &e)
    {
      throw UserError(explain(e));
    }
    catch (const dealii::ExceptionBase &e)
    {
      throw UserError(name + ": " + message(e));
    }
  }

  /// Declares plugins and the generator's name, then names of items, then all entries. Each pass
  /// knows the declarations for the next; only the last is strict.
  void Parameters::declare_in_passes(const std::string &text)
  {
    declared.structural.clear();
    const auto read_leniently = [&](dealii::ParameterHandler &prm)
    {
      prm.parse_input_from_string(text, "", true);
      visit_entries(listing_of(prm), [&](const std::string &path, const nlohmann::json &)
                    { declared.structural.insert(path); });
    };
    {
      dealii::ParameterHandler prm;
      prm.add_parameter("Additional shared libraries", shared_libraries);
      prm.add_parameter("Generator", generator_name);
      read_leniently(prm);
    }
    load_registered();
    const auto &generators = Registry<SceneGenerator>::instance();
    if (!generators.knows(generator_name))
    {
      const std::string near = nearest_name(generator_name, generators.list());
      throw EntryError("Generator",
                       "there is no such generator; known are: " + generators.names(", ") +
                           (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    generator = generators.create(generator_name);
    {
      dealii::ParameterHandler prm;
      bodies.declare_names(prm);
      contacts.declare_names(prm);
      generator->declare_names(prm);
      output.declare_names(prm);
      study.declare_names(prm);
      sweep.declare_names(prm);
      read_leniently(prm);
    }
    {
      dealii::ParameterHandler prm;
      bodies.declare_types(prm);
      read_leniently(prm);
    }
    bodies.create_types();
    begin_entries();
  }

  void Parameters::check_values() const
  {
    if (end_time > 0. && !(step > 0.))
      throw EntryError("Time/Step", "it must be positive");
    constexpr double most_steps = 1e10;
    if (end_time > 0. && end_time / step > most_steps)
      throw EntryError(
          "Time/Step",
          "Time/End takes more than 1e10 such steps; take a larger step or an earlier end");
    if (end_time > 0. && end_time < step * (1. - 1e-9))
      throw EntryError("Time/End", "it is shorter than one step; take a smaller Time/Step");
    statistics.check();
    check_pair(statistics.window, "Statistics/Window");
    check_pair(elasticity.range, "Elasticity/Range");
    for (const auto &[figure, range] : statistics.expected)
      check_pair(range, "Statistics/Expected ranges/" + figure);
    study.parameter_lists(entry_values);
    sweep.parameters(entry_values);
  }

  void Parameters::begin_entries()
  {
    declared.entries = std::make_unique<dealii::ParameterHandler>();
    declare(*declared.entries);
  }

  void Parameters::set_defaults()
  {
    load_registered();
    generator = Registry<SceneGenerator>::instance().create(generator_name);
    begin_entries();
    keep_values(listing_of(*declared.entries), entry_values, declared.defaults);
  }

  std::string Parameters::file_name() const
  {
    return std::filesystem::path(file.name()).filename().string();
  }

  std::string Parameters::file_text() const
  {
    std::ifstream stream(file.name(), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  void Parameters::print(std::ostream &out) const
  {
    if (!declared.entries)
      return;
    declared.entries->print_parameters(out, dealii::ParameterHandler::PRM |
                                                dealii::ParameterHandler::KeepDeclarationOrder);
  }

  std::string Parameters::unit_of(const std::string &entry) const
  {
    std::string unit;
    visit_entries(listing_of(*declared.entries),
                  [&](const std::string &path, const nlohmann::json &node)
                  {
                    const std::string help = node.at("documentation");
                    const std::size_t begin = help.rfind('[');
                    if (path == entry && begin != std::string::npos && help.back() == ']')
                      unit = help.substr(begin + 1, help.size() - begin - 2);
                  });
    return unit;
  }

  Scene Parameters::generated_scene() const
  {
    Scene scene;
    scene.bodies = bodies.bodies();
    scene.contacts = contacts.contacts(scene.bodies);
    scene.gravity = parse_coordinates(gravity, "Gravity");
    scene.start = start == "equilibrium"  ? Start::equilibrium
                  : start == "undeformed" ? Start::undeformed
                                          : Start::given;
    generator->fill(scene);
    scene.links.shrink_to_fit(); // those of a long line are large, and on each rank
    return scene;
  }

  Scene Parameters::scene() const
  {
    Scene scene = generated_scene();
    prepare_travels(scene, end_time);
    const ContactMass contact_mass = mass_redistribution == "mass"      ? ContactMass::keeps_total
                                     : mass_redistribution == "inertia" ? ContactMass::keeps_inertia
                                                                        : ContactMass::stays;
    for (Link &link : scene.links)
      if (link.rigid() && link.unilateral() && !link.moving() && !link.turns)
        link.contact_mass = contact_mass;
    for (std::size_t i = 0; i < output.probes.items.size(); ++i)
      output.probes.items[i].add(output.probes.names[i], output.probes.title(i), scene);
    share_places(scene);
    check(scene, end_time);
    statistics.check_window(scene, end_time);
    statistics.check_probes(scene);
    return scene;
  }
} // namespace taut
