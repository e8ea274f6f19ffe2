// Which pixels get how many of the samples that are left.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace phos::inline reference {

/// Samples of each pixel, `mean` on the mean, in whole groups of four but for the rest of all samples. A
/// third of them are the same for all; the rest go by the standard deviation of a sample, which makes the sum
/// of all squared errors least (Neyman 1934): of the eight pixels about each, without its own, so that its
/// number does not depend on its own samples, and its mean stays unbiased. `variance`: of a sample of each
/// pixel, row by row; all even where nothing varies, or there are no neighbours.
std::vector<std::uint32_t> sample_shares(std::span<const double> variance, std::size_t width,
                                         std::int64_t mean);

}  // namespace phos::inline reference
