// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cable/end_frames.h"

#include "base/text.h"
#include <taut/base/exceptions.h>
#include <taut/cable/cable.h>

#include <algorithm>
#include <string>
#include <utility>

namespace taut
{
  namespace
  {
    [[noreturn]] void refuse(const std::string &origin, const std::string &reason)
    {
      throw EntryError(origin.empty() ? "Geometry" : origin + "/Geometry", reason);
    }
  } // namespace

  /// A cable that is linearised, with the tangent at a displacement.
  Cable::Cable(const Cable &nonlinear, const std::vector<double> &U)
      : Substructure(nonlinear.name(), nonlinear.origin()), data(nonlinear.data),
        element(nonlinear.element), found(nonlinear.found), linear_at(U),
        frames(std::make_unique<EndFrames>())
  {
    hold();
    set_positions(U, tangent_at);
    if (element.smallest_strain(tangent_at) <= 0.)
      refuse(origin(), "at rest the cable is slack somewhere, and has no small motions there; take "
                       "nonlinear, or a shorter cable");
    nonlinear.internal_force(U, {}, force_there);
    energy_there = nonlinear.strain_energy(U);
    assemble();
    constant_force = nonlinear.constant_force;
    time_loads = nonlinear.time_loads;
    finish();
  }

  std::shared_ptr<Substructure> Cable::linearised(const std::vector<double> &U) const
  {
    if (!is_to_be_linearised())
      return nullptr;
    return std::shared_ptr<Substructure>(new Cable(*this, U));
  }

  /// The displacement from the state at which the cable is linearised.
  void Cable::set_way(const std::vector<double> &U) const
  {
    work = U;
    for (std::size_t i = 0; i < work.size(); ++i)
      work[i] -= linear_at[i];
  }

  /// Positions with the tension T0.
  const std::vector<double> &Cable::linear_from() const
  {
    return is_linearised() ? tangent_at : found.positions;
  }

  /// Reduces the load to the part that the found shape does not balance.
  void Cable::straighten()
  {
    std::vector<double> f, load(element.n_dofs(), 0.);
    element.internal_force(found.positions, {}, f);
    for (const bool last : {false, true})
      for (const unsigned int i : element.end_dofs(last))
        load[i] = constant_force[i] - f[i];
    constant_force = load;
  }

  /// Positions along the chord, stretched so that the tangent across the chord has the stiffness of
  /// the string: N / |r'| = T (length / chord) per unstressed length, with N = EA (|r'| - 1).
  std::vector<double> Cable::straight_line() const
  {
    const Coordinates chord = data.to - data.from;
    const double distance = norm(chord), EA = data.section.axial_stiffness;
    std::vector<double> f;
    element.internal_force(found.positions, {}, f);
    double tension = 0.;
    if (distance > 0.)
      for (const double s : {0., data.length})
        tension += .5 * (s > 0. ? 1. : -1.) / distance * element.position(s, chord).dot(f);
    const double across = tension * data.length / std::max(distance, tension * data.length / EA);
    if (!(tension > 0.) || !(across < EA))
      refuse(origin(), "at rest the cable has a tension of " + to_text(tension) +
                           " N along the line between its ends, and as a straight wire no "
                           "stiffness across it; take nonlinear, or a shorter cable");
    const Coordinates stretched = add_scaled({}, 1. / ((1. - across / EA) * distance), chord);
    return element.interpolate([&](const double s) { return add_scaled({}, s, stretched); },
                               [&](double) { return stretched; });
  }
} // namespace taut
