// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_elasticity_h
#define taut_elasticity_h

#include <taut/simulation/parameters.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace taut
{
  /// Elasticity of one contact wire along the line.
  struct ElasticityOfWire
  {
    std::string wire;
    std::vector<double> x;          ///< [m]
    std::vector<double> elasticity; ///< uplift under the force, over the force [m/N]

    double largest() const;
    double smallest() const;

    /// Non-uniformity (e_max - e_min) / (e_max + e_min), the u of EN 50119 [1].
    double nonuniformity() const;
  };

  /**
   * The elasticity of the wires that sliding contacts slide on: the static uplift of a place under
   * a force there, over the force. It counts from the state at rest without sliding contacts.
   */
  class Elasticity
  {
  public:
    /// @p overrides as for Parameters::read(). Throws UserError. Messages go to @p log.
    Elasticity(const std::string &file, const std::vector<std::string> &overrides, bool overwrite,
               std::ostream &log);

    /// As Simulation::stop_if(), asked after each place.
    void stop_if(std::function<int()> asked) { stop_asked = std::move(asked); }

    /// Measures all places, and writes elasticity.csv, elasticity.json and its entries,
    /// elasticity.prm, into Output/Folder.
    const std::vector<ElasticityOfWire> &run();

  private:
    void measure();
    void write() const;
    void report() const;

    Parameters parameters;
    bool overwrite;
    std::ostream &log;
    std::function<int()> stop_asked;
    std::vector<ElasticityOfWire> wires;
  };
} // namespace taut

#endif
