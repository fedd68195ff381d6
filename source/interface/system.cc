// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/interface/system.h>

#include <algorithm>

namespace taut
{
  Constraint::Constraint(const std::string &name, const bool unilateral, const Displacement &a,
                         const Displacement &b)
  {
    data.name = name;
    data.unilateral = unilateral;
    data.terms = a;
    for (Term term : b)
    {
      for (double &value : term.form.value)
        value = -value;
      data.terms.push_back(std::move(term));
    }
  }

  Constraint Constraint::unilateral(const std::string &name, const Displacement &a,
                                    const Displacement &b)
  {
    return Constraint(name, true, a, b);
  }

  Constraint Constraint::bilateral(const std::string &name, const Displacement &a,
                                   const Displacement &b)
  {
    return Constraint(name, false, a, b);
  }

  Constraint Constraint::unilateral(const std::string &name, std::shared_ptr<MovingPlace> place)
  {
    Constraint result(name, true, {}, {});
    result.data.place = std::move(place);
    return result;
  }

  Constraint Constraint::turning(const std::string &name, const bool unilateral, const double push,
                                 const LinkEnd &a, const LinkEnd &b, const double length)
  {
    auto direction = std::make_shared<TurningDirection>(a, b, push);
    if (!(direction->length > 0.))
      throw UserError("constraint '" + name + "' turns, and its ends start at one place, " +
                      text_of(a.position) + ": it has no direction. Move one of them, or take a " +
                      "bilateral constraint along each axis");
    if (!(length > 0.))
      throw UserError("constraint '" + name + "' needs a positive length, not " +
                      std::to_string(length) + " m");
    direction->length = length;
    Constraint result(name, unilateral, {}, {});
    result.data.direction = std::move(direction);
    return result;
  }

  Constraint Constraint::rope(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                              const double length)
  {
    return turning(name, true, -1., a, b, length);
  }

  Constraint Constraint::prop(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                              const double length)
  {
    return turning(name, true, 1., a, b, length);
  }

  Constraint Constraint::rod(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                             const double length)
  {
    return turning(name, false, 1., a, b, length);
  }

  Constraint &Constraint::gap(const double value)
  {
    if (data.direction)
      throw UserError("constraint '" + data.name +
                      "': the gap of a rope, prop or rod follows from its length; change that");
    data.gap = value;
    return *this;
  }

  Constraint &Constraint::stiffness(const double value)
  {
    data.stiffness = value;
    return *this;
  }

  Constraint &Constraint::law(std::shared_ptr<const ForceLaw> value)
  {
    if (!data.unilateral)
      throw UserError("constraint '" + data.name +
                      "': a law is for a unilateral constraint; give this one a stiffness");
    data.stiffness = value->largest_stiffness();
    data.law = std::move(value);
    return *this;
  }

  Constraint &Constraint::damping(const double value)
  {
    data.damping = value;
    return *this;
  }

  System::System(const Communicator &processes) : bodies(processes), load(processes.size(), 0) {}

  std::size_t System::add(const std::string &name, const Structure::Factory &make)
  {
    return add(name, std::min_element(load.begin(), load.end()) - load.begin(), make);
  }

  std::size_t System::add(const std::string &name, const unsigned int owner,
                          const Structure::Factory &make)
  {
    index.push_back(bodies.add(name, owner, make));
    load[owner] += bodies.all_bodies().back().n_dofs;
    return index.size() - 1;
  }

  Displacement System::displacement(const std::size_t body, const Coordinates &place,
                                    const Coordinates &direction) const
  {
    Displacement result;
    communicator().agree(
        [&]
        {
          if (index[body] != Structure::elsewhere)
            result.push_back({index[body], bodies[index[body]].displacement(place, direction)});
        });
    return result;
  }

  LinkEnd System::link_end(const std::size_t body, const Coordinates &place) const
  {
    double position[] = {0., 0., 0.};
    communicator().agree(
        [&]
        {
          if (index[body] == Structure::elsewhere)
            return;
          const Coordinates own = bodies[index[body]].position(place);
          for (unsigned int c = 0; c < 3; ++c)
            position[c] = own[c];
        });
    communicator().sum(position, 3);
    return link_end(body, place, {position[0], position[1], position[2]});
  }

  LinkEnd System::link_end(const std::size_t body, const Coordinates &place,
                           const Coordinates &position) const
  {
    return {position,
            {displacement(body, place, {1., 0., 0.}), displacement(body, place, {0., 1., 0.}),
             displacement(body, place, {0., 0., 1.})}};
  }

  std::size_t System::add(const Constraint &constraint)
  {
    list.push_back(constraint.constraint());
    list.back().link = list.size() - 1;
    return list.size() - 1;
  }

  const Substructure *System::body(const std::size_t number) const
  {
    return index[number] == Structure::elsewhere ? nullptr : &bodies[index[number]];
  }

  Constraints System::constraints() const
  {
    return constraints(bodies);
  }

  Constraints System::constraints(const Structure &structure) const
  {
    return Constraints(structure, list);
  }
} // namespace taut
