// Numbers of radiance records in few bits: a record's halves count one unit of the record, and its bytes
// count units of their bands. Units are powers of two. Numbers that were compact once stay the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "core/half.h"
#include "file/kinds/tensor_io.h"

namespace phos::inline radiance {

/// Columns of floats, with as many numbers for each record as they have.
using FloatColumns = std::initializer_list<std::span<const float>>;

/// number = unit x half. The greatest number of a record is 2^14 .. 2^15 units, so that numbers down to 2^-29
/// of it keep 11 bits, and smaller ones are off by at most 2^-39 of it. Units are at least 2^-126. The
/// greatest floats lose their last bits, and stay finite.
struct HalfColumns {
  std::vector<float> unit;                 ///< of each record; 1 where all its numbers are 0
  std::vector<std::vector<Half>> columns;  ///< as the columns of floats

  HalfColumns(std::size_t records, FloatColumns floats);
};

/// number = 2^exponent x byte. The greatest number of a band, of all colours and columns, is 64 .. 127 units:
/// numbers are off by at most 1/128 of it. Exponents are at least -126. The
/// greatest floats stay finite.
struct ByteColumns {
  std::vector<std::int8_t> exponent;              ///< [record][band]; 0 where all numbers are 0
  std::vector<std::vector<std::int8_t>> columns;  ///< as the columns of floats

  /// Columns are [record][colour][bands^2].
  ByteColumns(std::size_t records, std::size_t bands, FloatColumns floats);
};

/// A column of a file that may be compact, [record][colour][number].
class StoredColumn {
 public:
  /// `unit`: the tensor with the units of compact numbers. Throws Error(bad_input) where one of the two is
  /// missing.
  StoredColumn(const TensorReader& file, const std::string& name, const std::string& unit);
  /// The numbers of a record, in place or in `space`.
  const float* row(std::size_t record, std::vector<float>& space) const;

 private:
  std::size_t row_size_ = 0, bands_ = 0;
  std::span<const float> floats_, unit_;
  std::span<const Half> halves_;
  std::span<const std::int8_t> bytes_, exponent_;
};

}  // namespace phos::inline radiance
