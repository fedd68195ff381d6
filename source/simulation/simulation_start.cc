// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/instruction_set.h"
#include "base/text.h"
#include "model/check_joints.h"
#include "model/form_finding.h"
#include "model/scene_constraints.h"
#include "output/rest_limits.h"
#include "output/scene_report.h"
#include "simulation/free_bodies.h"
#include <taut/base/exceptions.h>
#include <taut/output/spans.h>
#include <taut/output/table_file.h>
#include <taut/simulation/simulation.h>
#include <taut/substructure/body_traits.h>
#include <taut/time/static_equilibrium.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>
#include <set>

namespace taut
{
  namespace
  {
    constexpr std::size_t most_named = 6; ///< in a line of the log

    /// "1 wire", "2 wires", "no wires".
    std::string counted(const std::size_t n, const std::string &one, const std::string &more = "")
    {
      const std::string many = more.empty() ? one + "s" : more;
      return n == 0 ? "no " + many : std::to_string(n) + " " + (n == 1 ? one : many);
    }
  } // namespace

  PartitionParameters Simulation::choose_parts()
  {
    PartitionParameters chosen = parameters.partition;
    if (chosen.method == "METIS" && chosen.n_substructures == "automatic")
    {
      const NumberOfParts parts =
          automatic_number_of_parts(model, parameters.end_time / parameters.step);
      chosen.n_substructures = std::to_string(parts.n);
      if (parts.n > 1)
        parts_reason = counted(parts.n, "part") + ": " + parts.reason;
    }
    return chosen;
  }

  void Simulation::describe() const
  {
    if (!parameters.accuracy_choice().empty())
      log << parameters.accuracy_choice() << '\n';
    log << "Scene '" << parameters.generator_name << "': " << counted(model.wires.size(), "wire")
        << ", " << counted(model.masses.size(), "mass", "masses") << ", "
        << counted(model.links.size(), "link") << '\n';
    print_bodies();
    print_links();
    for (const LineConstants &line : line_constants(model))
      log << to_text(std::setprecision(3), "  '", line.contact, "' at ", line.speed, " m/s under '",
                     line.wire, "', whose waves have ", line.wave_speed, " m/s: v/c ",
                     line.speed / line.wave_speed, ", Doppler factor ", line.doppler,
                     line.amplification > 0.
                         ? to_text(std::setprecision(3), ", reflection at droppers ",
                                   line.reflection, ", amplification ", line.amplification)
                         : std::string(),
                     '\n');
    for (const std::string &entry : parameters.unused_entries())
      log << "  not used: " << entry << '\n';
    for (const auto &warnings : {parameters.scene_warnings(), warnings_of_unheld_wires(model)})
      for (const std::string &warning : warnings)
        log << "Warning: " << warning << '\n';
    if (const std::string warning = warning_of_joints(model); !warning.empty())
      log << "Warning: " << warning << '\n';
    log << "  instruction set of the loops: " << instruction_set_in_use() << '\n';
    const double end = n_steps() * parameters.step;
    if (has_time() && std::fabs(end - parameters.end_time) > 1e-6 * parameters.step)
      log << "  Time/End = " << parameters.end_time
          << " s is no multiple of Time/Step = " << parameters.step << " s: the last step ends at "
          << end << " s\n";
  }

  void Simulation::print_bodies() const
  {
    const std::vector<Structure::Body> &all = bodies.all_bodies();
    log << "  " << counted(all.size(), "body", "bodies") << ':';
    for (std::size_t k = 0; k < std::min(all.size(), most_named); ++k)
      log << (k > 0 ? "," : "") << " '" << all[k].name << "' " << all[k].n_dofs << " DoFs";
    if (all.size() > most_named)
      log << " and more, "
          << std::accumulate(all.begin(), all.end(), std::size_t(0),
                             [](const std::size_t sum, const Structure::Body &body)
                             { return sum + body.n_dofs; })
          << " DoFs in all";
    if (!parts_reason.empty())
      log << "\n  " << parts_reason;
    if (bodies.n_cuts() > 0)
      log << "\n  cut in " << counted(bodies.n_cuts(), "constraint");
    log << '\n';
  }

