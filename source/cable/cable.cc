// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/end_frames.h"

#include "base/about_entry.h"
#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut
{
  namespace
  {
    std::string entry(const CableData &data, const std::string &name)
    {
      return data.origin.empty() ? name : data.origin + "/" + name;
    }
    /// Largest distance of a held end from its place at the start, over the length, and largest
    /// deviation of a clamped end from its direction [1].
    constexpr double same_start = 1e-5;

    /// Throws EntryError if the straight start of a cable does not fit its held and clamped ends.
    void check_start(const CableData &data, const CableElements &element, const CableShape &found)
    {
      const Coordinates along =
          add_scaled({}, 1. / norm(data.start_direction), data.start_direction);
      const double off = norm(data.to - add_scaled(data.from, data.length, along));
      if (data.holds_to && off > same_start * data.length)
        throw EntryError(entry(data, "Held ends"),
                         "it holds the last end at To, but the straight cable of Start direction "
                         "ends " +
                             to_text(off) + " m from there; set from or none, or another To");
      for (const bool last : {false, true})
      {
        if (!data.clamped || !(last ? data.holds_to : data.holds_from))
          continue;
        Coordinates kept = element.tangent(found.positions, last ? data.length : 0.);
        kept = add_scaled({}, 1. / norm(kept), kept);
        if (norm(kept - along) > same_start)
          throw EntryError(entry(data, "Clamped"),
                           "it keeps the direction (" + to_text(kept) +
                               ") of the shape at rest, which Start direction is not; set it to "
                               "false, or Start direction to that");
      }
    }
  } // namespace

  Coordinates force_per_length(const CableData &data)
  {
    return add_scaled(data.force, data.section.mass_per_length, data.gravity);
  }

  Cable::Cable(const CableData &given)
      : Substructure(given.name, given.origin), data(given),
        element(make_elements(given, given.length)), frames(std::make_unique<EndFrames>())
  {
    check();
    find();
    hold();
    assemble();
    finish();
  }

  /// A cable with known elements and shape.
  Cable::Cable(const CableData &given, const CableElements &elements, const CableShape &shape)
      : Substructure(given.name, given.origin), data(given), element(elements), found(shape),
        frames(std::make_unique<EndFrames>())
  {
    hold();
    assemble();
    finish();
  }

  Cable::~Cable() = default;

  std::unique_ptr<Substructure> Cable::with_axial_stiffness(const double EA) const
  {
    CableData other = data;
    other.section.axial_stiffness = EA;
    std::unique_ptr<Cable> result(new Cable(other, element.with_axial_stiffness(EA), found));
    result->constant_force = constant_force;
    result->time_loads = time_loads;
    return result;
  }

  bool Cable::is_slack(const std::vector<double> &U, Slack &slack) const
  {
    if (is_linear())
      return false;
    double place = 0.;
    set_positions(U, work);
    const double strain = element.smallest_strain(work, &place);
    if (!(strain * data.section.axial_stiffness < -rounding_of_force(0)))
      return false;
    slack.place = place;
    slack.bending_stiffness = data.section.bending_stiffness;
    slack.axial_damping = data.section.axial_damping;
    for (unsigned int i = 0; i + 1 < piece_ends.size(); ++i)
      slack.is_straight = slack.is_straight || (pushes(work, i) && is_straight(work, i));
    slack.disturbance = data.disturbance * data.length;
    return true;
  }

  Substructure::NullSpace Cable::null_space() const
  {
    NullSpace result;
    if (data.holds_from || data.holds_to)
      return result;
    const bool has_slopes = data.element == CableElement::ancf;
    const std::vector<unsigned int> unused = element.unused_dofs();
    for (unsigned int c = 0; c < 3; ++c)
    {
      std::vector<double> translation(n_dofs(), 0.);
      for (unsigned int i = c; i < n_dofs(); i += has_slopes ? 6 : 3)
        translation[i] = 1.;
      for (const unsigned int i : unused)
        translation[i] = 0.;
      result.vectors.push_back(std::move(translation));
      result.fixing_dofs.push_back(element.end_dofs(false)[c]);
    }
    return result;
  }

  void Cable::check() const
  {
    const auto require = [&](const bool holds, const std::string &name, const std::string &message)
    {
      if (!holds)
        throw EntryError(entry(data, name), message);
    };
    require(data.length > 0., "Unstressed length", "a cable needs a positive one [m]");
    require(data.section.axial_stiffness > 0., "Axial stiffness",
            "a cable needs a positive one [N]");
    require(data.section.bending_stiffness >= 0., "Bending stiffness", "it is negative");
    require(data.section.mass_per_length >= 0., "Mass per length", "it is negative");
    require(data.section.axial_damping >= 0., "Axial damping", "it is negative");
    require(data.n_elements > 0, "Elements", "a cable needs one at least");
    require(data.element == CableElement::ancf || data.section.bending_stiffness == 0.,
            "Bending stiffness", "bars have none; take Element = ANCF, or zero");
    require(data.element == CableElement::ancf || !data.clamped, "Clamped",
            "bars have no direction at their ends; take Element = ANCF");
    require(!data.clamped || data.holds_from || data.holds_to, "Clamped",
            "it is of held ends, and Held ends = none; hold one, or set it to false");
    require(!data.starts_straight || norm(data.start_direction) > 0., "Start direction",
            "it has no length");
    require(data.disturbance >= 0., "Disturbance", "it is negative");
  }

  /// Of a cable that one end holds: that end, or the upper one if links will hold it.
  bool Cable::hangs_from_last() const
  {
    return data.holds_to ||
           (!data.holds_from && dot(data.to - data.from, force_per_length(data)) < 0.);
  }

  /// True if one end is free, and below the other one by less than the length of the cable. Between
  /// these places the cable would fold. Its shape is that with the lower end free.
  bool Cable::hangs_freely() const
  {
    const Coordinates load = force_per_length(data);
    if ((data.holds_from && data.holds_to) || data.geometry == CableGeometry::linear ||
        !(norm(load) > 0.))
      return false;
    const Coordinates down = add_scaled({}, 1. / norm(load), load),
                      chord = hangs_from_last() ? data.from - data.to : data.to - data.from;
    const double below = dot(chord, down), beside = norm(add_scaled(chord, -below, down));
    return below >= 0. && below <= hanging_length(element, load) &&
           beside <= above_each_other * data.length;
  }

  void Cable::find()
  {
    const Coordinates to = data.to - data.from, load = force_per_length(data);
    about_entry(origin(),
                [&]
                {
                  const bool from_last = hangs_from_last();
                  found = hangs_freely() ? hang_freely(element, from_last ? to : Coordinates(),
                                                       from_last, load)
                                         : hang(element, {}, to, load);
                });
    check_at_rest(std::vector<double>(element.n_dofs(), 0.));
    if (data.starts_straight)
      check_start(data, element, found);
  }

  void Cable::assemble()
  {
    if (data.element == CableElement::ancf)
      kinds = {0, 0, 0, 1, 1, 1};
    const auto zero = [&]
    { return make_block_tridiagonal(CableElements::dofs_per_node, element.n_dofs()); };
    M = zero();
    C = zero();
    K = zero();
    element.add_mass(1., *M);
    element.add_mass(data.mass_damping, *C);
    if (data.geometry == CableGeometry::linear)
      tangent_at = straight_line();
    else if (linear_at.empty())
      tangent_at = found.positions;
    element.add_tangent(tangent_at, false, *K);
    if (is_linear())
      element.add_damping(tangent_at, 1., *C);
    constant_force.assign(element.n_dofs(), 0.);
    element.add_load(force_per_length(data), constant_force);
    if (data.geometry == CableGeometry::linear)
      straighten();
    for (auto *matrix : {&M, &C, &K})
      *matrix = frames->turn(std::move(*matrix));
    frames->turn(constant_force);
  }

  void Cable::hold()
  {
    find_pieces();
    for (const unsigned int i : element.unused_dofs())
      constrained.push_back({i});
    for (const bool last : {false, true})
      if (last ? data.holds_to : data.holds_from)
      {
        const auto dofs = element.end_dofs(last);
        for (const unsigned int i : dofs)
          constrained.push_back({i});
        if (!data.clamped)
          continue;
        const unsigned int along = dofs[0] + 3; // r' along the cable; then two components across it
        frames->add(along, element.tangent(found.positions, last ? data.length : 0.));
        constrained.push_back({along + 1});
        constrained.push_back({along + 2});
      }
  }

  std::vector<double> Cable::positions(const std::vector<double> &U) const
  {
    std::vector<double> q;
    set_positions(U, q);
    return q;
  }

  void Cable::set_positions(const std::vector<double> &U, std::vector<double> &q) const
  {
    q.resize(U.size());
    const std::vector<double> *displacement = &U;
    if (!frames->empty())
    {
      q = U;
      frames->turn(q);
      displacement = &q;
    }
    for (std::size_t i = 0; i < q.size(); ++i)
      q[i] = (*displacement)[i] + found.positions[i];
  }

  LinearForm Cable::displacement(const Coordinates &place, const Coordinates &direction) const
  {
    const double length = data.length, same = 1e-12 * length;
    if (!(place.x >= -same && place.x <= length + same))
      throw UserError("cable '" + name() + "' has no place " + to_text(place.x) +
                      " m along its unstressed length, only 0 to " + to_text(length) + " m");
    return frames->turn(element.position(place.x, direction));
  }

  LinearForm Cable::slope(const double place, const Coordinates &direction) const
  {
    return frames->turn(element.tangent(std::clamp(place, 0., data.length), direction));
  }

  Coordinates Cable::position(const Coordinates &place) const
  {
    const double s = std::clamp(place.x, 0., data.length);
    return add_scaled(data.from, 1., element.position(found.positions, s));
  }

  double Cable::strain_energy(const std::vector<double> &U) const
  {
    if (!is_linear())
    {
      set_positions(U, work);
      return element.strain_energy(work);
    }
    if (!is_linearised())
      return Substructure::strain_energy(U);
    set_way(U);
    return energy_there + std::inner_product(work.begin(), work.end(), force_there.begin(), 0.) +
           Substructure::strain_energy(work);
  }

  void Cable::internal_force(const std::vector<double> &U, const std::vector<double> &V,
                             std::vector<double> &f) const
  {
    if (is_linearised())
    {
      set_way(U);
      f = force_there;
      return K->vmult_add(1., work.data(), f.data());
    }
    if (is_linear())
      return Substructure::internal_force(U, V, f);
    work_0 = V;
    if (!V.empty())
      frames->turn(work_0);
    set_positions(U, work);
    element.internal_force(work, work_0, f);
    frames->turn(f);
  }

  /// Positions round with the length of the cable, strains with positions over elements.
  double Cable::rounding_of_force(const unsigned int kind) const
  {
    if (is_linear())
      return 0.;
    constexpr double operations = 8.;
    const double h = element.shortest_element(),
                 stiffness =
                     data.section.axial_stiffness + data.section.bending_stiffness / (h * h);
    return operations * std::numeric_limits<double>::epsilon() * stiffness *
           (1. + data.length / h) * (kind == 0 ? 1. : h);
  }

  void Cable::mean_internal_force(const std::vector<double> &U0, const std::vector<double> &U1,
                                  const double step, std::vector<double> &f) const
  {
    if (is_linearised())
    {
      work_0 = U0;
      for (std::size_t i = 0; i < work_0.size(); ++i)
        work_0[i] = .5 * (U0[i] + U1[i]);
      return internal_force(work_0, {}, f);
    }
    if (is_linear())
      return Substructure::mean_internal_force(U0, U1, step, f);
    set_positions(U0, work_0);
    set_positions(U1, work);
    element.mean_force(work_0, work, step, f);
    frames->turn(f);
  }

  std::unique_ptr<SymmetricMatrix> Cable::zero_matrix() const
  {
    if (!spare)
      return make_block_tridiagonal(CableElements::dofs_per_node, element.n_dofs());
    spare->set_zero();
    return std::move(spare);
  }

  std::unique_ptr<SymmetricMatrix> Cable::tangent(const std::vector<double> &U,
                                                  const std::vector<double> &V, const double rate,
                                                  const bool definite) const
  {
    if (is_linear())
      return Substructure::tangent(U, V, rate, definite);
    std::unique_ptr<SymmetricMatrix> A = zero_matrix();
    set_positions(U, work);
    element.add_tangent(work, definite, *A);
    element.add_damping(work, rate, *A);
    return frames->turn(std::move(A));
  }

  std::unique_ptr<SymmetricMatrix> Cable::mean_tangent(const std::vector<double> &U0,
                                                       const std::vector<double> &U1,
                                                       const double rate, const bool definite) const
  {
    if (is_linear())
      return Substructure::mean_tangent(U0, U1, rate, definite);
    std::unique_ptr<SymmetricMatrix> A = zero_matrix();
    set_positions(U0, work_0);
    set_positions(U1, work);
    element.add_mean_tangent(work_0, work, definite, *A);
    for (std::size_t i = 0; i < work.size(); ++i)
      work[i] = .5 * (work_0[i] + work[i]);
    element.add_damping(work, rate, *A);
    return frames->turn(std::move(A));
  }

  LinearForm Cable::node_displacement(const unsigned int node, const Coordinates &direction) const
  {
    return displacement({element.place(node)}, direction);
  }

  void Cable::initial_state(std::vector<double> &U, std::vector<double> &V) const
  {
    Substructure::initial_state(U, V);
    if (!data.starts_straight)
      return;
    const Coordinates along = add_scaled({}, 1. / norm(data.start_direction), data.start_direction);
    U = element.interpolate([&](const double s) { return add_scaled({}, s, along); },
                            [&](double) { return along; });
    for (std::size_t i = 0; i < U.size(); ++i)
      U[i] -= found.positions[i];
    frames->turn(U);
  }
} // namespace taut
