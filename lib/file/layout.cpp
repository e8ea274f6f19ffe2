#include "file/layout.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "file/json_parse.h"
#include "file/lfs_pointer.h"

namespace phos::inline file {

namespace {

constexpr std::size_t kPrefixBytes = 8;
constexpr const char* kMetadataName = "__metadata__";

[[noreturn]] void bad(const std::string& where, const std::string& message) {
  throw Error(ExitCode::bad_input, where, message);
}
[[noreturn]] void damaged(const std::string& where, const std::string& message) {
  bad(where, "damaged: " + message + "; rerun the command that made it");
}

std::uint64_t little_endian64(std::span<const std::byte> bytes) {
  std::uint64_t v = 0;
  for (std::size_t i = 0; i < kPrefixBytes; ++i) v |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return v;
}

std::string_view characters(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// What a file that is none of ours seems to be.
std::string guess(std::span<const std::byte> file) {
  const std::string_view s = characters(file.first(std::min<std::size_t>(file.size(), 256)));
  if (s.starts_with("glTF")) return " (it is a glTF scene)";
  if (s.starts_with("\x76\x2f\x31\x01")) return " (it is an OpenEXR image)";
  if (s.starts_with("\x89PNG")) return " (it is a PNG picture)";
  if (is_lfs_pointer(s)) return text(" (it is ", kLfsPointer, ")");
  const bool printable = std::all_of(s.begin(), s.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 || c == '\n' || c == '\r' || c == '\t';
  });
  return printable ? " (it is text)" : "";
}

std::string not_ours(std::span<const std::byte> file) {
  return "is not a phos file" + guess(file) + "; give a file that a phos program wrote";
}

std::uint64_t as_extent(const Json& v, const std::string& where, const std::string& tensor,
                        const char* field) {
  if (!v.is_integer() || v.as_integer() < 0)
    damaged(where, text("tensor \"", tensor, "\" has an entry in \"", field,
                        "\" that is not a whole number of at least 0"));
  return static_cast<std::uint64_t>(v.as_integer());
}

const Json& member(const Json& entry, const std::string& where, const std::string& tensor,
                   const char* field) {
  const Json* found = entry.find(field);
  if (found == nullptr) damaged(where, text("tensor \"", tensor, "\" has no \"", field, "\""));
  return *found;
}

Dtype as_dtype(const Json& v, const std::string& where, const std::string& tensor) {
  for (const Dtype d : kDtypes)
    if (v.is_string() && v.as_string() == dtype_name(d)) return d;
  damaged(where, text("tensor \"", tensor, "\" has the unknown dtype ", v.dump()));
}

struct Extent {
  std::uint64_t begin, end;
  std::string name;
  auto operator<=>(const Extent&) const = default;
};

/// One entry of the table; the bytes are set once the data are known to be there.
Extent read_entry(const std::string& name, const Json& entry, const std::string& where, Tensor& tensor) {
  if (!entry.is_object()) damaged(where, text("the entry of tensor \"", name, "\" is not an object"));
  tensor.dtype = as_dtype(member(entry, where, name, "dtype"), where, name);
  const Json& shape = member(entry, where, name, "shape");
  const Json& offsets = member(entry, where, name, "data_offsets");
  if (!shape.is_array()) damaged(where, text("the shape of tensor \"", name, "\" is not an array"));
  if (!offsets.is_array() || offsets.as_array().size() != 2)
    damaged(where, text("\"data_offsets\" of tensor \"", name, "\" is not a pair"));
  const Extent extent{as_extent(offsets.as_array()[0], where, name, "data_offsets"),
                      as_extent(offsets.as_array()[1], where, name, "data_offsets"), name};
  std::uint64_t size = dtype_size(tensor.dtype);
  for (const Json& n : shape.as_array()) {
    tensor.shape.push_back(as_extent(n, where, name, "shape"));
    if (__builtin_mul_overflow(size, tensor.shape.back(), &size))
      damaged(where, text("tensor \"", name, "\" is larger than any memory"));
  }
  if (extent.end < extent.begin || extent.end - extent.begin != size)
    damaged(where, text("tensor \"", name, "\" needs ", size, " bytes, but its offsets are [", extent.begin,
                        ", ", extent.end, "]"));
  return extent;
}

}  // namespace

LayoutHeader read_layout_header(std::span<const std::byte> file, const std::string& where) {
  if (file.empty()) bad(where, "is empty, not a phos file; rerun the command that makes it");
  if (file.size() <= kPrefixBytes) {
    const bool cut = file.size() < kPrefixBytes || little_endian64(file) <= kMaxHeaderBytes;
    bad(where, cut ? text("is not a phos file, or truncated to ", file.size(),
                          " bytes; rerun the command that makes it")
                   : not_ours(file));
  }
  const std::uint64_t length = little_endian64(file);
  if (length > kMaxHeaderBytes || length == 0 || file[kPrefixBytes] != std::byte{'{'})
    bad(where, not_ours(file));
  if (length > file.size() - kPrefixBytes)
    bad(where, text("truncated: its header takes ", kPrefixBytes + length, " bytes, the file has ",
                    file.size(), "; rerun the command that made it"));
  LayoutHeader header;
  header.data_begin = kPrefixBytes + static_cast<std::size_t>(length);
  try {
    header.table =
        parse_json(characters(file.subspan(kPrefixBytes, static_cast<std::size_t>(length))), where);
  } catch (const Error& e) {
    damaged(where, std::string("its header is ") + e.what());
  }
  if (!header.table.is_object()) damaged(where, "its header is no JSON object");
  const Json* metadata = header.table.find(kMetadataName);
  if (metadata == nullptr) return header;
  if (!metadata->is_object()) damaged(where, "its metadata are no JSON object");
  for (const auto& [name, value] : metadata->as_object()) {
    if (!value.is_string()) damaged(where, text("the metadata entry \"", name, "\" is not a string"));
    header.metadata[name] = value.as_string();
  }
  return header;
}

std::map<std::string, Tensor> read_layout_tensors(const LayoutHeader& header, std::span<const std::byte> file,
                                                  const std::string& where) {
  std::map<std::string, Tensor> tensors;
  std::vector<Extent> extents;
  for (const auto& [name, entry] : header.table.as_object())
    if (name != kMetadataName) extents.push_back(read_entry(name, entry, where, tensors[name]));
  std::sort(extents.begin(), extents.end());

  const std::span<const std::byte> data = file.subspan(header.data_begin);
  std::uint64_t at = 0;
  for (const Extent& e : extents) {
    if (e.begin < at) damaged(where, text("tensor \"", e.name, "\" overlaps the one before it"));
    if (e.begin > at)
      damaged(where, text(e.begin - at, " bytes before tensor \"", e.name, "\" belong to none"));
    at = e.end;
  }
  if (at > data.size())
    bad(where, text("truncated: its tensors take ", at, " bytes, the file has ", data.size(),
                    " for them; rerun the command that made it"));
  if (at < data.size()) damaged(where, text(data.size() - at, " bytes too many at the end"));
  for (const Extent& e : extents) {
    Tensor& tensor = tensors[e.name];
    tensor.bytes = data.subspan(static_cast<std::size_t>(e.begin), static_cast<std::size_t>(e.end - e.begin));
    if ((header.data_begin + e.begin) % dtype_size(tensor.dtype) != 0)
      damaged(where, text("tensor \"", e.name, "\" is not aligned to its dtype"));
  }
  return tensors;
}

LayoutPlan plan_layout(const std::map<std::string, Tensor>& tensors, const Metadata& metadata) {
  std::vector<std::pair<std::string, const Tensor*>> order;
  for (const auto& [name, tensor] : tensors) order.emplace_back(name, &tensor);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return dtype_size(a.second->dtype) > dtype_size(b.second->dtype);
  });

  LayoutPlan plan;
  Json table(Json::Object{});
  Json entries(Json::Object{});
  for (const auto& [name, value] : metadata) entries[name] = value;
  table[kMetadataName] = entries;
  std::size_t at = 0;
  for (const auto& [name, tensor] : order) {
    Json shape(Json::Array{});
    for (const std::uint64_t n : tensor->shape) shape.push_back(n);
    Json& entry = table[name];
    entry["dtype"] = dtype_name(tensor->dtype);
    entry["shape"] = shape;
    entry["data_offsets"] = Json::Array{at, at + tensor->bytes.size()};
    at += tensor->bytes.size();
    plan.order.push_back(tensor);
  }
  std::string json = table.dump();
  const std::size_t unpadded = kPrefixBytes + json.size();
  json.append((kDataAlignment - unpadded % kDataAlignment) % kDataAlignment, ' ');
  PHOS_CHECK(json.size() <= kMaxHeaderBytes, json.size());
  for (std::size_t i = 0; i < kPrefixBytes; ++i)
    plan.header += static_cast<char>((json.size() >> (8 * i)) & 255);
  plan.header += json;
  return plan;
}

std::span<const std::byte> phos_header_bytes(std::span<const std::byte> file) {
  if (file.size() <= kPrefixBytes || file[kPrefixBytes] != std::byte{'{'}) return {};
  const std::uint64_t length = little_endian64(file);
  if (length > kMaxHeaderBytes || length > file.size() - kPrefixBytes) return {};
  const std::span<const std::byte> header = file.first(kPrefixBytes + static_cast<std::size_t>(length));
  const bool ours = characters(header).find("\"format\":\"phos/") != std::string_view::npos &&
                    characters(header).find("\"checksums\":\"") != std::string_view::npos;
  return ours ? header : std::span<const std::byte>{};
}

bool is_cut_in_header(std::span<const std::byte> file) {
  const std::string begin = text("{\"", kMetadataName, "\":");
  if (file.size() <= kPrefixBytes) return false;
  const std::uint64_t length = little_endian64(file);
  const std::string_view header = characters(file.subspan(kPrefixBytes));
  return length <= kMaxHeaderBytes && length > header.size() &&
         begin.starts_with(header.substr(0, begin.size()));
}

}  // namespace phos::inline file
