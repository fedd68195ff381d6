// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "time/choose_scheme.h"
#include "time/contact_resolution.h"
#include "time/load_sampling.h"
#include "time/nonlinear_step.h"
#include "time/step.h"
#include "time/step_control.h"
#include "time/stored_rows.h"
#include "time/unseen_feature.h"
#include "time/velocity_projection.h"
#include <taut/base/archive.h>
#include <taut/base/exceptions.h>
#include <taut/time/motion.h>

#include <utility>

namespace taut
{
  /// The parts of a prepared motion.
  struct Motion::Parts
  {
    Parts(const Structure &structure, Constraints &constraints, const StepperOptions &options,
          const InitialState &initial, const std::vector<LongestStep> &longest_steps, long n_steps);

    /// What take_back() needs beside the vectors of the bodies, which the history has.
    struct Before
    {
      double time = 0., last_step = 0., step_before = 0.;
      long n_in_segment = 0, n_steps = 0;
      RowStates rows;
      Residuals residuals;
      StepReport report;
      std::vector<double> kinetic_energies;
      ByKind motion;
      ContactStep::Sizes sizes;
      std::vector<std::vector<double>> courses;
      std::vector<double> rates;
    };

    State state;
    Residuals residuals;
    const std::vector<char> quasi_static; ///< rows on DoFs without mass and damping
    StepMethod method;
    bool is_prepared = false; ///< the other parts, for the method
    NonlinearStep nonlinear;
    Step step;
    std::unique_ptr<LoadSampling> loads; ///< of adaptive steps
    LocalError errors;
    std::unique_ptr<VelocityProjection> projection; ///< for schemes with a velocity projection
    StepControl control;
    Before before;

    // Times of equal steps are multiples counted from their first start, and do not drift.
    double length;           ///< of the steps to come [s]
    double segment_start;    ///< start of the first step of this length [s]
    double step_before = 0.; ///< length of the step before the last one; 0: none [s]
    long n_in_segment = 0, n_steps = 0;
  };

  Motion::Parts::Parts(const Structure &structure, Constraints &constraints,
                       const StepperOptions &options, const InitialState &initial,
                       const std::vector<LongestStep> &longest_steps, const long n_steps)
      : state(initial.state), quasi_static(constraints.quasi_static()),
        nonlinear(structure, constraints, initial.reference, method),
        step(structure, constraints, options.solver, initial.reference, method, nonlinear.bodies(),
             nonlinear.constraints(), state),
        errors(structure, constraints, initial.reference),
        control(constraints, options.steps, options.step, n_steps, !nonlinear.is_linear(),
                longest_steps),
        length(options.step), segment_start(state.time)
  {
  }

  Motion::Motion(Structure &structure, Constraints &constraints, const StepperOptions &options)
      : structure(structure), constraints(constraints), options(options),
        initial(std::make_shared<const InitialState>(find_initial_state(
            structure, constraints, options.solver, options.start, options.step))),
        energy(structure, constraints, initial->reference, initial->state),
        contact_measures(structure, constraints, energy, initial->state)
  {
    contact_measures.set_scheme(options.scheme == "automatic", options.steps.adaptive());
  }

  namespace
  {
    StepperOptions in_other_steps(StepperOptions options, const double step,
                                  const StepParameters &steps)
    {
      options.step = step;
      options.steps = steps;
      options.allow_unsuitable_scheme = true; // as far as the other motion may, this one may, too
      return options;
    }

    Constraints &with_courses(Constraints &constraints,
                              const std::vector<std::vector<double>> &courses)
    {
      constraints.set_courses(courses);
      return constraints;
    }
  } // namespace

