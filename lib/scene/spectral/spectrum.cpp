#include "scene/spectral/spectrum.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "file/csv.h"
#include "scene/gltf/uri.h"

namespace phos::inline scene {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& message) {
  throw Error(ExitCode::bad_input, where, message);
}

std::size_t column_of(const CsvTable& table, const char* name) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), name);
  if (at == table.columns.end())
    fail(table.where, text("has no column \"", name, "\"; its first line must be wavelength_nm,value"));
  return static_cast<std::size_t>(at - table.columns.begin());
}

std::vector<double> cie_wavelengths_nm() {
  std::vector<double> nm;
  for (std::size_t i = 0; i < CieTable().size(); ++i)
    nm.push_back(kCieFirst_nm + kCieStep_nm * static_cast<double>(i));
  return nm;
}

}  // namespace

Spectrum::Spectrum(std::vector<double> wavelength_nm, std::vector<double> value, Beyond beyond)
    : nm_(std::move(wavelength_nm)), value_(std::move(value)), beyond_(beyond) {
  PHOS_CHECK(!nm_.empty() && nm_.size() == value_.size(), nm_.size(), " wavelengths of ", value_.size(),
             " values");
}

Spectrum::Spectrum(const CieTable& table)
    : Spectrum(cie_wavelengths_nm(), std::vector<double>(table.begin(), table.end()), Beyond::zero) {}

double Spectrum::at(double nm) const {
  if (nm < nm_.front()) return beyond_ == Beyond::zero ? 0 : value_.front();
  if (nm > nm_.back()) return beyond_ == Beyond::zero ? 0 : value_.back();
  const auto after = std::upper_bound(nm_.begin(), nm_.end(), nm);
  if (after == nm_.end()) return value_.back();
  const auto i = static_cast<std::size_t>(after - nm_.begin()) - 1;
  const double t = (nm - nm_[i]) / (nm_[i + 1] - nm_[i]);
  return (1 - t) * value_[i] + t * value_[i + 1];
}

double Spectrum::integral(double lo_nm, double hi_nm) const {
  double sum = 0;
  if (beyond_ == Beyond::end_value) {
    sum += value_.front() * std::max(std::min(hi_nm, nm_.front()) - lo_nm, 0.0);
    sum += value_.back() * std::max(hi_nm - std::max(lo_nm, nm_.back()), 0.0);
  }
  lo_nm = std::max(lo_nm, nm_.front()), hi_nm = std::min(hi_nm, nm_.back());
  if (!(lo_nm < hi_nm)) return sum;
  double from = lo_nm, value = at(lo_nm);
  auto next = static_cast<std::size_t>(std::upper_bound(nm_.begin(), nm_.end(), lo_nm) - nm_.begin());
  while (from < hi_nm) {
    const bool whole = next < nm_.size() && nm_[next] <= hi_nm;
    const double to = whole ? nm_[next] : hi_nm, value_to = whole ? value_[next] : at(hi_nm);
    sum += 0.5 * (value + value_to) * (to - from);
    from = to, value = value_to, ++next;
  }
  return sum;
}

Spectrum::Range Spectrum::above_zero_nm() const {
  std::size_t first = 0, last = value_.size();
  while (first < last && !(value_[first] > 0)) ++first;
  while (last > first && !(value_[last - 1] > 0)) --last;
  if (first == last) return {1, 0};
  // It rises from the point before the first, and falls to the one after the last.
  return {nm_[first > 0 ? first - 1 : 0], nm_[std::min(last, nm_.size() - 1)]};
}

Spectrum parse_spectrum(std::string_view bytes, const std::string& where, SpectrumKind kind) {
  const CsvTable table = parse_csv(bytes, where);
  const std::size_t nm_column = column_of(table, "wavelength_nm"), value_column = column_of(table, "value");
  const bool reflectance = kind == SpectrumKind::reflectance;
  std::vector<double> nm, value;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double w = table.number(row, nm_column), v = table.number(row, value_column);
    const auto bad = [&](const std::string& message) {
      fail(where, text("line ", table.line[row], ": ", message));
    };
    if (!std::isfinite(w) || !(w > 0)) bad("wavelength_nm must be a number above 0");
    if (!nm.empty() && !(w > nm.back()))
      bad(text("the wavelength ", shortest(w), " nm does not come after ", shortest(nm.back()),
               " nm; sort the table"));
    if (!std::isfinite(v) || v < 0) bad("value must be a number that is not negative");
    if (reflectance && v > 1)
      bad(text("a reflectance of ", shortest(v), " is above 1; give shares, not percent"));
    nm.push_back(w), value.push_back(v);
  }
  if (nm.empty()) fail(where, "has no row; give wavelengths and values");
  if (nm.back() < kCieFirst_nm || nm.front() > kCieLast_nm)
    fail(where, text("its data, ", shortest(nm.front()), " to ", shortest(nm.back()),
                     " nm, do not overlap 380 to 780 nm, where light is seen; give wavelengths in nm"));
  // Power is relative: no unit is too large or too small.
  if (const double most = *std::max_element(value.begin(), value.end()); !reflectance && most > 0)
    for (double& v : value) v /= most;
  Spectrum spectrum(std::move(nm), std::move(value),
                    reflectance ? Spectrum::Beyond::end_value : Spectrum::Beyond::zero);
  if (!reflectance && !(spectrum.integral(kCieFirst_nm, kCieLast_nm) > 0))
    fail(where, "has no power between 380 and 780 nm, where light is seen; give the spectrum of a lamp");
  return spectrum;
}

Spectrum read_spectrum(const std::string& path, SpectrumKind kind) {
  return parse_spectrum(read_referred(path), path, kind);
}

}  // namespace phos::inline scene
