// SPDX-License-Identifier: LGPL-2.1-or-later
// A second, slow and exact way through a scene; see extended_run.h.
#include "extended_run.h"

#include "extended_complementarity.h"
#include "extended_projection.h"
#include "extended_scheme.h"
#include "extended_system.h"

namespace extremes
{
  namespace
  {
    /// Part of the flexibility of the bodies at which a compliance of contacts counts as soft.
    const Number fading = .3;

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
      void set_mean_forces();
      void set_balance(const Vector &P);
      void project(const Number &t);
      void find_multipliers(const Vector &right_hand_side, const Number &t);
      Number elastic_terms(std::size_t i) const;
      void observe();
      bool conserves(const std::size_t k) const
      {
        return is_mean[k] && !c.conserving.empty() && c.conserving[k];
      }

      const Case c;
      const ExtendedModel &model;
      Matrix M, C, K;
      const bool as_double;
      const taut::Scene &scene;
      const std::vector<ObservedPoint> points;
      const std::vector<std::size_t> group;
      const Number tau;

      ExtendedSystem system;
      ExtendedScheme scheme;
      std::vector<char> is_mean; ///< of each constraint: its force is a mean over a step
      std::optional<ExtendedProjection> projection;
      ExtendedMotion motion;
      Vector N, D, r;
      std::vector<Form> B;
      Answer answer;
    };

