// SPDX-License-Identifier: LGPL-2.1-or-later
#include "phase.h"

namespace hunt
{
  namespace
  {
    /// |A| times a step of the series: with this and so many terms what is left out is 1e-15.
    constexpr double series_reach = .5;
    constexpr int series_terms = 12;
    /// Steps of one length after which a full matrix costs less than the series.
    constexpr unsigned int worth_a_matrix = 30;
    /// Part of its force by which a law may differ from its straight pieces.
    constexpr double law_error = 5e-4;
    constexpr int law_octaves = 30, law_halvings = 8;

    Vector scaled_sum(const Vector &a, const double factor, const Vector &b)
    {
      Vector result = a;
      for (std::size_t i = 0; i < a.size(); ++i)
        result[i] += factor * b[i];
      return result;
    }

    /// Of a square matrix, row by row, with z.
    Vector product(const Vector &A, const Vector &z)
    {
      const std::size_t n = z.size();
      Vector result(n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          result[i] += A[i * n + j] * z[j];
      return result;
    }

    double frobenius(const std::vector<Vector> &rows, const std::size_t first, const std::size_t n)
    {
      double sum = 0.;
      for (const Vector &row : rows)
        for (std::size_t j = first; j < first + n; ++j)
          sum += row[j] * row[j];
      return std::sqrt(sum);
    }
  } // namespace

  Pieces pieces_of(const taut::ForceLaw &law, const double reach)
  {
    Vector u = {0.};
    const std::function<void(double, double, int)> refine =
        [&](const double a, const double b, const int depth)
    {
      const double middle = .5 * (a + b), f = law.force(middle),
                   straight = .5 * (law.force(a) + law.force(b));
      if (depth > 0 && std::fabs(f - straight) > law_error * f)
      {
        refine(a, middle, depth - 1);
        refine(middle, b, depth - 1);
      }
      else
        u.push_back(b);
    };
    u.push_back(std::ldexp(reach, -law_octaves));
    for (int j = law_octaves; j > 0; --j)
      refine(std::ldexp(reach, -j), std::ldexp(reach, 1 - j), law_halvings);
    Pieces result;
    for (std::size_t j = 0; j + 1 < u.size(); ++j)
    {
      const double f = law.force(u[j]), k = (law.force(u[j + 1]) - f) / (u[j + 1] - u[j]);
      // One straight line may have many pieces.
      if (j > 0 && std::fabs(k - result.k.back()) < 1e-9 * k)
        continue;
      result.u.push_back(u[j]);
      result.f.push_back(f);
      result.k.push_back(k);
    }
    return result;
  }

  ModelParts::ModelParts(const LinearModel &model, const double reach) : model(model)
  {
    for (std::size_t i = 0; i < model.size(); ++i)
      (model.mass(i, i) > 0. ? with_mass : without_mass).push_back(i);
    dealii::FullMatrix<double> M(n_q(), n_q()), L(n_q(), n_q()), inverse(n_q(), n_q());
    M.extract_submatrix_from(model.mass, with_mass, with_mass);
    for (const std::size_t i : without_mass)
      for (std::size_t j = 0; j < model.size(); ++j)
        if (model.damping(i, j) != 0.)
          throw std::runtime_error("a DoF without mass is damped");
    T.reinit(n_q(), n_q());
    B.reinit(n_q(), std::max<std::size_t>(1, model.rows.size()));
    if (n_q() > 0)
    {
      L.cholesky(M);
      inverse.invert(L);
      T.copy_transposed(inverse);
    }
    for (std::size_t r = 0; r < model.rows.size(); ++r)
    {
      const LinearModel::Row &row = model.rows[r];
      double size = 0.;
      for (std::size_t i = 0; i < n_q(); ++i)
      {
        size += std::fabs(row.terms[with_mass[i]]);
        for (std::size_t j = 0; j < n_q(); ++j)
          B(j, r) += T(i, j) * row.terms[with_mass[i]];
      }
      acts_on_mass.push_back(size > 0.);
      for (const std::size_t i : without_mass)
        if (size > 0. && row.rigid() && row.terms[i] != 0.)
          throw std::runtime_error("a rigid constraint holds a mass to a DoF without one");
      springs.push_back(row.law       ? pieces_of(*row.law, reach)
                        : row.rigid() ? Pieces{}
                                      : Pieces{{0.}, {0.}, {row.stiffness}});
    }
  }

  Phase::Phase(const ModelParts &parts, const Modes &modes) : parts(parts)
  {
    forces.assign(parts.model.rows.size(), Vector(parts.n_state(), 0.));
    find_displacements(modes);
    find_forces(modes);
    hold_rigid(modes);
    assemble();
  }

