#include "file/container.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/kinds/sound.h"
#include "file/layout.h"
#include "file/mapped_file.h"
#include "file/provenance.h"

namespace phos::inline file {

namespace {

constexpr const char* kChecksums = "checksums";
constexpr const char* kUnits = "units";
/// Entry of `checksums` for the header itself. No tensor can have this name.
constexpr const char* kHeaderChecksum = "__metadata__";

/// Hash of everything that the header says (values, not their spelling or order), so that a changed digit in
/// a parameter is noticed like one in the data. `checksums` are the tensors' own.
std::string header_checksum(const Metadata& metadata, const std::map<std::string, Tensor>& tensors,
                            const std::map<std::string, std::string>& checksums) {
  Hasher hasher;
  for (const auto& [name, value] : metadata) {
    if (name == kChecksums) continue;
    hasher.add(name);
    hasher.add(value);
  }
  for (const auto& [name, tensor] : tensors) {
    hasher.add(name);
    hasher.add(std::string_view(dtype_name(tensor.dtype)));
    hasher.add_span(std::span<const std::uint64_t>(tensor.shape));
    hasher.add(checksums.at(name));
  }
  return hasher.finish().hex();
}

std::map<std::string, std::string> strings_by_name(const Metadata& metadata, const char* entry,
                                                   const std::string& where) {
  std::map<std::string, std::string> out;
  const auto found = metadata.find(entry);
  if (found == metadata.end())
    throw Error(ExitCode::bad_input, where,
                text("damaged: no \"", entry, "\" in its metadata; rerun the command that made it"));
  const Json json = parse_json(found->second, where);
  if (!json.is_object())
    throw Error(ExitCode::bad_input, where,
                text("damaged: \"", entry, "\" is not an object; rerun the command that made it"));
  for (const auto& [name, value] : json.as_object()) {
    if (!value.is_string())
      throw Error(ExitCode::bad_input, where,
                  text("damaged: \"", entry, "\" holds no strings; rerun the command that made it"));
    out[name] = value.as_string();
  }
  return out;
}

/// 0 is any extent.
std::string pattern_words(const Shape& shape) {
  std::string out;
  for (const std::uint64_t n : shape) out += text(out.empty() ? "" : ",", n == 0 ? "n" : std::to_string(n));
  return text('[', out, ']');
}

bool has_extents(const Shape& shape, const Shape& pattern) {
  return std::equal(shape.begin(), shape.end(), pattern.begin(), pattern.end(),
                    [](std::uint64_t n, std::uint64_t wanted) { return wanted == 0 || n == wanted; });
}

void check_version(const Provenance& p, const std::string& where) {
  const int known = row_of(p.kind).version;
  if (p.version == known) return;
  throw Error(
      ExitCode::bad_input, where,
      text("is of format phos/", name_of(p.kind), '/', p.version, ", this program reads phos/",
           name_of(p.kind), '/', known, "; rerun the command that made it, or use a phos of that version",
           p.tool.empty() ? "" : " (it was made by " + p.tool + ")"));
}

[[noreturn]] void refuse_changed(const Container& file, const std::string& tensor) {
  throw Error(ExitCode::bad_input, file.path(),
              text("damaged: tensor \"", tensor,
                   "\" has changed since it was written; rerun the command that made it"));
}

/// Calls act(piece) for one piece after another. Between two it looks whether the user wants to stop.
template <class Act>
void for_pieces(std::span<const std::byte> bytes, std::size_t piece, const Act& act) {
  while (!bytes.empty()) {
    throw_if_interrupted();
    const std::size_t n = std::min(bytes.size(), piece);
    act(bytes.first(n));
    bytes = bytes.subspan(n);
  }
}

/// Of mapped tensors one after another, so that few of their pages are in memory at a time.
std::map<std::string, std::string> tensor_checksums(const std::map<std::string, Tensor>& tensors,
                                                    bool mapped) {
  constexpr std::size_t kPiece = std::size_t{4} << 20;
  std::map<std::string, std::string> checksums;
  if (mapped) {
    for (const auto& [name, tensor] : tensors) {
      Hasher hasher;
      for_pieces(tensor.bytes, kPiece, [&](std::span<const std::byte> piece) {
        hasher.add_bytes(piece.data(), piece.size());
        release_pages(piece);
      });
      checksums[name] = hasher.finish().hex();
    }
    return checksums;
  }
  std::vector<std::pair<const Tensor*, std::string*>> unknown;
  for (const auto& [name, tensor] : tensors) unknown.emplace_back(&tensor, &checksums[name]);
  parallel_for(unknown.size(), 1,
               [&](std::size_t i) { *unknown[i].second = hash_bytes(unknown[i].first->bytes).hex(); });
  return checksums;
}

}  // namespace

std::uint64_t Tensor::elements() const {
  std::uint64_t n = 1;
  for (const std::uint64_t extent : shape) n *= extent;
  return n;
}

struct Container::Impl {
  Impl(const std::string& path, std::optional<FileKind> kind);

