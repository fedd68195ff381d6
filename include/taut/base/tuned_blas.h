// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tuned_blas_h
#define taut_tuned_blas_h

namespace taut
{
  /// Whether the BLAS of this process is one for its processor, OpenBLAS, BLIS or MKL, and not the
  /// reference implementation: then a supernodal factor of a large solid takes an eighth of the
  /// time (doc/results/decomposition.md).
  bool has_tuned_blas();
} // namespace taut

#endif