  /// To the stiffness and the constant load, those of the springs that are closed.
  void Phase::add_closed_springs(const Modes &modes, dealii::FullMatrix<double> &K,
                                 Vector &constant) const
  {
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (const LinearModel::Row &row = parts.model.rows[r]; modes[r] > 0 && !row.rigid())
      {
        const Pieces &spring = parts.springs[r];
        const std::size_t piece = modes[r] - 1;
        const double k = spring.k[piece], force = spring.f[piece] - k * (spring.u[piece] + row.gap);
        for (std::size_t i = 0; i < constant.size(); ++i)
        {
          constant[i] += force * row.terms[i];
          for (std::size_t j = 0; j < constant.size(); ++j)
            K(i, j) += k * row.terms[i] * row.terms[j];
        }
      }
  }

  /// u = T q where there is mass; elsewhere from the equilibrium with the springs that are closed.
  void Phase::find_displacements(const Modes &modes)
  {
    const LinearModel &model = parts.model;
    const std::size_t n = parts.n_q(), one = parts.one(), n_z = parts.without_mass.size();
    u.assign(model.size(), Vector(parts.n_state(), 0.));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        u[parts.with_mass[i]][j] = parts.T(i, j);
    if (n_z == 0)
      return;
    dealii::FullMatrix<double> K = model.stiffness;
    Vector constant = model.constant_load;
    add_closed_springs(modes, K, constant);
    std::vector<std::size_t> held;
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (modes[r] > 0 && model.rows[r].rigid() && !parts.acts_on_mass[r])
        held.push_back(r);
    dealii::FullMatrix<double> S(n_z + held.size(), n_z + held.size());
    std::vector<Vector> right(S.m(), Vector(parts.n_state(), 0.));
    for (std::size_t a = 0; a < n_z; ++a)
    {
      const std::size_t i = parts.without_mass[a];
      for (std::size_t b = 0; b < n_z; ++b)
        S(a, b) = K(i, parts.without_mass[b]);
      for (std::size_t h = 0; h < held.size(); ++h)
      {
        S(a, n_z + h) = -model.rows[held[h]].terms[i];
        S(n_z + h, a) = model.rows[held[h]].terms[i];
      }
      right[a][one] = constant[i];
      right[a][one + 1] = model.cosine_load[i];
      right[a][one + 2] = model.sine_load[i];
      right[a][parts.pulse()] = model.pulse_load[i];
      for (const std::size_t j : parts.with_mass)
        right[a] = scaled_sum(right[a], -K(i, j), u[j]);
    }
    for (std::size_t h = 0; h < held.size(); ++h)
      right[n_z + h][one] = -model.rows[held[h]].gap;
    S.gauss_jordan();
    for (std::size_t a = 0; a < S.m(); ++a)
    {
      Vector solution(parts.n_state(), 0.);
      for (std::size_t b = 0; b < S.m(); ++b)
        solution = scaled_sum(solution, S(a, b), right[b]);
      (a < n_z ? u[parts.without_mass[a]] : forces[held[a - n_z]]) = solution;
    }
  }

  /// Forces of springs, and q'' without those of rigid rows on masses.
  void Phase::find_forces(const Modes &modes)
  {
    const LinearModel &model = parts.model;
    const std::size_t n = parts.n_q(), one = parts.one();
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (modes[r] > 0 && !model.rows[r].rigid())
      {
        const Pieces &spring = parts.springs[r];
        const std::size_t piece = modes[r] - 1;
        forces[r] = Vector(parts.n_state(), 0.);
        forces[r][one] = spring.f[piece] - spring.k[piece] * spring.u[piece];
        forces[r] = scaled_sum(forces[r], -spring.k[piece], gap(r));
        forces[r] = scaled_sum(forces[r], -model.rows[r].damping, rate(r));
      }
    std::vector<Vector> force(n, Vector(parts.n_state(), 0.));
    for (std::size_t a = 0; a < n; ++a)
    {
      const std::size_t i = parts.with_mass[a];
      force[a][one] = model.constant_load[i];
      force[a][one + 1] = model.cosine_load[i];
      force[a][one + 2] = model.sine_load[i];
      force[a][parts.pulse()] = model.pulse_load[i];
      for (std::size_t j = 0; j < model.size(); ++j)
        if (model.stiffness(i, j) != 0.)
          force[a] = scaled_sum(force[a], -model.stiffness(i, j), u[j]);
      for (std::size_t b = 0; b < n; ++b)
        if (const double c = model.damping(i, parts.with_mass[b]); c != 0.)
          for (std::size_t j = 0; j < n; ++j)
            force[a][n + j] -= c * parts.T(b, j);
    }
    inertia.assign(n, Vector(parts.n_state(), 0.));
    for (std::size_t j = 0; j < n; ++j)
    {
      for (std::size_t a = 0; a < n; ++a)
        if (parts.T(a, j) != 0.)
          inertia[j] = scaled_sum(inertia[j], parts.T(a, j), force[a]);
      for (std::size_t r = 0; r < modes.size(); ++r)
        if (modes[r] > 0 && !model.rows[r].rigid())
          inertia[j] = scaled_sum(inertia[j], parts.B(j, r), forces[r]);
    }
  }