  Motion::Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
                 std::shared_ptr<const InitialState> start,
                 std::shared_ptr<const TimeIntegrator> scheme, const long n_steps,
                 std::vector<LongestStep> longest_steps)
      : structure(structure), constraints(constraints), options(options), initial(std::move(start)),
        energy(structure, constraints, initial->reference, initial->state),
        contact_measures(structure, constraints, energy, initial->state),
        integrator(std::move(scheme)), longest_steps(std::move(longest_steps))
  {
    begin(n_steps);
  }

  Motion::Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
                 InitialState start, std::shared_ptr<const TimeIntegrator> scheme,
                 const long n_steps, std::vector<LongestStep> longest_steps)
      : Motion(structure, constraints, options,
               std::make_shared<const InitialState>(std::move(start)), std::move(scheme), n_steps,
               std::move(longest_steps))
  {
  }

  Motion::Motion(Structure &structure, Constraints &constraints, const StepperOptions &options,
                 InitialState start, std::shared_ptr<const TimeIntegrator> scheme,
                 const long n_steps)
      : Motion(structure, constraints, options, std::move(start), std::move(scheme), n_steps, {})
  {
  }

  Motion::Motion(Motion &other, const double step, const StepParameters &steps,
                 std::vector<LongestStep> longest_steps, const long n_steps)
      : Motion(other.structure, with_courses(other.constraints, other.first_courses),
               in_other_steps(other.options, step, steps), other.initial, other.integrator, n_steps,
               std::move(longest_steps))
  {
  }

  Motion::~Motion() = default;

  bool Motion::is_finished() const
  {
    return !parts || parts->control.is_finished();
  }

  bool Motion::is_at_step() const
  {
    return parts->control.is_at_step();
  }

  long Motion::n_repeated() const
  {
    return parts ? parts->control.n_repeated() : 0;
  }

  const State &Motion::state() const
  {
    return parts ? parts->state : initial->state;
  }

  const Residuals &Motion::residuals() const
  {
    return has_moved() ? parts->residuals : initial->residuals;
  }

  const StepReport &Motion::report() const
  {
    return parts ? parts->step.report() : no_report;
  }

  const BodyVectors &Motion::loads() const
  {
    return parts ? parts->step.history().forces().P : initial->loads;
  }

  bool Motion::has_moved() const
  {
    return parts && parts->n_steps > 0;
  }

  long Motion::n_newton_iterations() const
  {
    return parts->nonlinear.n_iterations();
  }

  bool Motion::is_linear() const
  {
    return parts->nonlinear.is_linear();
  }

  InterfaceStatistics Motion::interface_statistics() const
  {
    return parts->step.interface_statistics();
  }

  const StepCosts &Motion::costs() const
  {
    return parts ? parts->step.costs() : no_costs;
  }

  StepCosts &Motion::costs()
  {
    return parts ? parts->step.costs() : no_costs;
  }

  const RowStates &Motion::rows_before() const
  {
    return parts->before.rows;
  }

  /// Made on demand only: its factors may be lost in rounding where those of the run are not.
  const ContactResolution &Motion::resolution()
  {
    if (!resolved)
      resolved =
          std::make_unique<ContactResolution>(structure, constraints, options.solver, options.step,
                                              options.steps.longest(options.step), options.end);
    return *resolved;
  }

  void Motion::choose_scheme()
  {
    std::map<std::string, std::string> entries = options.scheme_entries;
    chosen.name = options.scheme;
    if (options.scheme == "automatic")
      chosen = taut::choose_scheme(structure, constraints, resolution(), options.restitution);
    for (const auto &[path, value] : chosen.entries)
      entries[path] = value;
    integrator = make_integrator(chosen.name, entries);
  }

  std::string Motion::scheme() const
  {
    return integrator ? integrator->description() : "";
  }

  std::string Motion::scheme_and_reason() const
  {
    return scheme() + (chosen.reason.empty() ? "" : ", because " + chosen.reason);
  }

  void Motion::prepare(const long n_steps)
  {
    const double longest = options.steps.longest(options.step);
    integrator->coefficients(longest); // throws if its entries make no method
    check_mass(*integrator, structure);
    if (options.scheme != "automatic" && !options.allow_unsuitable_scheme)
      check_scheme(
          *integrator, structure, constraints,
          [this]() -> const ContactResolution & { return resolution(); }, options.solver, longest);
    if (integrator->rule(RowTraits()).corrected)
    {
      constraints.set_conserving(resolution().conserving());
      longest_steps = resolution().longest_steps(constraints);
      for (LongestStep &longest : longest_steps)
        longest.factor = options.steps.in_damped_contacts;
    }
    resolved.reset();
    begin(n_steps);
  }

  /// Sets all parts up at the start.
  void Motion::begin(const long n_steps)
  {
    const bool starts_itself = integrator->coefficients(options.step).starts_itself();
    first_scheme = starts_itself || options.start == Start::equilibrium
                       ? integrator
                       : make_integrator("backward Euler");
    constraints.update(initial->state.time);
    parts =
        std::make_unique<Parts>(structure, constraints, options, *initial, longest_steps, n_steps);
    parts->nonlinear.follow(parts->state);
    prepare_method(*first_scheme, first_scheme->coefficients(options.step));
    if (!starts_itself)
      return;
    structure.communicator().agree([this] { start_balance(); });
    parts->state.rate = constraints.motions(parts->state.V);
  }

  /// Sets r = P + B N - C V - K U at the start, where no scheme needs forces of rigid constraints.
  void Motion::start_balance()
  {
    State &state = parts->state;
    for (std::size_t k = 0; k < structure.size(); ++k)
    {
      std::vector<double> &r = state.balance[k];
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] = parts->step.history().forces().P[k][i] - state.KU[k][i];
      structure[k].damping().vmult_add(-1., state.V[k].data(), r.data());
    }
    std::vector<double> N = state.multiplier;
    for (std::size_t i = 0; i < constraints.size(); ++i)
      if (const RowRule &rule = parts->method.rules[i];
          rule.is_mean() && !(rule.corrected && constraints.slides(i)))
        N[i] = 0.;
    constraints.add_forces(N, state.balance);
    hold_quasi_static_dofs();
  }

  /// Puts quasi-static DoFs in equilibrium at the ends of steps, with a velocity projection.
  void Motion::hold_quasi_static_dofs()
  {
    if (parts->projection)
      for (std::size_t k = 0; k < structure.size(); ++k)
        for (const unsigned int dof : parts->projection->quasi_static_dofs()[k])
          parts->state.balance[k][dof] = 0.;
  }

  void Motion::prepare_method(const TimeIntegrator &scheme, const StepCoefficients &c)
  {
    Parts &p = *parts;
    p.is_prepared = false;
    p.method.set(scheme, c, p.length, constraints, p.quasi_static);
    p.nonlinear.prepare(p.state);
    p.step.prepare();
    if (p.method.corrects_velocities)
    {
      if (!p.projection)
        p.projection = std::make_unique<VelocityProjection>(structure, constraints, options.solver,
                                                            initial->reference);
      p.projection->prepare(c, p.length, p.step.contacts().compliance(),
                            p.step.equations().interface().matrix(), is_linear());
    }
    p.is_prepared = true;
  }

  void Motion::advance()
  {
    parts->control.advance(*this);
    costs().lap(StepPart::control);
    energy.record(state(), report(), loads());
    contact_measures.record(state(), report());
    costs().lap(StepPart::measures);
  }

  void Motion::try_step(const double length)
  {
    Parts &p = *parts;
    if (length != p.length)
    {
      p.length = length;
      p.segment_start = p.state.time;
      p.n_in_segment = 0;
    }
    keep();
    try
    {
      step_on();
    }
    catch (...)
    {
      const std::exception_ptr error = std::current_exception();
      try
      {
        take_back();
      }
      catch (...)
      {
        // A geometry that fails at the place before, too: the first error says why.
      }
      std::rethrow_exception(error);
    }
  }

  void Motion::keep()
  {
    Parts &p = *parts;
    Parts::Before &b = p.before;
    b.rows = p.state;
    b.time = p.state.time;
    b.last_step = p.state.last_step;
    b.step_before = p.step_before;
    b.n_in_segment = p.n_in_segment;
    b.n_steps = p.n_steps;
    b.residuals = p.residuals;
    b.report = p.step.report();
    b.kinetic_energies = energy.kinetic_energies();
    b.motion = p.errors.largest_motions;
    b.sizes = p.step.contacts().largest_sizes();
    constraints.copy_courses(b.courses);
    if (p.projection)
      b.rates = p.projection->largest_rates();
    else
      b.rates.clear();
    p.step.history().keep();
  }

  void Motion::take_back()
  {
    Parts &p = *parts;
    const Parts::Before &b = p.before;
    p.step.history().take_back(p.state);
    static_cast<RowStates &>(p.state) = b.rows;
    p.state.time = b.time;
    p.state.last_step = b.last_step;
    p.step_before = b.step_before;
    p.n_in_segment = b.n_in_segment;
    p.n_steps = b.n_steps;
    p.residuals = b.residuals;
    p.step.report() = b.report;
    energy.set_kinetic_energies(b.kinetic_energies);
    p.errors.largest_motions = b.motion;
    p.step.contacts().set_largest_sizes(b.sizes);
    if (p.projection && !b.rates.empty())
      p.projection->set_largest_rates(b.rates);
    constraints.set_courses(b.courses);
    constraints.update(p.state.time);
    p.nonlinear.return_to(p.state);
  }

  /// Reports a nonlinear step without solution, so that a shorter step can replace it.
  template <typename Work>
  void Motion::attempt(const Work &work)
  {
    try
    {
      work();
    }
    catch (const UserError &why)
    {
      if (!is_linear())
        throw StepNotSolved(why);
      throw;
    }
  }

  void Motion::step_on()
  {
    Parts &p = *parts;
    p.residuals = {};
    const double before = p.state.last_step;
    const TimeIntegrator &scheme = before == 0. ? *first_scheme : *integrator;
    const StepCoefficients c = before == 0. || before == p.length
                                   ? scheme.coefficients(p.length)
                                   : scheme.after_change(p.length, before);
    if (!p.is_prepared || c != p.method.c)
    {
      attempt([&] { prepare_method(scheme, c); });
      costs().lap(StepPart::factors);
    }
    begin_step();
    attempt([this] { solve(); });
    if (!options.allow_unsuitable_scheme)
      check_moving_contacts();
  }

  /// Sets the time at the end of the step, and the places of the constraints there.
  void Motion::begin_step()
  {
    Parts &p = *parts;
    State &state = p.state;
    const double start = state.time, before = state.last_step;
    p.step.contacts().begin_step(before == 0.);
    p.step.history().prescribed().begin_step(before);
    ++p.n_steps;
    p.step_before = before;
    state.time = p.segment_start + ++p.n_in_segment * p.length;
    state.last_step = p.length;
    p.step.check().set_time(state.time);
    attempt(
        [&] {
          constraints.follow(initial->reference.displacement, state.U, state.V, start, state.time);
        });
    constraints.update(state.time);
    costs().lap(StepPart::places);
    if (p.nonlinear.constraints().empty())
      p.step.equations().interface().update_moving();
    costs().lap(StepPart::moving_rows);
  }

  /// Finds the new state and its residuals.
  void Motion::solve()
  {
    Parts &p = *parts;
    if (is_linear())
    {
      p.step.set_loads(p.state);
      p.step.find_increments(p.state, p.residuals);
    }
    else
      p.nonlinear.find_increments(p.step, p.state, p.residuals);
    p.step.accept(p.state, p.residuals);
    p.step.certify(p.state, p.residuals);
    structure.communicator().agree([&] { p.nonlinear.bodies().set_own_force(p.state); });
    if (!p.nonlinear.constraints().empty())
    {
      // Turning constraints have the directions of the new state.
      p.nonlinear.follow(p.state);
      if (p.method.corrects_velocities)
        p.step.contacts().update_rates(p.state);
    }
    costs().lap(StepPart::nonlinear);
    if (p.method.corrects_velocities)
    {
      project_velocities();
      costs().lap(StepPart::projection);
    }
    energy.measure(p.step, p.nonlinear, p.state);
    costs().lap(StepPart::energy);
  }

  /// Sets the final velocities and forces of the step, and the balance for the next step.
  void Motion::project_velocities()
  {
    Parts &p = *parts;
    ContactStep &contacts = p.step.contacts();
    VelocityProjection::Residual of_rates;
    p.step.check().solve(
        [&] {
          of_rates =
              p.projection->project(contacts, p.state, p.step.equations().interface().matrix());
        });
    if (!(of_rates.largest <= p.residuals.complementarity))
    {
      p.residuals.complementarity = of_rates.largest;
      p.residuals.worst_constraint = constraints.number_of_first(of_rates.worst);
    }
    p.step.check().check_constraints(p.residuals);
    StepReport &report = p.step.report();
    for (std::size_t i = 0; i < constraints.size(); ++i)
      report.work[i] += p.projection->work()[i];
    report.impulse_work = constraints.total(p.projection->work());
    // Forces of moving constraints act half in their old place.
    for (const std::size_t i : constraints.sliding_rows())
      if (contacts.is_mean(i))
        constraints.add_force(i, p.state.multiplier[i], p.state.balance);
    hold_quasi_static_dofs();
  }

  /// Throws an EntryError if a moving elastic constraint acts as rigid in its place and the forces
  /// of the scheme then ring, see ContactResolution.
  void Motion::check_moving_contacts()
  {
    const StepMethod &method = parts->method;
    if (method.has_means() || !method.c.rings())
      return;
    const std::vector<double> &S = parts->step.contacts().compliance();
    ComplementarityOperator &F = parts->step.equations().interface().matrix();
    for (const std::size_t i : constraints.sliding_rows())
      if (constraints[i].cone.may_open() && S[i] > 0. && F.diagonal(i) > 2. * S[i] &&
          WholeBodies(constraints).flexibilities({i}, F)[i] > 2. * S[i])
        throw EntryError(
            constraints.origin(i),
            to_text("link '", constraints[i].name, "' acts as rigid at t = ", parts->state.time,
                    " s: there it is stiffer than the bodies in one step, which ", scheme(),
                    " does not suit. Take 'Moreau-Jean', or a smaller step"));
  }

  double Motion::local_error()
  {
    return parts->errors.measure(parts->state, parts->method, parts->step_before,
                                 parts->step.history().forces().old_A);
  }

  namespace
  {
    /// Searches for what the steps that see a feature do not see, and steps in each: some tenths of
    /// a second for a load.
    constexpr int most_searches = 4;
    constexpr double most_steps_of_search = 1e5;
  } // namespace

  const UnseenFeature &Motion::unseen_feature()
  {
    const LoadsAtStart loads = options.start == Start::equilibrium ? LoadsAtStart::balanced
                               : first_scheme == integrator        ? LoadsAtStart::seen
                                                                   : LoadsAtStart::unseen;
    if (unseen)
      return *unseen;
    unseen = std::make_unique<UnseenFeature>();
    if (!parts)
      return *unseen;
    const std::vector<Excitation> all = excitations(structure, constraints);
    const bool is_adaptive = options.steps.adaptive();
    const long n_steps = parts->control.n_steps();
    const auto find = [&](const Places places, const double step)
    {
      const auto n = static_cast<long>(static_cast<double>(n_steps) * options.step / step + .5);
      return find_unseen_feature(all, structure.communicator(), loads, initial->state.time, step,
                                 std::max(1L, n), places);
    };
    const auto take = [&](const UnseenFeature &found)
    {
      const double seeing = std::min(found.longest_step, unseen->longest_step);
      if (found.width < unseen->width)
        *unseen = found;
      unseen->longest_step = seeing;
      return found.is_complete;
    };
    take(find(Places::few, options.step));
    const UnseenFeature local =
        find(Places::many, is_adaptive ? options.steps.longest(options.step) : options.step);
    if (!is_adaptive)
      take(local);
    // Steps that see what is lost most may lose something narrower.
    const double length = static_cast<double>(n_steps) * options.step;
    for (int k = 0; k < most_searches && !unseen->name.empty() && !unseen->is_all_seen &&
                    length <= most_steps_of_search * unseen->longest_step;
         ++k)
    {
      const double longest = unseen->longest_step;
      bool is_complete = take(find(Places::few, longest));
      if (!is_adaptive)
        is_complete = take(find(Places::many, longest)) && is_complete;
      unseen->is_all_seen = is_complete && unseen->longest_step == longest;
    }
    if (is_adaptive && !local.name.empty())
      unseen->local = std::make_shared<const UnseenFeature>(local);
    return *unseen;
  }

  bool Motion::resolves_loads(const double length, const double tolerance)
  {
    if (!parts->loads)
      parts->loads = std::make_unique<LoadSampling>(excitations(structure, constraints),
                                                    structure.communicator(), options.step,
                                                    .25 * unseen_feature().width);
    return parts->loads->is_resolved(parts->state.time, length, tolerance);
  }

  std::string Motion::interface_description() const
  {
    return parts->step.equations().interface().description();
  }

  std::vector<std::size_t> Motion::repeated_joints() const
  {
    return parts->step.equations().repeated_rows().all_partners();
  }

  template <typename Archive>
  void Motion::store(Archive &archive)
  {
    Parts &p = *parts;
    ContactStep::Sizes sizes = p.step.contacts().largest_sizes();
    std::vector<std::vector<double>> courses = constraints.courses();
    const StoredRows rows(constraints, {p.state, p.step.report(), sizes.gaps, sizes.terms});
    if constexpr (Archive::is_saving::value)
      rows.gather();
    archive &p.state &p.residuals &p.step.report() & p.method.c;
    archive &sizes &courses;
    rows.pick();
    p.step.contacts().set_largest_sizes(sizes);
    constraints.set_courses(courses);
    archive &p.length &p.step_before &p.segment_start &p.n_in_segment &p.n_steps;
    for (double &size : p.errors.largest_motions)
      archive &size;
    std::vector<double> &opened = p.control.times_of_opening();
    const bool has_opened = constraints.any(!opened.empty());
    if (has_opened && Archive::is_saving::value)
    {
      const std::vector<double> own = opened;
      constraints.gather(own, opened);
    }
    archive &p.control;
    if (has_opened)
      constraints.pick(opened);
  }

  void Motion::save(OutputArchive &archive)
  {
    store(archive);
    const std::vector<double> largest_rates =
        parts->projection ? parts->projection->largest_rates() : std::vector<double>();
    std::vector<double> of_all;
    if (parts->projection)
      constraints.gather(largest_rates, of_all);
    archive << of_all;
    reset_caches(largest_rates);
    energy.save(archive);
    contact_measures.save(archive);
  }

  void Motion::load(InputArchive &archive, State state)
  {
    parts->state = std::move(state);
    store(archive);
    std::vector<double> largest_rates;
    archive >> largest_rates;
    if (!largest_rates.empty())
      constraints.pick(largest_rates);
    constraints.update(parts->state.time);
    parts->nonlinear.follow(parts->state);
    structure.communicator().agree(
        [&] { parts->step.history().set_external_forces(parts->state.time); });
    reset_caches(largest_rates);
    energy.load(archive);
    contact_measures.load(archive);
  }

  void Motion::discard_factors()
  {
    if (!parts)
      return;
    parts->step.reset();
    parts->is_prepared = false;
  }

  void Motion::reset_caches(const std::vector<double> &largest_rates)
  {
    Parts &p = *parts;
    p.step.reset();
    p.projection.reset();
    p.loads.reset();
    prepare_method(p.n_steps <= 1 ? *first_scheme : *integrator, StepCoefficients(p.method.c));
    if (p.projection && !largest_rates.empty())
      p.projection->set_largest_rates(largest_rates);
  }
} // namespace taut
