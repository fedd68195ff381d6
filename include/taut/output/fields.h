// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fields_h
#define taut_fields_h

#include <taut/output/observer.h>

#include <string>
#include <utility>
#include <vector>

namespace taut
{
  /**
   * The motion of all wires for ParaView: wires_NNNN.vtu with the displacement from the undeformed
   * line as a vector to warp by, links_NNNN.vtu with the ends of the links as points that carry
   * force and gap, and wires.pvd and links.pvd that join them in time. Positions are x, 0, y: the
   * plane stands upright.
   */
  class Fields : public Observer
  {
  public:
    /// @p interval: least time between two files [s]; @p subdivisions: pieces an element is drawn
    /// with.
    Fields(const std::string &folder, const Scene &scene, const Structure &structure,
           double interval, unsigned int subdivisions);

    /// Called by all ranks together; the root writes. Throws UserError when a file cannot be
    /// written.
    void record(const StepView &step) override;

  private:
    /// A place with the linear forms of its motion along x and y.
    struct Sample
    {
      Point place;
      std::vector<Term> x, y;
      unsigned int part = 0; ///< of the partition
    };
    Sample sample(const Scene &scene, const Structure &structure, const Attachment &at) const;
    /// Displacements of samples along x and y from the undeformed line, summed over all ranks [m].
    std::vector<Point> displacements(const std::vector<Sample> &samples,
                                     const StepView &step) const;
    std::vector<Sample> ends_of_links(const StepView &step) const;
    void write_wires(const std::vector<Point> &displacement, const std::string &name) const;
    void write_links(const StepView &step, const std::vector<Sample> &ends,
                     const std::vector<Point> &displacement, const std::string &name) const;
    void write_collection(const std::string &name,
                          const std::vector<std::pair<double, std::string>> &files) const;

    std::string folder;
    double interval, next = 0.;
    unsigned int subdivisions;
    std::vector<Sample> wires;            ///< along each wire, `subdivisions` an element
    std::vector<std::size_t> wire_begins; ///< index of the first sample of each wire, and the end
    std::vector<Sample>
        link_ends; ///< the `to` end, or `from` if that is the ground; fixed rows only
    std::vector<std::pair<double, std::string>> wire_files, link_files;
  };
} // namespace taut

#endif
