// SPDX-License-Identifier: LGPL-2.1-or-later
#include "model/found_droppers.h"

#include "base/text.h"
#include "model/scene_part.h"
#include "model/wires_at_rest.h"
#include "scene/entries.h"
#include <taut/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace taut
{
  namespace
  {
    /// Sets vectors from end to end of undeformed links. Only a body knows the positions of its
    /// places.
    void set_between(const Scene &scene, std::vector<FoundDropper> &droppers)
    {
      const bool is_on_body =
          std::any_of(droppers.begin(), droppers.end(),
                      [](const FoundDropper &dropper)
                      {
                        return dropper.link.from.kind == Attachment::Kind::body ||
                               dropper.link.to.kind == Attachment::Kind::body;
                      });
      std::optional<SceneBodies> bodies;
      if (is_on_body)
        bodies.emplace(scene);
      const auto at = [&](const Attachment &end)
      { return bodies ? bodies->position(scene, end) : place(scene, end); };
      for (FoundDropper &dropper : droppers)
        dropper.between = at(dropper.link.to) - at(dropper.link.from);
    }

    /// The direction across a dropper and the wire from which it hangs.
    Coordinates sideways(const Scene &scene, const Link &dropper)
    {
      return unit(cross(dropper.direction, scene.wires[dropper.from.index].tangent()),
                  dropper.origin);
    }

    /// Distance of the ends of a rope across its direction and the direction aside.
    double run_of(const Scene &scene, const Link &rope, const Coordinates &between)
    {
      Coordinates across = add_scaled(between, -dot(between, rope.direction), rope.direction);
      if (rope.form.find_direction)
      {
        const Coordinates aside = sideways(scene, rope);
        across = add_scaled(across, -dot(across, aside), aside);
      }
      // Places from which a rope hangs straight down differ by rounding.
      constexpr double rounding = 1e-12;
      const double run = norm(across);
      if (!(run > rounding * norm(between)))
        throw EntryError(rope.origin + "/Pull",
                         "both ends of rope '" + rope.name +
                             "' are above each other, so that no part of its tension is across its "
                             "Direction; move one, or give a Prescribed displacement in its place");
      return run;
    }
  } // namespace

  std::vector<FoundDropper> found_droppers(const Scene &scene)
  {
    std::vector<FoundDropper> result;
    result.reserve(std::count_if(scene.links.begin(), scene.links.end(), is_found));
    for (const Link &link : scene.links)
      if (is_found(link))
        result.push_back({link, {}});
    set_between(scene, result);
    for (FoundDropper &dropper : result)
    {
      Link &link = dropper.link;
      if (link.form.pull > 0.)
        dropper.run = run_of(scene, link, dropper.between);
      if (!dropper.is_given())
        link.length = dropper.length_over(dot(dropper.between, link.direction));
    }
    return result;
  }

  void add_mass(const Link &link, Scene &scene)
  {
    if (link.form.mass_per_length == 0.)
      return;
    const double half = .5 * link.form.mass_per_length * link.length;
    for (const Attachment *end : {&link.from, &link.to})
      if (end->kind == Attachment::Kind::wire)
        scene.point_masses.push_back(
            {link.name, link.origin, end->index, {end->position}, half, true});
      else
        scene.masses[end->index].mass += half;
  }

  namespace
  {
    Load force(const Link &link, const Attachment &end, const double magnitude)
    {
      Load load;
      load.name = link.name;
      load.target = end;
      load.direction = link.direction;
      load.magnitude = Expression(magnitude);
      return load;
    }

    /// A spring that pulls the ends of a dropper together, in proportion to their distance along a
    /// direction.
    Link spring_between(const FoundDropper &dropper, const Coordinates &direction,
                        const double stiffness)
    {
      Link spring;
      spring.name = dropper.link.name;
      spring.from = dropper.link.from;
      spring.to = dropper.link.to;
      spring.direction = direction;
      spring.stiffness = stiffness;
      spring.gap = dot(dropper.between, direction);
      return spring;
    }

    /// A dropper of a given length, from end to end.
    Link turning(const FoundDropper &dropper)
    {
      Link link = dropper.link;
      link.form = {};
      link.turns = true;
      return link;
    }

    /// Springs that pull the ends of droppers of a known form together across their heights.
    void add_sideways(const std::vector<FoundDropper> &droppers, const DropperForm &form,
                      Scene &scene)
    {
      for (std::size_t i = 0; i < form.length.size(); ++i)
        if (const FoundDropper &dropper = droppers[i];
            dropper.link.form.find_direction && !dropper.is_given() && form.tension[i] > 0.)
          scene.links.push_back(spring_between(dropper, sideways(scene, dropper.link),
                                               form.tension[i] / form.length[i]));
    }

    /// Whether forces at the `from` ends move what holds the `to` ends, through other links.
    bool are_ends_connected(const Scene &base, const std::vector<FoundDropper> &droppers)
    {
      Scene scene = base;
      std::vector<Attachment> lower;
      for (const FoundDropper &dropper : droppers)
        if (dropper.is_given() || dropper.is_rope())
          scene.links.push_back(dropper.link);
        else
          lower.push_back(dropper.link.to);
      const ScenePart part = connected_part(std::move(scene), lower);
      return std::any_of(droppers.begin(), droppers.end(),
                         [&](const FoundDropper &dropper)
                         {
                           const Attachment from = part.inside(dropper.link.from);
                           return from.kind != Attachment::Kind::ground && from.index != ground;
                         });
    }

    /// Bilateral constraints that hold the `to` ends: their multipliers are minus the tensions. 0
    /// for ropes and for droppers of a given length. The `from` ends carry the tensions @p last.
    std::vector<double> tensions(const Scene &base, const std::vector<FoundDropper> &droppers,
                                 const std::vector<double> &last, const DropperForm &before,
                                 const SolverParameters &parameters, const Communicator &processes)
    {
      Scene scene = base;
      scene.links.reserve(base.links.size() + droppers.size());
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        const FoundDropper &dropper = droppers[i];
        const Link &link = dropper.link;
        add_mass(link, scene);
        if (dropper.is_given())
        {
          scene.links.push_back(turning(dropper));
          continue;
        }
        if (dropper.is_rope())
        {
          scene.links.push_back(spring_between(dropper, link.direction, dropper.force_density()));
          continue;
        }
        if (!last.empty())
          scene.loads.push_back(force(link, link.from, last[i]));
        Link hold;
        hold.name = link.name;
        hold.kind = LinkKind::joint;
        hold.to = link.to;
        hold.direction = link.direction;
        hold.gap = link.form.prescribed_displacement;
        scene.links.push_back(hold);
      }
      add_sideways(droppers, before, scene);
      const WiresAtRest rest(scene, parameters, processes);
      std::vector<double> result;
      for (std::size_t i = 0; i < droppers.size(); ++i)
        result.push_back(droppers[i].is_rope() || droppers[i].is_given()
                             ? 0.
                             : -rest.multiplier(base.links.size() + i));
      return result;
    }

    void check_pull(const std::vector<FoundDropper> &droppers, const std::vector<double> &tension)
    {
      for (std::size_t i = 0; i < droppers.size(); ++i)
        if (const Link &link = droppers[i].link;
            !droppers[i].is_rope() && !droppers[i].is_given() && !(tension[i] >= 0.))
          throw EntryError(link.origin,
                           to_text("dropper '", link.name, "' would have to push with ",
                                   -tension[i], " N to hold its wire at the prescribed height, ",
                                   -link.form.prescribed_displacement,
                                   " m as it was read. Move or remove it, or prescribe another "
                                   "height."));
    }

    /// Solves x = G(x) for a G that is about linear, with the steps of J. Barzilai, J. M. Borwein,
    /// IMA J. Numer. Anal. 8 (1988): each takes the slope of the last one.
    class FixedPoint
    {
    public:
      /// From x to the next one.
      void advance(const std::vector<double> &G, std::vector<double> &x)
      {
        double square = 0., slope = 0.;
        std::vector<double> miss(x.size());
        for (std::size_t i = 0; i < x.size(); ++i)
        {
          miss[i] = G[i] - x[i];
          if (last_miss.empty())
            continue;
          const double step = x[i] - last_x[i];
          square += step * step;
          slope += step * (last_miss[i] - miss[i]);
        }
        last_x = x;
        const double factor = slope > 0. ? square / slope : 1.;
        for (std::size_t i = 0; i < x.size(); ++i)
          x[i] += factor * miss[i];
        last_miss = std::move(miss);
      }

    private:
      std::vector<double> last_x, last_miss;
    };

    /**
     * The droppers under their tensions. If the direction of a dropper is found, `tension` is the
     * part V of its tension along the prescribed height. The lateral part follows from the
     * direction: V/h times the lateral extent of the dropper, with the distance h along the height,
     * which no lateral force changes. This is a spring of stiffness V/h (a force density, H.-J.
     * Schek, Computer Methods in Applied Mechanics and Engineering 3 (1974), 115-134), so that the
     * static state is that of a linear scene. A rope of known pull is such a spring in both
     * directions. Next to droppers of a given length, which turn with both, the springs across the
     * heights are there from the form before on.
     */
    DropperForm form_under(const Scene &base, const std::vector<FoundDropper> &droppers,
                           const std::vector<double> &tension, const DropperForm &before,
                           const SolverParameters &parameters, const Communicator &processes)
    {
      Scene scene = base;
      std::vector<std::size_t> link_of; ///< of droppers of a given length
      std::vector<Coordinates> along;   ///< directions of the droppers
      bool finds_directions = false;
      for (const FoundDropper &dropper : droppers)
      {
        const Link &link = dropper.link;
        const double N = tension[link_of.size()];
        link_of.push_back(scene.links.size());
        add_mass(link, scene);
        if (dropper.is_given())
          scene.links.push_back(turning(dropper));
        else if (dropper.is_rope())
          scene.links.push_back(spring_between(dropper, link.direction, dropper.force_density()));
        else
        {
          scene.loads.push_back(force(link, link.from, N));
          scene.loads.push_back(force(link, link.to, -N));
        }
        finds_directions |= link.form.find_direction;
        along.push_back(link.direction);
      }
      DropperForm form{tension, {}, std::vector<double>(droppers.size(), 0.)};
      const auto n_links = static_cast<std::ptrdiff_t>(scene.links.size());
      add_sideways(droppers, before, scene);
      form.length = WiresAtRest(scene, parameters, processes).distances(droppers, along);
      scene.links.erase(scene.links.begin() + n_links, scene.links.end());
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        if (!(form.length[i] > 0.))
          throw EntryError(
              droppers[i].link.origin,
              to_text(
                  "dropper '", droppers[i].link.name,
                  "' would have no length: its wires touch in the static state. Undeformed they "
                  "are ",
                  dot(droppers[i].between, droppers[i].link.direction),
                  " m apart as it was read: are lengths in millimetres? Otherwise increase the "
                  "encumbrance or the tension of the upper wire."));
        if (droppers[i].is_rope())
          form.tension[i] = droppers[i].force_density() * form.length[i];
      }
      if (!finds_directions)
        return form;

      add_sideways(droppers, form, scene);
      const WiresAtRest rest(scene, parameters, processes);
      std::vector<Coordinates> across = along;
      for (std::size_t i = 0; i < droppers.size(); ++i)
        if (droppers[i].link.form.find_direction)
          across[i] = sideways(scene, droppers[i].link);
      const std::vector<double> extent = rest.distances(droppers, along),
                                aside = rest.distances(droppers, across);
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        const Link &link = droppers[i].link;
        if (!link.form.find_direction)
          continue;
        form.sideways[i] = aside[i];
        if (droppers[i].is_given())
        {
          form.length[i] = std::hypot(extent[i], form.sideways[i]);
          form.tension[i] = rest.multiplier(link_of[i]);
          continue;
        }
        const double length = std::hypot(form.length[i], form.sideways[i]);
        form.tension[i] *= length / form.length[i];
        form.length[i] = length;
      }
      return form;
    }

    /// Turns a dropper into the direction that was found.
    void set_direction(const Scene &scene, const double tension, const double length,
                       const double extent, const Coordinates &between, Link &link)
    {
      const double c = std::sqrt(1. - extent * extent / (length * length)), s = extent / length;
      const Coordinates along = link.direction, across = sideways(scene, link), zero;
      link.direction = add_scaled(add_scaled(zero, c, along), s, across);
      link.sideways.direction = add_scaled(add_scaled(zero, -s, along), c, across);
      link.sideways.stiffness = tension / length;
      link.sideways.gap = dot(between, link.sideways.direction);
    }
  } // namespace

  DropperForm find_form(const Scene &base, std::vector<FoundDropper> &droppers,
                        const SolverParameters &parameters, const Communicator &processes)
  {
    // Rounding of the heights of a long line keeps changes of lengths above `settled`, but not
    // above `rounding`, which are a hundredth of a newton for a dropper of 1e5 N/m and 1 m.
    constexpr double settled = 1e-12, rounding = 1e-7, not_less = .5;
    // Without other links between their ends the second tensions are the last ones. The changes of
    // a FixedPoint do not fall in each iteration.
    constexpr int max_iterations = 100, patience = 5;
    const bool is_connected = are_ends_connected(base, droppers);
    // The constraint at the lower end of a dropper carries the half of its mass that is there. The
    // tensions of many droppers follow their lengths by that, without another equilibrium.
    constexpr std::size_t many = 200;
    const bool weigh = droppers.size() > many && !is_connected &&
                       std::all_of(droppers.begin(), droppers.end(),
                                   [](const FoundDropper &d) {
                                     return !d.is_rope() && !d.is_given() &&
                                            d.link.to.kind == Attachment::Kind::wire;
                                   });
    std::vector<double> tension;
    FixedPoint tensions_of_ends;
    DropperForm before;
    double least = std::numeric_limits<double>::infinity();
    for (int iteration = 0, stalled = 0;; ++iteration)
    {
      if (iteration == 0 || !weigh)
      {
        const std::vector<double> found =
            tensions(base, droppers, tension, before, parameters, processes);
        if (is_connected && iteration > 0)
          tensions_of_ends.advance(found, tension);
        else
          tension = found;
      }
      if (!is_connected)
        check_pull(droppers, tension);
      const DropperForm form = form_under(base, droppers, tension, before, parameters, processes);
      double change = 0.;
      for (std::size_t i = 0; i < droppers.size(); ++i)
      {
        Link &link = droppers[i].link;
        const double length = droppers[i].length_over(form.length[i]);
        if (link.form.mass_per_length > 0. || is_connected)
          change = std::max(change, std::fabs(length - link.length) / length);
        tension[i] += .5 * link.form.mass_per_length * (length - link.length) *
                      dot(base.gravity, link.direction);
        link.length = length;
      }
      change = processes.max(change); // all ranks go on, or none
      stalled = change > not_less * least ? stalled + 1 : 0;
      if (change < settled || (change < rounding && stalled > (is_connected ? patience : 0)))
      {
        check_pull(droppers, tension);
        return form;
      }
      if (iteration + 1 == max_iterations)
        throw EntryError(
            droppers.front().link.origin,
            "the dropper lengths do not settle: the weight of droppers, or links beside them, "
            "decide the shape of the wires. Check the mass per length of the droppers, and the "
            "lengths that are given.");
      least = std::min(least, change);
      if (is_connected)
        before = form;
    }
  }

  void take_form(const Scene &scene, const FoundDropper &dropper, const DropperForm &form,
                 const std::size_t i, Link &link)
  {
    const double extent = form.length[i], N = form.tension[i];
    link.length = dropper.length_over(extent);
    if (link.form.axial_stiffness > 0. && !dropper.is_given())
      link.stiffness = link.form.axial_stiffness / link.length;
    double elongation = link.elongation(N);
    if (dropper.is_rope())
    {
      // Along the link, a part of the spring and of the force density, which turns.
      const double part = extent / link.length, run = dropper.run / link.length;
      elongation = N / part / link.stiffness;
      link.stiffness = dropper.force_density() * run * run + link.stiffness * part * part;
    }
    if (link.form.find_direction)
      set_direction(scene, N, extent, form.sideways[i], dropper.between, link);
    if (dropper.is_given())
    {
      link.gap = link.unstressed_length - dot(dropper.between, link.direction);
      return;
    }
    // D = -n . (u_to - u_from) + gap + N / stiffness = 0 under the tension
    link.gap = extent - dot(dropper.between, link.direction) - link.elongation(N);
    link.unstressed_length = link.length - elongation;
  }
} // namespace taut
