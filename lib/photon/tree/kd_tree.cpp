#include "photon/tree/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <flann/flann.hpp>
#include <limits>
#include <mutex>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "file/mapped_file.h"
#include "file/scratch/scratch_file.h"
#include "photon/limits.h"
#include "photon/tree/build.h"
#include "photon/tree/check.h"
#include "photon/tree/flann_compress.h"
#include "photon/tree/flann_stream.h"
#include "photon/tree/tree_on_disk.h"

namespace phos::inline photon {
namespace {

using Tree = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;

// Photon queries ask for hundreds of neighbours; small leaves would cost memory, build time and file size for
// nothing.
constexpr int kLeafSize = 16;
constexpr std::size_t kCheckChunk = 1 << 16;
constexpr auto kMostPoints = kMostPhotons.as<std::size_t>();
static_assert(kMostPhotons.most <= std::numeric_limits<int>::max(), "FLANN counts in int");

// FLANN takes a mutable pointer but never writes through it (reorder = false).
flann::Matrix<float> matrix(std::span<const Vec3> points) {
  return {const_cast<float*>(&points.data()->x), points.size(), 3};
}

flann::KDTreeSingleIndexParams parameters() { return {kLeafSize, /*reorder=*/false}; }

/// Is it a single kd-tree over floats, compressed? The enumerations may hold anything.
bool is_our_kind(const flann::IndexHeader& header) {
  int data, index;
  static_assert(sizeof data == sizeof header.h.data_type && sizeof index == sizeof header.h.index_type);
  std::memcpy(&data, &header.h.data_type, sizeof data);
  std::memcpy(&index, &header.h.index_type, sizeof index);
  return data == flann::flann_datatype_value<float>::value && index == flann::FLANN_INDEX_KDTREE_SINGLE &&
         header.h.compression == 1;
}

/// Collects without sorting every point nearer than the limit.
class Rows final : public flann::ResultSet<float> {
 public:
  Rows(float limit2_m2, std::vector<std::uint32_t>& rows) : limit_(limit2_m2), rows_(rows) {}
  bool full() const override { return true; }
  void addPoint(float, std::size_t index) override { rows_.push_back(static_cast<std::uint32_t>(index)); }
  float worstDist() const override { return limit_; }

 private:
  float limit_;
  std::vector<std::uint32_t>& rows_;
};

/// Collects the k nearest of the points nearer than a limit. They are sorted out once many too many have
/// come.
class Nearest final : public flann::ResultSet<float> {
 public:
  Nearest(std::size_t k, float limit2_m2) : k_(k), limit_(limit2_m2) { found_.reserve(k + kMore); }
  bool full() const override { return true; }
  void addPoint(float distance2, std::size_t index) override {
    if (!(distance2 < limit_)) return;
    found_.emplace_back(distance2, static_cast<std::uint32_t>(index));
    if (found_.size() < k_ + kMore) return;
    const auto last = found_.begin() + static_cast<std::ptrdiff_t>(k_ - 1);
    std::nth_element(found_.begin(), last, found_.end());
    found_.resize(k_);
    limit_ = std::nextafter(found_.back().first, std::numeric_limits<float>::infinity());
  }
  float worstDist() const override { return limit_; }

  std::span<const std::pair<float, std::uint32_t>> sorted() {
    std::sort(found_.begin(), found_.end());
    if (found_.size() > k_) found_.resize(k_);
    return found_;
  }

