// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_spans_h
#define taut_spans_h

#include <taut/model/scene_bodies.h>
#include <taut/output/contact_quantities.h>
#include <taut/scene/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace taut
{
  /// Whether a link is a dropper from wire to wire.
  bool is_dropper_between_wires(const Link &link);

  /// A part of a wire between two masts.
  struct Span
  {
    std::string name;                       ///< "WIRE span NUMBER", from 1 on
    double from = 0., to = 0.;              ///< s on the wire [m]
    double sag = 0.;                        ///< at rest [m], see find_sags()
    std::vector<std::size_t> droppers = {}; ///< links that hold this part of the wire, from `from`
  };

  /// A wire with spans.
  struct SpannedWire
  {
    std::size_t wire = 0; ///< of the scene
    std::string name;
    std::vector<Span> spans;
  };

  /**
   * Spans of the wires at the ends of droppers and under sliding contacts, in the order of the
   * scene. Masts of a wire are its transverse supports; of a wire that hangs on droppers the
   * transverse supports of the wires above it, projected on it. Wires with fewer than two masts
   * have no spans.
   */
  std::vector<SpannedWire> spanned_wires(const Scene &scene);

  /// Sets the sags: the largest depth of the wire below the chord between its points at the two
  /// masts, at four places of each element, or 0 above it, at the displacements @p U. Called by all
  /// ranks together.
  void find_sags(const Scene &scene, const SceneBodies &bodies, const BodyVectors &U,
                 std::vector<SpannedWire> &wires);

  /// Moments of the samples of a contact force in a span and in the window; a sample at a
  /// mast belongs to the span after it. Without samples all are 0.
  struct SpanForce
  {
    Moments moments;
    std::size_t n_samples = 0;

    static SpanForce of(const Span &span, const ContactRecord &record,
                        const StatisticsParameters &parameters);
  };

  /**
   * What waves in a wire mean to a contact that slides under it, from tensions T and masses per
   * length m (F. Kiessling, R. Puschmann, A. Schmieder, E. Schneider, Contact Lines for Electric
   * Railways).
   */
  struct LineConstants
  {
    std::string contact, wire;
    double speed = 0.;         ///< v, the largest |v| of the run [m/s]
    double wave_speed = 0.;    ///< c, see wave_speed() [m/s]
    double doppler = 0.;       ///< (c - v) / (c + v); 0 if not slower than the waves [1]
    double reflection = 0.;    ///< r of waves in the wire at a dropper; 0 without droppers [1]
    double amplification = 0.; ///< r / Doppler factor; 0 without one, or without droppers [1]
  };

  /// Of each sliding contact on a wire with tension, in the order of the scene.
  std::vector<LineConstants> line_constants(const Scene &scene);
} // namespace taut

#endif
