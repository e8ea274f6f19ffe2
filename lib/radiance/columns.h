// Records of radiance files row by row. Numbers are [colour][number] for each record there, as many as the
// greatest order has, 0 beyond a record's own; in memory they are [number][colour].
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "radiance/cache.h"

namespace phos::inline radiance {

inline void to_column(const std::vector<float>& record, float* column, std::size_t n) {
  for (std::size_t i = 0; i < record.size(); ++i) column[i % 3 * n + i / 3] = record[i];
}

inline std::vector<float> from_column(const float* column, std::size_t n, std::size_t used) {
  std::vector<float> record(3 * used);
  for (std::size_t i = 0; i < record.size(); ++i) record[i] = column[i % 3 * n + i / 3];
  return record;
}

/// Are the unused numbers of each record's column 0?
inline bool rest_is_zero(const float* column, std::size_t n, std::size_t used) {
  for (std::size_t c = 0; c < 3; ++c)
    if (std::any_of(column + c * n + used, column + (c + 1) * n, [](float x) { return x != 0; }))
      return false;
  return true;
}

/// As read_radiance(), but of some rows alone; null: all.
RadianceCache read_radiance_rows(const Container& file, FileForm form, const std::vector<std::size_t>* rows);

}  // namespace phos::inline radiance
