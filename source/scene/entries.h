// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_entries_h
#define taut_entries_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace taut
{
  /// Positions from "0, 1.5, 3" or from ranges first:step:last, "0:0.5:10, 12". Errors name @p
  /// entry.
  std::vector<double> parse_positions(const std::string &text, const std::string &entry);

  /// A number; EntryError for any other text.
  double parse_number(const std::string &text, const std::string &entry);

  /// A stiffness: a positive number, or "rigid" for infinity.
  double parse_stiffness(const std::string &text, const std::string &entry);

  /**
   * The law of a link from its entries under @p title: null for "linear", else a "table" of points
   * "elongation: force, ..." or a "formula" in d up to an elongation @p range [m, rad]. Throws
   * EntryError unless the law is 0 at 0 and increases.
   */
  std::shared_ptr<const ForceLaw> parse_law(const std::string &kind, const std::string &points,
                                            const std::string &formula, double range,
                                            const std::string &title);

  /// The law of a table of points "elongation: force, ..." [m, rad: N, N m], read from @p entry.
  /// Throws EntryError unless both increase from 0.
  std::shared_ptr<const ForceLaw> parse_table_law(const std::string &points,
                                                  const std::string &entry);

  /// The share of a property that a wire has left, as a function of s; zero for "1", all of it.
  /// Throws EntryError for a number that is not positive.
  Expression remaining_share(const std::string &formula, const std::string &entry);

  /// A point "x, y" or "x, y, z"; two numbers are in the plane z = 0.
  Coordinates parse_coordinates(const std::vector<double> &components, const std::string &entry);

  /// The unit vector along a direction; an EntryError if it is zero.
  Coordinates unit(const Coordinates &direction, const std::string &entry);

  /// A direction "x, y" or "x, y, z" of any length as a unit vector.
  Coordinates parse_direction(const std::vector<double> &components, const std::string &entry);

  /// The direction of a displacement or a force or, if @p rotational, the axis of a rotation or a
  /// moment, from the entries Direction and Axis of a section; the default direction is y, the
  /// default axis z. Throws EntryError if both are given, or the wrong entry.
  Coordinates parse_direction_or_axis(bool rotational, const std::vector<double> &direction,
                                      const std::vector<double> &axis, const std::string &section);

  /// Index of a wire or mass by its name; `ground` if there is none.
  template <typename Item>
  std::size_t find_name(const std::vector<Item> &items, const std::string &name)
  {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].name == name)
        return i;
    return ground;
  }

  /**
   * Attachments from "ground", "ground @ 1, 2", "mass", "wire @ 12.5", or several on one wire,
   * "wire @ 0:5:60"; on a body "plate @ 0.1, 0.2", or several, "plate @ 0.1, 0.2; 0.3, 0.2". An
   * unknown name is a UserError that lists the known names.
   */
  std::vector<Attachment> parse_attachments(const std::string &text, const Scene &scene,
                                            const std::string &entry);

  /// Whether a place is on a cable, so that its first coordinate is an unstressed arc length.
  bool is_on_cable(const Scene &scene, const Attachment &point);

  /// Place of an attachment in the undeformed scene. Places on a body are in the coordinates of the
  /// body, see SceneBodies::position(); the ground has a place only if one is given.
  Coordinates place(const Scene &scene, const Attachment &point);
} // namespace taut

#endif
