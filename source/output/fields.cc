// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/output/fields.h>
#include <taut/scene/entries.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <cstdio>
#include <fstream>
#include <tuple>

namespace taut
{
  namespace
  {
    using Ranges =
        std::vector<std::tuple<unsigned int, unsigned int, std::string,
                               dealii::DataComponentInterpretation::DataComponentInterpretation>>;

    /// Patches made by hand, written by deal.II.
    template <int dim>
    class Patches : public dealii::DataOutInterface<dim, 3>
    {
    public:
      std::vector<dealii::DataOutBase::Patch<dim, 3>> patches;
      std::vector<std::string> names;
      Ranges ranges;

      void write(const std::string &path)
      {
        std::ofstream file(path);
        dealii::DataOutBase::VtkFlags flags;
        flags.compression_level = dealii::DataOutBase::VtkFlags::best_speed;
        this->set_flags(flags);
        try
        {
          if (!patches.empty())
            this->write_vtu(file);
        }
        catch (const dealii::ExceptionBase &)
        {
          // deal.II throws as soon as the file fails; what the user can do is said below.
          file.setstate(std::ios::failbit);
        }
        file.close();
        if (!file)
          throw UserError("cannot write '" + path + "': the disk may be full");
      }

    protected:
      const std::vector<dealii::DataOutBase::Patch<dim, 3>> &get_patches() const override
      {
        return patches;
      }
      std::vector<std::string> get_dataset_names() const override { return names; }
      Ranges get_nonscalar_data_ranges() const override { return ranges; }
    };

    std::string numbered(const std::string &name, const std::size_t number)
    {
      char text[32];
      std::snprintf(text, sizeof text, "_%05zu.vtu", number);
      return name + text;
    }
  } // namespace

  Fields::Fields(const std::string &folder, const Scene &scene, const Structure &structure,
                 const double interval, const unsigned int subdivisions)
      : folder(folder), interval(interval), subdivisions(subdivisions)
  {
    for (std::size_t w = 0; w < scene.wires.size(); ++w)
    {
      const std::vector<double> nodes = grid(scene, w);
      wire_begins.push_back(wires.size());
      for (std::size_t e = 0; e + 1 < nodes.size(); ++e)
        for (unsigned int k = e == 0 ? 0 : 1; k <= subdivisions; ++k)
        {
          const double s = nodes[e] + (nodes[e + 1] - nodes[e]) * k / subdivisions;
          wires.push_back(sample(scene, structure, {Attachment::Kind::wire, w, s}));
          wires.back().part = structure.part(w, s);
        }
    }
    wire_begins.push_back(wires.size());
    for (const Link &link : scene.links)
      if (!link.moving())
        link_ends.push_back(sample(scene, structure,
                                   link.to.kind == Attachment::Kind::ground ? link.from : link.to));
  }

  Fields::Sample Fields::sample(const Scene &scene, const Structure &structure,
                                const Attachment &at) const
  {
    Sample result;
    result.place = place(scene, at);
    structure.motion(at, false, {1., 0.}, 1., result.x);
    structure.motion(at, false, {0., 1.}, 1., result.y);
    return result;
  }

  std::vector<Point> Fields::displacements(const std::vector<Sample> &samples,
                                           const StepView &step) const
  {
    const BlockVector &reference = step.reference.displacement, &U = step.state.U;
    std::vector<double> shares;
    for (const Sample &sample : samples)
      for (const std::vector<Term> *terms : {&sample.x, &sample.y})
        shares.push_back(evaluate(*terms, reference) + evaluate(*terms, U));
    step.structure.communicator().sum(shares);
    std::vector<Point> result;
    for (std::size_t i = 0; i < samples.size(); ++i)
      result.push_back({shares[2 * i], shares[2 * i + 1]});
    return result;
  }

  /// The fixed ends of the rows that are links, and where the moving ones are now.
  std::vector<Fields::Sample> Fields::ends_of_links(const StepView &step) const
  {
    std::vector<Sample> ends = link_ends;
    for (std::size_t i = 0; i < step.rows.size(); ++i)
      if (step.rows[i].moving)
        ends.push_back(sample(step.scene, step.structure,
                              {Attachment::Kind::wire, step.scene.links[step.rows[i].link].to.index,
                               step.rows.position(i, step.state.time)}));
    return ends;
  }

