// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "interface/check_constraint.h"
#include <taut/base/exceptions.h>
#include <taut/interface/system.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    void check_finite(const Structure &bodies, const std::size_t k, const Coordinates &x,
                      const std::string &what)
    {
      if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
        throw UserError("body '" + bodies[k].name() + "': " + what +
                        to_text(" (", x, ") m is not finite"));
    }
  } // namespace

  Constraint::Constraint(const std::string &name, const bool unilateral, const Displacement &a,
                         const Displacement &b)
  {
    data.name = name;
    data.cone = Cone::unilateral_if(unilateral);
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
    if (!place)
      throw UserError("constraint '" + name + "' moves, and has no place; hand one over");
    Constraint result(name, true, {}, {});
    result.data.geometry = std::move(place);
    return result;
  }

  Constraint Constraint::turning(const std::string &name, const bool unilateral, const double push,
                                 std::vector<LinkEnd> places, const double length)
  {
    if (places.size() < 2)
      throw UserError(to_text("constraint '", name, "' runs from place to place, and has ",
                              places.size(), " of them; give two or more"));
    auto direction = std::make_shared<TurningDirection>(std::move(places), push);
    for (std::size_t k = 0; k < direction->size(); ++k)
      if (!(norm(direction->start[k]) > 0.))
        throw UserError("constraint '" + name + "' turns, and " +
                        (direction->size() > 1 ? "two of its places are" : "its ends start at") +
                        " one place, " + to_text('(', direction->places[k].position, ") m") +
                        ": it has no direction. Move one of them, or take a bilateral constraint "
                        "along each axis");
    if (!(length > 0.))
      throw UserError("constraint '" + name + "' needs a positive length, not " +
                      std::to_string(length) + " m");
    direction->length = length;
    Constraint result(name, unilateral, {}, {});
    result.data.geometry = std::move(direction);
    return result;
  }

  Constraint Constraint::rope(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                              const double length)
  {
    return turning(name, true, -1., {a, b}, length);
  }

  Constraint Constraint::rope(const std::string &name, const std::vector<LinkEnd> &places,
                              const double length)
  {
    return turning(name, true, -1., places, length);
  }

  Constraint Constraint::prop(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                              const double length)
  {
    return turning(name, true, 1., {a, b}, length);
  }

  Constraint Constraint::rod(const std::string &name, const LinkEnd &a, const LinkEnd &b,
                             const double length)
  {
    return turning(name, false, 1., {a, b}, length);
  }

  Constraint &Constraint::gap(const double value)
  {
    if (data.geometry)
      throw UserError("constraint '" + data.name +
                      "': the gap of a rope, prop or rod follows from its length; change that");
    data.gap = value;
    return *this;
  }

  Constraint &Constraint::stiffness(const double value)
  {
    data.spring.stiffness = value;
    return *this;
  }

  Constraint &Constraint::law(std::shared_ptr<const ForceLaw> value)
  {
    if (data.cone.is_free())
      throw UserError("constraint '" + data.name +
                      "': a law is for a unilateral constraint; give this one a stiffness");
    if (!value)
      throw UserError("constraint '" + data.name +
                      "': it has no law; hand one over, or none at all");
    data.spring.stiffness = value->largest_stiffness();
    data.spring.law = std::move(value);
    return *this;
  }

  Constraint &Constraint::damping(const double value)
  {
    data.spring.damping = value;
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
    if (owner >= load.size())
      throw UserError("body '" + name + "': its owner is rank " + std::to_string(owner) +
                      ", and there are " + std::to_string(load.size()) + ", counted from 0");
    index.push_back(bodies.add(name, owner, make));
    load[owner] += bodies.all_bodies().back().n_dofs;
    return index.size() - 1;
  }

  Displacement System::displacement(const std::size_t body, const Coordinates &place,
                                    const Coordinates &direction) const
  {
    Displacement result;
    const std::size_t k = index_here(body);
    communicator().agree(
        [&]
        {
          if (k == Structure::elsewhere)
            return;
          check_finite(bodies, k, place, "the place");
          check_finite(bodies, k, direction, "the direction");
          result.push_back({k, bodies[k].displacement(place, direction), &bodies[k]});
          const std::string fault = fault_of(result, bodies);
          if (!fault.empty())
            throw UserError("the form that displacement() gives for " +
                            to_text('(', place, ") m ") + fault);
        });
    return result;
  }

  LinkEnd System::link_end(const std::size_t body, const Coordinates &place) const
  {
    double position[] = {0., 0., 0.};
    const std::size_t k = index_here(body);
    communicator().agree(
        [&]
        {
          if (k == Structure::elsewhere)
            return;
          const Coordinates own = bodies[k].position(place);
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
    const ConstraintData &data = constraint.constraint();
    communicator().agree([&] { check_constraint(data, bodies); });
    if (!communicator().any(acts_here(data)))
      throw UserError("constraint '" + data.name +
                      "': it acts on no body, as its displacements are empty or zero; take the "
                      "displacement() of a place that moves along the direction");
    list.push_back(data);
    list.back().link = list.size() - 1;
    return list.size() - 1;
  }

  const Substructure *System::body(const std::size_t number) const
  {
    const std::size_t k = index_here(number);
    return k == Structure::elsewhere ? nullptr : &bodies[k];
  }

  std::size_t System::index_here(const std::size_t body) const
  {
    if (body >= index.size())
      throw UserError("there is no body number " + std::to_string(body) + "; the system has " +
                      std::to_string(index.size()) + ", counted from 0");
    return index[body];
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
