// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_contact_tables_h
#define taut_contact_tables_h

#include "model/surface_constraints.h"
#include <taut/output/observer.h>
#include <taut/output/table_file.h>
#include <taut/output/vtu_file.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// What a contact of surfaces does as a whole.
  struct SurfaceForce
  {
    Coordinates force, point;       ///< on the slave; where it acts [N, m]
    double size = 0.;               ///< sum of the sizes of its parts [N]
    double area = 0., largest = 0.; ///< where it is closed; pressure there [m^2, Pa or m, N/m]
    double gap = std::numeric_limits<double>::infinity(); ///< the least [m]
    std::size_t n_closed = 0, n_nodes = 0;
    bool is_line = false; ///< of a cable
  };

  /**
   * Writes the contacts of surfaces. `contact_<name>.csv` has a line each Output/Interval: the
   * resultant force on the slave and its place (displaced on cables, otherwise undeformed), contact
   * area, largest pressure (of a cable length and force per length) and least gap.
   * `contact_<name>_NNNNN.vtu`, joined by `contact_<name>.pvd`, are for ParaView. They have the
   * nodes of the slave that may touch, with displacement, pressure, gap and normal. Places are
   * undeformed, as in `body_<name>.pvd`, in the folder `fields`.
   */
  class ContactTables : public Observer
  {
  public:
    /// @p field_interval: least time between two .vtu files [s]; 0: no files.
    ContactTables(const Scene &scene, double field_interval);

    std::vector<std::string> files() const override;
    void begin(const RunView &run) override;
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;
    void finish() override;

    /// Each contact in the last line of its table, in the order of the scene; on the root.
    std::vector<SurfaceForce> last() const;

  private:
    struct Contact
    {
      std::string stem;
      ContactGeometry geometry;
      std::unique_ptr<TableFile> table; ///< on the root
      std::unique_ptr<VtuFile> picture;
      std::unique_ptr<PvdFile> collection;
      std::size_t displacement = 0, pressure = 0, gap = 0;
      SurfaceForce last;
    };
    void write_line(Contact &contact, double time);
    void write_picture(Contact &contact, double time, const std::vector<double> &forces,
                       const std::vector<double> &gaps,
                       const std::vector<Coordinates> &displacements);

    std::vector<Contact> contacts;
    std::string folder, fields_folder;
    double interval = 0., field_interval, next = 0., next_field = 0.;
    bool is_root = false;
  };
} // namespace taut

#endif