  void Fields::record(const StepView &step)
  {
    // A step counts as due if it is within rounding of its time.
    if (interval == 0. || step.state.time < next - 1e-9 * interval)
      return;
    next = step.state.time + interval;
    const std::vector<Sample> ends = ends_of_links(step);
    const std::vector<Point> wire_displacement = displacements(wires, step),
                             link_displacement = displacements(ends, step);
    const auto write = [&]
    {
      if (!step.structure.communicator().is_root())
        return;
      if (!wires.empty())
      {
        wire_files.emplace_back(step.state.time, numbered("wires", wire_files.size()));
        write_wires(wire_displacement, wire_files.back().second);
        write_collection("wires.pvd", wire_files);
      }
      if (!ends.empty())
      {
        link_files.emplace_back(step.state.time, numbered("links", link_files.size()));
        write_links(step, ends, link_displacement, link_files.back().second);
        write_collection("links.pvd", link_files);
      }
    };
    step.structure.communicator().agree(write);
  }

  void Fields::write_wires(const std::vector<Point> &displacement, const std::string &name) const
  {
    Patches<1> out;
    out.names = {"displacement", "displacement", "displacement", "wire", "part"};
    out.ranges = {
        {0, 2, "displacement", dealii::DataComponentInterpretation::component_is_part_of_vector}};
    for (std::size_t w = 0; w + 1 < wire_begins.size(); ++w)
    {
      // One patch a wire, with the coordinates of its points as the last rows of its data.
      const std::size_t begin = wire_begins[w], n = wire_begins[w + 1] - begin;
      const Point first = wires[begin].place, last = wires[begin + n - 1].place;
      dealii::DataOutBase::Patch<1, 3> patch;
      patch.reference_cell = dealii::ReferenceCells::Line;
      patch.n_subdivisions = n - 1;
      patch.patch_index = w;
      patch.points_are_available = true;
      patch.vertices[0] = dealii::Point<3>(first.x, 0., first.y);
      patch.vertices[1] = dealii::Point<3>(last.x, 0., last.y);
      patch.data.reinit(8, n);
      for (std::size_t k = 0; k < n; ++k)
      {
        const Sample &at = wires[begin + k];
        const Point &u = displacement[begin + k];
        const double values[] = {
            u.x,        0., u.y,       static_cast<double>(w), static_cast<double>(at.part),
            at.place.x, 0., at.place.y};
        for (unsigned int c = 0; c < 8; ++c)
          patch.data(c, k) = values[c];
      }
      out.patches.push_back(std::move(patch));
    }
    out.write(folder + "/" + name);
  }

  void Fields::write_links(const StepView &step, const std::vector<Sample> &ends,
                           const std::vector<Point> &displacement, const std::string &name) const
  {
    Patches<0> out;
    out.names = {"displacement", "displacement", "displacement", "force", "gap", "open"};
    out.ranges = {
        {0, 2, "displacement", dealii::DataComponentInterpretation::component_is_part_of_vector}};
    for (std::size_t i = 0; i < step.rows.size(); ++i)
    {
      if (step.rows[i].is_cut())
        continue;
      const std::size_t index = out.patches.size();
      const Sample &end = ends[index];
      const Point &u = displacement[index];
      dealii::DataOutBase::Patch<0, 3> patch;
      patch.patch_index = index;
      patch.vertices[0] = dealii::Point<3>(end.place.x, 0., end.place.y);
      patch.data.reinit(6, 1);
      const double values[] = {u.x,
                               0.,
                               u.y,
                               step.state.multiplier[i],
                               step.state.geometric_gap[i],
                               step.state.multiplier[i] == 0. ? 1. : 0.};
      for (unsigned int k = 0; k < 6; ++k)
        patch.data(k, 0) = values[k];
      out.patches.push_back(std::move(patch));
    }
    out.write(folder + "/" + name);
  }

  void Fields::write_collection(const std::string &name,
                                const std::vector<std::pair<double, std::string>> &files) const
  {
    std::ofstream file(folder + "/" + name);
    try
    {
      dealii::DataOutBase::write_pvd_record(file, files);
    }
    catch (const dealii::ExceptionBase &)
    {
      file.setstate(std::ios::failbit);
    }
    file.close();
    if (!file)
      throw UserError("cannot write '" + folder + "/" + name + "': the disk may be full");
  }
} // namespace taut
