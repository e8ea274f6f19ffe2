#include "file/inspect/rows.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/origin.h"
#include "core/text/append_item.h"
#include "file/inspect/inspect.h"
#include "file/kinds/shape_pattern.h"
#include "file/limits.h"

namespace phos::inline file {

namespace {

constexpr std::size_t kPieceBytes = 1 << 16;
constexpr auto kMostColumns = kMostTableColumns.as<std::size_t>();

template <class T>
void append_number(std::string& out, T v) {
  char buffer[64];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, v);
  out.append(buffer, end);
}

void append_number(std::string& out, Half v) { append_number(out, static_cast<float>(v)); }

template <class T>
T element(const Tensor& tensor, std::size_t i) {
  T v;
  std::memcpy(&v, tensor.bytes.data() + i * sizeof v, sizeof v);
  return v;
}

void append_element(std::string& out, const Tensor& tensor, std::size_t i) {
  with_type_of(tensor.dtype, [&]<class T>(T) { append_number(out, element<T>(tensor, i)); });
}

/// One column name per element of a row.
std::vector<std::string> column_names(const std::string& name, const Tensor& tensor, const TensorRow* row) {
  std::vector<std::string> names{name};
  for (std::size_t d = 1; d < tensor.shape.size(); ++d) {
    std::vector<std::string> longer;
    for (const std::string& prefix : names)
      for (std::uint64_t i = 0; i < tensor.shape[d]; ++i)
        longer.push_back(prefix + '.' + (row ? index_name(*row, d, i) : std::to_string(i)));
    names = std::move(longer);
  }
  return names;
}

struct Column {
  const Tensor* tensor;
  std::vector<std::string> names;
  bool decode;
  DVec3 origin_m{0};  // of positions
};

Column make_column(const Container& file, const std::string& name, bool decode) {
  const auto found = file.tensors().find(name);
  if (found == file.tensors().end()) {
    std::string all;
    for (const auto& [other, tensor] : file.tensors()) append_item(all, other);
    throw Error(ExitCode::usage, file.path(), text("has no tensor \"", name, "\"; it has: ", all));
  }
  const Tensor& tensor = found->second;
  if (tensor.shape.empty())
    throw Error(ExitCode::usage, file.path(), text("tensor \"", name, "\" has no rows"));
  std::uint64_t columns = 1;
  for (std::size_t d = 1; d < tensor.shape.size(); ++d)  // cannot overflow unless there are no rows
    columns = tensor.shape[d] > kMostColumns
                  ? kMostColumns + 1
                  : std::min(columns * tensor.shape[d], std::uint64_t{kMostColumns} + 1);
  if (columns > kMostColumns)
    throw Error(ExitCode::usage, file.path(),
                text("tensor \"", name, "\" has more than ", kMostColumns, " columns"));
  if (decode && is_octahedral(tensor) && tensor.shape.size() == 1)
    return {&tensor, {name + ".x", name + ".y", name + ".z"}, true, DVec3(0)};
  const bool places = name == "position" && tensor.dtype == Dtype::f32 && columns == 3;
  return {&tensor, column_names(name, tensor, find_row(file.kind(), name)), false,
          places ? origin_in(file.provenance().scene_parts) : DVec3(0)};
}

void append_cells(std::string& out, const Column& column, std::size_t row) {
  if (column.decode) {
    const Vec3 v = decode_octahedral(element<std::uint32_t>(*column.tensor, row));
    append_number(out, v.x), out += ',';
    append_number(out, v.y), out += ',';
    append_number(out, v.z);
    return;
  }
  const std::size_t n = column.names.size();
  for (std::size_t c = 0; c < n; ++c) {
    if (c > 0) out += ',';
    if (column.origin_m != DVec3(0)) {
      out += world_text(column.origin_m[static_cast<int>(c)], element<float>(*column.tensor, row * n + c));
      continue;
    }
    append_element(out, *column.tensor, row * n + c);
  }
}

/// sRGB transfer function (IEC 61966-2-1) to 8 bits.
std::uint8_t srgb8(float linear) {
  const float v = std::clamp(std::isfinite(linear) ? linear : 0.f, 0.f, 1.f);
  const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255.f * s));
}

/// Luminance that becomes white: the 99th percentile, so that one bright point does not darken all others.
float white_point(std::span<const Vec3> colours) {
  std::vector<float> y;
  y.reserve(colours.size());
  for (const Vec3& c : colours)
    if (is_finite(c)) y.push_back(luminance(c));
  if (y.empty()) return 0.f;
  const auto at = y.begin() + static_cast<std::ptrdiff_t>((y.size() - 1) * 99 / 100);
  std::nth_element(y.begin(), at, y.end());
  return *at;
}

/// What a PLY vertex is made of.
struct Points {
  std::span<const Vec3> position, colour, normal;
  const Tensor* coded_normal = nullptr;
  std::string quantity;
  float white = 0;
  DVec3 origin_m{0};
};

