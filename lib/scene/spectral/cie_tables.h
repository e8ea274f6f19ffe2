// Data of the CIE, in steps of 5 nm from 380 to 780 nm.
#pragma once

#include <array>

namespace phos::inline scene {

inline constexpr double kCieFirst_nm = 380, kCieLast_nm = 780, kCieStep_nm = 5;
using CieTable = std::array<double, 81>;

/// Colour matching functions of the standard observer of 1931 (2 degrees); y is V(lambda).
extern const CieTable kCieX, kCieY, kCieZ;
/// Relative power of standard illuminant D65, 100 at 560 nm.
extern const CieTable kCieD65;
/// Components of daylight, of which illuminants D of any colour temperature are sums (CIE 15, part 4.1.2).
extern const CieTable kCieS0, kCieS1, kCieS2;
/// Reflectances of the test colour samples 1 to 8 of CIE 13.3-1995.
extern const std::array<CieTable, 8> kCieTestColours;

}  // namespace phos::inline scene
