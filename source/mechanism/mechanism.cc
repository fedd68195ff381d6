// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mechanism/mechanism.h"
#include "base/groups.h"
#include "base/text.h"
#include "mechanism/coordinate_matrix.h"
#include "scene/travel.h"
#include "substructure/motion_rate.h"
#include <taut/base/exceptions.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// The first member, if all members are masses of the scene.
    const Mass &first_of(const Scene &scene, const std::vector<std::size_t> &members)
    {
      if (members.empty())
        throw UserError("a mechanism has no mass; name at least one");
      for (const std::size_t m : members)
        if (m >= scene.masses.size())
          throw UserError("a mechanism has mass number " + std::to_string(m) +
                          ", and the scene has " + std::to_string(scene.masses.size()) +
                          ", counted from 0");
      return scene.masses[members.front()];
    }
  } // namespace

  Mechanism::Mechanism(const Scene &scene, const std::vector<std::size_t> &members)
      : Substructure(name_of(scene, members), first_of(scene, members).origin)
  {
    for (const std::size_t m : members)
      for (unsigned int motion = 0; motion < 4; ++motion)
        if (scene.masses[m].moves[motion])
          dofs.push_back(
              {m, motion, scene.masses[m].displacement[motion], scene.masses[m].velocity[motion]});
    const unsigned int n = dofs.size();
    kinds.clear();
    for (const Dof &dof : dofs)
      kinds.push_back(dof.motion == 2 ? 1 : 0);
    M = std::make_unique<CoordinateMatrix>(n);
    C = std::make_unique<CoordinateMatrix>(n);
    K = std::make_unique<CoordinateMatrix>(n);
    constant_force.assign(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      const Mass &mass = scene.masses[dofs[i].mass];
      M->add(i, i, dofs[i].motion == 2 ? mass.inertia : mass.mass);
      if (mass.weight && dofs[i].motion != 2)
        constant_force[i] += mass.mass * (dofs[i].motion == 0   ? scene.gravity.x
                                          : dofs[i].motion == 1 ? scene.gravity.y
                                                                : scene.gravity.z);
    }
    add_springs(scene);
    add_loads(scene);
    prescribe_motions(scene);
    finish();
  }

  std::string Mechanism::name_of(const Scene &scene, const std::vector<std::size_t> &members)
  {
    return first_of(scene, members).name + (members.size() > 1 ? " and others" : "");
  }

  void Mechanism::add_springs(const Scene &scene)
  {
    LinearForm row, other;
    for (const Spring &spring : scene.springs)
    {
      row = {};
      for (const std::size_t end : {spring.from, spring.to})
        if (end != ground)
        {
          motion(end, spring.rotational, spring.direction, other);
          for (std::size_t k = 0; k < other.index.size(); ++k)
            row.add(other.index[k], (end == spring.to ? 1. : -1.) * other.value[k]);
        }
      for (std::size_t i = 0; i < row.index.size(); ++i)
        for (std::size_t j = 0; j <= i; ++j)
        {
          const double product = row.value[i] * row.value[j];
          K->add(row.index[i], row.index[j], spring.stiffness * product);
          C->add(row.index[i], row.index[j], spring.damping * product);
        }
    }
  }

  void Mechanism::add_loads(const Scene &scene)
  {
    for (const Load &load : scene.loads)
    {
      if (load.target.kind != Attachment::Kind::mass)
        continue;
      LinearForm row;
      motion(load.target.index, load.rotational, load.direction, row, load.target.place);
      if (row.index.empty())
        continue;
      if (load.magnitude.depends_on_time())
        time_loads.push_back(std::make_unique<PointLoad>(row, [f = load.magnitude](const double t)
                                                         { return f(0., t); }));
      else
        row.add_to(load.magnitude(0., 0.), constant_force);
    }
  }

  void Mechanism::prescribe_motions(const Scene &scene)
  {
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const Mass &mass = scene.masses[dofs[i].mass];
      if (!mass.is_prescribed[dofs[i].motion])
        continue;
      const Expression &u = mass.prescribed[dofs[i].motion];
      constrained.push_back({i});
      if (u.is_constant())
        constrained.back().displacement = u(0., 0.);
      else
        constrained.back().motion = [u, mass](const double t)
        { return u(mass.position.x + way(mass, t), t); };
      check_start(mass, dofs[i], constrained.back());
    }
  }

  /// A given start of a prescribed motion has to be that of the motion.
  void Mechanism::check_start(const Mass &mass, const Dof &dof, const ConstrainedDof &prescribed)
  {
    // For numbers with five digits; the length of a step, for differences.
    constexpr double digits = 1e-5, step = 1e-3;
    constexpr const char *names[] = {"x", "y", "rotation", "z"};
    const std::string name = names[dof.motion];
    const auto check =
        [&](const double given, const double right, const char *const entry, const char *const unit)
    {
      if (given == 0. || std::fabs(given - right) <= digits * std::fabs(right))
        return;
      throw EntryError(mass.origin + "/" + entry,
                       to_text("mass '", mass.name, "': the ", name, " of its start is ", given,
                               unit, ", and its Prescribed ", name, " has ", right, unit,
                               " at t = 0. Set it to that or to 0"));
    };
    const bool turns = dof.motion == 2;
    check(dof.displacement, prescribed.at(0.), "Initial displacement", turns ? " rad" : " m");
    check(dof.velocity,
          prescribed.motion && dof.velocity != 0. ? rate_of_motion(prescribed.motion, 0., step)
                                                  : 0.,
          "Initial velocity", turns ? " rad/s" : " m/s");
  }

  void Mechanism::motion(const std::size_t mass, const bool rotational,
                         const Coordinates &direction, LinearForm &result,
                         const Coordinates &arm) const
  {
    result = {};
    const double factor[4] = {rotational ? 0. : direction.x, rotational ? 0. : direction.y,
                              rotational ? direction.z : arm.x * direction.y - arm.y * direction.x,
                              rotational ? 0. : direction.z};
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (dofs[i].mass == mass && factor[dofs[i].motion] != 0.)
        result.add(i, factor[dofs[i].motion]);
  }

  LinearForm Mechanism::displacement(const Coordinates &place, const Coordinates &direction) const
  {
    std::vector<std::size_t> masses;
    for (const Dof &dof : dofs)
      if (masses.empty() || masses.back() != dof.mass)
        masses.push_back(dof.mass);
    if (!(place[0] >= 0.) || !(place[0] < masses.size()))
      throw UserError("body '" + name() + "' has " + std::to_string(masses.size()) +
                      " masses, counted from 0, and a constraint is to act on number " +
                      std::to_string(place[0]));
    LinearForm form;
    motion(masses[static_cast<std::size_t>(place[0])], false, direction, form);
    return form;
  }

  void Mechanism::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    U.clear();
    V.clear();
    for (const Dof &dof : dofs)
    {
      U.push_back(dof.displacement);
      V.push_back(dof.velocity);
    }
  }

  Substructure::NullSpace Mechanism::null_space() const
  {
    // Eigenvectors to the eigenvalue zero of the stiffness scaled to a unit diagonal; a DoF without
    // stiffness is such an eigenvector.
    const int n = dofs.size();
    std::vector<double> a(n * n, 0.), scale(n, 1.), eigenvalues(n), work(8 * n + 64);
    K->visit([&](unsigned int i, unsigned int j, double value)
             { a[i * n + j] = a[j * n + i] = value; });
    for (const ConstrainedDof &held : constrained)
    {
      for (int i = 0; i < n; ++i)
        a[i * n + held.dof] = a[held.dof * n + i] = 0.;
      a[held.dof * (n + 1)] = 1.;
    }
    for (int i = 0; i < n; ++i)
      if (a[i * n + i] > 0.)
        scale[i] = 1. / std::sqrt(a[i * n + i]);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        a[i * n + j] *= scale[i] * scale[j];
    const int lwork = work.size();
    int info = 0;
    dealii::syev("V", "L", &n, a.data(), &n, eigenvalues.data(), work.data(), &lwork, &info);
    if (info != 0)
      throw std::runtime_error("LAPACK dsyev failed on the stiffness of " + name());

    NullSpace null_space;
    std::vector<std::vector<double>> reduced;
    for (int k = 0; k < n && eigenvalues[k] < 1e-13 * n; ++k)
    {
      std::vector<double> R(n);
      for (int i = 0; i < n; ++i)
        R[i] = scale[i] * a[k * n + i];
      null_space.vectors.push_back(R);
      // Gaussian elimination with the largest entry as pivot gives independent DoFs to hold.
      for (std::size_t p = 0; p < reduced.size(); ++p)
      {
        const unsigned int pivot = null_space.fixing_dofs[p];
        const double factor = R[pivot] / reduced[p][pivot];
        for (int i = 0; i < n; ++i)
          R[i] -= factor * reduced[p][i];
      }
      const auto largest = std::max_element(
          R.begin(), R.end(), [](double p, double q) { return std::fabs(p) < std::fabs(q); });
      null_space.fixing_dofs.push_back(largest - R.begin());
      reduced.push_back(std::move(R));
    }
    return null_space;
  }

  std::vector<std::vector<std::size_t>> connected_masses(const Scene &scene)
  {
    Groups groups(scene.masses.size());
    for (const Spring &spring : scene.springs)
      if (spring.from != ground && spring.to != ground)
        groups.join(spring.from, spring.to);
    return groups.members();
  }
} // namespace taut