  /// Reports special features of the scene, which save work or are not intended.
  void Simulation::print_links() const
  {
    const std::size_t n_rows = links.n_of_all();
    std::vector<double> unilateral, rigid;
    for (std::size_t i = 0; i < links.size(); ++i)
    {
      unilateral.push_back(links[i].cone.may_open() ? 1. : 0.);
      rigid.push_back(links[i].spring.is_rigid() ? 1. : 0.);
    }
    const auto n_unilateral = static_cast<std::size_t>(links.total(unilateral)),
               n_rigid = static_cast<std::size_t>(links.total(rigid));
    log << "  " << counted(n_rows, "multiplier") << ": " << n_unilateral << " unilateral, "
        << n_rows - n_unilateral << " bilateral; " << links.sliding_rows().size() << " moving; "
        << n_rigid << " rigid\n";
    const auto no_wire = [&](const auto &has)
    { return !model.wires.empty() && std::none_of(model.wires.begin(), model.wires.end(), has); };
    if (no_wire([](const Wire &w) { return w.transverse == TransverseKind::beam; }))
      log << "  no bending: no slope DoFs\n";
    if (no_wire([](const Wire &w) { return w.has_axial || w.has_lateral; }))
      log << "  no axial motion: one DoF per point of a wire across it\n";
    if (n_rows == 0)
      log << "  no links: the bodies move independently\n";
    else if (n_unilateral == 0)
      log << "  only bilateral links: one linear solve a step, no active set\n";
    if (!links.turning_rows().empty())
      log << "  " << counted(links.turning_rows().size(), "link")
          << " with the direction from end to end at each time\n";
    if (n_rows > 0 && links.varying_rows().empty())
      log << "  no moving link: the interface operator is constant\n";
    const Scene asked = parameters.scene();
    const std::size_t n_found =
        std::count_if(asked.links.begin(), asked.links.end(),
                      [](const Link &link) { return link.form.find_length; });
    if (n_found > 0)
      log << "  " << counted(n_found, "length") << " of droppers found anew for these heights, "
          << "tensions and masses; "
          << (parameters.generator_name == "catenary"
                  ? "'Droppers/Lengths = " + parameters.output.folder + "'"
                  : "the 'cut length' of droppers.csv as Length")
          << " keeps the line as built when entries change\n";
    if (grounded_links.empty())
      return;
    log << "  at held ends of cables, which stand like the ground:";
    for (std::size_t i = 0; i < std::min(grounded_links.size(), most_named); ++i)
      log << (i > 0 ? "," : "") << " '" << grounded_links[i] << "'";
    log << (grounded_links.size() > most_named ? " and more\n" : "\n");
  }

  StepperOptions Simulation::stepper_options() const
  {
    return {parameters.step,          parameters.step_parameters,
            parameters.end_time,      model.start,
            parameters.scheme,        parameters.entries_below("Time/"),
            parameters.restitution(), parameters.allow_unsuitable_scheme,
            parameters.solver};
  }

  void Simulation::find_start()
  {
    motion = std::make_unique<Motion>(bodies, links, stepper_options());
    report_linearised();
    const InitialState &start = motion->start();
    if (model.start == Start::equilibrium)
    {
      log << "Static equilibrium: residual " << start.residuals.complementarity << " (links), "
          << start.residuals.balance << " (balance), "
          << counted(start.residuals.iterations, "active-set iteration");
      if (start.residuals.n_systems > 0)
        log << ", " << counted(start.residuals.n_inner_iterations, "iteration")
            << " of conjugate gradients in " << counted(start.residuals.n_systems, "system") << ", "
            << counted(start.residuals.n_products, "product") << " with F";
      log << '\n';
      report_free_bodies();
      processes.agree(
          [&]
          {
            for (std::size_t k = 0; k < bodies.size(); ++k)
              if (const auto *slender = dynamic_cast<const SlenderBody *>(&bodies[k]))
                slender->check_at_rest(displacement(start.reference, start.state, k));
          });
    }
    report_repeated_joints(start.repeated_joints);
    BodyVectors at_start = start.reference.displacement;
    for (std::size_t k = 0; k < at_start.size(); ++k)
      at_start[k] = displacement(start.reference, start.state, k);
    for (const std::string &warning : warnings_at_rest(model, bodies, at_start))
      log << "Warning: " << warning << '\n';
    if (model.start == Start::equilibrium)
      for (const std::string &warning : warnings_of_slack_droppers(
               model, links.of_links(start.state.multiplier, model.links.size()),
               links.of_links(start.state.distance, model.links.size())))
        log << "Warning: " << warning << '\n';
    observed = std::make_unique<ObservedRun>(*motion, model, bodies, parameters.output.folder,
                                             parameters.output.interval);
    observed->stop_if(stop_asked);
  }

