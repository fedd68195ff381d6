// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_end_frames_h
#define taut_end_frames_h

#include <taut/base/linear_form.h>
#include <taut/substructure/symmetric_matrix.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace taut
{
  struct Coordinates;

  /**
   * Local axes for the derivatives r' of clamped ends of a cable, with the first axis along the
   * cable. A clamp holds the other two components and leaves the strain free. The axes are mirror
   * images of x, y, z (Householder), so that the transformation is its own inverse.
   */
  class EndFrames
  {
  public:
    /// For the three DoFs from @p first_dof on, with the first axis along @p direction.
    void add(unsigned int first_dof, const Coordinates &direction);

    bool empty() const { return mirrors.empty(); }

    /// Transforms from x, y, z to these axes, or back.
    void turn(std::vector<double> &x) const;
    LinearForm turn(LinearForm form) const;
    std::unique_ptr<SymmetricMatrix> turn(std::unique_ptr<SymmetricMatrix> A) const;

  private:
    using Mirror = std::array<std::array<double, 3>, 3>;

    /// A unit vector of a DoF in the other axes: n entries from DoF first on.
    struct Turned
    {
      unsigned int first, n;
      std::array<double, 3> value;
    };
    Turned turned(unsigned int i) const;

    std::map<unsigned int, Mirror> mirrors; ///< by the first DoF
  };
} // namespace taut

#endif