  /// Forces of closed rigid rows on masses: their gaps have no acceleration.
  void Phase::hold_rigid(const Modes &modes)
  {
    std::vector<std::size_t> held;
    for (std::size_t r = 0; r < modes.size(); ++r)
      if (modes[r] > 0 && parts.model.rows[r].rigid() && parts.acts_on_mass[r])
        held.push_back(r);
    if (held.empty())
      return;
    const std::size_t n = parts.n_q();
    dealii::FullMatrix<double> G(held.size(), held.size());
    std::vector<Vector> acceleration(held.size(), Vector(parts.n_state(), 0.));
    for (std::size_t a = 0; a < held.size(); ++a)
      for (std::size_t j = 0; j < n; ++j)
      {
        for (std::size_t b = 0; b < held.size(); ++b)
          G(a, b) += parts.B(j, held[a]) * parts.B(j, held[b]);
        acceleration[a] = scaled_sum(acceleration[a], parts.B(j, held[a]), inertia[j]);
      }
    G.gauss_jordan();
    for (std::size_t a = 0; a < held.size(); ++a)
    {
      for (std::size_t b = 0; b < held.size(); ++b)
        forces[held[a]] = scaled_sum(forces[held[a]], -G(a, b), acceleration[b]);
      for (std::size_t j = 0; j < n; ++j)
        inertia[j] = scaled_sum(inertia[j], parts.B(j, held[a]), forces[held[a]]);
    }
  }

  void Phase::assemble()
  {
    const std::size_t n = parts.n_q(), m = forces.size(), size = parts.n_state(), one = parts.one();
    A.assign(size * size, 0.);
    for (std::size_t j = 0; j < n; ++j)
    {
      A[j * size + n + j] = 1.;
      std::copy(inertia[j].begin(), inertia[j].end(), A.begin() + (n + j) * size);
    }
    for (std::size_t r = 0; r < m; ++r)
      std::copy(forces[r].begin(), forces[r].end(), A.begin() + (2 * n + r) * size);
    A[parts.pulse() * size + parts.pulse() + 1] = 1.;
    A[(one + 1) * size + one + 2] = -parts.model.frequency;
    A[(one + 2) * size + one + 1] = parts.model.frequency;
    const double rate =
        std::sqrt(frobenius(inertia, 0, n)) + frobenius(inertia, n, n) + parts.model.frequency;
    longest = series_reach / rate;
  }

  Vector Phase::gap(const std::size_t row) const
  {
    Vector result(parts.n_state(), 0.);
    const LinearModel::Row &data = parts.model.rows[row];
    result[parts.one()] = data.gap;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (data.terms[i] != 0.)
        result = scaled_sum(result, data.terms[i], u[i]);
    return result;
  }

  Vector Phase::rate(const std::size_t row) const
  {
    Vector result(parts.n_state(), 0.);
    for (std::size_t j = 0; j < parts.n_q(); ++j)
      result[parts.n_q() + j] = parts.B(j, row);
    return result;
  }

  Vector Phase::displacement(const Vector &z) const
  {
    Vector result;
    for (const Vector &row : u)
      result.push_back(dot(row, z));
    return result;
  }

  Vector Phase::series(const Vector &z, const double time) const
  {
    Vector result = z, term = z;
    for (int k = 1; k <= series_terms; ++k)
    {
      term = product(A, term);
      for (std::size_t i = 0; i < z.size(); ++i)
      {
        term[i] *= time / k;
        result[i] += term[i];
      }
    }
    return result;
  }

  void Phase::make_exponential(const double time)
  {
    const std::size_t n = parts.n_state();
    exponential.assign(n * n, 0.);
    for (std::size_t j = 0; j < n; ++j)
    {
      Vector unit(n, 0.);
      unit[j] = 1.;
      const Vector column = series(unit, time);
      for (std::size_t i = 0; i < n; ++i)
        exponential[i * n + j] = column[i];
    }
    exponential_time = time;
  }

  Vector Phase::propagate(const Vector &z, const double time)
  {
    n_repeated = time == last_time ? n_repeated + 1 : 0;
    last_time = time;
    if (n_repeated > worth_a_matrix && time != exponential_time)
      make_exponential(time);
    if (time != exponential_time)
      return series(z, time);
    return product(exponential, z);
  }
} // namespace hunt
