// SPDX-License-Identifier: LGPL-2.1-or-later
// A second, slow and exact way through a scene; see extended_run.h.
#include "extended_run.h"

#include "extended_model.h"

#include <algorithm>
#include <stdexcept>

namespace extremes
{
  namespace
  {
    const Number held_by("1e-45"), shared_by("1e-30"), tie("1e-70"), no_share("1e-15");

    /// V = velocity U + known and A = acceleration U + known of a scheme, and its weights.
    struct Scheme
    {
      Number alpha_m = 0, alpha_f = 0, velocity = 0, acceleration = 0;
    };

    /// Of one vector of the bodies.
    struct Motion
    {
      Vector U, V, A, U_old, V_old;
    };

    class ExtendedRun
    {
    public:
      ExtendedRun(const Case &c, const ExtendedModel &model,
                  const std::vector<ObservedPoint> &points, bool as_double);
      Answer run();

    private:
      void start();
      void step(unsigned int i);
      void prepare(const std::string &scheme);
      void factor(const Matrix &full);
      void find_multipliers(const Vector &right_hand_side, const Number &t);
      Vector principal_pivoting(const Matrix &F, const Vector &d) const;
      void check_answer(const Vector &right_hand_side) const;
      Vector combine(const Number &a, const Vector &x, const Number &b, const Vector &y) const;
      void observe();

      const Case c;
      const ExtendedModel &model;
      Matrix M, C, K;
      const bool as_double;
      const taut::Scene &scene;
      const std::vector<ObservedPoint> points;
      const std::vector<std::size_t> group;
      const Number tau;

      std::vector<std::size_t> free_dofs;
      Matrix A;           ///< of the free DoFs, with the springs of a static problem
      Matrix A_full;      ///< of all DoFs, without them
      Vector spring;      ///< of the free DoFs
      Vector flexibility; ///< of the constraints with their bodies held: what `shared_by` counts in
      Cholesky factor_of_A;
      bool is_static = false;

      std::string scheme_name;
      Scheme scheme;
      Motion motion;
      Vector N, D, r, KU;
      std::vector<Form> B;
      Answer answer;
    };

    Number size(const Vector &x)
    {
      Number m = 0;
      for (const Number &v : x)
        m = std::max(m, Number(abs(v)));
      return m;
    }

    /// Of the units in the last place that number i is changed by: 1, 0.5 or 1.5.
    Number last_place(const std::size_t i)
    {
      return Number(0x1p-53) * Number(i % 3 == 0 ? 1. : i % 3 == 1 ? .5 : 1.5);
    }

    ExtendedRun::ExtendedRun(const Case &c, const ExtendedModel &model,
                             const std::vector<ObservedPoint> &points, const bool as_double)
        : c(c), model(model), M(model.M), C(model.C), K(model.K), as_double(as_double),
          scene(this->c.scene), points(points), group(groups_of_links(scene)), tau(c.step),
          N(scene.links.size(), Number(0)), D(scene.links.size(), Number(0)), B(scene.links.size())
    {
      for (std::size_t i = 0; i < model.n_dofs(); ++i)
        if (!model.held[i])
          free_dofs.push_back(i);
      if (as_double)
        for (Matrix *matrix : {&M, &C, &K})
          for (std::size_t i = 0; i < matrix->size(); ++i)
            (*matrix)(i, i) *= 1 + last_place(i);
    }