    ExtendedRun::ExtendedRun(const Case &c, const ExtendedModel &model,
                             const std::vector<ObservedPoint> &points, const bool as_double)
        : c(c), model(model), M(model.M), C(model.C), K(model.K), as_double(as_double),
          scene(this->c.scene), points(points), group(groups_of_links(scene)), tau(c.step),
          system(scene, model, as_double), is_mean(scene.links.size(), 0),
          N(Number(0), scene.links.size()), D(Number(0), scene.links.size()), B(scene.links.size())
    {
      if (as_double)
        for (Matrix *matrix : {&M, &C, &K})
          for (std::size_t i = 0; i < matrix->size(); ++i)
            (*matrix)(i, i) *= 1 + last_place(i);
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

    void ExtendedRun::start()
    {
      const std::size_t n = model.n_dofs();
      const Vector zero(Number(0), n);
      motion = {zero, zero, zero, zero, zero};
      r = zero;
      std::string first =
          ExtendedScheme(c.scheme, tau).starts_itself() ? c.scheme : "backward Euler";
      for (std::size_t k = 0; k < B.size(); ++k)
        B[k] = model.constraint(scene.links[k], Number(0));
      if (scene.start == taut::Start::equilibrium)
      {
        system.factor(K, true);
        find_multipliers(model.load(Number(0)), Number(0));
        first = c.scheme;
      }
      else
      {
        if (scene.start == taut::Start::given)
        {
          motion.U = model.initial_U;
          motion.V = model.initial_V;
          for (std::size_t i = 0; i < n; ++i)
            if (model.held[i])
            {
              motion.U[i] = model.given[i];
              motion.V[i] = 0;
            }
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
      }
      motion.U_old = motion.U;
      prepare(first);
      if (scheme.starts_itself())
        set_balance(model.load(Number(0)));
    }

    void ExtendedRun::prepare(const std::string &name)
    {
      scheme = ExtendedScheme(name, tau);
      const Number m = (1 - scheme.alpha_m) / (1 - scheme.alpha_f) * scheme.acceleration;
      Matrix full(model.n_dofs());
      for (std::size_t i = 0; i < full.size(); ++i)
        for (std::size_t j = 0; j < full.size(); ++j)
          full(i, j) = m * M(i, j) + scheme.velocity * C(i, j) + K(i, j);
      system.factor(full, false);
      set_mean_forces();
      if (scheme.projects)
        projection.emplace(model, M, as_double);
    }

    /// All rigid contacts have them, and elastic ones where velocities are projected, but for those
    /// that act on DoFs without inertia: these are in equilibrium at the ends of steps.
    void ExtendedRun::set_mean_forces()
    {
      for (std::size_t k = 0; k < B.size(); ++k)
      {
        const taut::Link &link = scene.links[k];
        is_mean[k] = scheme.has_mean_forces && (link.rigid() || scheme.projects);
        if (is_mean[k] && !link.unilateral())
          throw std::logic_error("the extended run has no joints with mean forces");
        for (const auto &[i, value] : B[k])
          if (scheme.projects && value != 0 && model.is_quasi_static(i))
            is_mean[k] = 0;
      }
    }

    void ExtendedRun::step(const unsigned int i)
    {
      if (i == 2 && scheme.name != c.scheme)
        prepare(c.scheme);
      const Number t = tau * i;
      for (std::size_t k = 0; k < B.size(); ++k)
        B[k] = model.constraint(scene.links[k], t);
      const ExtendedMotion before = motion;
      Vector v, a;
      scheme.look_back(before, v, a);
      const Number kappa = scheme.alpha_f / (1 - scheme.alpha_f),
                   now = (1 - scheme.alpha_m) / (1 - scheme.alpha_f),
                   old = scheme.alpha_m / (1 - scheme.alpha_f);
      const Vector P = model.load(t);
      Vector rhs = P + kappa * r - C.times(v) - M.times(now * a + old * before.A);
      // Mean forces of moving contacts: the balance has the last one in its old place.
      for (std::size_t k = 0; k < B.size(); ++k)
        if (is_mean[k] && scene.links[k].moving() && scheme.projects)
          for (const auto &[dof, value] : B[k])
            rhs[dof] -= value * N[k];
      find_multipliers(rhs, t);
      for (std::size_t k = 0; k < B.size(); ++k)
        if (is_mean[k])
          N[k] *= 1 - scheme.alpha_f;
      motion.U_old = before.U;
      motion.V_old = before.V;
      motion.V = scheme.velocity * motion.U + v;
      motion.A = scheme.acceleration * motion.U + a;
      if (scheme.projects)
        project(t);
      set_balance(P);
    }

    /// r = P + B N - C V - K U of the forces at the end of the step. Mean forces of moving contacts
    /// are in it, too, as the next step takes them off in their new place.
    void ExtendedRun::set_balance(const Vector &P)
    {
      r = P - C.times(motion.V) - K.times(motion.U);
      // Their roundings differ from step to step, so that what one gives the next does not take.
      const std::size_t step = answer.steps.size();
      for (std::size_t i = 0; as_double && i < r.size(); ++i)
        r[i] -= last_place(i + step) * elastic_terms(i);
      for (std::size_t k = 0; k < B.size(); ++k)
        if (!is_mean[k] || (scheme.projects && scene.links[k].moving()))
          for (const auto &[i, value] : B[k])
            r[i] += value * N[k];
      for (std::size_t i = 0; i < r.size(); ++i)
        if (model.held[i] || (scheme.projects && model.is_quasi_static(i)))
          r[i] = 0;
    }

    /// Velocities at the end of the step, and the forces of contacts with what their impulses take.
    void ExtendedRun::project(const Number &t)
    {
      std::vector<ProjectedContact> contacts;
      std::vector<std::size_t> index;
      for (std::size_t k = 0; k < B.size(); ++k)
      {
        if (!is_mean[k] || conserves(k) || !(N[k] > 0))
          continue;
        const taut::Link &link = scene.links[k];
        ProjectedContact contact;
        contact.form.resize(model.n_dofs());
        bool takes_part = true;
        for (const auto &[i, value] : B[k])
        {
          contact.form[i] += value;
          takes_part = takes_part && (value == 0 || !model.is_massless(i));
        }
        contact.rate = dot(B[k], motion.V) + dot(model.convection(link, t), motion.U);
        contact.impulse = tau * N[k];
        if (!link.rigid())
        {
          const Number flexibility = system.motion_of_force()[k] / (1 - scheme.alpha_f);
          takes_part = takes_part && flexibility > 0;
          if (takes_part)
            contact.softness = 1 / (Number(link.stiffness) * fading * flexibility);
          contact.softness *= contact.softness;
        }
        if (!takes_part)
          continue;
        contacts.push_back(std::move(contact));
        index.push_back(k);
      }
      projection->project(contacts, motion.V);
      for (std::size_t i = 0; i < index.size(); ++i)
        N[index[i]] = contacts[i].impulse / tau;
    }

    /// N, D and U of A U = P + B N. The mean force of an elastic contact counts the compression
    /// that this has at the start of the step; of one that conserves, all of its energy.
    void ExtendedRun::find_multipliers(const Vector &right_hand_side, const Number &t)
    {
      Vector past(Number(0), B.size());
      std::vector<std::optional<ConservingLaw>> laws(B.size());
      for (std::size_t k = 0; k < B.size(); ++k)
        if (conserves(k))
          laws[k].emplace(Number(scene.links[k].stiffness), -D[k]);
        else if (is_mean[k] && !scene.links[k].rigid() && D[k] < 0)
          past[k] = D[k];
      system.solve(right_hand_side, t, B, past, laws, N, D, motion.U);
    }

    /// sum_j |K_ij U_j|, which an elastic force rounds with.
    Number ExtendedRun::elastic_terms(const std::size_t i) const
    {
      Number sum = 0;
      for (std::size_t j = 0; j < model.n_dofs(); ++j)
        sum += abs(K(i, j) * motion.U[j]);
      return sum;
    }

    void ExtendedRun::observe()
    {
      Observation o;
      for (const ObservedPoint &p : points)
        o[p.rotational ? rotation : displacement].push_back(
            static_cast<double>(dot(model.motion(p.at, p.rotational, p.direction), motion.U)));
      Vector sum(Number(0), N.size());
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
      const Vector &flexibility = system.flexibility();
      for (std::size_t k = 0; k < N.size() && flexibility.size() > 0; ++k)
      {
        double &largest = scene.links[k].rotational ? answer.row_turn : answer.row_motion;
        largest = std::max(largest, static_cast<double>(abs(flexibility[k] * N[k])));
      }
      for (std::size_t i = 0; i < model.n_dofs(); ++i)
      {
        double &largest = model.is_rotation[i] ? answer.elastic_moment : answer.elastic_force;
        largest = std::max(largest, static_cast<double>(elastic_terms(i)));
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
