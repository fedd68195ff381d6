// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace taut
{
  namespace
  {
    /// "A.B.Entry=value" as the text of a parameter file.
    std::string as_parameter_text(const std::string &override_text)
    {
      const std::size_t equals = override_text.find('=');
      if (equals == std::string::npos || equals == 0)
        throw UserError("--set '" + override_text + "': write Section.Entry=value");
      std::istringstream path(override_text.substr(0, equals));
      std::vector<std::string> parts;
      for (std::string part; std::getline(path, part, '.');)
        parts.push_back(part);
      std::string text;
      for (std::size_t i = 0; i + 1 < parts.size(); ++i)
        text += "subsection " + parts[i] + "\n";
      text += "set " + parts.back() + " = " + override_text.substr(equals + 1) + "\n";
      for (std::size_t i = 0; i + 1 < parts.size(); ++i)
        text += "end\n";
      return text;
    }

    /// The part of a deal.II exception that is for the user.
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

  void Parameters::declare_general(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Generator", generator_name,
                      "What fills the scene. " +
                          Registry<SceneGenerator>::instance().descriptions(),
                      Selection(Registry<SceneGenerator>::instance().names()));
    prm.add_parameter("Gravity", gravity, "'x, y' [m/s^2]", List(Double(), 2, 2));
    prm.add_parameter(
        "Start", start,
        "'equilibrium': at rest under the loads at t = 0. 'undeformed': straight wires, "
        "at rest. 'given': initial displacements and velocities of the bodies",
        Selection("equilibrium|undeformed|given"));

    prm.enter_subsection("Time");
    prm.add_parameter("Scheme", scheme,
                      "Time integration. 'automatic' follows from the links of the scene. " +
                          Registry<TimeIntegrator>::instance().descriptions(),
                      Selection("automatic|" + Registry<TimeIntegrator>::instance().names()));
    prm.add_parameter("Step", step, "[s]", Double(0., Double::max_double_value));
    prm.add_parameter("End", end_time, "0: the start only, e.g. a static equilibrium [s]",
                      Double(0., Double::max_double_value));
    for (auto &[name, integrator] : integrators)
      integrator->declare_parameters(prm);
    prm.leave_subsection();

    solver.declare_parameters(prm);

    prm.enter_subsection("Output");
    prm.add_parameter("Folder", folder, "Where the results go; made if it does not exist",
                      Anything());
    prm.add_parameter(
        "Interval", interval,
        "Least time between two lines of sliding.csv, probes.csv, certificate.csv; 0: "
        "every step [s]",
        Double(0., Double::max_double_value));
    prm.add_parameter("Link interval", link_interval,
                      "Least time between two lines of links.csv; 0: every step [s]",
                      Double(0., Double::max_double_value));
    prm.leave_subsection();
    statistics.declare_parameters(prm);
  }

  void Parameters::read(const std::string &file, const std::vector<std::string> &overrides)
  {
    std::ifstream in(file);
    if (!in)
      throw UserError("cannot read '" + file + "': no such file, or no permission");
    std::stringstream text;
    text << in.rdbuf() << '\n';
    for (const std::string &o : overrides)
      text << as_parameter_text(o);

    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
    const std::string names = Registry<TimeIntegrator>::instance().names();
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, '|');)
      integrators[name] = Registry<TimeIntegrator>::instance().create(name);

    try
    {
      // The generator's name, then the names of its items, then everything: each pass knows what to
      // declare for the next one, and only the last is strict.
      {
        dealii::ParameterHandler prm;
        prm.add_parameter(
            "Generator", generator_name, "",
            dealii::Patterns::Selection(Registry<SceneGenerator>::instance().names()));
        prm.parse_input_from_string(text.str(), "", true);
      }
      generator = Registry<SceneGenerator>::instance().create(generator_name);
      {
        dealii::ParameterHandler prm;
        generator->declare_names(prm);
        prm.parse_input_from_string(text.str(), "", true);
      }
      dealii::ParameterHandler prm;
      declare_general(prm);
      generator->declare_parameters(prm);
      std::istringstream all(text.str());
      prm.parse_input(all, file);
    }
    catch (const dealii::ExceptionBase &e)
    {
      throw UserError(message(e));
    }
    if (end_time > 0. && !(step > 0.))
      throw UserError(file + ": Time, Step must be positive");
    constexpr double most_steps = 1e10;
    if (end_time > 0. && end_time / step > most_steps)
      throw UserError(file + ": Time, End / Step makes too many steps");
  }

  Scene Parameters::scene() const
  {
    Scene scene = generator->generate();
    scene.gravity = {gravity[0], gravity[1]};
    scene.start = start == "equilibrium"  ? Start::equilibrium
                  : start == "undeformed" ? Start::undeformed
                                          : Start::given;
    check(scene, end_time);
    return scene;
  }
} // namespace taut
