#include "file/kinds/tensor_row.h"

#include <algorithm>

#include "file/kinds/tables.h"

namespace phos::inline file {

namespace {

constexpr std::string_view kTable = "K.";

}  // namespace

const KindRow& row_of(FileKind kind) { return all_kinds()[static_cast<std::size_t>(kind)]; }

bool is_of_tables(const TensorRow& row) { return row.name.starts_with(kTable); }

std::string_view table_of(std::string_view tensor) {
  const std::size_t digits = tensor.find_first_not_of("0123456789");
  return digits == std::string_view::npos || digits == 0 || tensor[digits] != '.' ? std::string_view()
                                                                                  : tensor.substr(0, digits);
}

std::string tensor_name(const TensorRow& row, std::string_view table) {
  if (!is_of_tables(row)) return std::string(row.name);
  return std::string(table) + std::string(row.name.substr(kTable.size() - 1));
}

std::string type_words(const TensorRow& row) {
  const std::string usual = dtype_name(row.dtype);
  return row.compact ? usual + " or " + dtype_name(row.compact->dtype) : usual;
}

const TensorRow* find_row(FileKind kind, std::string_view tensor) {
  const std::string_view table = table_of(tensor);
  for (const TensorGroup& group : row_of(kind).groups)
    for (const TensorRow& row : group.rows) {
      const bool same = is_of_tables(row) ? !table.empty() && tensor.substr(table.size() + 1) ==
                                                                  row.name.substr(kTable.size())
                                          : tensor == row.name;
      if (same) return &row;
    }
  return nullptr;
}

}  // namespace phos::inline file
