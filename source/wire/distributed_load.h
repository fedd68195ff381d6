// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_distributed_load_h
#define taut_distributed_load_h

#include "element_load.h"

#include <taut/wire/wire_component.h>

#include <array>
#include <string>
#include <vector>

namespace taut
{
  /**
   * A force per length f(s, t), integrated at each call over each element, see LoadIntegral.
   *
   * Of a load that changes with time an element is looked at in one piece, so that what moves has
   * to be as wide as is seen at once: narrower ones throw EntryError. What is narrower and stands
   * is found at the set-up, at a few times; its elements are looked at in fine pieces from then on.
   */
  class WireComponent::DistributedLoad : public TimeLoad
  {
  public:
    /// With name and section of @p load for messages.
    DistributedLoad(const WireComponent &wire, double factor, const Load &load);

    void add(double t, std::vector<double> &P) const override;

  private:
    struct Element
    {
      std::array<LinearForm, ElementLoad::n_points> shapes; ///< weighted
      std::array<double, ElementLoad::n_points> places;
      double begin, length;
      unsigned int n_pieces;
    };
    class WidthCheck;

    ElementLoad over(const Element &element, double t, TypicalLoad &typical) const;
    void find_standing_details();

    Expression magnitude;
    LoadIntegral integral;
    std::string name, origin;
    double wire_length;
    bool is_uniform; ///< along the wire
    std::vector<Element> elements;
  };
} // namespace taut

#endif