  std::string path;
  MappedFile file;
  Provenance provenance;
  std::map<std::string, Tensor> tensors;
  std::map<std::string, std::string> checksums;
  mutable std::atomic<bool> verified = false, sound = false;  ///< the whole file, so that it is checked once
};

Container::Impl::Impl(const std::string& p, std::optional<FileKind> kind) : path(p), file(p) {
  const LayoutHeader header = read_layout_header(file.bytes(), path);
  provenance = from_metadata(header.metadata, path);
  check_version(provenance, path);
  if (kind && provenance.kind != *kind)
    throw Error(ExitCode::bad_input, path,
                text("holds ", name_of(provenance.kind), ", not ", name_of(*kind),
                     "; give the output of phos-", name_of(*kind)));
  tensors = read_layout_tensors(header, file.bytes(), path);
  checksums = strings_by_name(header.metadata, kChecksums, path);
  const std::map<std::string, std::string> units = strings_by_name(header.metadata, kUnits, path);
  for (auto& [name, tensor] : tensors) {
    if (!checksums.contains(name))
      throw Error(ExitCode::bad_input, path,
                  text("damaged: no checksum of tensor \"", name, "\"; rerun the command that made it"));
    if (const auto unit = units.find(name); unit != units.end()) tensor.unit = unit->second;
  }
  const auto stated = checksums.find(kHeaderChecksum);
  if (stated == checksums.end() || stated->second != header_checksum(header.metadata, tensors, checksums))
    throw Error(ExitCode::bad_input, path,
                "damaged: its header has changed since it was written; rerun the command that made it");
}

Container Container::open(const std::string& path, std::optional<FileKind> kind) {
  Container container;
  container.impl_ = std::make_shared<const Impl>(path, kind);
  return container;
}

const std::string& Container::path() const { return impl_->path; }
const Provenance& Container::provenance() const { return impl_->provenance; }
bool Container::has(const std::string& tensor) const { return impl_->tensors.contains(tensor); }
const std::map<std::string, Tensor>& Container::tensors() const { return impl_->tensors; }

const Tensor& Container::require(const std::string& name, Dtype dtype, const Shape& shape) const {
  const Tensor& t = require_tensor(*this, name);
  if (t.dtype != dtype || !has_extents(t.shape, shape))
    throw Error(ExitCode::bad_input, path(),
                text("tensor \"", name, "\" is ", dtype_name(t.dtype), shape_words(t.shape), ", not ",
                     dtype_name(dtype), pattern_words(shape), "; rerun the command that made it"));
  return t;
}

void Container::verify() const {
  if (impl_->verified) return;
  std::vector<const std::pair<const std::string, Tensor>*> all;
  for (const auto& named : impl_->tensors) all.push_back(&named);
  std::vector<char> changed(all.size());
  parallel_for(all.size(), 1, [&](std::size_t i) {
    changed[i] = hash_bytes(all[i]->second.bytes).hex() != impl_->checksums.at(all[i]->first);
  });
  for (std::size_t i = 0; i < all.size(); ++i)
    if (changed[i]) refuse_changed(*this, all[i]->first);
  impl_->verified = true;
}

void Container::require_sound() const {
  if (impl_->sound) return;
  require_layout(*this);
  verify();
  require_sound_numbers(*this);
  impl_->sound = true;
}

void Container::require_sound_in(std::size_t window) const {
  require_layout(*this);
  for (const auto& [name, tensor] : impl_->tensors) {
    Hasher hasher;
    for_pieces(tensor.bytes, window, [&](std::span<const std::byte> piece) {
      hasher.add_bytes(piece.data(), piece.size());
      release(piece);
    });
    if (hasher.finish().hex() != impl_->checksums.at(name)) refuse_changed(*this, name);
  }
  require_sound_numbers(*this, window);
}

void Container::release(std::span<const std::byte> part) const { impl_->file.release(part); }

bool is_container(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;  // looking would drain a pipe
  try {
    const MappedFile file(path);
    return !phos_header_bytes(file.bytes()).empty() || is_cut_in_header(file.bytes());
  } catch (const Error&) {
    return false;
  }
}

void ContainerWriter::add(const std::string& name, Tensor tensor) {
  PHOS_CHECK(!name.empty() && name != kHeaderChecksum, name);
  PHOS_CHECK(!tensors_.contains(name), name, " is added twice");
  PHOS_CHECK(tensor.elements() * dtype_size(tensor.dtype) == tensor.bytes.size(), name,
             shape_words(tensor.shape), " of ", dtype_name(tensor.dtype), " with ", tensor.bytes.size(),
             " bytes");
  tensors_[name] = std::move(tensor);
}

void ContainerWriter::write(const std::string& path, const Provenance& provenance) const {
  write(path, provenance, false);
}

void ContainerWriter::write_mapped(const std::string& path, const Provenance& provenance) const {
  write(path, provenance, true);
}

void ContainerWriter::write(const std::string& path, const Provenance& provenance, bool mapped) const {
  AtomicFile file(path);
  Metadata metadata = to_metadata(provenance);
  std::map<std::string, std::string> checksums = tensor_checksums(tensors_, mapped);
  Json units(Json::Object{});
  for (const auto& [name, tensor] : tensors_) units[name] = tensor.unit;
  metadata[kUnits] = units.dump();
  checksums[kHeaderChecksum] = header_checksum(metadata, tensors_, checksums);
  Json all(Json::Object{});
  for (const auto& [name, hash] : checksums) all[name] = hash;
  metadata[kChecksums] = all.dump();

  const LayoutPlan plan = plan_layout(tensors_, metadata);
  file.write(plan.header);
  const std::size_t piece = std::size_t{mapped ? 4u : 64u} << 20;
  for (const Tensor* tensor : plan.order)
    for_pieces(tensor->bytes, piece, [&](std::span<const std::byte> bytes) {
      file.write(bytes);
      if (mapped) release_pages(bytes);
    });
  file.commit();
}

}  // namespace phos::inline file