 private:
  static constexpr std::size_t kMore = 64;
  std::size_t k_;
  float limit_;
  std::vector<std::pair<float, std::uint32_t>> found_;
};

/// What FLANN compares strictly, so that a squared distance of radius_m is within: one step up.
float limit_of(float radius_m) {
  const float limit = std::nextafter(radius_m * radius_m, std::numeric_limits<float>::infinity());
  return std::fmax(limit, std::numeric_limits<float>::min());
}

std::size_t count_out_of_range(std::span<const Vec3> points) {
  return parallel_reduce<std::size_t>(
      points.size(), kCheckChunk, 0,
      [&](std::size_t begin, std::size_t end) {
        std::size_t n = 0;
        for (std::size_t i = begin; i < end; ++i) n += KdTree::in_range(points[i]) ? 0 : 1;
        return n;
      },
      [](std::size_t& total, std::size_t n) { total += n; });
}

struct FileCloser {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

flann::IndexHeader header_of(std::size_t points) {
  flann::IndexHeader header;
  header.h.data_type = flann::flann_datatype_value<float>::value;
  header.h.index_type = flann::FLANN_INDEX_KDTREE_SINGLE;
  header.h.rows = points, header.h.cols = 3;
  header.h.compression = 1;
  return header;
}

/// What FLANN saves of an index, header too, not compressed; and loads.
class Contents : public flann::serialization::OutputArchive<Contents> {
 public:
  std::vector<std::byte> bytes;

  template <class T>
  void save(const T& value) {
    const auto more = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  template <class T>
  void save(T* const&) {}
  void save_binary(const void* data, std::size_t size) {
    const auto* more = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), more, more + size);
  }
};

class ContentsReader : public flann::serialization::InputArchive<ContentsReader> {
 public:
  ContentsReader(const flann::IndexHeader& header, std::span<const std::byte> contents)
      : header_(std::as_bytes(std::span(&header, 1))), contents_(contents) {}

  template <class T>
  void load(T& value) {
    std::span<const std::byte>& from = header_.empty() ? contents_ : header_;
    PHOS_CHECK(sizeof value <= from.size(), "a tree's contents end too early");
    std::memcpy(&value, from.data(), sizeof value);
    from = from.subspan(sizeof value);
  }
  template <class T>
  void load(T*&) {}
  void load_binary(void*, std::size_t) { PHOS_CHECK(false, "a tree holds no points"); }

 private:
  std::span<const std::byte> header_, contents_;
};

}  // namespace

struct KdTree::Impl {
  explicit Impl(std::span<const Vec3> p) : points(p) {}

  /// FLANN's tree. One that is only built and saved never needs it.
  Tree& tree() {
    std::call_once(made, [this] {
      index.emplace(matrix(points), parameters());
      if (contents.empty()) return;
      const flann::IndexHeader header = header_of(points.size());
      ContentsReader reader(header, contents);
      index->serialize(reader);
      contents = {};
    });
    return *index;
  }

  std::span<const Vec3> points;
  Column<std::byte> contents;  // of build_tree(), until FLANN has them

