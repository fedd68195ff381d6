// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef taut_tuned_blas_h
#define taut_tuned_blas_h

namespace taut
{
  /// True if the BLAS of this process is tuned for its processor (OpenBLAS, BLIS or MKL), not the
  /// reference implementation. A supernodal factor of a large solid then takes an eighth of the
  /// time (doc/results/decomposition.md).
  bool has_tuned_blas();
} // namespace taut

#endif
