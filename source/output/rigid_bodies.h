// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_rigid_bodies_h
#define taut_rigid_bodies_h

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
} // namespace taut

#endif