 private:
  std::once_flag made;
  std::optional<Tree> index;
};

bool KdTree::in_range(const Vec3& p) {
  return is_finite(p) && max_component(glm::abs(p)) <= kLargestCoordinate_m;
}

KdTree::KdTree() = default;
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::require_fit(std::size_t count) {
  if (count > kMostPoints)
    throw Error(
        ExitCode::numerical, "",
        text(count, " photons are more than one map can hold (", kMostPhotons.most, "); use fewer paths"));
}

void KdTree::require_fit(std::span<const Vec3> points) {
  require_fit(points.size());
  if (const std::size_t bad = count_out_of_range(points); bad > 0)
    throw Error(ExitCode::numerical, "",
                text(bad, " of ", points.size(), " photon positions are not finite or beyond ",
                     kLargestCoordinate_m, " m; check the scene with phos-scene"));
}

KdTree KdTree::build(std::span<const Vec3> points) {
  KdTree result;
  if (points.empty()) return result;
  require_fit(points);
  result.impl_ = std::make_unique<Impl>(points);
  result.impl_->contents = build_tree(points, kLeafSize);
  return result;
}

KdTree KdTree::load(std::span<const Vec3> points, std::span<const std::byte> bytes,
                    const std::string& where) {
  KdTree result;
  if (points.empty() && bytes.empty()) return result;
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::bad_input, where,
                text("the kd-tree ", why, "; make the file again with phos-photons"));
  };
  flann::IndexHeader header;
  if (points.empty() || bytes.size() < sizeof header) refuse("does not fit the photons");
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
  if (std::memcmp(header.h.signature, FLANN_SIGNATURE_, sizeof FLANN_SIGNATURE_) != 0)
    refuse("has another version of FLANN's format");
  if (header.h.rows != points.size() || header.h.cols != 3)
    refuse(text("is over ", header.h.rows, " points, but there are ", points.size(), " photons"));
  if (!is_our_kind(header)) refuse("is of another kind");
  if (points.size() > kMostPoints) refuse(text("cannot be over ", points.size(), " photons"));
  if (const std::size_t bad = count_out_of_range(points); bad > 0)
    refuse(text("cannot be over photons of which ", bad, " are nowhere in space"));
  try {
    check_tree(points, {bytes, sizeof header, header.h.first_block_size});
  } catch (const FlannStream::Damaged& e) {
    refuse(e.what());
  }
  const File file(fmemopen(const_cast<std::byte*>(bytes.data()), bytes.size(), "rb"));
  PHOS_CHECK(file != nullptr, "fmemopen of ", bytes.size(), " bytes");
  result.impl_ = std::make_unique<Impl>(points);
  try {
    result.impl_->tree().loadIndex(file.get());
  } catch (const flann::FLANNException& e) {
    refuse(text("cannot be read (", e.what(), ")"));
  }
  return result;
}

std::vector<std::byte> KdTree::save() const {
  if (!impl_) return {};
  const flann::IndexHeader header = header_of(impl_->points.size());
  const std::span<const std::byte> bytes = std::as_bytes(std::span(&header, 1));
  if (!impl_->contents.empty()) return compress_tree(bytes, impl_->contents);
  Contents contents;
  impl_->tree().serialize(contents);
  return compress_tree(bytes, std::span(contents.bytes).subspan(sizeof header));
}

void KdTree::save_on_disk(ScratchFile& points, std::size_t count, std::uint64_t memory_bytes,
                          const std::string& output, ScratchFile& saved) {
  if (count == 0) return;
  ScratchFile file(output);
  build_tree_on_disk(points, count, kLeafSize, memory_bytes, output, file);
  const flann::IndexHeader header = header_of(count);
  const std::span<const std::byte> contents = file.map();
  Progress progress("compressing the kd-tree", contents.size(), "bytes");
  std::size_t released = 0;
  compress_tree(std::as_bytes(std::span(&header, 1)), contents,
                [&](std::span<const std::byte> piece, std::size_t done) {
                  saved.write(piece);
                  release_pages(contents.subspan(released, done - released));
                  progress.advance(done - released);
                  released = done;
                });
  progress.advance(contents.size() - released);
}

void KdTree::in_sphere(const Vec3& p, float radius_m, std::vector<std::uint32_t>& rows) const {
  rows.clear();
  if (!impl_ || !(radius_m >= 0) || !in_range(p)) return;
  Rows result(limit_of(radius_m), rows);
  impl_->tree().findNeighbors(result, &p.x, flann::SearchParams());
}

void KdTree::nearest(const Vec3& p, std::size_t k, std::vector<std::uint32_t>& rows,
                     std::vector<float>& distance2_m2, float most_m) const {
  rows.clear(), distance2_m2.clear();
  if (!impl_ || k == 0 || !(most_m >= 0) || !in_range(p)) return;
  Nearest result(std::min(k, impl_->points.size()), limit_of(most_m));
  impl_->tree().findNeighbors(result, &p.x, flann::SearchParams());
  for (const auto& [distance2, row] : result.sorted()) {
    rows.push_back(row), distance2_m2.push_back(distance2);
  }
}

}  // namespace phos::inline photon
