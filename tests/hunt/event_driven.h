// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_hunt_event_driven_h
#define taut_hunt_event_driven_h

#include "phase.h"

namespace hunt
{
  /// A motion that the reference cannot follow, with the reason.
  class NoReference : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  double size_of(const Vector &a, const Vector &b); ///< sum |a_i b_i|

  /// The motion of a linear model between events by the exponential of its matrix, and events where
  /// they happen: a constraint closes, opens, or reaches the next straight piece of its law. At a
  /// rigid one Newton's law of impact holds, for all that touch at once. The program takes no part.
  class EventDriven
  {
  public:
    /// @p restitution of rigid unilateral constraints; compressions stay far below @p reach [m].
    /// @p duration is that of the motion [s]. @p fineness divides the steps between which events
    /// are looked for; @p disturbance is added to the start, relative to its size.
    EventDriven(const LinearModel &model, double restitution, double reach, double duration,
                double fineness = 1., double disturbance = 0.);

    void advance(double end); ///< throws NoReference after too much work
    Sample sample();

  private:
    /// Of the rows that may change next, the value that is not negative as long as they do not.
    struct Watched
    {
      std::size_t row;
      int change; ///< of its mode
      Vector value;
      bool relaxes;
    };

    void set_start(double disturbance);
    void move(double end);
    const Phase &phase();
    const std::vector<Watched> &watched();
    double value(const Watched &event, const Vector &z, double t) const;
    double rounding(const Watched &event, const Vector &z) const;
    double root(const Watched &event, double step, double at_end);
    bool find_event(const Vector &next, double step);
    void change(const Watched &event);
    void impact();
    bool impulses(const std::vector<std::size_t> &touching, unsigned int set, double e, Vector &p);
    void choose_closed(const std::vector<std::size_t> &touching);
    double relaxed(std::size_t row, double t) const;
    void spend(double work);

    const LinearModel &model;
    ModelParts parts;
    const double restitution, largest_step, fineness;
    Modes modes;
    Vector state;                    ///< see Phase
    double time = 0.;                ///< [s]
    std::vector<double> opened, set; ///< of damped rows: when they opened, and how compressed
    std::map<Modes, Phase> phases;
    std::map<Modes, std::vector<Watched>> watches;
    double speed = 0., work = 0.;
    unsigned int n_events = 0, n_at_once = 0;
    int n_kinks = 0; ///< of the pulse, that are past
  };

  /// Samples at the given times, the first of which is 0.
  History event_driven_history(const LinearModel &model, double restitution, double reach,
                               const std::vector<double> &times, double fineness = 1.,
                               double disturbance = 0.);
} // namespace hunt

#endif
