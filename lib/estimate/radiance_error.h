// The standard error of coefficients of radiance, from one hemisphere.
#pragma once

#include <vector>

#include "estimate/hemisphere/hemisphere.h"

namespace phos::inline estimate {

/// Remembers its results for the cells; for one thread.
class RadianceError {
 public:
  explicit RadianceError(int order) : order_(order) {}
  /// [order][3]: of one coefficient of each band, root mean square over the band, cd/m2 sqrt(sr). The noise
  /// of the rays is known of hemispheres stratified by solid angle alone (else 0). The variances of a band's
  /// coefficients sum to that over cells of omega^2 (2l+1)/(2 pi) (Var L + L^2 (1 - mean of P_l between two
  /// points of the cell)), for by the addition theorem the light's slope within a cell and the harmonics'
  /// have no part in common; Var L comes from neighbouring strata, less the part that even places on lamps
  /// take away (as standard_error_of). Hemisphere::source is in it.
  std::vector<float> of(const Hemisphere& h);

 private:
  int order_;
  int rings_ = 0, slices_ = 0;                  // that variation_ is for
  std::vector<std::vector<double>> variation_;  // by ring and band
};

}  // namespace phos::inline estimate
