// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_surface_geometry_h
#define taut_surface_geometry_h

#include "solid/face_shapes.h"
#include <taut/scene/contact_surface.h>

#include <string>
#include <vector>

namespace taut
{
  inline Coordinates scaled(const double s, const Coordinates &a)
  {
    return {s * a.x, s * a.y, s * a.z};
  }

  inline Coordinates normalised(const Coordinates &a)
  {
    return scaled(1. / norm(a), a);
  }

  /// A box with axes along those of space.
  struct Box
  {
    Coordinates lower, upper;

    void add(const Coordinates &x);
    double diagonal() const { return norm(upper - lower); }
  };

  /// A place on a face.
  struct FacePoint
  {
    FaceShapes shapes;
    Coordinates position;
    Coordinates tangent_x, tangent_y; ///< derivatives of the position; in the plane only the first
    Coordinates area;                 ///< outer normal, as long as the area per reference area

    double measure() const { return norm(area); }
    Coordinates normal() const { return normalised(area); }
  };

  /// Smallest cosine between the normal of a slave face and the opposite normal of a master face
  /// for which the faces face each other.
  constexpr double facing = .1;

  /// Faces of a contact surface as mappings from their reference faces, with outer sides.
  class SurfaceGeometry
  {
  public:
    /// Keeps a reference. Throws UserError, see contact_constraints.h.
    explicit SurfaceGeometry(const ContactSurface &surface);

    const ContactSurface &surface() const { return description; }
    std::size_t n_faces() const { return forms.size(); }
    FaceForm form(const std::size_t face) const { return forms[face]; }
    const std::vector<unsigned int> &nodes(const std::size_t face) const
    {
      return description.faces[face];
    }
    Coordinates point(const unsigned int node) const;

    FacePoint at(std::size_t face, const ReferencePoint &reference) const;

    /// A box that contains the face.
    Box box(std::size_t face) const;

    /// The box of all faces.
    Box bounding_box() const;

  private:
    [[noreturn]] void complain(std::size_t face, const std::string &what) const;
    void check_nodes(std::size_t face) const;

    const ContactSurface &description;
    std::vector<FaceForm> forms;
    std::vector<double> sides; ///< 1 or -1: which side of the tangents is the outer one
  };

  /// Throws UserError if the two are not in the same dimension.
  void check_dimensions(const ContactSurface &a, const ContactSurface &b);

  /// Throws UserError if @p thickness is no positive number.
  void check_thickness(double thickness);

  /// The search distance for a pair of surfaces, with the automatic distance resolved; UserError if
  /// it is negative or no number.
  double search_distance(const SurfaceGeometry &slave, const SurfaceGeometry &master,
                         double distance);

  /// Throws the UserError for two surfaces that do not face each other anywhere.
  [[noreturn]] void complain_about_search(const SurfaceGeometry &slave,
                                          const SurfaceGeometry &master, double distance);
} // namespace taut

#endif
