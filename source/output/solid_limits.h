// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_solid_limits_h
#define taut_solid_limits_h

#include "model/surface_constraints.h"
#include "output/facet_limits.h"
#include "output/linear_forms.h"
#include <taut/base/warning.h>
#include <taut/output/observer.h>
#include <taut/substructure/body_traits.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /**
   * Checks assumptions of the equations of solids and their contacts. The worst case of each kind
   * in a run is kept.
   *
   * - "turn": a line between two nodes of the surface of a body turns by less than 0.1 rad. Such a
   *   turn stretches stiff parts by 0.5 %.
   * - "strain": less than half of the elastic energy of a body is where strains exceed 5 %. Peaks
   *   at corners and below contacts do not count.
   * - "locking": elements of degree 1 are too stiff by less than 5 %. Four square elements through
   *   the thickness of a beam in plane strain with nu = 0.3 are so by 4 %, three by 7 %, and six
   *   layers of triangles by 7 to 10 %.
   * - "sliding": at a closed contact the sides slide by less than half of the shorter element of
   *   both sides. A plane as the obstacle has no such limit.
   * - "overhang": where a contact is closed, the master covers the faces of the slave as a whole.
   * - "nodes_on_faces": loaded nodes of the slave are at nodes of the master.
   * - "facets": straight faces on curves are small beside the contact, see FacetLimits.
   * - "between_nodes": the other side does not enter a face between its nodes.
   * - "search": nodes outside an automatic search distance stay open.
   */
  class SolidLimits
  {
  public:
    /// Called by all ranks together.
    SolidLimits(const Scene &scene, const SceneBodies &structure);

    /// Throws EntryError for a body that turns, or a contact that slides, by more than its entry
    /// allows. Called by all ranks together.
    void record(const StepView &step);

    /// Prints the number of nodes that the search left out.
    void print_left_out(std::ostream &out) const;

    /// At most one warning of each kind.
    std::vector<Warning> warnings() const;

    /// Stores the worst cases so far, for checkpoints.
    template <typename Archive>
    void store(Archive &archive)
    {
      for (Worst &w : worst)
        archive &w;
      for (Turning &b : bodies)
        archive &b.stretch &b.turn &b.seen_stretch &b.seen_turn &b.most.energy &b.most.large &b.most
            .locked &b.most.strain &b.most.place.x &b.most.place.y &b.most.place.z &b.time;
      for (Sliding &c : contacts)
      {
        c.facets.store(archive);
        archive &c.carries &c.entered;
      }
    }

  private:
    enum Kind
    {
      turn,
      strain,
      locking,
      sliding,
      overhang,
      nodes_on_faces,
      facets,
      search,
      between_nodes,
      n_kinds
    };

    /// Worst case of a kind so far.
    struct Worst
    {
      double excess = 0.; ///< value over limit
      double value = 0., limit = 0., time = 0.;
      std::size_t item = 0, place = 0; ///< body or contact; its line or constraint

      template <typename Archive>
      void serialize(Archive &archive, unsigned int)
      {
        archive &excess &value &limit &time &item &place;
      }
    };

    /// Lines between nodes of a body's surface, with three forms each.
    struct Turning
    {
      std::string name, origin;
      double largest; ///< [rad]
      std::size_t body, first;
      std::vector<Coordinates> places, chords; ///< [m]

      /// Largest stretch and turn of a line so far, and as the straining was last looked at.
      double stretch = 0., turn = 0., seen_stretch = 0., seen_turn = 0.;
      Straining most = {}; ///< that of most energy so far
      double time = 0.;    ///< of it [s]
    };

    /// A contact: three forms for each constraint if it can slide, then one for each left-out node
    /// and for each inner point.
    struct Sliding
    {
      std::string name, origin;
      double largest; ///< [elements]
      bool can_slide, is_mortar;
      std::size_t contact, first, first_left_out;
      ContactGeometry geometry;
      std::vector<double> elements; ///< of each constraint [m]
      std::vector<char> between;    ///< of each constraint: on a face of the master, not at a node
      FacetLimits facets;
      std::vector<SurfaceConstraint> left_out;
      std::vector<InnerPoint> inner;
      bool carries = false;  ///< at any time
      double first_gap = 0.; ///< where the sides meet first [m]
      Worst entered; ///< depth at an inner point, its excess over the face; a limit at any of them
    };

    void add_body(const Scene &scene, const SceneBodies &structure, std::size_t body);
    void add_contact(const Scene &scene, const SceneBodies &structure, std::size_t contact);
    void describe(const Scene &scene, Sliding &contact) const;
    void record_turns(double time);
    void record_strains(const StepView &step);
    void record_contacts(const StepView &step);
    void keep(Kind kind, double value, double limit, double time, std::size_t item,
              std::size_t place);
    Worst worst_between_nodes() const;
    std::string text_of(Kind kind, const Worst &w) const;
    std::string text_of_body(Kind kind, const Worst &w) const;

    std::vector<Turning> bodies;
    std::vector<Sliding> contacts;
    LinearForms forms;
    std::vector<double> values, forces, displacement; ///< of a contact, and of a body
    std::array<Worst, n_kinds> worst;
  };
} // namespace taut

#endif
