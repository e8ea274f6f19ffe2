// A quantity over wavelength: the power of a lamp, the reflectance of a paint.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/spectral/cie_tables.h"

namespace phos::inline scene {

/// Linear between its points. Wavelengths in nm.
class Spectrum {
 public:
  /// What holds before the first and after the last point.
  enum class Beyond { zero, end_value };

  /// There must be at least one point, of each as many, wavelengths rising.
  Spectrum(std::vector<double> wavelength_nm, std::vector<double> value, Beyond beyond);
  /// Of a table of the CIE; zero beyond.
  explicit Spectrum(const CieTable& table);

  double at(double nm) const;
  /// Over an interval, exact; times nm.
  double integral(double lo_nm, double hi_nm) const;
  /// integral() over the width of an interval, which must be above 0.
  double mean(double lo_nm, double hi_nm) const { return integral(lo_nm, hi_nm) / (hi_nm - lo_nm); }

  const std::vector<double>& wavelengths_nm() const { return nm_; }
  const std::vector<double>& values() const { return value_; }
  /// From where to where it is above zero by its points; lo > hi where it is zero everywhere.
  struct Range {
    double lo_nm, hi_nm;
  };
  Range above_zero_nm() const;

 private:
  std::vector<double> nm_, value_;
  Beyond beyond_;
};

/// What a file holds. Reflectance is of light from everywhere or nowhere special, 0 to 1, and continues with
/// its end values beyond the data; power is in any unit, for each nm (its greatest becomes 1), and is 0
/// beyond.
enum class SpectrumKind { reflectance, power };

/// Reads CSV with the columns wavelength_nm and value. Throws Error(bad_input), naming file and line: not
/// such a table, wavelengths that do not rise or are not above 0, values that are negative, not finite or, of
/// reflectances, above 1, no data between 380 and 780 nm, or a lamp without power there.
Spectrum read_spectrum(const std::string& path, SpectrumKind kind);
/// The same from text; `where` is its name in messages.
Spectrum parse_spectrum(std::string_view text, const std::string& where, SpectrumKind kind);

}  // namespace phos::inline scene
