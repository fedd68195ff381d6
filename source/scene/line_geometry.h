// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_line_geometry_h
#define taut_line_geometry_h

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// A mast of an overhead line, or an end of it. Lengths are in m.
  struct LineMast
  {
    double x = 0.;             ///< from the begin of the line
    double height = 0.;        ///< of the contact wire
    double encumbrance = 0.;   ///< of the messenger wire over the contact wire
    double contact_z = 0.;     ///< stagger of the contact wire
    double messenger_z = 0.;   ///< stagger of the messenger wire
    double stitch_length = 0.; ///< 0: no stitch wire
    double mid_point = 0.;     ///< between the clamps of its ropes on the contact wire; 0: none
  };

  /// A dropper of an overhead line. Lengths are in m.
  struct LineDropper
  {
    double x = 0.;       ///< from the begin of the line
    double pre_sag = 0.; ///< depth of the contact wire below the line between its heights
    double length = 0.;  ///< unstressed; 0: found from the height
    double built = 0.;   ///< under its force where its stiffness and mass are known; 0: unstressed
  };

  /// Where the parts of one tension length are.
  struct LineLayout
  {
    double begin = 0.;  ///< x of the first mast in the scene [m]
    double offset = 0.; ///< z of the straight wires [m]
    std::vector<LineMast> masts;
    std::vector<std::vector<LineDropper>> spans; ///< droppers between each mast and the next
    std::string built_in; ///< folder of the results that have their lengths; empty: none

    double length() const { return masts.back().x; }

    /// Prescribed height of the contact wire without pre-sag [m]: a monotone cubic through the
    /// heights at the masts, whose slope at a mast is between those of its spans.
    std::vector<double> heights(const std::vector<double> &x) const;
  };

  /// Entries of the geometry of one tension length: lists for spans and masts, or a table.
  class LineGeometry
  {
  public:
    /// Declares the entries in the section of the line, with its sections Droppers, Contact wire
    /// and Messenger wire.
    void declare(dealii::ParameterHandler &prm);

    /// Throws EntryError; @p section is the path of the section.
    LineLayout layout(const std::string &section) const;

  private:
    void declare_wires(dealii::ParameterHandler &prm);
    void declare_droppers(dealii::ParameterHandler &prm);
    LineLayout from_lists(const std::string &section) const;
    LineLayout from_table(const std::string &section) const;

    std::string table;
    double begin = 0., offset = 0.;
    unsigned int n_spans = 10;
    double span_length = 60.;
    std::vector<double> span_lengths, encumbrances = {1.2}, heights = {0.}, stitch_lengths = {0.},
                                      mid_points = {0.};
    std::vector<double> contact_stagger = {0.}, messenger_stagger = {0.};
    std::string positions = "5, 10.5, 17, 23.5, 30, 36.5, 43, 49.5, 55", pre_sag, lengths;
    std::string positions_are = "absolute";
  };
} // namespace taut

#endif
