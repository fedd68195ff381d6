// SPDX-License-Identifier: LGPL-2.1-or-later
#include "scene/catenary.h"

#include "base/patterns.h"
#include "base/text.h"
#include "scene/entries.h"
#include "scene/travel.h"
#include <taut/base/exceptions.h>
#include <taut/scene/named_items.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  using namespace dealii::Patterns;

  void Catenary::declare_names(dealii::ParameterHandler &prm)
  {
    check_item_names(pantographs, "Catenary/Pantographs");
    prm.enter_subsection("Catenary");
    prm.add_parameter("Pantographs", pantographs,
                      "Names, separated by commas; each has a section 'Pantograph <name>'. Empty: "
                      "the line alone",
                      List(Anything()));
    tension_lengths.declare_names(prm);
    items.masses.declare_names(prm);
    prm.leave_subsection();
  }

  void Catenary::PantographItem::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Masses", masses, "From the head down [kg]", List(not_negative(), 1));
    prm.add_parameter("Stiffnesses", stiffnesses,
                      "Of the spring below each mass, the last to the base [N/m]",
                      List(not_negative(), 1));
    prm.add_parameter("Dampings", dampings, "Of the damper beside each spring [N s/m]",
                      List(not_negative(), 1));
    prm.add_parameter(
        "Lift", lift,
        "Aerodynamic force on each mass over the square of the speed, upwards; empty: "
        "none [N s^2/m^2]",
        List(Double(), 0));
    prm.add_parameter(
        "Bump stop gaps", stop_gaps,
        "Compression of the spring below each mass at which a stop pushes; 0 or empty: "
        "no stop [m]",
        List(not_negative(), 0));
    prm.add_parameter("Bump stop stiffnesses", stop_stiffnesses, "Of these stops [N/m]",
                      List(not_negative(), 0));
    prm.add_parameter(
        "Bump stop laws", stop_laws,
        "Of stops whose stiffness changes, in place of it: for each mass, with ';' between "
        "them, nothing or the force over the compression beyond the gap, as 'compression: "
        "force, ...', both increasing from 0:0, linear between points and on beyond the last "
        "[m: N]",
        Anything());
    prm.add_parameter("Static force", static_force,
                      "Upwards on the lowest mass, net of the weight [N]", Double());
    // To add an action runs it, too; later it runs for entries of the file alone.
    for (const char *const entry : {"Masses", "Stiffnesses", "Dampings", "Static force"})
      prm.add_action(entry, [this, entry](const std::string &) { given.insert(entry); });
    given.clear();
    prm.add_parameter("Base motion", base_motion,
                      "Of the roof that the lowest spring stands on, upwards: a formula in t, and "
                      "in s, the x of the pantograph; empty: it stands still [m]",
                      Anything());
    prm.add_parameter("Start", start, "x at t = 0 [m]", Double());
    prm.add_parameter("Speed", speed, "A number, or a formula in t [km/h]", Anything());
    prm.add_parameter("Strip distance", strip_distance,
                      "Between two collector strips on a head that pitches; 0: one strip [m]",
                      not_negative());
    prm.add_parameter("Head inertia", head_inertia,
                      "Moment of inertia of a head with two strips about its centre [kg m^2]",
                      not_negative());
    prm.add_parameter("Pitch stiffness", pitch_stiffness, "Of such a head [N m/rad]",
                      not_negative());
    prm.add_parameter("Pitch damping", pitch_damping, "Of such a head [N m s/rad]", not_negative());
    prm.add_parameter(
        "Faster than waves", faster_than_waves,
        "Lets it run at least as fast as the waves of the contact wire, which is an error "
        "otherwise");
    prm.add_parameter("Contact stiffness", contact_stiffness,
                      "Between head and contact wire; a number or 'rigid' [N/m]", Anything());
    prm.add_parameter("Contact damping", contact_damping, "Beside the stiffness [N s/m]",
                      not_negative());
    prm.add_parameter("Height profile", profile,
                      "Irregularity of the contact wire, a formula in s (= x) [m]", Anything());
  }

  void Catenary::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Catenary");
    prm.add_parameter("Kind", kind,
                      "'catenary': a contact wire on droppers under a messenger wire. 'conductor "
                      "rail': a contact wire alone, a beam on the springs of its arms",
                      Selection("catenary|conductor rail"));
    prm.add_parameter("Lateral component", items.lateral,
                      "Motion along z, also where neither Stagger nor Wind asks for it");
    prm.add_parameter(
        "Curvature", items.curvature,
        "Of the track, 1 / R, positive for a centre on the side of z > 0: a number, a "
        "formula in s (= x), or 'table(FILE.csv, column, s)'. Places are those along "
        "the track and beside it; wires run on chords between the masts and pull "
        "their arms. A conductor rail follows the track [1/m]",
        Anything());
    prm.add_parameter("Cant", items.cant,
                      "Angle of the track across, cant over gauge, positive towards z > 0: as "
                      "Curvature. Strips of pantographs are turned by it about the axis of the "
                      "track at the height of the contact wire [rad]",
                      Anything());
    prm.add_parameter("Contact wires", items.n_contact_wires,
                      "2: twin contact wires side by side, each as section Contact wire says",
                      Integer(1, 2));
    prm.add_parameter(
        "Twin droppers", twin_droppers,
        "'both': at each place a dropper to each of twin contact wires; 'in turn': to "
        "one and the other in turn",
        Selection("both|in turn"));
    items.contact.declare(prm, "Contact wire", true);
    items.messenger.declare(prm, "Messenger wire", true);
    items.stitch.declare(prm, "Stitch wires", false);
    items.supports.declare(prm);
    items.droppers.declare(prm);
    items.mid_point.declare(prm);
    items.masses.declare_parameters(prm);
    if (tension_lengths.names.empty())
      geometry.declare(prm);
    else
      tension_lengths.declare_parameters(prm);

    prm.add_parameter("Uplift positions", uplift_positions,
                      "x where the contact wire's motion is recorded: numbers and ranges "
                      "first:step:last; empty: all inner masts [m]",
                      Anything());
    pantograph_items.resize(pantographs.size());
    for (std::size_t i = 0; i < pantographs.size(); ++i)
    {
      enter_item(prm, "Pantograph", pantographs, i);
      pantograph_items[i].declare(prm);
      leave_item(prm);
    }
    prm.leave_subsection();
  }

  std::string Catenary::section_of(const std::size_t tension_length) const
  {
    return tension_lengths.names.empty() ? "Catenary" : tension_lengths.title(tension_length);
  }

  std::vector<LineLayout> Catenary::layouts() const
  {
    if (tension_lengths.names.empty())
      return {geometry.layout("Catenary")};
    std::vector<LineLayout> result;
    for (std::size_t i = 0; i < tension_lengths.items.size(); ++i)
      result.push_back(tension_lengths.items[i].layout(section_of(i)));
    return result;
  }

  std::vector<LineItems> Catenary::items_of_parts() const
  {
    LineItems of_line = items;
    of_line.is_rail = kind == "conductor rail";
    of_line.hangs_in_turn = twin_droppers == "in turn";
    if (tension_lengths.names.empty())
      return {of_line};
    std::vector<LineItems> result;
    for (std::size_t i = 0; i < tension_lengths.items.size(); ++i)
      result.push_back(tension_lengths.items[i].own.with(of_line, section_of(i)));
    return result;
  }

  void Catenary::add_masses(const std::string &name, const PantographItem &item, Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    const std::size_t n = item.masses.size(), first = scene.masses.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      Mass mass;
      mass.name = name + (i == 0 ? " head" : " mass " + std::to_string(i + 1));
      mass.origin = section;
      mass.position = {item.start, 0.};
      mass.mass = item.masses[i];
      mass.weight = false;
      scene.masses.push_back(mass);
      if (item.stiffnesses[i] == 0. && item.dampings[i] == 0.)
        continue;
      Spring spring;
      spring.name = name + " spring " + std::to_string(i + 1);
      spring.origin = section;
      spring.from = i + 1 < n ? first + i + 1 : ground;
      spring.to = first + i;
      spring.stiffness = item.stiffnesses[i];
      spring.damping = item.dampings[i];
      scene.springs.push_back(spring);
    }
    add_bump_stops(name, item, first, scene);
    if (!item.base_motion.empty())
      add_base(name, item, first, scene);
    const auto push = [&](const std::string &what, const std::size_t mass, const double force)
    {
      Load load;
      load.name = name + what;
      load.origin = section;
      load.target = {Attachment::Kind::mass, mass, 0.};
      load.magnitude = Expression(force);
      scene.loads.push_back(load);
    };
    push(" static force", first + n - 1, item.static_force);
    const Speed speed = speed_of(item, section);
    const double v = speed.constant;
    for (std::size_t i = 0; i < item.lift.size(); ++i)
    {
      if (item.lift[i] == 0.)
        continue;
      push(" lift " + std::to_string(i + 1), first + i, item.lift[i] * v * v);
      if (speed.travel)
        scene.loads.back().magnitude =
            Expression(to_text(std::setprecision(17), item.lift[i], "*((", item.speed, ")/3.6)^2"),
                       section + "/Speed", Expression::Variables::time);
    }
  }

  /// A node with a prescribed motion, on which spring, damper and bump stop of the lowest mass
  /// stand.
  void Catenary::add_base(const std::string &name, const PantographItem &item,
                          const std::size_t first, Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    const std::size_t lowest = first + item.masses.size() - 1, index = scene.masses.size();
    const Speed speed = speed_of(item, section);
    Mass base;
    base.name = name + " base";
    base.origin = section;
    base.position = {item.start, 0.};
    base.weight = false;
    base.is_prescribed[1] = true;
    base.prescribed[1] = Expression(item.base_motion, section + "/Base motion");
    base.speed = speed.constant;
    base.travel = speed.travel;
    scene.masses.push_back(base);
    for (Spring &spring : scene.springs)
      if (spring.to == lowest && spring.from == ground)
        spring.from = index;
    for (Link &stop : scene.links)
      if (stop.to.kind == Attachment::Kind::mass && stop.to.index == lowest &&
          stop.from.kind == Attachment::Kind::ground)
        stop.from = {Attachment::Kind::mass, index, 0.};
  }

  void Catenary::add_bump_stops(const std::string &name, const PantographItem &item,
                                const std::size_t first, Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    const auto laws = stop_laws(item, section);
    for (std::size_t i = 0; i < item.stop_gaps.size(); ++i)
    {
      if (item.stop_gaps[i] == 0.)
        continue;
      Link stop;
      stop.name = name + " bump stop " + std::to_string(i + 1);
      stop.origin = section;
      stop.kind = LinkKind::stop;
      if (i + 1 < item.masses.size())
        stop.from = {Attachment::Kind::mass, first + i + 1, 0.};
      stop.to = {Attachment::Kind::mass, first + i, 0.};
      stop.gap = item.stop_gaps[i];
      stop.law = laws[i];
      stop.stiffness = stop.law ? stop.law->largest_stiffness() : item.stop_stiffnesses[i];
      scene.links.push_back(stop);
    }
  }

  void Catenary::add_pantograph(const std::string &name, const PantographItem &item,
                                const Line &line, Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    check_lists(item, section);
    const std::size_t head = scene.masses.size();
    add_masses(name, item, scene);
    Link contact_link;
    contact_link.name = name;
    contact_link.origin = section;
    contact_link.kind = LinkKind::sliding_contact;
    contact_link.from = {Attachment::Kind::mass, head, 0.};
    contact_link.stiffness =
        parse_stiffness(item.contact_stiffness, section + "/Contact stiffness");
    contact_link.damping = item.contact_damping;
    const Speed speed = speed_of(item, section);
    contact_link.speed = speed.constant;
    contact_link.travel = speed.travel;
    contact_link.faster_than_waves = item.faster_than_waves;
    const bool has_wires = line.size() > 1 || line.front().contact_wires().size() > 1;
    if (item.strip_distance == 0.)
    {
      if (has_wires)
        contact_link.strip = name;
      add_strip(contact_link, item.profile, item.start, has_wires, line, scene);
      return;
    }
    let_head_pitch(name, item, head, scene);
    contact_link.strip = name;
    for (const int strip : {1, 2})
    {
      const double arm = (strip == 1 ? -.5 : .5) * item.strip_distance;
      contact_link.name = name + " strip " + std::to_string(strip);
      contact_link.from.place = {arm};
      add_strip(contact_link, item.profile, item.start + arm, has_wires, line, scene);
    }
  }

  /// A link of a strip at x to each contact wire. @p profile: a formula in x.
  void Catenary::add_strip(Link strip, const std::string &profile, const double x,
                           const bool has_several, const Line &line, Scene &scene) const
  {
    const std::string name = strip.name;
    for (const TensionLength &part : line)
      for (const std::size_t wire : part.contact_wires())
      {
        if (has_several)
          strip.name = name + " on " + scene.wires[wire].name;
        strip.to = {Attachment::Kind::wire, wire, x - part.begin()};
        strip.profile =
            Expression(along_wire(profile, part.begin(), true), strip.origin + "/Height profile",
                       Expression::Variables::position);
        // A rail follows its track.
        strip.cant = scene.wires[wire].has_lateral ? items.track_cant(part.begin()) : Expression();
        scene.links.push_back(strip);
      }
  }

  void Catenary::let_head_pitch(const std::string &name, const PantographItem &item,
                                const std::size_t head, Scene &scene) const
  {
    const std::string section = "Catenary/Pantograph " + name;
    if (!(item.head_inertia > 0.))
      throw EntryError(section + "/Head inertia",
                       "a head with two strips pitches; give it a moment of inertia in kg m^2");
    scene.masses[head].moves[2] = true;
    scene.masses[head].inertia = item.head_inertia;
    if (item.pitch_stiffness == 0. && item.pitch_damping == 0.)
      return;
    Spring pitch;
    pitch.name = name + " pitch spring";
    pitch.origin = section;
    pitch.to = head;
    pitch.rotational = true;
    pitch.direction = {0., 0., 1.};
    pitch.stiffness = item.pitch_stiffness;
    pitch.damping = item.pitch_damping;
    scene.springs.push_back(pitch);
  }

  void Catenary::fill(Scene &scene) const
  {
    std::vector<LineItems> of_parts = items_of_parts();
    check_wires(of_parts);
    const std::vector<LineLayout> parts = layouts();
    const bool in_space = is_in_space(of_parts);
    Line line;
    line.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      of_parts[i].is_in_space = in_space && !of_parts[i].is_rail;
      line.emplace_back(of_parts[i], parts[i],
                        tension_lengths.names.empty() ? "" : tension_lengths.names[i],
                        section_of(i), scene);
    }
    const std::vector<double> uplifts =
        parse_positions(uplift_positions, "Catenary/Uplift positions");
    check_uplift_positions(uplifts, line);
    check_point_masses(line);
    check_pantographs(line);
    check_cant(line);
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      TensionLength &part = line[i];
      part.check();
      part.add_supports();
      part.add_point_masses();
      part.add_vertical_loads();
      part.add_probes(uplifts);
      if (of_parts[i].is_in_space)
        part.add_lateral();
      if (of_parts[i].is_rail)
        continue;
      part.add_stitch_wires();
      part.add_droppers();
      part.add_mid_points();
    }
    for (std::size_t i = 0; i < pantographs.size(); ++i)
      add_pantograph(pantographs[i], pantograph_items[i], line, scene);
  }

  namespace
  {
    const Register<SceneGenerator, Catenary>
        registration("catenary", "a railway overhead line with droppers and pantographs");
  }
} // namespace taut
