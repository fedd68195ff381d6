// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of an author with exact results, and what an author may do wrong with one.
#ifndef taut_tests_door_bodies_h
#define taut_tests_door_bodies_h

#include <taut/base/exceptions.h>
#include <taut/substructure/substructure.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace library
{
  constexpr double gravity = 9.81, not_a_number = std::numeric_limits<double>::quiet_NaN(),
                   infinite = std::numeric_limits<double>::infinity();

  /// What is wrong with a body: at once, as soon as a place is asked for, or at the start.
  enum class Defect
  {
    none,
    no_stiffness,
    no_damping,
    not_finished,
    no_dofs,
    other_size_of_M,
    other_size_of_C,
    short_force,
    no_kinds,
    unknown_kind,
    negative_mass,
    mass_not_finite,
    stiffness_infinite,
    force_not_finite,
    prescribes_too_far,
    prescribes_twice,
    no_load,
    load_too_far,
    load_without_magnitude,
    short_null_space,
    null_space_not_finite,
    no_fixing_dof,
    fixing_dof_too_far,
    fixing_dof_twice,
    ragged_form, // from here on of places
    form_too_far,
    form_not_finite,
    short_start, // from here on of the start
    start_not_finite,
    load_not_finite,
    resized_load,
    motion_not_finite,
    not_linear
  };
  constexpr int first_of_places = static_cast<int>(Defect::ragged_form),
                first_of_starts = static_cast<int>(Defect::short_start),
                n_defects = static_cast<int>(Defect::not_linear) + 1;

  class ResizedLoad : public taut::TimeLoad
  {
  public:
    void add(double, std::vector<double> &P) const override { P.resize(P.size() + 3); }
  };

  /// Masses on a vertical chain: spring i is above mass i, the first one hangs from the ground, and
  /// with a first spring of zero the chain floats. DoF i is mass i upwards; a place is {i, 0, 0}.
  class Chain : public taut::Substructure
  {
  public:
    Chain(const std::string &name, const std::vector<double> &masses,
          const std::vector<double> &springs, const Defect defect = Defect::none)
        : Substructure(name), defect(defect), floats(springs[0] == 0.)
    {
      const unsigned int n = masses.size();
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        M->add(i, i, masses[i]);
        K->add(i, i, springs[i]);
        if (i > 0)
        {
          K->add(i - 1, i - 1, springs[i]);
          K->add(i, i - 1, -springs[i]);
        }
        constant_force.push_back(-gravity * masses[i]);
      }
      spoil(n);
      if (defect != Defect::not_finished)
        finish();
    }

    taut::LinearForm displacement(const taut::Coordinates &place,
                                  const taut::Coordinates &direction) const override
    {
      if (!(place.x >= 0.) || !(place.x < n_dofs()))
        throw taut::UserError("body '" + name() + "' has no such mass");
      taut::LinearForm form;
      form.add(static_cast<unsigned int>(place.x), direction.y);
      if (defect == Defect::ragged_form)
        form.index.push_back(0);
      if (defect == Defect::form_too_far)
        form.index[0] = n_dofs();
      if (defect == Defect::form_not_finite)
        form.value[0] = not_a_number;
      return form;
    }

    NullSpace null_space() const override
    {
      NullSpace result;
      if (floats || (defect >= Defect::short_null_space && defect <= Defect::fixing_dof_twice))
        result = {{std::vector<double>(n_dofs(), 1.)}, {0}};
      if (defect == Defect::short_null_space)
        result.vectors[0].pop_back();
      if (defect == Defect::null_space_not_finite)
        result.vectors[0][0] = infinite;
      if (defect == Defect::no_fixing_dof)
        result.fixing_dofs.clear();
      if (defect == Defect::fixing_dof_too_far)
        result.fixing_dofs[0] = n_dofs();
      if (defect == Defect::fixing_dof_twice)
        result = {{result.vectors[0], result.vectors[0]}, {0, 0}};
      return result;
    }

    void initial_state(std::vector<double> &U, std::vector<double> &V) const override
    {
      Substructure::initial_state(U, V);
      if (defect == Defect::short_start)
        U.pop_back();
      if (defect == Defect::start_not_finite)
        V[0] = not_a_number;
    }

    bool is_linear() const override { return defect != Defect::not_linear; }

  private:
    void spoil(const unsigned int n)
    {
      using taut::CompressedMatrix;
      const auto not_finite = [](double) { return not_a_number; };
      const auto add_load = [&](const unsigned int dof, const std::function<double(double)> &P)
      {
        taut::LinearForm form;
        form.add(dof, 1.);
        time_loads.push_back(std::make_unique<taut::PointLoad>(form, P));
      };
      const auto lose_dofs = [&]
      {
        for (auto *matrix : {&M, &C, &K})
          *matrix = std::make_unique<CompressedMatrix>(0);
        constant_force.clear();
      };
      const std::map<Defect, std::function<void()>> spoils = {
          {Defect::no_stiffness, [&] { K.reset(); }},
          {Defect::no_damping, [&] { C.reset(); }},
          {Defect::other_size_of_M, [&] { M = std::make_unique<CompressedMatrix>(n + 1); }},
          {Defect::other_size_of_C, [&] { C = std::make_unique<CompressedMatrix>(n - 1); }},
          {Defect::short_force, [&] { constant_force.pop_back(); }},
          {Defect::no_kinds, [&] { kinds.clear(); }},
          {Defect::unknown_kind, [&] { kinds = {7}; }},
          {Defect::no_dofs, lose_dofs},
          {Defect::negative_mass, [&] { M->add(0, 0, -1e9); }},
          {Defect::mass_not_finite, [&] { M->add(0, 0, not_a_number); }},
          {Defect::stiffness_infinite, [&] { K->add(0, 0, infinite); }},
          {Defect::force_not_finite, [&] { constant_force[0] = not_a_number; }},
          {Defect::prescribes_too_far,
           [&] {
             constrained = {{n, {}}};
           }},
          {Defect::prescribes_twice,
           [&] {
             constrained = {{0, {}}, {0, {}}};
           }},
          {Defect::motion_not_finite,
           [&] {
             constrained = {{0, not_finite}};
           }},
          {Defect::no_load, [&] { time_loads.push_back(nullptr); }},
          {Defect::resized_load, [&] { time_loads.push_back(std::make_unique<ResizedLoad>()); }},
          {Defect::load_too_far, [&] { add_load(n + 1000000, not_finite); }},
          {Defect::load_without_magnitude, [&] { add_load(0, nullptr); }},
          {Defect::load_not_finite, [&] { add_load(0, not_finite); }}};
      if (const auto found = spoils.find(defect); found != spoils.end())
        found->second();
    }

    const Defect defect;
    const bool floats;
  };

  inline std::unique_ptr<Chain> chain_of(const std::string &name, const std::vector<double> &masses,
                                         const std::vector<double> &springs,
                                         const Defect defect = Defect::none)
  {
    return std::make_unique<Chain>(name, masses, springs, defect);
  }

  /// A mass that moves along x, y and z, under its weight.
  class Bob : public taut::Substructure
  {
  public:
    Bob(const std::string &name, const double mass) : Substructure(name)
    {
      for (auto *matrix : {&M, &C, &K})
        *matrix = std::make_unique<taut::CompressedMatrix>(3);
      for (const unsigned int i : {0, 1, 2})
        M->add(i, i, mass);
      constant_force = {0., -gravity * mass, 0.};
      finish();
    }
    taut::LinearForm displacement(const taut::Coordinates &,
                                  const taut::Coordinates &direction) const override
    {
      taut::LinearForm form;
      for (const unsigned int i : {0, 1, 2})
        form.add(i, direction[i]);
      return form;
    }
    NullSpace null_space() const override
    {
      return {{{1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}, {0, 1, 2}};
    }
  };
} // namespace library

#endif
