// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_distributed_load_h
#define taut_distributed_load_h

#include "wire/element_load.h"
#include "wire/smooth_load.h"
#include "wire/travelling_load.h"

#include <taut/wire/wire_component.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace taut
{
  /**
   * A force per length f(s, t), integrated at each call: by its shapes where they travel, see
   * TravellingLoad; by panels of elements where it is smooth, see SmoothLoad; elsewhere over each
   * element, see LoadIntegral.
   *
   * There an element is looked at in one piece for a load that changes with time, so that it has to
   * be as wide as this piece sees if it moves; a narrower moving load throws EntryError. A narrower
   * load at rest is found at the set-up, at a few times. Its elements are looked at in fine pieces
   * from then on.
   */
  class WireComponent::DistributedLoad : public TimeLoad
  {
  public:
    /// With name and section of @p load for messages. @p product is the load as shapes that travel;
    /// nullptr: it is none.
    DistributedLoad(const WireComponent &wire, double factor, const Load &load,
                    const Expression::Separated::Travelling *product = nullptr);

    void add(double t, std::vector<double> &P) const override;
    double sample(double t) const override { return sample_at_places(t, 8); }
    double sample_at_places(double t, std::size_t n_places) const override;

  private:
    using Element = LoadedElement;
    class WidthCheck;

    ElementLoad over(const Element &element, double t, TypicalLoad &typical) const;
    void find_standing_details();
    void add_elements(double t, std::vector<double> &P) const;
    void add_shapes(double t, std::vector<double> &P) const;
    void add_to(std::vector<double> &P, std::size_t element,
                const ElementLoad::Values &values) const;

    Expression magnitude;
    LoadIntegral integral;
    std::string name, origin;
    double wire_length;
    std::vector<Element> elements;
    unsigned int n_dofs, dofs_between; ///< of an element, and from one to the next
    std::vector<double> forces;        ///< on the DoFs by unit values at each Gauss point
    std::optional<TravellingLoad> travelling;
    std::optional<SmoothLoad> smooth;
  };
} // namespace taut

#endif
