#include "radiance/compact_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace phos::inline radiance {
namespace {

constexpr int kLeastExponent = std::numeric_limits<float>::min_exponent - 1;  // of normal floats: -126
constexpr std::size_t kChunk = 256;

float size_of(float x) { return std::fabs(x); }

/// e of |x| = m 2^e with m from 0.5 to 1. x: above 0.
int exponent_of(float x) {
  int e = 0;
  std::frexp(x, &e);
  return e;
}

/// The greatest floats that halves and bytes hold: without their last bits, so that none rounds to infinity.
constexpr float kMostOfHalves = 0x7ffp117f, kMostOfBytes = 0x7fp121f;

/// Within -most .. most. Numbers that programs may flush to zero are 0 in all files.
float limited(float x, float most) {
  return size_of(x) < std::numeric_limits<float>::min() ? 0.f : std::clamp(x, -most, most);
}

float power_of_two(int e) { return std::ldexp(1.f, e); }

/// Of halves; `greatest` rounds to less than 2^15 units.
float unit_for_halves(float greatest) {
  if (greatest == 0) return 1;
  int e = std::max(exponent_of(greatest) - 15, kLeastExponent);
  if (static_cast<float>(Half(greatest * power_of_two(-e))) >= 0x1p15f) ++e;
  return power_of_two(e);
}

/// Of bytes; `greatest` rounds to at most 127 units.
int exponent_for_bytes(float greatest) {
  if (greatest == 0) return 0;
  const int e = std::max(exponent_of(greatest) - 7, kLeastExponent);
  return std::nearbyint(greatest * power_of_two(-e)) > 127 ? e + 1 : e;
}

/// Of one colour, bands stand one after another.
std::size_t first_of(std::size_t band) { return band * band; }

/// Calls visit(number) for the numbers of a band in a record of a column.
template <class Visit>
void for_band(std::size_t record, std::size_t bands, std::size_t band, const Visit& visit) {
  const std::size_t of_colour = first_of(bands);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = first_of(band); i < first_of(band + 1); ++i) visit((3 * record + c) * of_colour + i);
}

}  // namespace

HalfColumns::HalfColumns(std::size_t records, FloatColumns floats) : unit(records) {
  for (const auto& column : floats) columns.emplace_back(column.size());
  parallel_for(records, kChunk, [&](std::size_t record) {
    const auto row = [&](auto&& column) {
      const std::size_t n = column.size() / records;
      return std::span(column).subspan(record * n, n);
    };
    float greatest = 0;
    for (const auto& column : floats)
      for (const float x : row(column)) greatest = std::max(greatest, size_of(limited(x, kMostOfHalves)));
    unit[record] = unit_for_halves(greatest);
    const float units_in_one = 1 / unit[record];
    for (std::size_t k = 0; k < columns.size(); ++k)
      std::transform(row(floats.begin()[k]).begin(), row(floats.begin()[k]).end(), row(columns[k]).begin(),
                     [&](float x) { return Half(limited(x, kMostOfHalves) * units_in_one); });
  });
}

ByteColumns::ByteColumns(std::size_t records, std::size_t bands, FloatColumns floats)
    : exponent(records * bands) {
  for (const auto& column : floats) columns.emplace_back(column.size());
  parallel_for(records, kChunk, [&](std::size_t record) {
    for (std::size_t band = 0; band < bands; ++band) {
      float greatest = 0;
      for (const auto& column : floats)
        for_band(record, bands, band, [&](std::size_t i) {
          greatest = std::max(greatest, size_of(limited(column[i], kMostOfBytes)));
        });
      const int e = exponent_for_bytes(greatest);
      exponent[record * bands + band] = static_cast<std::int8_t>(e);
      const float units_in_one = power_of_two(-e);
      for (std::size_t k = 0; k < columns.size(); ++k)
        for_band(record, bands, band, [&](std::size_t i) {
          columns[k][i] = static_cast<std::int8_t>(
              std::nearbyint(limited(floats.begin()[k][i], kMostOfBytes) * units_in_one));
        });
    }
  });
}

StoredColumn::StoredColumn(const TensorReader& file, const std::string& name, const std::string& unit)
    : bands_(static_cast<std::size_t>(file.extent("N"))) {
  const auto n = static_cast<std::size_t>(file.extent("n"));
  const auto take = [&]<class T>(std::span<const T>& numbers) {
    numbers = file.values<T>(name);
    row_size_ = n > 0 ? numbers.size() / n : 0;
  };
  switch (file.type_of(name)) {
    case Dtype::f16:
      take(halves_);
      unit_ = file.values<float>(unit);
      break;
    case Dtype::i8:
      take(bytes_);
      exponent_ = file.values<std::int8_t>(unit);
      break;
    default:
      take(floats_);
  }
}

const float* StoredColumn::row(std::size_t record, std::vector<float>& space) const {
  if (!floats_.empty()) return floats_.data() + record * row_size_;
  space.resize(row_size_);
  if (!halves_.empty()) {
    std::transform(halves_.begin() + static_cast<std::ptrdiff_t>(record * row_size_),
                   halves_.begin() + static_cast<std::ptrdiff_t>((record + 1) * row_size_), space.begin(),
                   [&](Half x) { return static_cast<float>(x) * unit_[record]; });
    return space.data();
  }
  for (std::size_t band = 0; band < bands_; ++band) {
    const float unit = power_of_two(exponent_[record * bands_ + band]);
    for_band(0, bands_, band,
             [&](std::size_t i) { space[i] = static_cast<float>(bytes_[record * row_size_ + i]) * unit; });
  }
  return space.data();
}

}  // namespace phos::inline radiance
