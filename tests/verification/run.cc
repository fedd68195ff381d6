// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs scenes for the tests of this folder; see run.h.
#include "run.h"

namespace verification
{
  namespace
  {
    class Guest : public taut::Observer
    {
    public:
      explicit Guest(const Callback &callback) : callback(callback) {}
      void record(const taut::StepView &view) override
      {
        if (callback)
          callback(view);
      }

    private:
      const Callback &callback;
    };
  } // namespace

  std::string scene_file(const std::string &name)
  {
    return std::string(TAUT_PRM_FOLDER) + "/" + name + ".prm";
  }

  Session::Session(const std::string &file_or_text, const Overrides &overrides,
                   const taut::Communicator &processes)
  {
    std::string file = file_or_text;
    if (file.find('\n') != std::string::npos)
    {
      file = scratch.write("scene.prm", prm(file_or_text));
    }
    values.read(file, Overrides{"Output.Folder=" + scratch / "results", "Output.Interval=1e9",
                                "Output.Link interval=1e9"} +
                          overrides);
    runner = std::make_unique<taut::Simulation>(values, text, processes);
  }

  void Session::run(const Callback &callback)
  {
    Guest guest(callback);
    runner->observe(guest);
    runner->run();
  }

  nlohmann::json Session::statistics() const
  {
    return nlohmann::json::parse(file_text(folder() + "/statistics.json"));
  }

  std::string Session::write_scene() const
  {
    std::ostringstream entries;
    parameters().print(entries);
    return scratch.write("results/scene.prm", entries.str());
  }

  Said say(const std::string &file_or_text, const Overrides &overrides, const Callback &callback)
  {
    Session session(file_or_text, overrides);
    session.run(callback);
    return {session.statistics(), session.log(), read_table(session.folder() + "/sliding.csv")};
  }

  void run_scene(const std::string &file_or_text, const Overrides &overrides,
                 const Callback &callback)
  {
    Session(file_or_text, overrides).run(callback);
  }

  std::string log_of(const std::string &file_or_text, const Overrides &overrides,
                     const Callback &callback)
  {
    Session session(file_or_text, overrides);
    session.run(callback);
    return session.log();
  }

  std::vector<double> history_of(const std::string &file_or_text, const Overrides &overrides,
                                 const std::function<double(const taut::StepView &)> &value)
  {
    std::vector<double> result;
    run_scene(file_or_text, overrides,
              [&](const taut::StepView &view) { result.push_back(value(view)); });
    return result;
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

  std::vector<taut::Term> point_of_mass(const taut::StepView &view, const std::size_t mass,
                                        const taut::Coordinates &direction)
  {
    std::vector<taut::Term> terms;
    view.structure.motion({taut::Attachment::Kind::mass, mass}, false, direction, 1., terms);
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
      R"(Start = equilibrium
Wire beam: To = 12, 0; Components = beam; Mass per length = 5; Bending stiffness = 4000;
  Element size = 0.25
Support ends: Wire = beam; Positions = 0, 12
Link stop: Type = stop; From = ground; To = beam @ 2:2:10; Direction = 0, 1; Gap = 0.005;
  Law = formula; Law formula = 5e3*d + 1e8*d^3; Law range = 0.1
Link dropper: Type = dropper; From = ground; To = beam @ 1:2:11; Direction = 0, -1; Law = table;
  Law points = 0.002: 40, 0.02: 80
Load push: On = beam @ 5; Direction = 0, 1; Magnitude = -600*sin(20*t)
Time: Step = 2e-3; End = 0.4
)";

  double figure(const std::string &name, const double value, const std::string &unit)
  {
    std::printf("figure | %s | %.8g %s\n", name.c_str(), value, unit.c_str());
    return value;
  }
} // namespace verification
