#include "photon/kd_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <flann/flann.hpp>
#include <limits>
#include <new>
#include <utility>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "photon/flann_stream.h"
#include "photon/kd_tree_check.h"

namespace phos {
namespace {

using Tree = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;

// Photon queries ask for hundreds of neighbours; small leaves would cost memory, build time and file size for
// nothing.
constexpr int kLeafSize = 16;
constexpr std::size_t kCheckChunk = 1 << 16;
constexpr auto kMostPoints = static_cast<std::size_t>(std::numeric_limits<int>::max());

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

/// What FLANN writes to a file, kept in memory. (open_memstream tells nobody of writes that it had no memory
/// for.)
struct Written {
  std::vector<std::byte> bytes;
  bool all = true;

  static ssize_t write(void* written, const char* data, std::size_t size) {
    auto& [bytes, all] = *static_cast<Written*>(written);
    const auto more = std::as_bytes(std::span(data, size));
    try {
      bytes.insert(bytes.end(), more.begin(), more.end());
    } catch (const std::bad_alloc&) {
      all = false;
      return 0;
    }
    return static_cast<ssize_t>(size);
  }
};

}  // namespace

struct KdTree::Impl {
  explicit Impl(std::span<const Vec3> p) : points(p), tree(matrix(p), parameters()) {}
  std::span<const Vec3> points;
  Tree tree;
};

bool KdTree::in_range(const Vec3& p) {
  return is_finite(p) && max_component(glm::abs(p)) <= kLargestCoordinate_m;
}

KdTree::KdTree() = default;
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::require_fit(std::span<const Vec3> points) {
  if (points.size() > kMostPoints)
    throw Error(ExitCode::numerical, "",
                text(points.size(), " photons are more than one map can hold (2147483647); use fewer paths"));
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
  const NoFloatTraps traps;  // FLANN divides by the spread of coincident points
  const StopAtOnce stop;     // and does not look
  result.impl_->tree.buildIndex();
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
    result.impl_->tree.loadIndex(file.get());
  } catch (const flann::FLANNException& e) {
    refuse(text("cannot be read (", e.what(), ")"));
  }
  return result;
}

std::vector<std::byte> KdTree::save() const {
  if (!impl_) return {};
  Written written;
  const File file(fopencookie(&written, "w",
                              {.read = nullptr, .write = Written::write, .seek = nullptr, .close = nullptr}));
  if (!file) throw std::bad_alloc();
  impl_->tree.saveIndex(file.get());
  if (std::fflush(file.get()) != 0 || !written.all) throw std::bad_alloc();
  return std::move(written.bytes);
}

void KdTree::in_sphere(const Vec3& p, float radius_m, std::vector<std::uint32_t>& rows) const {
  rows.clear();
  if (!impl_ || !(radius_m >= 0) || !in_range(p)) return;
  Rows result(limit_of(radius_m), rows);
  impl_->tree.findNeighbors(result, &p.x, flann::SearchParams());
}

void KdTree::nearest(const Vec3& p, std::size_t k, std::vector<std::uint32_t>& rows,
                     std::vector<float>& distance2_m2, float most_m) const {
  rows.clear(), distance2_m2.clear();
  if (!impl_ || k == 0 || !(most_m >= 0) || !in_range(p)) return;
  Nearest result(std::min(k, impl_->points.size()), limit_of(most_m));
  impl_->tree.findNeighbors(result, &p.x, flann::SearchParams());
  for (const auto& [distance2, row] : result.sorted()) {
    rows.push_back(row), distance2_m2.push_back(distance2);
  }
}

}  // namespace phos