  /// Names of selected bodies: "'a', 'b' and 3 more". Parts of one have one name.
  std::string Simulation::names_of(const std::vector<char> &some) const
  {
    std::string names;
    std::set<std::string> known;
    std::size_t n = 0;
    for (std::size_t i = 0; i < some.size(); ++i)
      if (const std::string &name = bodies.all_bodies()[i].name;
          some[i] && known.insert(name).second && ++n <= most_named)
        names += (n > 1 ? ", '" : "'") + name + "'";
    return names + (n > most_named ? " and " + std::to_string(n - most_named) + " more" : "");
  }

  void Simulation::report_repeated_joints(const std::string &names) const
  {
    if (!names.empty())
      log << "Joints repeat each other: " << names
          << "; of all forces that move the bodies alike, theirs are those of least norm\n";
  }

  /// Reports bodies and links that are linearised at the start.
  void Simulation::report_linearised() const
  {
    const InitialState &start = motion->start();
    const std::string names = names_of(start.linearised);
    if (names.empty())
      return;
    log << "Linearised at the "
        << (model.start == Start::equilibrium ? "equilibrium of the scene: " : "shape at rest: ")
        << names;
    if (!start.kept.empty())
      log << "; " << counted(start.kept.size(), "link") << " that would turn "
          << (start.kept.size() == 1 ? "keeps its direction" : "keep their directions");
    log << '\n';
  }

  /// Reports bodies that are at rest only because nothing pushes them.
  void Simulation::report_free_bodies() const
  {
    std::vector<Substructure::NullSpace> null_spaces;
    for (std::size_t k = 0; k < bodies.size(); ++k)
      null_spaces.push_back(bodies[k].null_space());
    const std::vector<char> free =
        free_bodies(bodies, null_spaces, links, motion->start().state.multiplier);
    std::vector<double> flags(bodies.all_bodies().size(), 0.);
    for (std::size_t k = 0; k < bodies.size(); ++k)
      flags[bodies.number(k)] = free[k];
    processes.sum(flags);
    const std::vector<char> all(flags.begin(), flags.end());
    const std::string names = names_of(all);
    if (!names.empty())
      log << "  nothing holds " << names << ": at rest only because no force moves "
          << (std::count(all.begin(), all.end(), 1) > 1 ? "them" : "it") << '\n';
  }

  /// The equilibrium without the sliding contacts, which lift what they touch, of a run that starts
  /// from an equilibrium; otherwise, and where there is none, the start.
  void Simulation::find_rest()
  {
    const InitialState &start = motion->start();
    rest = start.reference.displacement;
    for (std::size_t k = 0; k < rest.size(); ++k)
      rest[k] = displacement(start.reference, start.state, k);
    keep_forces_at_rest(model, links.of_links(start.state.multiplier, model.links.size()));
    const bool is_still = model.start == Start::equilibrium,
               has_sliding = !links.sliding_rows().empty();
    if (is_still && has_sliding && !(model.probes.empty() && spanned_wires(model).empty()))
    {
      const Scene without = without_sliding_contacts(model);
      Constraints fixed_constraints = scene_constraints(without, bodies);
      choose_rows(fixed_constraints, parameters.solver.interface, bodies, true);
      if (!start.kept.empty())
        fixed_constraints.keep_directions(start.reference.displacement, start.kept);
      try
      {
        const StaticState alone =
            static_equilibrium(bodies, fixed_constraints, parameters.solver, 0.);
        rest = alone.displacement;
        keep_forces_at_rest(without,
                            fixed_constraints.of_links(alone.multiplier, without.links.size()));
      }
      catch (const UserError &why)
      {
        log << "No equilibrium without the sliding contacts: displacements of probes count from "
               "the equilibrium with them, and sags and droppers are those of it ("
            << why.what() << ")\n";
      }
    }
    figures.find_sags(model, bodies, rest);
    // In a scene without motion the probes show the equilibrium itself.
    if (is_still && !model.probes.empty() && (has_time() || has_sliding))
      observed->set_rest_of_probes(rest);
  }

  void Simulation::keep_forces_at_rest(const Scene &scene, const std::vector<double> &of_links)
  {
    for (std::size_t l = 0; l < of_links.size() && processes.is_root(); ++l)
      if (is_dropper_between_wires(scene.links[l]))
        forces_at_rest[scene.links[l].name] = of_links[l];
  }

  /// Of the `to` ends of links between wires; 0 of others. Called by all ranks together.
  std::vector<double> Simulation::heights_at_rest() const
  {
    std::vector<double> heights;
    for (const Link &link : model.links)
    {
      std::vector<Term> terms;
      if (is_dropper_between_wires(link))
        bodies.motion(link.to, false, {0., 1.}, 1., terms);
      heights.push_back(evaluate(terms, rest));
    }
    processes.sum(heights);
    return heights;
  }

