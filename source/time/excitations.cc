// SPDX-License-Identifier: LGPL-2.1-or-later
#include "time/excitations.h"
#include "base/unlike_weights.h"
#include <taut/base/exceptions.h>
#include <taut/interface/geometry.h>

#include <algorithm>
#include <cmath>

namespace taut
{
  namespace
  {
    /// Prescribed DoFs of a body that are looked at: those of a face move alike, or by one formula.
    constexpr std::size_t most_dofs = 4;

    /// The sum of the forces, each with a weight of its own: opposite ones do not cancel.
    double weighted_sum(const TimeLoad &load, const double t, std::vector<double> &P)
    {
      std::fill(P.begin(), P.end(), 0.);
      load.add(t, P);
      double sum = 0.;
      UnlikeWeights weights;
      for (const double force : P)
        sum += weights.next() * force;
      return sum;
    }

    /// The sum of the sizes of the forces, but not of moments; or of all with weights from 0.4
    /// to 1.4 that grow. Both change slowly as a load moves.
    double slow_sum(const Substructure &body, const TimeLoad &load, const double t,
                    const bool of_sizes, std::vector<double> &P)
    {
      std::fill(P.begin(), P.end(), 0.);
      load.add(t, P);
      double sum = 0.;
      const auto n = static_cast<double>(P.size());
      for (unsigned int i = 0; i < P.size(); ++i)
        sum += !of_sizes ? (.4 + i / n) * P[i] : body.kind(i) == 0 ? std::fabs(P[i]) : 0.;
      return sum;
    }

    Excitation of_load(const Substructure &body, const std::shared_ptr<const TimeLoad> &load)
    {
      Excitation result{"the load on '" + body.name() + "'", body.origin(), true, false,
                        [load](const double t) { return load->sample(t); }};
      bool is_in_space = false;
      try
      {
        result.is_costly = std::isnan(load->sample(0.));
        is_in_space = !std::isnan(load->sample_at_places(0., 1));
      }
      catch (const UserError &)
      {
        // It has no value at the start, which the run says when it gets there.
      }
      if (result.is_costly)
        result.at = [load, P = std::vector<double>(body.n_dofs())](const double t) mutable
        { return weighted_sum(*load, t, P); };
      if (is_in_space)
      {
        result.at_places = [load](const double t, const std::size_t n)
        { return load->sample_at_places(t, n); };
        result.n_dofs = body.n_dofs();
        result.of_all_forces = [&body, load, P = std::vector<double>(body.n_dofs())](
                                   const double t, const bool of_sizes) mutable
        { return slow_sum(body, *load, t, of_sizes, P); };
      }
      return result;
    }
  } // namespace

  std::vector<Excitation> excitations(const Structure &structure, const Constraints &constraints)
  {
    std::vector<Excitation> all;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      const Substructure &body = structure[k];
      for (const auto &load : body.loads_in_time())
        all.push_back(of_load(body, load));
      std::vector<const ConstrainedDof *> moving;
      for (const ConstrainedDof &constraint : body.constraints())
        if (constraint.motion)
          moving.push_back(&constraint);
      const std::size_t stride = moving.size() / most_dofs + 1;
      for (std::size_t i = 0; i < moving.size(); i += stride)
        all.push_back({"the prescribed place of '" + body.name() + "'", body.origin(), false, false,
                       moving[i]->motion});
    }
    for (const std::size_t i : constraints.turning_rows())
      if (const auto &length = constraints.turning(i).length_at)
        all.push_back({"the length of '" + constraints[i].name + "'", constraints.origin(i), false,
                       false, length});
    for (const std::size_t i : constraints.sliding_rows())
      if (const auto *place = dynamic_cast<const MovingPlace *>(constraints[i].geometry.get()))
        all.push_back({"the height under '" + constraints[i].name + "'", constraints.origin(i),
                       false, false, [place](const double t) { return place->profile(t); }});
    return all;
  }
} // namespace taut