    Vector ExtendedRun::combine(const Number &a, const Vector &x, const Number &b,
                                const Vector &y) const
    {
      Vector z(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        z[i] = a * x[i] + b * y[i];
      return z;
    }

    Answer ExtendedRun::run()
    {
      try
      {
        start();
        observe();
        for (unsigned int i = 1; i <= c.n_steps; ++i)
        {
          step(i);
          observe();
        }
      }
      catch (const std::runtime_error &e)
      {
        answer.error = e.what();
      }
      return answer;
    }

    void ExtendedRun::factor(const Matrix &full)
    {
      A_full = full;
      const std::size_t n = free_dofs.size();
      A = Matrix(n);
      spring.assign(n, Number(0));
      Number largest[2] = {0, 0};
      for (std::size_t i = 0; i < n; ++i)
      {
        for (std::size_t j = 0; j < n; ++j)
          A(i, j) = full(free_dofs[i], free_dofs[j]);
        Number &m = largest[int(model.is_rotation[free_dofs[i]])];
        m = std::max(m, A(i, i));
      }
      Matrix heavy = A;
      for (std::size_t i = 0; i < n; ++i)
      {
        const Number typical = A(i, i) > 0 ? A(i, i)
                               : largest[int(model.is_rotation[free_dofs[i]])] > 0
                                   ? largest[int(model.is_rotation[free_dofs[i]])]
                                   : Number(1);
        heavy(i, i) += typical;
        if (is_static || A(i, i) == 0)
          spring[i] = held_by * typical;
        A(i, i) += spring[i];
      }
      Cholesky of_heavy;
      if (!factor_of_A.factor(A) || !of_heavy.factor(heavy))
        throw std::runtime_error("not held: the matrix is singular");
      flexibility.assign(B.size(), Number(0));
      for (std::size_t k = 0; k < B.size(); ++k)
      {
        Vector full_row(model.n_dofs(), Number(0)), constraint;
        for (const auto &[i, v] : model.constraint(scene.links[k], Number(0)))
          full_row[i] += v;
        for (const std::size_t i : free_dofs)
          constraint.push_back(full_row[i]);
        const Vector x = of_heavy.solve(constraint);
        for (std::size_t i = 0; i < n; ++i)
          flexibility[k] += constraint[i] * x[i];
        if (flexibility[k] == 0)
          flexibility[k] = n > 0 ? 1 / heavy(0, 0) : Number(1);
      }
    }

    void ExtendedRun::start()
    {
      const std::size_t n = model.n_dofs();
      const Vector zero(n, Number(0));
      motion = {zero, zero, zero, zero, zero};
      r = zero;
      for (std::size_t k = 0; k < B.size(); ++k)
        B[k] = model.constraint(scene.links[k], Number(0));
      if (scene.start == taut::Start::equilibrium)
      {
        is_static = true;
        factor(K);
        find_multipliers(model.load(Number(0)), Number(0));
        is_static = false;
        scheme_name = c.scheme;
      }
      else
      {
        if (scene.start == taut::Start::given)
        {
          motion.U = model.initial_U;
          motion.V = model.initial_V;
          for (std::size_t i = 0; i < n; ++i)
            if (model.held[i])
              motion.U[i] = model.given[i];
        }
        for (std::size_t k = 0; k < B.size(); ++k)
        {
          const taut::Link &link = scene.links[k];
          Number g = dot(B[k], motion.U) + Number(link.gap);
          if (!link.rigid())
          {
            const Number u = link.unilateral() && g > 0 ? Number(0) : Number(-g);
            N[k] = u * Number(link.stiffness);
          }
          D[k] = g;
        }
        scheme_name = "backward Euler";
      }
      motion.U_old = motion.U;
      if (c.n_steps > 0)
        prepare(scheme_name);
    }

    void ExtendedRun::prepare(const std::string &name)
    {
      scheme_name = name;
      scheme = {};
      const Number two = 2;
      if (name == "backward Euler")
        scheme = {0, 0, 1 / tau, 1 / (tau * tau)};
      else if (name == "BDF2")
        scheme = {0, 0, 3 / (2 * tau), 9 / (4 * tau * tau)};
      else if (name == "generalised-alpha")
      {
        // Chung and Hulbert with the default spectral radius, the double 0.8.
        const Number rho = .8;
        scheme.alpha_m = (2 * rho - 1) / (rho + 1);
        scheme.alpha_f = rho / (rho + 1);
        const Number gamma = 1 / two - scheme.alpha_m + scheme.alpha_f,
                     root = 1 - scheme.alpha_m + scheme.alpha_f, beta = root * root / 4;
        scheme.acceleration = 1 / (beta * tau * tau);
        scheme.velocity = gamma / (beta * tau);
      }
      else
        throw std::logic_error("the extended run has no scheme " + name);
      const Number m = (1 - scheme.alpha_m) / (1 - scheme.alpha_f) * scheme.acceleration;
      Matrix full(model.n_dofs());
      for (std::size_t i = 0; i < full.size(); ++i)
        for (std::size_t j = 0; j < full.size(); ++j)
          full(i, j) = m * M(i, j) + scheme.velocity * C(i, j) + K(i, j);
      factor(full);
    }

    void ExtendedRun::step(const unsigned int i)
    {
      if (i == 2 && scheme_name != c.scheme)
        prepare(c.scheme);
      const Number t = tau * i;
      for (std::size_t k = 0; k < B.size(); ++k)
        B[k] = model.constraint(scene.links[k], t);

      // Known parts: V = velocity U + v, A = acceleration U + a.
      const std::size_t n = model.n_dofs();
      Vector v(n), a(n);
      const Motion &m = motion;
      for (std::size_t k = 0; k < n; ++k)
      {
        if (scheme_name == "BDF2")
        {
          v[k] = (m.U_old[k] - 4 * m.U[k]) / (2 * tau);
          a[k] = (3 * v[k] - 4 * m.V[k] + m.V_old[k]) / (2 * tau);
        }
        else if (scheme_name == "backward Euler")
        {
          v[k] = -m.U[k] / tau;
          a[k] = (v[k] - m.V[k]) / tau;
        }
        else
        {
          // 1/(beta tau^2) and gamma/(beta tau) are at hand.
          const Number per_beta = scheme.acceleration * tau * tau,
                       gamma = scheme.velocity * tau / per_beta;
          a[k] = -scheme.acceleration * (m.U[k] + tau * m.V[k]) - (per_beta / 2 - 1) * m.A[k];
          v[k] = m.V[k] + tau * ((1 - gamma) * m.A[k] + gamma * a[k]);
        }
      }
      const Number kappa = scheme.alpha_f / (1 - scheme.alpha_f),
                   now = (1 - scheme.alpha_m) / (1 - scheme.alpha_f),
                   old = scheme.alpha_m / (1 - scheme.alpha_f);
      const Vector P = model.load(t), Cv = C.times(v), Ma = M.times(combine(now, a, old, m.A));
      Vector rhs(n);
      for (std::size_t k = 0; k < n; ++k)
        rhs[k] = P[k] + kappa * r[k] - Cv[k] - Ma[k];

      const Motion before = motion;
      find_multipliers(rhs, t);
      motion.U_old = before.U;
      motion.V_old = before.V;
      for (std::size_t k = 0; k < n; ++k)
      {
        motion.V[k] = scheme.velocity * motion.U[k] + v[k];
        motion.A[k] = scheme.acceleration * motion.U[k] + a[k];
      }
      const Vector CV = C.times(motion.V), stiff = K.times(motion.U);
      for (std::size_t k = 0; k < n; ++k)
        r[k] = P[k] - CV[k] - stiff[k];
      for (std::size_t k = 0; k < B.size(); ++k)
        for (const auto &[dof, value] : B[k])
          r[dof] += value * N[k];
      for (std::size_t k = 0; k < n; ++k)
        if (model.held[k])
          r[k] = 0;
    }

    /// N, D and U of A U = P + B N.
    void ExtendedRun::find_multipliers(const Vector &full_rhs, const Number &t)
    {
      const std::size_t n = free_dofs.size(), m = B.size();
      Vector held_U(model.n_dofs(), Number(0));
      for (std::size_t i = 0; i < held_U.size(); ++i)
        if (model.held[i])
          held_U[i] = model.given[i];
      const Vector lift = A_full.times(held_U);
      Vector rhs(n);
      for (std::size_t i = 0; i < n; ++i)
        rhs[i] = full_rhs[free_dofs[i]] - lift[free_dofs[i]];

      std::vector<Vector> constraints(m, Vector(n)), columns;
      for (std::size_t k = 0; k < m; ++k)
      {
        Vector full(model.n_dofs(), Number(0));
        for (const auto &[i, v] : B[k])
          full[i] += v;
        for (std::size_t i = 0; i < n; ++i)
          constraints[k][i] = full[free_dofs[i]];
        columns.push_back(factor_of_A.solve(constraints[k]));
      }
      const Vector U_free = factor_of_A.solve(rhs);
      Matrix F(m);
      Vector d(m);
      for (std::size_t k = 0; k < m; ++k)
      {
        const taut::Link &link = scene.links[k];
        for (std::size_t l = 0; l < m; ++l)
          for (std::size_t i = 0; i < n; ++i)
            F(k, l) += constraints[k][i] * columns[l][i];
        F(k, k) += shared_by * flexibility[k];
        if (!link.rigid())
          F(k, k) += 1 / Number(link.stiffness);
        d[k] = Number(link.gap) + dot(B[k], held_U);
        if (link.moving())
          d[k] += Number(link.profile(
              static_cast<double>(Number(link.to.position) + Number(link.speed) * t), 0.));
        for (std::size_t i = 0; i < n; ++i)
          d[k] += constraints[k][i] * U_free[i];
      }
      if (as_double)
        for (std::size_t k = 0; k < m; ++k)
          F(k, k) *= 1 + last_place(k);
      N = principal_pivoting(F, d);
      if (as_double)
        for (std::size_t k = 0; k < m; ++k)
          N[k] *= 1 + last_place(k + 1);

      motion.U = held_U;
      Vector U = U_free;
      for (std::size_t k = 0; k < m; ++k)
        for (std::size_t i = 0; i < n; ++i)
          U[i] += columns[k][i] * N[k];
      for (std::size_t i = 0; i < n; ++i)
        motion.U[free_dofs[i]] = U[i];
      check_answer(rhs);
      for (std::size_t k = 0; k < m; ++k)
        D[k] =
            dot(B[k], motion.U) + Number(scene.links[k].gap) +
            (scene.links[k].moving() ? Number(scene.links[k].profile(
                                           static_cast<double>(Number(scene.links[k].to.position) +
                                                               Number(scene.links[k].speed) * t),
                                           0.))
                                     : Number(0));
    }

    Vector ExtendedRun::principal_pivoting(const Matrix &F, const Vector &d) const
    {
      const std::size_t m = d.size();
      std::vector<char> closed(m);
      for (std::size_t k = 0; k < m; ++k)
        closed[k] = !scene.links[k].unilateral() || N[k] > 0;
      for (unsigned int iteration = 0; iteration < 20000; ++iteration)
      {
        std::vector<std::size_t> set;
        for (std::size_t k = 0; k < m; ++k)
          if (closed[k])
            set.push_back(k);
        Matrix sub(set.size());
        Vector rhs(set.size());
        for (std::size_t p = 0; p < set.size(); ++p)
        {
          rhs[p] = -d[set[p]];
          for (std::size_t q = 0; q < set.size(); ++q)
            sub(p, q) = F(set[p], set[q]);
        }
        Cholesky factor;
        if (!factor.factor(sub))
          throw std::logic_error("the extended F is singular");
        const Vector x = factor.solve(rhs);
        Vector result(m, Number(0));
        for (std::size_t p = 0; p < set.size(); ++p)
          result[set[p]] = x[p];
        bool changed = false;
        for (std::size_t k = 0; k < m && !changed; ++k)
        {
          if (!scene.links[k].unilateral())
            continue;
          Number terms = abs(d[k]), sum = d[k];
          for (std::size_t l = 0; l < m; ++l)
          {
            sum += F(k, l) * result[l];
            terms += abs(F(k, l) * result[l]);
          }
          changed = closed[k] ? F(k, k) * result[k] < -tie * terms : sum < -tie * terms;
          if (changed)
            closed[k] = !closed[k];
        }
        if (!changed)
          return result;
      }
      throw std::logic_error("principal pivoting does not end");
    }

    void ExtendedRun::check_answer(const Vector &rhs) const
    {
      const Number load = size(rhs);
      Number force = load, in_springs = 0;
      for (std::size_t k = 0; k < N.size(); ++k)
        for (const auto &[i, v] : B[k])
          force = std::max(force, Number(abs(v * N[k])));
      for (std::size_t i = 0; i < spring.size(); ++i)
        in_springs = std::max(in_springs, Number(abs(spring[i] * motion.U[free_dofs[i]])));
      if (in_springs > no_share * force)
        throw std::runtime_error("not held: nothing balances the loads");
      for (std::size_t k = 0; k < N.size(); ++k)
      {
        Number terms = std::max(Number(abs(Number(scene.links[k].gap))), flexibility[k] * load);
        for (const auto &[i, v] : B[k])
          terms = std::max(terms, Number(abs(v * motion.U[i])));
        if (abs(shared_by * flexibility[k] * N[k]) > no_share * terms)
          throw std::runtime_error("contradictory: link " + scene.links[k].name);
      }
    }

    void ExtendedRun::observe()
    {
      Observation o;
      for (const ObservedPoint &p : points)
        o[p.rotational ? rotation : displacement].push_back(
            static_cast<double>(dot(model.motion(p.at, p.rotational, p.direction), motion.U)));
      Vector sum(N.size(), Number(0));
      for (std::size_t k = 0; k < N.size(); ++k)
        sum[group[k]] += N[k];
      for (std::size_t k = 0; k < N.size(); ++k)
      {
        const bool rotational = scene.links[k].rotational;
        if (group[k] == k)
          o[rotational ? moment : force].push_back(static_cast<double>(sum[k]));
        o[rotational ? angular_gap : gap].push_back(static_cast<double>(D[k]));
      }
      answer.steps.push_back(std::move(o));
      for (std::size_t k = 0; k < N.size() && !flexibility.empty(); ++k)
      {
        double &largest = scene.links[k].rotational ? answer.row_turn : answer.row_motion;
        largest = std::max(largest, static_cast<double>(abs(flexibility[k] * N[k])));
      }
      for (std::size_t i = 0; i < model.n_dofs(); ++i)
      {
        Number sum = 0;
        for (std::size_t j = 0; j < model.n_dofs(); ++j)
          sum += abs(K(i, j) * motion.U[j]);
        double &largest = model.is_rotation[i] ? answer.elastic_moment : answer.elastic_force;
        largest = std::max(largest, static_cast<double>(sum));
      }
    }
  } // namespace

  Answer extended_answer(const Case &c, const bool as_double)
  {
    return ExtendedRun(c, ExtendedWires(c.scene), observed_points(c.scene), as_double).run();
  }

  Answer extended_answer(const Case &c, const ExtendedModel &model,
                         const std::vector<ObservedPoint> &points, const bool as_double)
  {
    return ExtendedRun(c, model, points, as_double).run();
  }
} // namespace extremes
