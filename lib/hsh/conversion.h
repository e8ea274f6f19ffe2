// Between spherical and hemispherical harmonics.
#pragma once

#include <span>
#include <vector>

namespace phos::inline hsh {

/// C_ij = integral over the upper hemisphere of H_i Y_j dw, HSH order x SH order, nonzero for equal m alone.
/// SH coefficients in the local frame to HSH: h = C s. HSH, zero below the horizon, to SH: s = C^T h (least
/// squares, not an inverse: HSH -> SH -> HSH loses the part that the SH order cannot show, less the higher
/// the order is).
class HarmonicConversion {
 public:
  /// Throws Error(usage) for orders outside 1 .. HarmonicBasis::kMaxOrder.
  HarmonicConversion(int hsh_order, int sh_order);
  int hsh_order() const { return hsh_order_; }
  int sh_order() const { return sh_order_; }
  double at(int hsh_index, int sh_index) const;
  /// Of one m >= 0 (C is the same for -m) and HSH band l >= m: the entries of SH bands m .. sh_order - 1.
  const double* row(int m, int l) const {
    return block_[static_cast<std::size_t>(m)].data() + (l - m) * (sh_order_ - m);
  }
  /// Coefficients of each index are `channels` numbers side by side (RGB: 3).
  void sh_to_hsh(std::span<const float> sh, std::span<float> hsh, int channels = 1) const;
  void hsh_to_sh(std::span<const float> hsh, std::span<float> sh, int channels = 1) const;

 private:
  int hsh_order_, sh_order_;
  std::vector<std::vector<double>> block_;  // per |m|
};

}  // namespace phos::inline hsh
