// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs scenes for the tests of this folder; see run.h.
#include "run.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace verification
{
  namespace
  {
    class Guest : public taut::Observer
    {
    public:
      explicit Guest(const Callback &callback) : callback(callback) {}
      void record(const taut::StepView &view) override { callback(view); }

    private:
      const Callback &callback;
    };

    std::string new_folder()
    {
      static int count = 0;
      const std::string name =
          "taut_verification_" + std::to_string(getpid()) + "_" + std::to_string(++count);
      const std::filesystem::path path = std::filesystem::temp_directory_path() / name;
      std::filesystem::create_directories(path);
      return path.string();
    }
  } // namespace

  std::string scene_file(const std::string &name)
  {
    return std::string(TAUT_PRM_FOLDER) + "/" + name + ".prm";
  }

  Session::Session(const std::string &file_or_text, const Overrides &overrides,
                   const taut::Communicator &processes)
      : scratch(new_folder())
  {
    std::string file = file_or_text;
    if (file.find('\n') != std::string::npos)
    {
      file = scratch + "/scene.prm";
      std::ofstream(file) << prm(file_or_text);
    }
    Overrides all = {"Output.Folder=" + scratch + "/results", "Output.Interval=1e9",
                     "Output.Link interval=1e9"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    values.read(file, all);
    runner = std::make_unique<taut::Simulation>(values, text, processes);
  }

  Session::~Session()
  {
    std::error_code ignored;
    std::filesystem::remove_all(scratch, ignored);
  }

  void Session::run(const Callback &callback)
  {
    Guest guest(callback);
    runner->observe(guest);
    runner->run();
  }

  void run_scene(const std::string &file_or_text, const Overrides &overrides,
                 const Callback &callback)
  {
    Session(file_or_text, overrides).run(callback);
  }

  std::vector<taut::Term> point_on_wire(const taut::StepView &view, const std::size_t wire,
                                        const double s, const taut::Coordinates &direction,
                                        const bool rotational)
  {
    std::vector<taut::Term> terms;
    view.structure.motion({taut::Attachment::Kind::wire, wire, s}, rotational, direction, 1.,
                          terms);
    return terms;
  }

  double displacement(const taut::StepView &view, const std::vector<taut::Term> &terms)
  {
    return evaluate(terms, view.reference.displacement) + evaluate(terms, view.state.U);
  }

  double displacement(const taut::StepView &view, const std::size_t wire, const double s,
                      const taut::Coordinates &direction, const bool rotational)
  {
    return displacement(view, point_on_wire(view, wire, s, direction, rotational));
  }

  double fitted_order(const std::vector<double> &steps, const std::vector<double> &errors)
  {
    double sx = 0., sy = 0., sxx = 0., sxy = 0.;
    const double n = steps.size();
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
      const double x = std::log(steps[i]), y = std::log(errors[i]);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }

  std::string number(const double x)
  {
    std::ostringstream text;
    text.precision(17);
    text << x;
    return text.str();
  }

  const char *const beam_under_laws =
      "set Generator = network\nset Start = equilibrium\n"
      "subsection Network\n set Wires = beam\n set Supports = ends\n set Links = stop, dropper\n"
      " set Loads = push\n"
      " subsection Wire beam\n  set To = 12, 0\n  set Components = beam\n"
      "  set Mass per length = 5\n  set Bending stiffness = 4000\n  set Element size = 0.25\n end\n"
      " subsection Support ends\n  set Wire = beam\n  set Positions = 0, 12\n end\n"
      " subsection Link stop\n  set Type = stop\n  set From = ground\n  set To = beam @ 2:2:10\n"
      "  set Direction = 0, 1\n  set Gap = 0.005\n  set Law = formula\n"
      "  set Law formula = 5e3*d + 1e8*d^3\n  set Law range = 0.1\n end\n"
      " subsection Link dropper\n  set Type = dropper\n  set From = ground\n"
      "  set To = beam @ 1:2:11\n  set Direction = 0, -1\n  set Law = table\n"
      "  set Law points = 0.002: 40, 0.02: 80\n end\n"
      " subsection Load push\n  set On = beam @ 5\n  set Direction = 0, 1\n"
      "  set Magnitude = -600*sin(20*t)\n end\nend\n"
      "subsection Time\n set Step = 2e-3\n set End = 0.4\nend\n";

  void figure(const std::string &name, const double value, const std::string &unit)
  {
    std::printf("figure | %s | %.8g %s\n", name.c_str(), value, unit.c_str());
  }
} // namespace verification
