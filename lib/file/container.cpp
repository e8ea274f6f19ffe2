#include "file/container.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "file/atomic_file.h"
#include "file/json_parse.h"
#include "file/layout.h"
#include "file/mapped_file.h"

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
    throw Error(ExitCode::bad_input, where, text("damaged: \"", entry, "\" is no object"));
  for (const auto& [name, value] : json.as_object()) {
    if (!value.is_string())
      throw Error(ExitCode::bad_input, where, text("damaged: \"", entry, "\" holds no strings"));
    out[name] = value.as_string();
  }
  return out;
}

std::string shape_text(const Shape& shape, bool pattern = false) {
  std::string out;
  for (const std::uint64_t n : shape) {
    if (!out.empty()) out += ',';
    out += pattern && n == 0 ? std::string("n") : std::to_string(n);
  }
  return text('[', out, ']');
}

bool fits(const Shape& shape, const Shape& pattern) {
  return std::equal(shape.begin(), shape.end(), pattern.begin(), pattern.end(),
                    [](std::uint64_t n, std::uint64_t wanted) { return wanted == 0 || n == wanted; });
}

void check_version(const Provenance& p, const std::string& where) {
  if (p.version == kLayoutVersion) return;
  throw Error(ExitCode::bad_input, where,
              text("is of format phos/", p.kind, '/', p.version, ", this program reads phos/", p.kind, '/',
                   kLayoutVersion, "; rerun the command that made it, or use a phos of that version",
                   p.tool.empty() ? "" : " (it was made by " + p.tool + ")"));
}

}  // namespace

std::uint64_t Tensor::elements() const {
  std::uint64_t n = 1;
  for (const std::uint64_t extent : shape) n *= extent;
  return n;
}

struct Container::Impl {
  Impl(const std::string& path, const std::string& kind);
  void check(const std::string& name, const Tensor& tensor) const;

  std::string path;
  MappedFile file;
  Provenance provenance;
  std::map<std::string, Tensor> tensors;
  std::map<std::string, std::string> checksums;
  mutable std::atomic<bool> verified = false;  ///< all of it, so that nobody needs to again
};

Container::Impl::Impl(const std::string& p, const std::string& kind) : path(p), file(p) {
  const LayoutHeader header = read_layout_header(file.bytes(), path);
  provenance = from_metadata(header.metadata, path);
  check_version(provenance, path);
  if (!kind.empty() && provenance.kind != kind)
    throw Error(ExitCode::bad_input, path,
                text("is a ", provenance.kind, " file, not ", kind, "; give what phos-", kind, " writes"));
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

void Container::Impl::check(const std::string& name, const Tensor& tensor) const {
  if (hash_bytes(tensor.bytes).hex() == checksums.at(name)) return;
  throw Error(ExitCode::bad_input, path,
              text("damaged: tensor \"", name,
                   "\" has changed since it was written; rerun the command that made it"));
}

Container Container::open(const std::string& path, const std::string& kind) {
  Container container;
  container.impl_ = std::make_shared<const Impl>(path, kind);
  return container;
}

const std::string& Container::path() const { return impl_->path; }
const Provenance& Container::provenance() const { return impl_->provenance; }
bool Container::has(const std::string& tensor) const { return impl_->tensors.contains(tensor); }
const std::map<std::string, Tensor>& Container::tensors() const { return impl_->tensors; }

const Tensor& Container::require(const std::string& name, Dtype dtype, const Shape& shape) const {
  const auto found = impl_->tensors.find(name);
  if (found == impl_->tensors.end())
    throw Error(ExitCode::bad_input, path(),
                text("has no tensor \"", name, "\"; rerun the command that made it"));
  const Tensor& t = found->second;
  if (t.dtype != dtype || !fits(t.shape, shape))
    throw Error(ExitCode::bad_input, path(),
                text("tensor \"", name, "\" is ", dtype_name(t.dtype), shape_text(t.shape), ", not ",
                     dtype_name(dtype), shape_text(shape, true), "; rerun the command that made it"));
  return t;
}

void Container::verify() const {
  if (impl_->verified) return;
  for (const auto& [name, tensor] : impl_->tensors) impl_->check(name, tensor);
  impl_->verified = true;
}

void Container::verify(const std::string& name) const {
  const auto found = impl_->tensors.find(name);
  if (found == impl_->tensors.end())
    throw Error(ExitCode::bad_input, path(),
                text("has no tensor \"", name, "\"; rerun the command that made it"));
  impl_->check(name, found->second);
}

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

void ContainerWriter::add_tensor(const std::string& name, Tensor tensor) {
  PHOS_CHECK(!name.empty() && name != kHeaderChecksum, name);
  PHOS_CHECK(!tensors_.contains(name), name, " is added twice");
  PHOS_CHECK(tensor.elements() * dtype_size(tensor.dtype) == tensor.bytes.size(), name,
             shape_text(tensor.shape), " of ", dtype_name(tensor.dtype), " with ", tensor.bytes.size(),
             " bytes");
  tensors_[name] = std::move(tensor);
}

void ContainerWriter::write(const std::string& path, const Provenance& provenance) const {
  AtomicFile file(path);
  Metadata metadata = to_metadata(provenance);
  std::map<std::string, std::string> checksums;
  Json units(Json::Object{});
  std::vector<std::pair<const Tensor*, std::string*>> unknown;
  for (const auto& [name, tensor] : tensors_) {
    unknown.emplace_back(&tensor, &checksums[name]);
    units[name] = tensor.unit;
  }
  parallel_for(unknown.size(), 1,
               [&](std::size_t i) { *unknown[i].second = hash_bytes(unknown[i].first->bytes).hex(); });
  metadata[kUnits] = units.dump();
  checksums[kHeaderChecksum] = header_checksum(metadata, tensors_, checksums);
  Json all(Json::Object{});
  for (const auto& [name, hash] : checksums) all[name] = hash;
  metadata[kChecksums] = all.dump();

  const LayoutPlan plan = plan_layout(tensors_, metadata);
  file.write(plan.header);
  constexpr std::size_t kPiece = std::size_t{64}
                                 << 20;  // between two looks at whether the user wants to stop
  for (const Tensor* tensor : plan.order)
    for (std::span<const std::byte> rest = tensor->bytes; !rest.empty();) {
      throw_if_interrupted();
      const std::size_t n = std::min(rest.size(), kPiece);
      file.write(rest.first(n));
      rest = rest.subspan(n);
    }
  file.commit();
}

}  // namespace phos::inline file
