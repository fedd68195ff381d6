// SPDX-License-Identifier: LGPL-2.1-or-later
#include <taut/base/exceptions.h>
#include <taut/model/scene_rows.h>

#include <sstream>

namespace taut
{
  namespace
  {
    /// B_i of a link with its `to` end at an attachment.
    std::vector<Term> link_terms(const SceneBodies &bodies, const Link &link, const Attachment &to)
    {
      const double sign = link.kind == LinkKind::dropper ? -1. : 1.;
      std::vector<Term> terms;
      bodies.motion(to, link.rotational, link.direction, sign, terms);
      bodies.motion(link.from, link.rotational, link.direction, -sign, terms);
      return terms;
    }

    /// A contact that slides along a wire at constant speed.
    class SlidingPlace : public MovingPlace
    {
    public:
      SlidingPlace(const Scene &scene, const SceneBodies &bodies, const Link &link)
          : scene(scene), bodies(bodies), link(link)
      {
      }

      double position(const double t) const override { return link.to.position + link.speed * t; }

      std::vector<Term> terms(const double t) const override
      {
        const Wire &wire = scene.wires[link.to.index];
        const double length = wire.length(), s = position(t);
        // A step that ends on the end of the wire up to rounding is on the wire.
        if (s < -1e-9 * length || s > (1. + 1e-9) * length)
        {
          std::ostringstream out;
          out << "sliding contact '" << link.name << "' leaves wire '" << wire.name
              << "' at t = " << t << " s, position " << s << " m of " << length
              << " m. End the run earlier or lengthen the wire.";
          throw EntryError(link.origin, out.str());
        }
        return link_terms(bodies, link, place(t));
      }

      std::vector<Term> rates(const double t) const override
      {
        std::vector<Term> slope;
        bodies.slope(place(t), link.direction, link.speed, slope);
        return slope;
      }

      double gap(const double t) const override { return link.gap + link.profile(position(t), t); }

    private:
      Attachment place(const double t) const
      {
        Attachment to = link.to;
        to.position = position(t);
        return to;
      }

      const Scene &scene;
      const SceneBodies &bodies;
      const Link link;
    };
  } // namespace

  ContactRows scene_rows(const Scene &scene, const SceneBodies &bodies)
  {
    std::vector<Row> rows;
    for (std::size_t i = 0; i < scene.links.size(); ++i)
    {
      const Link &link = scene.links[i];
      Row row{link.name, link.origin, i};
      row.unilateral = link.unilateral();
      row.rotational = link.rotational;
      row.stiffness = link.stiffness;
      row.damping = link.damping;
      row.gap = link.gap;
      if (link.moving())
        row.place = std::make_shared<SlidingPlace>(scene, bodies, link);
      else
        row.terms = link_terms(bodies, link, link.to);
      rows.push_back(std::move(row));
    }
    for (const CutRow &cut : bodies.cut_rows())
    {
      Row row{cut.name};
      row.rotational = cut.rotational;
      row.terms = cut.terms;
      rows.push_back(std::move(row));
    }
    return ContactRows(bodies, std::move(rows));
  }
} // namespace taut
