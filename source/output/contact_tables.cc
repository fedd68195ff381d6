// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output/contact_tables.h"
#include <taut/base/archive.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace taut
{
  namespace
  {
    /// Whether a time is at the end of an interval, or before it by rounding.
    bool is_due(const double time, const double next, const double interval)
    {
      return time >= next - 1e-9 * interval;
    }

    std::string frame(const std::string &stem, const std::size_t number)
    {
      char text[16];
      std::snprintf(text, sizeof text, "_%05zu.vtu", number);
      return stem + text;
    }

    /// Displacements of the nodes with constraints, from the undeformed body [m]. Called by all
    /// ranks together.
    std::vector<Coordinates> displacements_of(const ContactGeometry &geometry,
                                              const std::size_t body, const StepView &step)
    {
      const Coordinates axes[] = {{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
      std::vector<double> shares;
      for (const SurfaceConstraint &constraint : geometry.constraints)
      {
        const std::size_t k = step.structure.index_at_node(body, constraint.node);
        for (const Coordinates &axis : axes)
        {
          std::vector<Term> terms;
          if (k != Structure::elsewhere)
            terms.push_back({k, step.structure[k].node_displacement(constraint.node, axis)});
          shares.push_back(evaluate(terms, step.reference.displacement) +
                           evaluate(terms, step.state.U));
        }
      }
      step.structure.communicator().sum(shares);
      std::vector<Coordinates> result;
      for (std::size_t i = 0; i < shares.size(); i += 3)
        result.push_back({shares[i], shares[i + 1], shares[i + 2]});
      return result;
    }

    /// Place of a constraint: displaced on a line, which moves far, otherwise undeformed [m].
    Coordinates place_of(const ContactGeometry &geometry, const std::size_t constraint,
                         const Coordinates &displacement)
    {
      const Coordinates &point = geometry.constraints[constraint].point;
      return geometry.slave.dim == 1 ? add_scaled(point, 1., displacement) : point;
    }

    SurfaceForce sum_of(const ContactGeometry &geometry, const std::vector<double> &forces,
                        const std::vector<double> &gaps,
                        const std::vector<Coordinates> &displacements)
    {
      SurfaceForce result;
      Coordinates weighted;
      const std::vector<SurfaceConstraint> &all = geometry.constraints;
      result.n_nodes = all.size();
      result.is_line = geometry.slave.dim == 1;
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        const double N = forces[i];
        result.gap = std::min(result.gap, gaps[i]);
        if (!(N > 0.))
          continue;
        ++result.n_closed;
        result.force = add_scaled(result.force, -N, all[i].normal);
        weighted = add_scaled(weighted, N, place_of(geometry, i, displacements[i]));
        result.size += N;
        result.area += all[i].area;
        result.largest = std::max(result.largest, N / all[i].area);
      }
      if (result.size > 0.)
        result.point = add_scaled({}, 1. / result.size, weighted);
      return result;
    }

    void append(const Coordinates &p, std::vector<float> &values)
    {
      for (unsigned int d = 0; d < 3; ++d)
        values.push_back(static_cast<float>(p[d]));
    }
  } // namespace

  ContactTables::ContactTables(const Scene &scene, const double field_interval)
      : field_interval(field_interval)
  {
    for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    {
      contacts.emplace_back();
      contacts.back().stem = "contact_" + scene.contacts[c].name;
      contacts.back().geometry = contact_geometry(scene, c);
    }
  }

  std::vector<std::string> ContactTables::files() const
  {
    std::vector<std::string> result;
    for (const Contact &contact : contacts)
    {
      result.push_back(contact.stem + ".csv");
      result.push_back(contact.stem + ".pvd");
    }
    return result;
  }

  void ContactTables::begin(const RunView &run)
  {
    folder = run.folder + "/";
    interval = run.interval;
    if (field_interval > 0. && !contacts.empty() && run.communicator.is_root())
      fields_folder = make_fields_folder(run.folder);
    is_root = run.communicator.is_root();
    if (!is_root)
      return;
    for (Contact &contact : contacts)
    {
      const bool is_line = contact.geometry.slave.dim == 1;
      contact.table = std::make_unique<TableFile>(
          folder + contact.stem + ".csv",
          std::vector<std::string>{
              "time [s]", "force x [N]", "force y [N]", "force z [N]", "point x [m]", "point y [m]",
              "point z [m]", is_line ? "length [m]" : "area [m^2]",
              is_line ? "largest force per length [N/m]" : "largest pressure [Pa]", "least gap [m]",
              "closed [1]"},
          run.resumes);
      if (!(field_interval > 0.))
        continue;
      const std::vector<SurfaceConstraint> &all = contact.geometry.constraints;
      std::vector<std::vector<std::int32_t>> cells;
      std::vector<float> normals;
      for (const SurfaceConstraint &constraint : all)
      {
        cells.push_back({static_cast<std::int32_t>(cells.size())});
        append(constraint.normal, normals);
      }
      contact.picture = std::make_unique<VtuFile>(all.size(), cells);
      contact.displacement =
          contact.picture->add(VtuFile::Location::points, "displacement", 3, "m");
      contact.pressure =
          contact.picture->add(VtuFile::Location::points, "pressure", 1, is_line ? "N/m" : "Pa");
      contact.gap = contact.picture->add(VtuFile::Location::points, "gap", 1, "m");
      contact.picture->set(contact.picture->add(VtuFile::Location::points, "normal", 3, "1"),
                           normals);
      contact.collection = std::make_unique<PvdFile>(fields_folder + contact.stem + ".pvd");
    }
  }

  void ContactTables::record(const StepView &step)
  {
    const State &state = step.state;
    const bool line = is_due(state.time, next, interval),
               picture = field_interval > 0. && is_due(state.time, next_field, field_interval);
    if (line)
      next = state.time + interval;
    if (picture)
      next_field = state.time + field_interval;
    if (!line && !picture)
      return;
    std::vector<std::vector<Coordinates>> displacements;
    std::vector<std::vector<double>> forces, gaps;
    for (std::size_t c = 0; c < contacts.size(); ++c)
    {
      const ContactGeometry &geometry = contacts[c].geometry;
      displacements.push_back(
          picture || geometry.slave.dim == 1
              ? displacements_of(geometry, step.scene.contacts[c].slave.body, step)
              : std::vector<Coordinates>(geometry.constraints.size()));
      for (const auto &[values, of_contacts] :
           {std::pair(&state.multiplier, &forces), std::pair(&state.distance, &gaps)})
        of_contacts->push_back(step.constraints.of_contact(*values, c));
    }
    if (!is_root)
      return;
    for (std::size_t c = 0; c < contacts.size(); ++c)
    {
      if (line)
      {
        contacts[c].last = sum_of(contacts[c].geometry, forces[c], gaps[c], displacements[c]);
        write_line(contacts[c], state.time);
      }
      if (picture)
        write_picture(contacts[c], state.time, forces[c], gaps[c], displacements[c]);
    }
  }

  void ContactTables::write_line(Contact &contact, const double time)
  {
    const SurfaceForce &sum = contact.last;
    contact.table->begin_line(time);
    for (int d = 0; d < 3; ++d)
      *contact.table << sum.force[d];
    for (int d = 0; d < 3; ++d)
      *contact.table << sum.point[d];
    *contact.table << sum.area << sum.largest << sum.gap << static_cast<double>(sum.n_closed);
    contact.table->end_line();
  }

  std::vector<SurfaceForce> ContactTables::last() const
  {
    std::vector<SurfaceForce> result;
    for (const Contact &contact : contacts)
      result.push_back(contact.last);
    return result;
  }

  void ContactTables::write_picture(Contact &contact, const double time,
                                    const std::vector<double> &forces,
                                    const std::vector<double> &gaps,
                                    const std::vector<Coordinates> &displacements)
  {
    std::vector<float> places, moved, pressure, distances;
    const std::vector<SurfaceConstraint> &all = contact.geometry.constraints;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      append(all[i].point, places);
      append(displacements[i], moved);
      pressure.push_back(static_cast<float>(forces[i] / all[i].area));
      distances.push_back(static_cast<float>(gaps[i]));
    }
    contact.picture->set(VtuFile::positions, places);
    contact.picture->set(contact.displacement, moved);
    contact.picture->set(contact.pressure, pressure);
    contact.picture->set(contact.gap, distances);
    const std::string file = frame(contact.stem, contact.collection->size());
    contact.picture->write(fields_folder + file);
    contact.collection->add(time, file);
  }

  void ContactTables::save(OutputArchive &archive)
  {
    archive << next << next_field;
    for (Contact &contact : contacts)
    {
      const std::size_t length = contact.table ? contact.table->save() : 0,
                        n_frames = contact.collection ? contact.collection->size() : 0,
                        pvd = n_frames > 0 ? contact.collection->length() : 0;
      archive << length << n_frames << pvd;
    }
  }

  void ContactTables::resume(InputArchive &archive, const StepView &)
  {
    archive >> next >> next_field;
    for (Contact &contact : contacts)
    {
      std::size_t length = 0, n_frames = 0, pvd = 0;
      archive >> length >> n_frames >> pvd;
      if (contact.table)
        contact.table->resume(length);
      if (contact.collection && n_frames > 0)
        contact.collection->resume(n_frames, pvd);
    }
  }

  void ContactTables::finish()
  {
    for (Contact &contact : contacts)
      if (contact.table)
        contact.table->close();
  }
} // namespace taut
