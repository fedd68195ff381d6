// SPDX-License-Identifier: LGPL-2.1-or-later
#include "linear_model.h"

#include <deal.II/lac/vector.h>

namespace hunt
{
  LinearModel::LinearModel(const taut::StepView &view, const double frequency, const Pulse &pulse)
      : frequency(frequency), pulse(pulse)
  {
    for (std::size_t k = 0; k < view.structure.size(); ++k)
    {
      const taut::Substructure &body = view.structure[k];
      if (!body.is_linear())
        throw std::runtime_error("body " + body.name() + " is not linear");
      number.emplace_back(body.n_dofs(), 0);
      for (const unsigned int dof : body.constrained_dofs())
        number[k][dof] = -1;
      for (unsigned int i = 0; i < body.n_dofs(); ++i)
        if (number[k][i] == 0)
        {
          number[k][i] = static_cast<int>(free.size());
          free.push_back({k, i});
          is_place.push_back(body.kind(i) == 0 || body.is_lumped());
        }
    }
    add_matrices(view);
    find_loads(view);
    add_rows(view);
    start = displacement(view);
    start_velocity = velocity(view);
  }

  void LinearModel::add_matrices(const taut::StepView &view)
  {
    for (auto *matrix : {&mass, &damping, &stiffness})
      matrix->reinit(size(), size());
    for (std::size_t k = 0; k < view.structure.size(); ++k)
    {
      const taut::Substructure &body = view.structure[k];
      const auto add = [&](const taut::SymmetricMatrix &from, dealii::FullMatrix<double> &to)
      {
        from.visit(
            [&](const unsigned int i, const unsigned int j, const double value)
            {
              const int a = number[k][i], b = number[k][j];
              if (a < 0 || b < 0)
                return;
              to(a, b) += value;
              if (a != b)
                to(b, a) += value;
            });
      };
      add(body.mass(), mass);
      add(body.damping(), damping);
      add(body.stiffness(), stiffness);
    }
  }

  Vector LinearModel::load(const taut::StepView &view, const double t) const
  {
    taut::BodyVectors P(view.structure.size());
    for (std::size_t k = 0; k < P.size(); ++k)
      view.structure[k].external_force(t, P[k]);
    Vector result = gather(P);
    add_prescribed(view, t, result);
    return result;
  }

  /// Subtracts K u + C u' + M u" of the prescribed places u = mean + a sin(w t + phase).
  void LinearModel::add_prescribed(const taut::StepView &view, const double t, Vector &loads) const
  {
    for (std::size_t k = 0; k < view.structure.size(); ++k)
    {
      const taut::Substructure &body = view.structure[k];
      std::map<unsigned int, std::array<double, 3>> given; // place, velocity, acceleration
      for (const taut::ConstrainedDof &dof : body.constraints())
      {
        const double u = dof.at(t);
        given[dof.dof] = {u, 0., 0.};
        if (!dof.motion || !(frequency > 0.))
          continue;
        const double period = 2. * std::acos(-1.) / frequency,
                     mean = .5 * (dof.at(0.) + dof.at(.5 * period));
        given[dof.dof] = {u, frequency * (dof.at(t + .25 * period) - mean),
                          -frequency * frequency * (u - mean)};
      }
      const taut::SymmetricMatrix *const matrices[] = {&body.stiffness(), &body.damping(),
                                                       &body.mass()};
      for (int order = 0; order < 3; ++order)
        matrices[order]->visit(
            [&](const unsigned int i, const unsigned int j, const double value)
            {
              for (const auto &[row, column] : {std::pair(i, j), std::pair(j, i)})
                if (const int a = number[k][row]; a >= 0 && number[k][column] < 0)
                  loads[a] -= value * given[column][order];
            });
    }
  }

  void LinearModel::find_loads(const taut::StepView &view)
  {
    if (frequency > 0. && pulse.width > 0.)
      throw std::runtime_error("a load has a frequency and a pulse");
    const double period = frequency > 0. ? 2. * std::acos(-1.) / frequency : 0.,
                 peak = pulse.begin + .5 * pulse.width;
    const Vector at_start = load(view, 0.), quarter = load(view, .25 * period),
                 half = load(view, .5 * period), highest = load(view, peak);
    for (std::size_t i = 0; i < size(); ++i)
    {
      constant_load.push_back(.5 * (at_start[i] + half[i]));
      cosine_load.push_back(frequency > 0. ? at_start[i] - constant_load[i] : 0.);
      sine_load.push_back(frequency > 0. ? quarter[i] - constant_load[i] : 0.);
      pulse_load.push_back(pulse.width > 0. ? highest[i] - at_start[i] : 0.);
    }
    const double of_period = .37 * (frequency > 0. ? period : 1.);
    for (const double t : {of_period, 1., pulse.begin + .25 * pulse.width,
                           pulse.begin + .8 * pulse.width, pulse.begin + 1.5 * pulse.width})
    {
      const Vector found = load(view, t);
      for (std::size_t i = 0; i < size(); ++i)
      {
        const double expected = constant_load[i] + std::cos(t * frequency) * cosine_load[i] +
                                std::sin(t * frequency) * sine_load[i] +
                                pulse.at(t) * pulse_load[i];
        if (std::fabs(found[i] - expected) >
            1e-9 * (std::fabs(at_start[i]) + std::fabs(quarter[i])) +
                1e-6 * std::fabs(pulse_load[i]))
          throw std::runtime_error("a load is no constant, one frequency or the pulse");
      }
    }
  }

  void LinearModel::add_rows(const taut::StepView &view)
  {
    for (std::size_t i = 0; i < view.constraints.size(); ++i)
      has_moving = has_moving || view.constraints.slides(i) || view.constraints.turns(i);
    if (has_moving)
      return;
    for (std::size_t i = 0; i < view.constraints.size(); ++i)
    {
      const taut::ConstraintData &data = view.constraints[i];
      Row row = {Vector(size(), 0.),  data.gap,       data.cone.may_open(), data.spring.stiffness,
                 data.spring.damping, data.spring.law};
      for (const taut::Term &term : data.terms)
        for (std::size_t j = 0; j < term.form.index.size(); ++j)
          if (const int a = number[term.substructure][term.form.index[j]]; a >= 0)
            row.terms[a] += term.form.value[j];
      rows.push_back(row);
    }
  }

  Vector LinearModel::gather(const taut::BodyVectors &values) const
  {
    Vector result;
    for (const Dof &dof : free)
      result.push_back(values[dof.body][dof.index]);
    return result;
  }

  Vector LinearModel::displacement(const taut::StepView &view) const
  {
    Vector result = gather(view.state.U);
    const Vector reference = gather(view.reference.displacement);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += reference[i];
    return result;
  }

  double LinearModel::kinetic(const Vector &v) const
  {
    return .5 * mass.matrix_norm_square(dealii::Vector<double>(v.begin(), v.end()));
  }

  double LinearModel::potential(const Vector &u) const
  {
    return .5 * stiffness.matrix_norm_square(dealii::Vector<double>(u.begin(), u.end())) -
           dot(constant_load, u);
  }

  Vector LinearModel::places(const Vector &u) const
  {
    Vector result;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (is_place[i])
        result.push_back(u[i]);
    return result;
  }
} // namespace hunt
