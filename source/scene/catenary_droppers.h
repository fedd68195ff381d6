// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_catenary_droppers_h
#define taut_catenary_droppers_h

#include <taut/scene/scene.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace taut
{
  /// The droppers of an overhead line, alike in all its spans, with their clamps. Catenary hangs
  /// them between its wires.
  class CatenaryDroppers
  {
  public:
    void declare(dealii::ParameterHandler &prm);

    /// Throws EntryError for entries that are impossible in spans of this length [m]. Droppers up
    /// to @p same [m] apart hang at one place.
    void check(double span_length, double same, bool is_in_space) const;

    /// Adds the droppers between two complete wires of the scene, one above the other.
    void add(std::size_t messenger_wire, std::size_t contact_wire, unsigned int n_spans,
             double span_length, Scene &scene) const;

  private:
    std::vector<double> positions = {5., 10.5, 17., 23.5, 30., 36.5, 43., 49.5, 55.};
    std::string stiffness = "100000";
    double damping = 0., axial_stiffness = 0., mass_per_length = 0.;
    double messenger_clamp_mass = 0., contact_clamp_mass = 0.;
    std::vector<double> pre_sag, lengths;
  };
} // namespace taut

#endif
