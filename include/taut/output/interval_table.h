// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_interval_table_h
#define taut_interval_table_h

#include <taut/base/archive_forward.h>
#include <taut/output/table_file.h>

#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /// A table of quantities in time, with a line each step or lines at least an interval apart. With
  /// an interval, a quantity has its value at the time of the line, and the extremes since the line
  /// before, "a force least [N]". Hence no peak is lost.
  class IntervalTable
  {
  public:
    /// @p interval [s]; 0: every step.
    explicit IntervalTable(const double interval = 0.) : interval(interval) {}

    /// The columns that are added from here on are those of this item, with its name in front.
    void begin_item(const std::string &name) { items.push_back({name, columns.size()}); }

    /// Adds a smooth quantity, without extremes.
    void add_value(const std::string &name, const std::string &unit);

    /// Adds a quantity with extremes, if there is an interval.
    void add_quantity(const std::string &name, const std::string &unit);

    /// Adds the number of changes of a state since the line before, if there is an interval.
    void add_state(const std::string &name);

    bool is_empty() const { return columns.empty(); }

    /// Creates the file @p stem.csv or @p stem.bin; if it @p goes_on, leaves it for load(). Throws
    /// UserError on failure.
    void open(TableFormat format, const std::string &stem, bool goes_on = false);

    /// The same with a line for each item and time, in the place of columns for each item. Each
    /// item has as many values and quantities as there are @p heads, and one state at most.
    void open_long(const std::string &stem, const std::vector<std::string> &heads,
                   bool goes_on = false);

    /// Records one step at a time [s]: a value for each column in the order of their addition; for
    /// a state, a number that changes with it. Throws UserError if the disk is full.
    void record(double time, const std::vector<double> &values);

    /// Writes also the steps since the last line. Throws UserError if the disk is full.
    void close();

    /// Stores the position for a checkpoint, with all records on the disk.
    void save(OutputArchive &archive);
    void load(InputArchive &archive);

  private:
    enum class Kind
    {
      value,
      quantity,
      state
    };

    struct Column
    {
      std::string name, unit;
      Kind kind;
    };

    void add(const std::string &name, const std::string &unit, Kind kind);
    void write_line();
    void write_long();
    template <typename Archive>
    void store(Archive &archive);

    double interval, time = 0., next = 0.;
    bool has_started = false, is_pending = false;
    std::vector<Column> columns;
    std::vector<double> last, least, largest; ///< of each column
    std::vector<unsigned int> n_changes;      ///< of each state
    std::vector<double> line;

    struct Item
    {
      std::string name;
      std::size_t first; ///< of its columns
    };
    std::vector<Item> items;
    bool is_long = false;
    std::unique_ptr<TableFile> file;
  };
} // namespace taut

#endif