Points points_of(const Container& file) {
  if (!file.has("position"))
    throw Error(ExitCode::bad_input, file.path(), "has no positions, so there are no points to write");
  Points p;
  p.position = file.vectors("position");
  p.origin_m = origin_in(file.provenance().scene_parts);
  for (const char* quantity : {"irradiance", "flux"})
    if (file.has(quantity) && p.colour.empty()) p.colour = file.vectors(quantity), p.quantity = quantity;
  if (const auto normal = file.tensors().find("normal"); normal != file.tensors().end()) {
    if (is_octahedral(normal->second)) {
      p.coded_normal = &normal->second;
    } else {
      p.normal = file.vectors("normal");
    }
  }
  const std::size_t n = p.position.size();
  const bool whole = (p.quantity.empty() || p.colour.size() == n) &&
                     (p.normal.empty() || p.normal.size() == n) &&
                     (p.coded_normal == nullptr || p.coded_normal->elements() == n);
  if (!whole)
    throw Error(ExitCode::bad_input, file.path(),
                "its position, colour and normal have different numbers of rows");
  p.white = white_point(p.colour);
  return p;
}

std::optional<Vec3> normal_of(const Points& p, std::size_t i) {
  if (p.coded_normal != nullptr) return decode_octahedral(element<std::uint32_t>(*p.coded_normal, i));
  if (!p.normal.empty()) return p.normal[i];
  return std::nullopt;
}

std::string ply_header(const Container& file, const Points& p, PlyFormat format) {
  std::string out = "ply\nformat ";
  out += format == PlyFormat::ascii ? "ascii" : "binary_little_endian";
  out += text(" 1.0\ncomment phos ", name_of(file.kind()), "\nelement vertex ");
  append_number(out, p.position.size());
  const bool far = p.origin_m != DVec3(0);  // floats could not say the places
  out += far ? "\nproperty double x\nproperty double y\nproperty double z\n"
             : "\nproperty float x\nproperty float y\nproperty float z\n";
  if (p.coded_normal != nullptr || !p.normal.empty())
    out += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!p.quantity.empty()) {
    out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    out += "property float " + p.quantity + '\n';
  }
  return out + "end_header\n";
}

/// Appends values as text or as little-endian bytes.
class Record {
 public:
  Record(std::string& out, PlyFormat format) : out_(out), ascii_(format == PlyFormat::ascii) {}
  ~Record() {
    if (ascii_) out_ += '\n';
  }
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;
  void add(float v) { add_number(v); }
  void add(double v) { add_number(v); }
  void add(std::uint8_t v) {
    if (ascii_) return add_text(v);
    out_ += static_cast<char>(v);
  }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }

 private:
  template <class T>
  void add_number(T v) {
    static_assert(std::endian::native == std::endian::little);
    if (ascii_) return add_text(v);
    char bytes[sizeof v];
    std::memcpy(bytes, &v, sizeof v);
    out_.append(bytes, sizeof v);
  }
  template <class T>
  void add_text(T v) {
    if (!first_) out_ += ' ';
    first_ = false;
    append_number(out_, v);
  }
  std::string& out_;
  bool ascii_, first_ = true;
};

void append_vertex(std::string& out, const Points& p, std::size_t i, PlyFormat format) {
  Record record(out, format);
  if (p.origin_m == DVec3(0)) {
    record.add(p.position[i]);
  } else {
    for (int c = 0; c < 3; ++c) record.add(world_number(p.origin_m[c], p.position[i][c]));
  }
  if (const std::optional<Vec3> normal = normal_of(p, i)) record.add(*normal);
  if (p.quantity.empty()) return;
  const Vec3& c = p.colour[i];
  for (const float channel : {c.x, c.y, c.z}) record.add(srgb8(p.white > 0 ? channel / p.white : 0.f));
  record.add(luminance(c));
}

/// Calls append(out, i) for each row and passes the text on in pieces.
template <class Append>
void for_rows(std::size_t rows, const Sink& sink, std::string out, const Append& append) {
  for (std::size_t i = 0; i < rows; ++i) {
    append(out, i);
    if (out.size() < kPieceBytes) continue;
    throw_if_interrupted();
    sink(out);
    out.clear();
  }
  if (!out.empty()) sink(out);
}

}  // namespace

void dump_csv(const Container& file, const std::vector<std::string>& names, bool decode, const Sink& sink) {
  std::vector<Column> columns;
  std::string header;
  for (const std::string& name : names) {
    columns.push_back(make_column(file, name, decode));
    if (columns.back().tensor->shape[0] != columns.front().tensor->shape[0])
      throw Error(ExitCode::usage, file.path(),
                  text("tensors \"", names.front(), "\" and \"", name,
                       "\" have different numbers of rows; dump them apart"));
    for (const std::string& column : columns.back().names) append_item(header, column, ",");
  }
  if (columns.empty()) return;
  for_rows(static_cast<std::size_t>(columns.front().tensor->shape[0]), sink, header + '\n',
           [&](std::string& out, std::size_t row) {
             for (std::size_t c = 0; c < columns.size(); ++c) {
               if (c > 0) out += ',';
               append_cells(out, columns[c], row);
             }
             out += '\n';
           });
}

void write_ply(const Container& file, PlyFormat format, const Sink& sink) {
  const Points p = points_of(file);
  for_rows(p.position.size(), sink, ply_header(file, p, format),
           [&](std::string& out, std::size_t i) { append_vertex(out, p, i, format); });
}

}  // namespace phos::inline file
