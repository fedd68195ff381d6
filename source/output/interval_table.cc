// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/archive.h>
#include <taut/output/interval_table.h>

#include <algorithm>

namespace taut
{
  void IntervalTable::add_value(const std::string &name, const std::string &unit)
  {
    columns.push_back({name, unit, Kind::value});
  }

  void IntervalTable::add_quantity(const std::string &name, const std::string &unit)
  {
    columns.push_back({name, unit, interval > 0. ? Kind::quantity : Kind::value});
  }

  void IntervalTable::add_state(const std::string &name)
  {
    columns.push_back({name, "1", Kind::state});
  }

  void IntervalTable::open(const std::string &path, const bool goes_on)
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
    file = std::make_unique<CsvFile>(path, header, goes_on);
  }

  void IntervalTable::record(const double now, const std::vector<double> &values)
  {
    time = now;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      Column &column = columns[i];
      column.n_changes += has_started && values[i] != column.last;
      column.last = values[i];
      column.least = std::min(column.least, values[i]);
      column.largest = std::max(column.largest, values[i]);
    }
    has_started = is_pending = true;
    // A step counts as due if it is within rounding of its time.
    if (time >= next - 1e-9 * interval)
      write_line();
  }

  void IntervalTable::write_line()
  {
    file->begin_line(time);
    for (Column &column : columns)
    {
      if (column.kind != Kind::state)
        *file << column.last;
      else if (interval > 0.)
        *file << column.n_changes;
      if (column.kind == Kind::quantity)
        *file << column.least << column.largest;
      column.least = std::numeric_limits<double>::infinity();
      column.largest = -column.least;
      column.n_changes = 0;
    }
    file->end_line();
    next = time + interval;
    is_pending = false;
  }

  void IntervalTable::save(OutputArchive &archive)
  {
    if (!file)
      return;
    archive << time << next << has_started << is_pending;
    for (const Column &column : columns)
      archive << column.last << column.least << column.largest << column.n_changes;
    const std::size_t length = file->save();
    archive << length;
  }

  void IntervalTable::load(InputArchive &archive)
  {
    if (!file)
      return;
    archive >> time >> next >> has_started >> is_pending;
    for (Column &column : columns)
      archive >> column.last >> column.least >> column.largest >> column.n_changes;
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
