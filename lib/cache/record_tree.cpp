// Octree of records after Ward, Rubinstein, Clear (1988): a record hangs in every cell of about its own size
// that its zone of influence touches, so that a query walks one path from the root.
#include <algorithm>
#include <array>

#include "cache/irradiance_cache.h"
#include "core/error.h"

namespace phos {
namespace {

constexpr float kLeastWeight = 1e-6f;  // below it a record counts as a miss (FORMULAS A4)
constexpr int kDeepest = 40;
constexpr std::uint32_t kNone = ~0u;

/// What a lookup needs of a record before it is known to be valid, side by side.
struct Entry {
  Vec3 position;
  float radius_m;
  Vec3 normal;
  std::uint32_t record, next;
};

struct Cell {
  std::array<std::uint32_t, 8> child;
  std::uint32_t first = kNone;
  Cell() { child.fill(kNone); }
};

}  // namespace

struct RecordTree::Impl {
  float accuracy;
  DVec3 lo;
  double side_m;
  std::vector<IrradianceRecord> records;
  std::vector<Cell> cells{1};
  std::vector<Entry> entries;
  std::vector<std::size_t> first_entry;  // per record; a record's entries lie together

  /// Octant of a point, and the corner of that octant. Points outside of the root fall into its border cells:
  /// insertion and lookup clamp alike, so nothing is missed.
  static unsigned octant(const DVec3& p, const DVec3& middle) {
    return (p.x >= middle.x ? 1u : 0u) | (p.y >= middle.y ? 2u : 0u) | (p.z >= middle.z ? 4u : 0u);
  }
  static DVec3 corner(const DVec3& corner_lo, double half, unsigned o) {
    return corner_lo + half * DVec3(o & 1u ? 1 : 0, o & 2u ? 1 : 0, o & 4u ? 1 : 0);
  }

  void hang(std::uint32_t cell, const DVec3& cell_lo, double side, const DVec3& box_lo, const DVec3& box_hi,
            double size_m, int depth, const Entry& entry) {
    if (side < 4 * size_m || depth == kDeepest) {
      entries.push_back(entry);
      entries.back().next = cells[cell].first;
      cells[cell].first = static_cast<std::uint32_t>(entries.size() - 1);
      return;
    }
    const double half = side / 2;
    const DVec3 middle = cell_lo + half;
    const unsigned from = octant(box_lo, middle), to = octant(box_hi, middle);
    for (unsigned o = 0; o < 8; ++o) {
      if ((o & from) != from || (o & ~to) != 0) continue;  // not between the two on every axis
      if (cells[cell].child[o] == kNone) {
        cells[cell].child[o] = static_cast<std::uint32_t>(cells.size());
        cells.emplace_back();
      }
      hang(cells[cell].child[o], corner(cell_lo, half, o), half, box_lo, box_hi, size_m, depth + 1, entry);
    }
  }

  /// visit(record index, weight) for each record valid at p until it returns false.
  template <class Visit>
  void visit_valid(const Vec3& p, const Vec3& n, const Visit& visit) const {
    std::uint32_t cell = 0;
    DVec3 cell_lo = lo;
    double side = side_m;
    const DVec3 point(p);
    while (cell != kNone) {
      for (std::uint32_t i = cells[cell].first; i != kNone; i = entries[i].next) {
        const Entry& e = entries[i];
        const Vec3 d = p - e.position;
        const float reach = accuracy * e.radius_m;
        if (!(glm::dot(d, d) < reach * reach)) continue;
        const IrradianceRecord& r = records[e.record];
        const float w = record_weight(record_error(r, p, n), accuracy);
        if (w > kLeastWeight && !record_in_front(r, p, n) && !visit(e.record, w)) return;
      }
      side /= 2;
      const unsigned o = octant(point, cell_lo + side);
      cell_lo = corner(cell_lo, side, o);
      cell = cells[cell].child[o];
    }
  }
};

RecordTree::RecordTree(const Bounds& bounds, double accuracy) : impl_(std::make_unique<Impl>()) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  impl_->accuracy = static_cast<float>(accuracy);
  const DVec3 centre = bounds.empty() ? DVec3(0) : DVec3(bounds.centre());
  const double side = std::max(static_cast<double>(max_component(bounds.size())), 1e-30);
  impl_->side_m = side;
  impl_->lo = centre - side / 2;
}
RecordTree::~RecordTree() = default;
RecordTree::RecordTree(RecordTree&&) noexcept = default;

void RecordTree::insert(const IrradianceRecord& r) {
  PHOS_CHECK(r.radius_m > 0 && is_finite(r.position), "radius ", r.radius_m);
  const auto index = static_cast<std::uint32_t>(impl_->records.size());
  impl_->records.push_back(r);
  impl_->first_entry.push_back(impl_->entries.size());
  const double reach = static_cast<double>(impl_->accuracy) * static_cast<double>(r.radius_m);
  // The lookup measures in float: let the box be larger by its rounding.
  const Vec3 size = glm::abs(r.position);
  const double slack = 1e-5 * std::min(reach, 1e30) + 1e-6 * static_cast<double>(max_component(size));
  const DVec3 centre(r.position);
  const double half = std::min(reach, 1e35) + slack;
  impl_->hang(0, impl_->lo, impl_->side_m, centre - half, centre + half, half, 0,
              Entry{r.position, r.radius_m, r.normal, index, kNone});
}

void RecordTree::shrink(std::size_t record, float radius_m) {
  PHOS_CHECK(record < impl_->records.size() && radius_m > 0 && radius_m <= impl_->records[record].radius_m,
             "record ", record, " radius ", radius_m);
  const std::size_t last =
      record + 1 < impl_->records.size() ? impl_->first_entry[record + 1] : impl_->entries.size();
  for (std::size_t i = impl_->first_entry[record]; i < last; ++i) impl_->entries[i].radius_m = radius_m;
  impl_->records[record].radius_m = radius_m;
}

std::size_t RecordTree::size() const { return impl_->records.size(); }
std::span<const IrradianceRecord> RecordTree::records() const { return impl_->records; }

bool RecordTree::covered(const Vec3& p, const Vec3& n) const {
  bool found = false;
  impl_->visit_valid(p, n, [&](std::uint32_t, float) {
    found = true;
    return false;
  });
  return found;
}

Interpolated RecordTree::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated sum;
  impl_->visit_valid(p, n, [&](std::uint32_t i, float w) {
    const IrradianceRecord& r = impl_->records[i];
    sum.irradiance += w * extrapolate(r, p, n);
    sum.stderr_lx += w * r.stderr_lx;
    sum.weight += w;
    return true;
  });
  if (sum.weight > 0) sum.irradiance /= sum.weight, sum.stderr_lx /= sum.weight;
  return sum;
}

}  // namespace phos
