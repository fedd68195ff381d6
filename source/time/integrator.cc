// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "time/named_scheme.h"
#include <taut/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace taut
{
  bool StepCoefficients::operator==(const StepCoefficients &o) const
  {
    return std::tie(velocity, acceleration, v_V, v_A, v_dU, a_V, a_A, a_dU, a_V_old, alpha_m,
                    alpha_f, restitution) == std::tie(o.velocity, o.acceleration, o.v_V, o.v_A,
                                                      o.v_dU, o.a_V, o.a_A, o.a_dU, o.a_V_old,
                                                      o.alpha_m, o.alpha_f, o.restitution);
  }

  double StepCoefficients::ringing() const
  {
    // V = v_V V0 + v_A A0, A = a_V V0 + a_A A0, and N = -old_balance N0 + ...; steps further back
    // have no effect after two steps.
    const double half_trace = .5 * (v_V + a_A), determinant = v_V * a_A - v_A * a_V,
                 discriminant = half_trace * half_trace - determinant;
    const double radius = discriminant < 0. ? std::sqrt(determinant)
                                            : std::fabs(half_trace) + std::sqrt(discriminant);
    return std::max(radius, std::fabs(old_balance()));
  }

  std::unique_ptr<TimeIntegrator> make_integrator(const std::string &name,
                                                  const std::map<std::string, std::string> &entries)
  {
    std::unique_ptr<TimeIntegrator> result = Registry<TimeIntegrator>::instance().create(name);
    dealii::ParameterHandler prm;
    result->declare_parameters(prm);
    for (const auto &[path, value] : entries)
      set_declared_entry(path, value, prm);
    return result;
  }

  StepCoefficients backward_euler(const double step)
  {
    StepCoefficients c;
    c.velocity = 1. / step;
    c.acceleration = 1. / (step * step);
    c.a_V = -1. / step;
    return c;
  }

  StepCoefficients bdf2(const double step)
  {
    return bdf2(step, step);
  }

  StepCoefficients bdf2(const double step, const double last_step)
  {
    // V = [(1 + b) dU - b w dU0] / step, A = [(1 + b) V - (1 + w) V0 + b w V_{-1}] / step; equal
    // steps: V = (3 dU - dU0) / (2 step), A = (3 V - 4 V0 + V_{-1}) / (2 step).
    const double w = step / last_step, b = w / (1. + w);
    StepCoefficients c;
    c.velocity = (1. + b) / step;
    c.v_dU = -b * w / step;
    c.acceleration = c.velocity * c.velocity;
    c.a_dU = c.velocity * c.v_dU;
    c.a_V = -(1. + w) / step;
    c.a_V_old = b * w / step;
    return c;
  }

  StepCoefficients newmark(const double step, const double beta, const double gamma,
                           const double alpha_m, const double alpha_f)
  {
    if (!(beta > 0.) || !(gamma >= .5))
      throw UserError("Newmark needs beta > 0 (it is solved for the displacement) and gamma >= 1/2 "
                      "(or it is unstable)");
    StepCoefficients c;
    c.velocity = gamma / (beta * step);
    c.v_V = 1. - gamma / beta;
    c.v_A = step * (1. - gamma / (2. * beta));
    c.acceleration = 1. / (beta * step * step);
    c.a_V = -1. / (beta * step);
    c.a_A = 1. - 1. / (2. * beta);
    c.alpha_m = alpha_m;
    c.alpha_f = alpha_f;
    return c;
  }

  StepCoefficients generalised_alpha(const double step, const double rho)
  {
    if (!(rho >= 0.) || !(rho <= 1.))
      throw UserError("the spectral radius of generalised-alpha lies in [0, 1]");
    const double alpha_m = (2. * rho - 1.) / (rho + 1.), alpha_f = rho / (rho + 1.);
    const double gamma = .5 - alpha_m + alpha_f,
                 beta = .25 * (1. - alpha_m + alpha_f) * (1. - alpha_m + alpha_f);
    return newmark(step, beta, gamma, alpha_m, alpha_f);
  }

  StepCoefficients hht(const double step, const double alpha)
  {
    if (!(alpha >= 0.) || !(alpha <= 1. / 3.))
      throw UserError("alpha of the HHT method lies in [0, 1/3]");
    return newmark(step, .25 * (1. + alpha) * (1. + alpha), .5 + alpha, 0., alpha);
  }

  StepCoefficients moreau_jean(const double step, const double theta, const double restitution)
  {
    if (!(theta >= .5) || !(theta <= 1.) || !(restitution >= 0.) || !(restitution <= 1.))
      throw UserError("theta of Moreau-Jean lies in [1/2, 1] and the restitution in [0, 1]");
    StepCoefficients c;
    c.velocity = 1. / (theta * step);
    c.v_V = -(1. - theta) / theta;
    c.acceleration = 1. / (theta * step * step);
    c.a_V = -1. / (theta * step);
    c.alpha_f = 1. - theta;
    c.restitution = restitution;
    return c;
  }

  namespace
  {
    class BackwardEuler : public TimeIntegrator
    {
    public:
      StepCoefficients coefficients(const double step) const override
      {
        return backward_euler(step);
      }
      std::string description() const override { return "backward Euler"; }
    };

    class BDF2 : public TimeIntegrator
    {
    public:
      StepCoefficients coefficients(const double step) const override { return bdf2(step); }
      StepCoefficients after_change(const double step, const double last_step) const override
      {
        return bdf2(step, last_step);
      }
      std::string description() const override { return "BDF2"; }
    };

    class Newmark : public TimeIntegrator
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override
      {
        prm.enter_subsection("Newmark");
        prm.add_parameter("Beta", beta,
                          "Weight of the new acceleration in the displacement; from Gamma / 2 on "
                          "every step is stable, less is stable up to a step, and more accurate: "
                          "with 1/12 of fourth order in smooth free motions [1]",
                          dealii::Patterns::Double(0., 1.));
        prm.add_parameter(
            "Gamma", gamma,
            "Weight of the new acceleration in the velocity; 1/2 is second order, more "
            "dissipates and is first order [1]",
            dealii::Patterns::Double(.5, 2.));
        prm.leave_subsection();
      }
      StepCoefficients coefficients(const double step) const override
      {
        if (!(beta > 0.))
          throw EntryError("Time/Newmark/Beta",
                           "Newmark is solved for the displacement and needs a positive one");
        return newmark(step, beta, gamma);
      }
      /// Hughes, The Finite Element Method, 1987, section 9.1.
      double largest_stable_frequency(const double step) const override
      {
        return beta < .5 * gamma ? 1. / (step * std::sqrt(.5 * gamma - beta))
                                 : TimeIntegrator::largest_stable_frequency(step);
      }
      std::string description() const override
      {
        return to_text("Newmark (beta ", beta, ", gamma ", gamma, ")");
      }

    private:
      double beta = .25, gamma = .5;
    };

    class GeneralisedAlpha : public TimeIntegrator
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override
      {
        prm.enter_subsection("Generalised-alpha");
        prm.add_parameter(
            "Spectral radius", rho,
            "Spectral radius at infinite frequency: 1 keeps all energy, 0 removes the "
            "highest frequencies in one step [1]",
            dealii::Patterns::Double(0., 1.));
        prm.leave_subsection();
      }
      StepCoefficients coefficients(const double step) const override
      {
        return generalised_alpha(step, rho);
      }
      std::string description() const override
      {
        return to_text("generalised-alpha (spectral radius ", rho, ")");
      }

    private:
      double rho = .8;
    };

    class HHT : public TimeIntegrator
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override
      {
        prm.enter_subsection("HHT");
        prm.add_parameter("Alpha", alpha,
                          "Weight of the old forces in the balance (minus the alpha of Hilber, "
                          "Hughes and Taylor): 0 keeps all energy, 1/3 dissipates most [1]",
                          dealii::Patterns::Double(0., 1. / 3.));
        prm.leave_subsection();
      }
      StepCoefficients coefficients(const double step) const override { return hht(step, alpha); }
      std::string description() const override { return to_text("HHT (alpha ", alpha, ")"); }

    private:
      double alpha = .1;
    };

    class MoreauJean : public TimeIntegrator
    {
    public:
      void declare_parameters(dealii::ParameterHandler &prm) override
      {
        prm.enter_subsection("Moreau-Jean");
        prm.add_parameter("Theta", theta,
                          "Weight of the new forces and velocities: 1/2 keeps the energy of "
                          "vibrations and is second order, 1 is first order [1]",
                          dealii::Patterns::Double(.5, 1.));
        prm.add_parameter("Restitution", rebound,
                          "Newton's coefficient: velocity of separation over that of approach at "
                          "rigid unilateral links. An elastic body rebounds by its own waves with "
                          "0; of a rigid one it says how much [1]",
                          dealii::Patterns::Double(0., 1.));
        prm.add_parameter(
            "Conditions", conditions,
            "What rigid links ask for. 'gaps then velocities': no penetration at the end of a "
            "step, "
            "and then no approach, by impulses: second order, and a fixed link never gives energy; "
            "with Theta 1/2 only. 'velocities': no approach at the end of a step in which they "
            "touch; gaps are open to a step of motion. 'gaps': no penetration at its end, and no "
            "restitution; with Theta 1/2 for linear elements with the mass matrix 'reduced' and "
            "steps of element over wave speed, which carry fronts undistorted",
            dealii::Patterns::Selection("gaps then velocities|velocities|gaps"));
        prm.leave_subsection();
      }
      StepCoefficients coefficients(const double step) const override
      {
        if (is_projected() && theta != .5)
          throw EntryError("Time/Moreau-Jean/Theta",
                           "conditions on gaps, then velocities, are for Theta 1/2; set it to 0.5, "
                           "or 'Conditions' to 'gaps' or 'velocities'");
        if (conditions == "gaps" && rebound > 0.)
          throw EntryError("Time/Moreau-Jean/Restitution",
                           "restitution is a law of velocities; set it to 0, or 'Conditions' to "
                           "'gaps then velocities'");
        return moreau_jean(step, theta, rebound);
      }

      /**
       * 'velocities': M. Jean (1999). 'gaps': a mean force N does the work N (D - D_0) = -N D_0 <=
       * 0 at the end of the step, and never adds energy; bilateral constraints are at velocity
       * level, as under D = 0 their velocities alternate for ever at theta = 1/2. 'gaps then
       * velocities': constraints hold for both at the end of each step (C. W. Gear, B. Leimkuhler,
       * G. K. Gupta, J. Comput. Appl. Math. 12-13 (1985); O. Brüls, V. Acary, A. Cardona, Comput.
       * Methods Appl. Mech. Engrg. 281 (2014)); elastic ones that open or turn have mean forces,
       * too. Forces on quasi-static DoFs remain those at the end of the step, where they hold them
       * in equilibrium.
       */
      RowRule rule(const RowTraits &row) const override
      {
        using Condition = RowRule::Condition;
        if (is_projected())
        {
          const bool is_mean = (row.is_rigid || row.may_open || row.turns) && !row.is_quasi_static;
          return {Condition::gap, is_mean ? ForceTime::mean : ForceTime::end, is_mean};
        }
        if (!row.is_rigid)
          return {};
        return {conditions == "gaps" && row.may_open ? Condition::gap : Condition::velocity,
                ForceTime::mean, false};
      }
      ForceTime internal_forces() const override { return ForceTime::mean; }
      double restitution() const override { return rebound; }
      std::string description() const override
      {
        std::ostringstream out;
        out << "Moreau-Jean (theta " << theta << ", " << conditions;
        if (conditions != "gaps")
          out << ", restitution " << rebound;
        out << ')';
        return out.str();
      }

    private:
      bool is_projected() const { return conditions == "gaps then velocities"; }

      double theta = .5, rebound = 0.;
      std::string conditions = "gaps then velocities";
    };

    const Register<TimeIntegrator, BackwardEuler> register_backward_euler(
        "backward Euler", "first order, dissipates; forces of rigid unilateral links never ring");
    const Register<TimeIntegrator, BDF2>
        register_bdf2("BDF2",
                      "second order, dissipates high frequencies; at rigid unilateral links "
                      "bodies rebound at random");
    const Register<TimeIntegrator, Newmark>
        register_newmark("Newmark", "second order at gamma 1/2; for smooth problems, compliant "
                                    "links, and rigid ones with 'Mass redistribution'");
    const Register<TimeIntegrator, GeneralisedAlpha>
        register_generalised_alpha("generalised-alpha",
                                   "second order, dissipation chosen by the spectral radius; for "
                                   "compliant links, with spectral radius 0 for rigid ones");
    const Register<TimeIntegrator, MoreauJean> register_moreau_jean(
        "Moreau-Jean",
        "theta method with impulses, for rigid unilateral links: conditions on gaps, on "
        "velocities, or on both, and restitution");
    const Register<TimeIntegrator, HHT>
        register_hht("HHT", "second order, dissipation chosen by alpha; for smooth problems, "
                            "compliant links, and rigid ones with 'Mass redistribution'");
  } // namespace
} // namespace taut
