// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/output/interval_table.h>

#include <algorithm>
#include <limits>

namespace taut
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
  } // namespace

  void IntervalTable::add(const std::string &name, const std::string &unit, const Kind kind)
  {
    columns.push_back({name, unit, kind});
    last.push_back(0.);
    least.push_back(infinity);
    largest.push_back(-infinity);
    n_changes.push_back(0);
  }

  void IntervalTable::add_value(const std::string &name, const std::string &unit)
  {
    add(name, unit, Kind::value);
  }

  void IntervalTable::add_quantity(const std::string &name, const std::string &unit)
  {
    add(name, unit, interval > 0. ? Kind::quantity : Kind::value);
  }

  void IntervalTable::add_state(const std::string &name)
  {
    add(name, "1", Kind::state);
  }

  void IntervalTable::open(const TableFormat format, const std::string &stem, const bool goes_on)
  {
    std::vector<std::string> header = {"time [s]"};
    for (const Column &column : columns)
    {
      const std::string unit = " [" + column.unit + "]";
      if (column.kind != Kind::state)
        header.push_back(column.name + unit);
      else if (interval > 0.)
        header.push_back(column.name + " changes" + unit);
      if (column.kind == Kind::quantity)
      {
        header.push_back(column.name + " least" + unit);
        header.push_back(column.name + " largest" + unit);
      }
    }
    file = std::make_unique<TableFile>(format, stem, header, goes_on);
  }

  void IntervalTable::open_long(const std::string &stem, const std::vector<std::string> &heads,
                                const bool goes_on)
  {
    is_long = true;
    std::vector<std::string> header = {"time [s]", "name"};
    for (const std::string &head : heads)
    {
      header.push_back(head);
      for (const char *const kind : {" least", " largest"})
        if (interval > 0.)
          header.push_back(std::string(head).insert(head.find(" ["), kind));
    }
    if (interval > 0.)
      header.emplace_back("changes [1]");
    file = std::make_unique<TableFile>(TableFormat::csv, stem, header, goes_on);
  }

  void IntervalTable::write_long()
  {
    for (std::size_t k = 0; k < items.size(); ++k)
    {
      const std::size_t end = k + 1 < items.size() ? items[k + 1].first : columns.size();
      double changes = 0.; // none of what has no state
      file->begin_line(time) << items[k].name;
      for (std::size_t i = items[k].first; i < end; ++i)
        if (columns[i].kind == Kind::state)
          changes = n_changes[i];
        else if (*file << last[i]; interval > 0.)
          *file << least[i] << largest[i];
      if (interval > 0.)
        *file << changes;
      file->end_line();
    }
  }

  void IntervalTable::record(const double now, const std::vector<double> &values)
  {
    time = now;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      if (columns[i].kind == Kind::state)
        n_changes[i] += has_started && values[i] != last[i];
      least[i] = std::min(least[i], values[i]);
      largest[i] = std::max(largest[i], values[i]);
    }
    last = values;
    has_started = is_pending = true;
    // A step within rounding of its time is due.
    if (time >= next - 1e-9 * interval)
      write_line();
  }

  void IntervalTable::write_line()
  {
    line.clear();
    for (std::size_t i = 0; i < columns.size() && !is_long; ++i)
    {
      const Kind kind = columns[i].kind;
      if (kind != Kind::state)
        line.push_back(last[i]);
      else if (interval > 0.)
        line.push_back(n_changes[i]);
      if (kind == Kind::quantity)
      {
        line.push_back(least[i]);
        line.push_back(largest[i]);
      }
    }
    if (is_long)
      write_long();
    else
      file->add_line(time, line);
    std::fill(least.begin(), least.end(), infinity);
    std::fill(largest.begin(), largest.end(), -infinity);
    std::fill(n_changes.begin(), n_changes.end(), 0);
    next = time + interval;
    is_pending = false;
  }

  template <typename Archive>
  void IntervalTable::store(Archive &archive)
  {
    archive &time &next &has_started &is_pending &last &least &largest &n_changes;
  }

  void IntervalTable::save(OutputArchive &archive)
  {
    if (!file)
      return;
    store(archive);
    const std::size_t length = file->save();
    archive << length;
  }

  void IntervalTable::load(InputArchive &archive)
  {
    if (!file)
      return;
    store(archive);
    std::size_t length = 0;
    archive >> length;
    file->resume(length);
  }

  void IntervalTable::close()
  {
    if (!file)
      return;
    if (is_pending)
      write_line();
    file->close();
  }
} // namespace taut
