// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/text.h"
#include "output/fixed_links.h"
#include "output/impulse_of_step.h"
#include "output/signals.h"
#include <taut/base/archive.h>
#include <taut/output/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  }

  Statistics::Statistics(const StatisticsParameters &parameters, const Scene &scene,
                         const Constraints &rows)
      : parameters(parameters), lines(line_constants(scene)), spanned(spanned_wires(scene)),
        supports(scene)
  {
    for (SlidingContact &contact : sliding_contacts(scene, rows))
    {
      contacts.push_back({std::move(contact)});
      contacts.back().wires.resize(contacts.back().of.links.size());
      const std::size_t first = contacts.back().of.links[0];
      contacts.back().has_height = first < scene.links.size();
      if (first < scene.links.size() && scene.links[first].to.kind == Attachment::Kind::wire)
        contacts.back().wire = scene.links[first].to.index;
    }
    sums = contact_sums(parameters.sums, sliding_contacts(scene, rows));
    links.reserve(scene.links.size());
    index_of_link.assign(scene.links.size(), no_link);
    for (const FixedLink &of : fixed_links(scene, rows))
    {
      if (of.link >= index_of_link.size())
        index_of_link.resize(of.link + 1, no_link);
      index_of_link[of.link] = links.size();
      links.push_back({of.link, of.name, of.may_open, of.rotates});
      LinkQuantities &link = links.back();
      link.is_dropper =
          of.link < scene.links.size() && scene.links[of.link].kind == LinkKind::dropper;
      link.dropper.keeps_reversals = link.is_dropper && parameters.has_table("cycles");
    }
    for (const Probe &probe : scene.probes)
      probes.push_back({probe.name, probe.unit()});
  }

  void Statistics::find_sags(const Scene &scene, const SceneBodies &bodies, const BodyVectors &rest)
  {
    taut::find_sags(scene, bodies, rest, spanned);
  }

  void Statistics::record_links(const StepView &step, const double dt)
  {
    // Of each link: impulse in the step, mean force, and largest impulse.
    constexpr std::size_t n_values = 3;
    of_links.assign(n_values * index_of_link.size(), 0.);
    for (std::size_t i = 0; i < rows->size() && !rows->slides(i); ++i)
    {
      if (!(*rows)[i].is_link() || !rows->counts(i))
        continue;
      const std::size_t link = (*rows)[i].link;
      double *const values = of_links.data() + n_values * link;
      values[0] = impulse_of_step(*rows, step.report, i, links[index_of_link[link]].last_force,
                                  step.state.multiplier[i], dt);
      values[1] = step.measures.mean_force(i);
      values[2] = step.measures.largest_impulse(i);
    }
    rows->add_up(of_links);
    for (LinkQuantities &link : links)
    {
      const double force = step.links.force[link.link];
      const double *const values = of_links.data() + n_values * link.link;
      (force == 0. ? link.open_time : link.closed_time) += dt;
      link.impulse += values[0];
      link.last_force = force;
      if (link.is_dropper && dt == 0.)
        link.dropper.start(force);
      else if (link.is_dropper)
        link.dropper.add(force, dt);
      const double mean = link.unilateral ? values[1] : force;
      if (std::fabs(mean) > std::fabs(link.largest_force))
        link.largest_force = mean;
      link.largest_impulse = values[2];
    }
  }

  /// Height of the `from` end along the direction of the contact, over all ranks [m].
  double Statistics::height_of(Contact &contact, const StepView &step)
  {
    if (!contact.has_height)
      return 0.;
    const Link &link = step.scene.links[contact.of.links[0]];
    if (contact.foot.empty())
      step.structure.motion(link.from, false, link.direction, 1., contact.foot);
    double height =
        evaluate(contact.foot, step.reference.displacement) + evaluate(contact.foot, step.state.U);
    step.structure.communicator().sum(&height, 1);
    return height;
  }

  void Statistics::record_contacts(const StepView &step)
  {
    for (Contact &contact : contacts)
    {
      const double position =
          rows->position(rows->index_of_link(contact.of.links[0]), step.state.time);
      contact.places.insert(contact.places.end(), {position, height_of(contact, step)});
      for (std::size_t i = 0; i < contact.wires.size(); ++i)
      {
        const std::size_t row = rows->index_of_link(contact.of.links[i]);
        contact.wires[i].force.push_back(step.state.multiplier[row]);
        contact.wires[i].mean_force.push_back(step.measures.mean_force(row));
      }
    }
  }

  /// Whether a sliding contact is in the window now; true without such contacts.
  bool Statistics::is_in_window() const
  {
    return contacts.empty() ||
           std::any_of(contacts.begin(), contacts.end(),
                       [&](const Contact &contact)
                       { return parameters.is_in_window(*(contact.places.end() - 2)); });
  }

  void Statistics::record(const StepView &step)
  {
    const State &state = step.state;
    const bool is_start = times.empty();
    const double dt = is_start ? 0. : state.time - times.back();
    times.push_back(state.time);
    measures = &step.measures;
    rows = &step.constraints;
    record_contacts(step);
    record_links(step, dt);
    for (std::size_t i = 0; i < probes.size(); ++i)
    {
      ProbeQuantities &probe = probes[i];
      probe.last = step.probes[i];
      probe.largest = std::max(probe.largest, probe.last);
      probe.smallest = std::min(probe.smallest, probe.last);
    }
    supports.record(step.supports, dt, is_in_window());
    if (dt != 0.) // the start is no step
      record_residuals(step);
  }

  void Statistics::record_residuals(const StepView &step)
  {
    ++n_steps;
    n_iterations += step.residuals.iterations;
    n_fallbacks += step.residuals.fallback;
    if (step.residuals.complementarity > worst.complementarity)
    {
      worst.complementarity = step.residuals.complementarity;
      worst_complementarity_time = step.state.time;
    }
    if (step.residuals.balance > worst.balance)
    {
      worst.balance = step.residuals.balance;
      worst_balance_time = step.state.time;
    }
    worst.drift = std::max(worst.drift, step.residuals.drift);
  }

  template <typename Archive>
  void Statistics::store(Archive &archive)
  {
    archive &times &n_steps &n_iterations &n_fallbacks;
    archive &worst.complementarity &worst.balance &worst.drift;
    archive &worst_complementarity_time &worst_balance_time;
    for (Contact &contact : contacts)
    {
      archive &contact.places;
      for (ContactRecord &wire : contact.wires)
        archive &wire.force &wire.mean_force;
    }
    for (LinkQuantities &link : links)
      archive &link.open_time &link.closed_time &link.largest_force &link.impulse &link
          .largest_impulse &link.last_force &link.dropper;
    for (ProbeQuantities &probe : probes)
      archive &probe.largest &probe.smallest &probe.last;
    for (SpannedWire &wire : spanned)
      for (Span &span : wire.spans)
        archive &span.sag;
    archive &supports;
  }

  void Statistics::save(OutputArchive &archive)
  {
    store(archive);
  }

  void Statistics::resume(InputArchive &archive, const StepView &step)
  {
    store(archive);
    measures = &step.measures;
    rows = &step.constraints;
  }

  void Statistics::add_places(const Contact &contact, ContactRecord &record)
  {
    for (std::size_t i = 0; i < contact.places.size(); i += 2)
    {
      record.position.push_back(contact.places[i]);
      record.height.push_back(contact.places[i + 1]);
    }
  }

  ContactRecord Statistics::sum(const Contact &contact) const
  {
    ContactRecord result = sum_of(contact.wires);
    add_places(contact, result);
    return result;
  }

  /// The record with equal steps, low-passed as in measure().
  ContactRecord Statistics::judged(const Contact &contact) const
  {
    ContactRecord record = sum(contact).at_equal_steps(times);
    if (measure(contact).is_filtered)
      record.force = record.mean_force =
          low_pass(record.force, (times.back() - times.front()) / (record.force.size() - 1),
                   parameters.filter_frequency);
    return record;
  }

  ContactQuantities Statistics::measure(const Contact &contact) const
  {
    return ContactQuantities::of(sum(contact), times, parameters);
  }

  ContactQuantities Statistics::measure(const Contact &contact, ContactRecord wire) const
  {
    add_places(contact, wire);
    return ContactQuantities::of(wire, times, parameters);
  }

  ContactQuantities Statistics::measure(const ContactSum &sum) const
  {
    std::vector<ContactRecord> records;
    for (const ContactSum::Part &part : sum.parts)
      records.push_back(contacts[part.contact].wires[part.wire]);
    return measure(contacts[sum.parts[0].contact], sum_of(records));
  }

  std::vector<std::size_t> Statistics::links_of_sum(const std::string &name) const
  {
    std::vector<std::size_t> result;
    for (const ContactSum &sum : sums)
      for (const ContactSum::Part &part : sum.parts)
        if (sum.name == name)
          result.push_back(contacts[part.contact].of.links[part.wire]);
    return result;
  }

  std::vector<double> Statistics::expected_range(const std::string &quantity) const
  {
    const auto range = parameters.expected.find(quantity);
    return range != parameters.expected.end() && range->second.size() == 2 ? range->second
                                                                           : std::vector<double>();
  }

  std::vector<Statistics::Figure> Statistics::figures_of(const ContactQuantities &f,
                                                         const bool compared) const
  {
    const Moments &m = f.filtered, &r = f.raw;
    std::vector<Figure> list = {
        {"mean", "N", m.mean, r.mean},
        {"standard deviation", "N", m.deviation, r.deviation},
        {"mean + 3 standard deviations", "N", m.mean + 3. * m.deviation, r.mean + 3. * r.deviation},
        {"mean - 3 standard deviations", "N", m.mean - 3. * m.deviation, r.mean - 3. * r.deviation},
        {"maximum", "N", m.maximum, r.maximum},
        {"minimum", "N", m.minimum, r.minimum},
        {"standard deviation over mean", "1", m.mean > 0. ? m.deviation / m.mean : 0.},
        {"contact loss", "share", f.loss}};
    if (!compared)
      return list;
    for (Figure &figure : list)
      figure.expected = expected_range(capitalised(figure.name));
    if (std::vector<double> range = parameters.mean_force_range(f.speed); !range.empty())
      list.push_back({"mean at this speed", "N", m.mean, std::nan(""), std::move(range)});
    return list;
  }

  std::vector<Statistics::Figure> Statistics::details_of(const Contact &contact) const
  {
    const ContactFigures f = ContactFigures::of(sum(contact), times, parameters);
    const bool is_empty = measure(contact).n_samples == 0;
    const auto in_window = [&](const double value) { return is_empty ? not_known : value; };
    std::vector<Figure> list;
    for (const ContactFigures::Band &band : f.bands)
      list.push_back({to_text("standard deviation ", band.from, " to ", band.to, " Hz"), "N",
                      band.is_resolved ? band.deviation : not_known});
    for (const ContactFigures::Losses &l : f.losses)
    {
      const std::string duration = to_text(1e3 * l.longer_than, " ms");
      list.push_back({"losses over " + duration, "1", in_window(l.number)});
      list.push_back({"share of losses over " + duration, "share", in_window(l.share)});
      for (std::size_t i = list.size() - 2; i < list.size(); ++i)
        list[i].shown_if_zero = false;
    }
    if (contact.has_height)
      list.push_back({"height range", "m", in_window(f.height_range)});
    return list;
  }

  std::vector<Statistics::Figure> Statistics::figures_of_share(const ContactQuantities &share)
  {
    const Moments &m = share.raw;
    const auto in_window = [&](const double value)
    { return share.n_samples > 0 ? value : not_known; };
    return {{"mean share", "N", in_window(m.mean)},
            {"largest share", "N", in_window(m.maximum)},
            {"smallest share", "N", in_window(m.minimum)},
            {"standard deviation of the share", "N", in_window(m.deviation)},
            {"not touched", "share", in_window(share.loss)}};
  }

  std::vector<Statistics::Figure> Statistics::figures_of(const LineConstants &line)
  {
    const bool reflects = line.reflection > 0.;
    return {{"speed", "m/s", line.speed},
            {"wave speed", "m/s", line.wave_speed},
            {"speed over wave speed", "1", line.speed / line.wave_speed},
            {"doppler factor", "1", line.doppler},
            {"reflection at droppers", "1", reflects ? line.reflection : not_known},
            {"amplification", "1", reflects ? line.amplification : not_known}};
  }

  std::vector<Statistics::Figure> Statistics::figures_of(const SupportFigures::Figures &f)
  {
    const auto in_window = [&](const double value) { return f.n_samples > 0 ? value : not_known; };
    return {{"reaction at the start", f.unit, f.at_start},
            {"smallest reaction", f.unit, in_window(f.window.least)},
            {"largest reaction", f.unit, in_window(f.window.largest)},
            {"mean reaction", f.unit, in_window(f.window.mean)}};
  }

  std::vector<Statistics::Figure>
  Statistics::figures_of(const SpannedWire &wire, const Span &span,
                         const std::vector<ContactRecord> &records) const
  {
    double n_slackenings = 0.;
    for (const std::size_t link : span.droppers)
      if (const std::size_t own = index_of_link[link]; own != no_link)
        n_slackenings += links[own].dropper.n_slackenings;
    std::vector<Figure> list = {{"sag", "m", span.sag}, {"slackenings", "1", n_slackenings}};
    for (std::size_t c = 0; c < contacts.size(); ++c)
      if (const Contact &contact = contacts[c]; contact.wire == wire.wire)
      {
        const SpanForce f = SpanForce::of(span, records[c], parameters);
        const Moments &m = f.moments;
        for (const auto &[name, value] :
             {std::pair("mean", m.mean), std::pair("standard deviation", m.deviation),
              std::pair("maximum", m.maximum), std::pair("minimum", m.minimum)})
          list.push_back(
              {to_text(name, " of ", contact.of.name), "N", f.n_samples > 0 ? value : not_known});
      }
    return list;
  }

  std::vector<Statistics::Figure> Statistics::figures_of(const LinkQuantities &f)
  {
    const std::string force = f.rotates ? "N m" : "N";
    std::vector<Figure> list = {{"open time", "s", f.open_time},
                                {"closed time", "s", f.closed_time},
                                {"largest force", force, f.largest_force},
                                {"impulse", force + " s", f.impulse},
                                {"largest impulse", force + " s", f.largest_impulse}};
    if (f.is_dropper)
      list.insert(list.end(), {{"smallest force", force, f.dropper.least},
                               {"mean force", force, f.dropper.mean},
                               {"standard deviation of the force", force, f.dropper.deviation()},
                               {"slackenings", "1", static_cast<double>(f.dropper.n_slackenings)}});
    return list;
  }

  std::vector<Statistics::Figure> Statistics::figures_of(const ProbeQuantities &probe) const
  {
    return {{"largest", probe.unit, probe.largest, std::nan(""),
             probe.unit == "m" && parameters.has_uplift(probe.name) ? expected_range("Uplift")
                                                                    : std::vector<double>()},
            {"smallest", probe.unit, probe.smallest},
            {"last", probe.unit, probe.last}};
  }

  std::vector<Statistics::Item> Statistics::items() const
  {
    std::vector<Item> list;
    for (const Contact &contact : contacts)
    {
      const std::string &name = contact.of.name;
      list.push_back({{"sliding_contacts", name}, figures_of(measure(contact), false), true});
      list.push_back({{"sliding_contacts", name}, details_of(contact)});
      for (std::size_t i = 0; contact.of.is_strip && i < contact.wires.size(); ++i)
        list.push_back({{"sliding_contacts", name, "wires", contact.of.names[i]},
                        figures_of_share(measure(contact, contact.wires[i]))});
    }
    for (const LineConstants &line : lines)
      list.push_back({{"line_constants", line.contact}, figures_of(line)});
    for (const ContactSum &sum : sums)
      list.push_back({{"sums", sum.name}, figures_of(measure(sum), false), true});
    for (const ProbeQuantities &probe : probes)
      list.push_back({{"probes", probe.name}, figures_of(probe)});
    for (const LinkQuantities &link : links)
      list.push_back({{"links", link.name}, figures_of(link)});
    for (const SupportFigures::Figures &support : supports.of_supports())
      list.push_back({{"supports", support.name}, figures_of(support)});
    std::vector<ContactRecord> records; // filtered once for all spans
    for (const Contact &contact : contacts)
      records.push_back(spanned.empty() ? ContactRecord() : judged(contact));
    for (const SpannedWire &wire : spanned)
      for (const Span &span : wire.spans)
        list.push_back({{"spans", span.name}, figures_of(wire, span, records)});
    return list;
  }

  std::vector<NamedQuantity> Statistics::named_quantities() const
  {
    std::vector<NamedQuantity> list;
    for (const Item &item : items())
      for (const Figure &figure : item.figures)
        list.push_back({item.path.back(), figure.name, figure.value,
                        figure.unit == "share" ? "1" : figure.unit});
    return list;
  }
} // namespace taut
