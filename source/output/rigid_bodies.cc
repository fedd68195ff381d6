// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/mechanism/rigid_body.h>
#include <taut/output/observer.h>
#include <taut/output/table_file.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// Writes the motion of the rigid bodies of a scene, rigid_bodies.csv: the place of each centre
  /// [m], and the rotation from the undeformed position, a vector along its axis [rad].
  class RigidBodies : public Observer
  {
  public:
    std::vector<std::string> files() const override { return {"rigid_bodies.csv"}; }
    void begin(const RunView &run) override;
    void record(const StepView &step) override;
    void finish() override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;

  private:
    void find_bodies(const StepView &step);
    void open(bool goes_on);

    std::string folder;
    double interval = 0., next = 0.;
    bool is_root = false, has_begun = false;
    std::vector<std::size_t> bodies; ///< numbers among all bodies
    std::vector<std::string> names;
    std::unique_ptr<TableFile> file;
  };

  void RigidBodies::begin(const RunView &run)
  {
    folder = run.folder;
    interval = run.interval;
    is_root = run.communicator.is_root();
  }

  void RigidBodies::find_bodies(const StepView &step)
  {
    const Structure &structure = step.structure;
    std::vector<double> is_rigid(structure.all_bodies().size(), 0.);
    for (std::size_t k = 0; k < structure.size(); ++k)
      is_rigid[structure.number(k)] = dynamic_cast<const RigidBody *>(&structure[k]) != nullptr;
    structure.communicator().sum(is_rigid);
    for (std::size_t i = 0; i < is_rigid.size(); ++i)
      if (is_rigid[i] > 0.)
      {
        bodies.push_back(i);
        names.push_back(structure.all_bodies()[i].name);
      }
    if (bodies.empty())
      throw EntryError("Output/Observers",
                       "the scene has no rigid body; take 'rigid bodies' out of the list");
    has_begun = true;
  }

  void RigidBodies::open(const bool goes_on)
  {
    if (!is_root)
      return;
    std::vector<std::string> columns = {"time [s]"};
    for (const std::string &name : names)
      for (const char *quantity : {" x [m]", " y [m]", " z [m]", " rotation x [rad]",
                                   " rotation y [rad]", " rotation z [rad]"})
        columns.push_back(name + quantity);
    file = std::make_unique<TableFile>(folder + "/rigid_bodies.csv", columns, goes_on);
  }

  void RigidBodies::record(const StepView &step)
  {
    if (!has_begun)
    {
      find_bodies(step);
      step.structure.communicator().agree([&] { open(false); });
    }
    if (!(step.state.time >= next - 1e-9 * interval))
      return;
    next = step.state.time + interval;
    constexpr std::size_t quantities = 6;
    const Structure &structure = step.structure;
    std::vector<double> values(quantities * bodies.size(), 0.);
    for (std::size_t b = 0; b < bodies.size(); ++b)
      for (std::size_t k = 0; k < structure.size(); ++k)
      {
        if (structure.number(k) != bodies[b])
          continue;
        const std::vector<double> U = displacement(step.reference, step.state, k);
        const auto &body = dynamic_cast<const RigidBody &>(structure[k]);
        const Coordinates centre = body.centre(U), rotation = body.rotation(U);
        for (unsigned int c = 0; c < 3; ++c)
        {
          values[quantities * b + c] = centre[c];
          values[quantities * b + 3 + c] = rotation[c];
        }
      }
    structure.communicator().sum(values);
    if (!file)
      return;
    file->begin_line(step.state.time);
    for (const double value : values)
      *file << value;
    file->end_line();
  }

  void RigidBodies::finish()
  {
    if (file)
      file->close();
  }

  void RigidBodies::save(OutputArchive &archive)
  {
    const std::size_t length = file ? file->save() : 0;
    archive << next << length;
  }

  void RigidBodies::resume(InputArchive &archive, const StepView &step)
  {
    std::size_t length = 0;
    archive >> next >> length;
    find_bodies(step);
    step.structure.communicator().agree([&] { open(true); });
    if (file)
      file->resume(length);
  }

  namespace
  {
    const Register<Observer, RigidBodies> register_rigid_bodies(
        "rigid bodies",
        "rigid_bodies.csv: place of the centre of each rigid body, and its rotation "
        "from the undeformed position as a vector along its axis, as often as "
        "Interval says");
  }
} // namespace taut
