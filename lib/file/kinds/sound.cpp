#include "file/kinds/sound.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/parallel.h"

namespace phos::inline file {

namespace {

constexpr const char* kAgain = "; rerun the command that made it";

/// "" for rows that are not of tables.
std::vector<std::string> tables_of(const Container& file) {
  std::set<std::string> tables;
  for (const auto& [name, tensor] : file.tensors())
    if (const std::string_view table = table_of(name); !table.empty()) tables.emplace(table);
  return {tables.begin(), tables.end()};
}

/// Calls visit(row, table, name) for the tensors that must be in the file.
template <class Visit>
void for_each_due(const Container& file, const Visit& visit) {
  const FileForm form = form_of(file.provenance().extra);
  const std::vector<std::string> tables = tables_of(file), none{""};
  for (const TensorGroup& group : row_of(file.provenance().kind).groups) {
    if (!group.can_be_in(form)) continue;
    for (const std::string& table : is_of_tables(group.rows.front()) ? tables : none) {
      const bool due = group.present == TensorGroup::Present::always ||
                       std::any_of(group.rows.begin(), group.rows.end(),
                                   [&](const TensorRow& row) { return file.has(tensor_name(row, table)); });
      if (!due) continue;
      for (const TensorRow& row : group.rows) visit(row, table, tensor_name(row, table));
    }
  }
}

std::string known_extents(const Extents& known) {
  std::string out;
  for (const auto& [symbol, n] : known) out += text(out.empty() ? " with " : ", ", symbol, " = ", n);
  return out;
}

bool is_unit(const float* v, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(v[i]) * static_cast<double>(v[i]);
  return std::fabs(std::sqrt(sum) - 1) <= 1e-3;
}

bool is_frame(const float* v) {
  double dot = 0;
  for (std::size_t i = 0; i < 3; ++i) dot += static_cast<double>(v[i]) * static_cast<double>(v[3 + i]);
  return is_unit(v, 3) && is_unit(v + 3, 3) && std::fabs(dot) <= 1e-3;
}

template <class T>
bool is_sound_number(T v, const NumberCheck& check) {
  const auto x = static_cast<double>(v);
  switch (check.rule) {
    case NumberCheck::Rule::finite:
      return std::isfinite(x);
    case NumberCheck::Rule::within:
      return x >= check.least && x <= check.most;
    case NumberCheck::Rule::positive:
      return x > 0 && std::isfinite(x);
    default:
      return true;
  }
}

template <class T>
bool is_sound_row(const T* row, std::size_t n, const NumberCheck& check) {
  if constexpr (std::is_same_v<T, float>) {
    if (check.rule == NumberCheck::Rule::unit) return is_unit(row, n);
    if (check.rule == NumberCheck::Rule::frame) return is_frame(row);
  }
  return std::all_of(row, row + n, [&](T v) { return is_sound_number(v, check); });
}

/// The first row that is not sound; `rows` where all are sound. The same for any number of threads.
std::size_t first_bad_row(const Tensor& tensor, std::size_t rows, const NumberCheck& check) {
  return with_type_of(tensor.dtype, [&]<class T>(T) {
    const auto* v = reinterpret_cast<const T*>(tensor.bytes.data());
    const std::size_t columns = tensor.bytes.size() / sizeof(T) / rows;
    return parallel_reduce<std::size_t>(
        rows, 1 << 16, rows,
        [&](std::size_t begin, std::size_t end) {
          const NoFloatTraps traps;  // files may hold anything
          while (begin < end && is_sound_row(v + begin * columns, columns, check)) ++begin;
          return begin < end ? begin : rows;
        },
        [](std::size_t& least, std::size_t part) { least = std::min(least, part); });
  });
}

/// The same, some rows after others.
std::size_t first_bad_row_in(const Container& file, const Tensor& tensor, std::size_t rows,
                             const NumberCheck& check, std::size_t window) {
  const std::size_t row_bytes = tensor.bytes.size() / rows,
                    most = std::max<std::size_t>(window / row_bytes, 1);
  for (std::size_t begin = 0; begin < rows; begin += most) {
    const std::size_t n = std::min(rows - begin, most);
    const Tensor part{tensor.dtype, tensor.shape, tensor.unit,
                      tensor.bytes.subspan(begin * row_bytes, n * row_bytes)};
    const std::size_t bad = first_bad_row(part, n, check);
    if (bad < n) return begin + bad;
    file.release(part.bytes);
  }
  return rows;
}

}  // namespace

const Tensor& require_tensor(const Container& file, const std::string& name) {
  const auto found = file.tensors().find(name);
  if (found == file.tensors().end())
    throw Error(ExitCode::bad_input, file.path(), text("has no tensor \"", name, "\"", kAgain));
  return found->second;
}

Extents require_layout(const Container& file) {
  Extents known;
  for_each_due(file, [&](const TensorRow& row, const std::string& table, const std::string& name) {
    const Tensor& t = require_tensor(file, name);
    const Extents before = known;
    if (row.has_type(t.dtype) && fits(row, table, t.shape, known)) return;
    throw Error(ExitCode::bad_input, file.path(),
                text("tensor \"", name, "\" is ", dtype_name(t.dtype), shape_words(t.shape), ", not ",
                     type_words(row), shape_words(row), known_extents(before), kAgain));
  });
  return known;
}

void require_sound_numbers(const Container& file, std::optional<std::size_t> window) {
  for_each_due(file, [&](const TensorRow& row, const std::string&, const std::string& name) {
    if (row.check.rule == NumberCheck::Rule::any) return;
    const Tensor& t = require_tensor(file, name);
    const auto rows = static_cast<std::size_t>(t.shape.front());
    if (t.bytes.empty()) return;
    const std::size_t bad =
        window ? first_bad_row_in(file, t, rows, row.check, *window) : first_bad_row(t, rows, row.check);
    if (bad == rows) return;
    throw Error(ExitCode::bad_input, file.path(),
                text("row ", bad, " of tensor \"", name, "\" is not ", row.check.words,
                     "; the file is damaged or was made by a faulty program: make it again"));
  });
}

}  // namespace phos::inline file
