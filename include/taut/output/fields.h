// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_fields_h
#define taut_fields_h

#include <taut/output/observer.h>
#include <taut/output/vtu_file.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Writes the motion for ParaView into the folder `fields` of the results. Points are where the
   * undeformed bodies are, those of cables where they are at rest; `displacement` moves all to
   * where they belong together. wires_NNNNN.vtu has the wires as lines, cut between parts.
   * Their data are displacements, name, number and part. links_NNNNN.vtu has each link as a line
   * between its ends, or as a point if one end is the ground. Its data are displacement, force,
   * gap, whether the link is open, and its name; a sliding contact is in its present place.
   * wires.pvd and links.pvd join the files in time. A body with a picture has files
   * `body_<name>_NNNNN.vtu` and `body_<name>.pvd`, written by its owner; if it is cut, each rank
   * writes its parts, and `body_<name>_NNNNN.pvtu` joins them.
   */
  class Fields : public Observer
  {
  public:
    /// @p results: folder of the run; @p interval: least time between two files [s]; @p
    /// subdivisions: lines in each element.
    Fields(const std::string &results, const Scene &scene, const SceneBodies &structure,
           double interval, unsigned int subdivisions);

    /// Called by all ranks together; the root writes. Throws UserError if it cannot write.
    void record(const StepView &step) override;
    void save(OutputArchive &archive) override;
    void resume(InputArchive &archive, const StepView &step) override;
    void finish() override;

  private:
    /// Points of a file: each rank has the linear forms of the motion along x, y and z of the
    /// points on its bodies, the root has the places of all.
    struct Points
    {
      struct Moved
      {
        std::size_t number;
        std::array<std::vector<Term>, 3> motion;
      };
      std::size_t size = 0;
      std::vector<Coordinates> places; ///< at U = 0 [m]
      std::vector<Moved> moved;

      void set_motion(const SceneBodies &structure, std::size_t number, const Attachment &at);

      /// Called by all ranks together.
      void add(const Scene &scene, const SceneBodies &structure, const Attachment &at);
    };

    /// On the root, displacements of points along x, y, z from the undeformed line [m]; called by
    /// all ranks together.
    std::vector<float> displacements(const Points &points, const StepView &step) const;
    void add_wires(const Scene &scene, const SceneBodies &structure, unsigned int subdivisions);
    void add_links(const Scene &scene, const SceneBodies &structure);
    void move_ends(const StepView &step);
    void set_links(const LinkValues &links);
    void add_bodies(const Scene &scene, const SceneBodies &structure);
    void write_bodies(const StepView &step);
    void write(const StepView &step, const std::string &name, const VtuFile &file,
               PvdFile &collection) const;

    std::string folder;
    double interval, next = 0.;
    Points wires; ///< along each wire, `subdivisions` an element

    /// Ends of links on bodies: of fixed links in the order of the scene, then of sliding ones.
    Points ends;
    std::vector<std::size_t> link_of_end; ///< index in the scene
    std::size_t n_fixed_ends = 0;

    bool is_root = true;
    std::unique_ptr<VtuFile> wire_file, link_file; ///< of the root; null: nothing to show
    std::size_t wire_displacement = 0;             ///< arrays of the files
    std::size_t link_displacement = 0, force = 0, gap = 0, open = 0;
    PvdFile wire_collection, link_collection;

    /// A custom body with a picture. Parts of a rank that can be drawn together are one piece,
    /// with one file.
    struct BodyFiles
    {
      std::string stem;
      PvdFile collection;                           ///< on the root
      std::vector<std::vector<std::size_t>> pieces; ///< on this rank
      std::size_t first_piece = 0, n_pieces = 1;    ///< of all ranks
      bool is_joined = false;                       ///< by a .pvtu file
      std::size_t n_frames = 0;

      std::string piece(std::size_t p) const; ///< name of its files
    };
    static std::vector<std::vector<std::size_t>> pieces_of(const SceneBodies &structure,
                                                           const std::vector<std::size_t> &parts);
    void write_pieces(const StepView &step, const BodyFiles &body) const;
    std::vector<BodyFiles> bodies;
  };
} // namespace taut

#endif