  namespace
  {
    bool is_same_or_ground(const Attachment &a, const Attachment &b)
    {
      const bool is_same =
          a.kind == b.kind && a.index == b.index && a.position == b.position && a.place == b.place;
      return is_same || a.kind == Attachment::Kind::ground || b.kind == Attachment::Kind::ground;
    }

    /// Whether joints are of one ball joint: along several directions, from one section, between
    /// the same ends. In place of a body in its plane the ground holds across the plane.
    bool are_one_ball_joint(const Link &a, const Link &b)
    {
      return !a.origin.empty() && a.origin == b.origin && a.kind == LinkKind::joint &&
             b.kind == LinkKind::joint && dot(a.direction, b.direction) == 0. &&
             is_same_or_ground(a.from, b.from) && is_same_or_ground(a.to, b.to);
    }

    /// The links in the order of their rows, see Constraints: those that slide last, and before
    /// them those that turn.
    std::vector<std::size_t> in_order_of_rows(const Scene &scene)
    {
      std::vector<std::size_t> result(scene.links.size());
      std::iota(result.begin(), result.end(), 0);
      const auto place = [&](const std::size_t l) {
        return scene.links[l].moving() ? 2 : scene.links[l].turns ? 1 : 0;
      };
      std::stable_sort(result.begin(), result.end(),
                       [&](const std::size_t a, const std::size_t b)
                       { return place(a) < place(b); });
      return result;
    }
  } // namespace

  /// All rows of a ball joint have the place of the first one.
  void Simulation::write_start(const ScenePlaces &places, const std::vector<double> &heights,
                               const std::vector<double> &forces,
                               const std::vector<double> &gaps) const
  {
    TableFile file(parameters.output.folder + "/start.csv",
                   {"link", "x [m]", "y [m]", "z [m]", "force [N or N m]", "gap [m or rad]",
                    "length [m]", "stretched length [m]"});
    std::size_t placed = 0; ///< the link whose place is shown
    for (const std::size_t l : in_order_of_rows(model))
    {
      const Link &link = model.links[l];
      if (!are_one_ball_joint(model.links[placed], link))
        placed = l;
      const Coordinates &at = model.links[placed].to.kind == Attachment::Kind::ground
                                  ? places.links[placed].front()
                                  : places.links[placed].back();
      file << link.name << at.x << at.y << at.z << forces[l] << gaps[l];
      // A force makes droppers longer, other links shorter.
      const double elongation = link.elongation(forces[l]);
      // A rope is inclined: its ends come apart by more than it stretches.
      if (link.form.pull > 0.)
        file << link.unstressed_length << link.length;
      else if (link.unstressed_length > 0.)
        file << link.unstressed_length
             << link.unstressed_length +
                    (link.kind == LinkKind::dropper ? elongation : -elongation);
      else
        file << std::string() << std::string();
      file.end_line();
    }
    file.close();
    write_droppers(places, heights);
  }

  /// The table for who makes and mounts the droppers between wires.
  void Simulation::write_droppers(const ScenePlaces &places,
                                  const std::vector<double> &heights) const
  {
    if (std::none_of(model.links.begin(), model.links.end(), is_dropper_between_wires))
      return;
    std::vector<double> masts;
    for (const Support &support : model.supports)
      if (support.motion == WireMotion::transverse)
        for (const double s : support.positions)
          masts.push_back(model.wires[support.wire].at(s).x);
    std::sort(masts.begin(), masts.end());
    TableFile file(parameters.output.folder + "/droppers.csv",
                   {"dropper", "upper wire", "lower wire", "x [m]", "from the support before [m]",
                    "height of the lower end [m]", "cut length [m]", "static force [N]",
                    "length as built [m]"});
    for (const std::size_t l : in_order_of_rows(model))
    {
      const Link &link = model.links[l];
      if (!is_dropper_between_wires(link))
        continue;
      const Coordinates &at = places.links[l].back();
      const auto next = std::upper_bound(masts.begin(), masts.end(), at.x);
      file << link.name << model.wires[link.from.index].name << model.wires[link.to.index].name
           << at.x << (next == masts.begin() ? 0. : at.x - *(next - 1)) << at.y + heights[l]
           << link.unstressed_length << forces_at_rest.at(link.name) << link.length;
      file.end_line();
    }
    file.close();
  }
} // namespace taut
