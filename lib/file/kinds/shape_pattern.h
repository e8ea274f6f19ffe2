// Compares the shapes that rows of tensors state with the shapes in files.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "file/kinds/tensor_row.h"

namespace phos::inline file {

using Shape = std::vector<std::uint64_t>;

/// The numbers that the symbols of shapes stand for in one file.
using Extents = std::map<std::string, std::uint64_t>;

/// "F32[n,3]"-like, with numbers for the names of colours and axes.
std::string shape_words(const TensorRow& row);
/// "[5,3]".
std::string shape_words(const Shape& shape);

/// Does a tensor's shape fit its row? Symbols that occur for the first time enter `known`. `table`: the table
/// of the tensor, "" where rows are not of tables.
bool fits(const TensorRow& row, std::string_view table, const Shape& shape, Extents& known);

/// The shape of a tensor with that many numbers. One symbol may be unknown, and enters `known`. Aborts for
/// more than one.
Shape shape_of(const TensorRow& row, std::string_view table, std::uint64_t numbers, Extents& known);

/// The name of an index along a dimension: a colour, an axis, or the number.
std::string index_name(const TensorRow& row, std::size_t dimension, std::uint64_t index);

}  // namespace phos::inline file
