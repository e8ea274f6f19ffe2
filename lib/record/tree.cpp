// Octree of records after Ward, Rubinstein, Clear (1988): a record hangs in every cell of about its own size
// that its zone of influence touches, so that a query walks one path from the root.
#include "record/tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "record/in_sight.h"
#include "record/index.h"
#include "record/irradiance_cache.h"
#include "scene/rays.h"

namespace phos::inline record {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// What a lookup needs of a record before it is known to be valid, side by side.
struct Entry {
  Vec3 position;
  float radius_m;
  Vec3 normal;
  std::uint32_t record;
};

struct Cell {
  std::array<std::uint32_t, 8> child;
  std::vector<Entry> entries;
  Cell() { child.fill(kNone); }
};

}  // namespace

struct RecordTree::Impl {
  float accuracy;
  float off_plane = std::numeric_limits<float>::infinity();  // farthest place from a record's plane, radii
  const RayScene* leak_test;
  DVec3 lo;
  double side_m;
  std::vector<IrradianceRecord> records;
  std::vector<Cell> cells{1};
  std::vector<float> hung_radius_m;  // per record: the radius by which its cells were chosen
  std::size_t misplaced = 0;         // records that shrank to less than half of it

  /// Box of a record's zone; half_m is half its side.
  struct Box {
    DVec3 lo, hi;
    double half_m;
  };

  /// use(cell) for the cells of about the box's size that it touches; makes those that are not there.
  template <class Use>
  void each_cell(std::uint32_t cell, const DVec3& cell_lo, double side, const Box& box, int depth,
                 const Use& use) {
    if (side < 4 * box.half_m || depth == kDeepestCell) return use(cells[cell]);
    const double half = side / 2;
    const DVec3 middle = cell_lo + half;
    const unsigned from = octant_of(box.lo, middle), to = octant_of(box.hi, middle);
    for (unsigned o = 0; o < 8; ++o) {
      if ((o & from) != from || (o & ~to) != 0) continue;  // not between the two on every axis
      if (cells[cell].child[o] == kNone) {
        cells[cell].child[o] = static_cast<std::uint32_t>(cells.size());
        cells.emplace_back();
      }
      each_cell(cells[cell].child[o], corner_of(cell_lo, half, o), half, box, depth + 1, use);
    }
  }

  template <class Use>
  void each_cell_of(std::uint32_t index, const Use& use) {
    const Vec3 p = records[index].position;
    const double reach = static_cast<double>(accuracy) * static_cast<double>(hung_radius_m[index]);
    // The lookup measures in float: let the box be larger by its rounding.
    const double slack =
        1e-5 * std::min(reach, 1e30) + 1e-6 * static_cast<double>(max_component(glm::abs(p)));
    const double half = std::min(reach, 1e35) + slack;
    each_cell(0, lo, side_m, {DVec3(p) - half, DVec3(p) + half, half}, 0, use);
  }

  void hang(std::uint32_t index) {
    const IrradianceRecord& r = records[index];
    hung_radius_m.push_back(r.radius_m);
    each_cell_of(index, [&](Cell& c) { c.entries.push_back({r.position, r.radius_m, r.normal, index}); });
  }

  /// Shrunken records crowd the large cells that they once needed; they are hung anew once they are many.
  void hang_all() {
    cells.assign(1, Cell());
    hung_radius_m.clear();
    misplaced = 0;
    for (std::uint32_t i = 0; i < records.size(); ++i) hang(i);
  }

  /// Weight at p, n of a record; 0: it is not valid there, whatever the leak test says.
  float unseen_weight_of(const Entry& e, const Vec3& p, const Vec3& n) const {
    float w = weight_at(e.position, e.normal, e.radius_m, accuracy, p, n);
    if (!(w > kLeastWeight)) return 0;
    if (std::fabs(glm::dot(p - e.position, e.normal)) > off_plane * e.radius_m) return 0;
    const IrradianceRecord& r = records[e.record];
    if (r.footprint) w = weight_within(*r.footprint, r, accuracy, p, n);
    return w > kLeastWeight && !record_apart(r, p, n) ? w : 0;
  }
  bool in_sight(std::uint32_t record, const Vec3& p, const Vec3& n) const {
    return !leak_test || record_in_sight(*leak_test, records[record], p, n);
  }
  /// The same with the leak test.
  float weight_of(const Entry& e, const Vec3& p, const Vec3& n) const {
    const float w = unseen_weight_of(e, p, n);
    return w > 0 && in_sight(e.record, p, n) ? w : 0;
  }

  /// visit(record, weight) for each record valid at p until it returns false.
  template <class Visit>
  void visit_valid(const Vec3& p, const Vec3& n, const Visit& visit) const {
    visit_unseen(p, n, [&](std::uint32_t record, float w) {
      return !in_sight(record, p, n) || visit(records[record], w);
    });
  }

  /// use(record, weight) for the records that serve p: those valid there and no farther from it across their
  /// planes than `most_height`; with a leak test, at most kMostInSight of them.
  template <class Use>
  void each_serving(const Vec3& p, const Vec3& n, float most_height, const Use& use) const {
    std::vector<Candidate> candidates;
    visit_unseen(p, n, [&](std::uint32_t record, float w) {
      if (!(height_over(records[record], p) <= most_height)) return true;
      if (leak_test)
        candidates.push_back({w, record});
      else
        use(records[record], w);
      return true;
    });
    serve_in_sight(candidates, [&](const Candidate& c) {
      if (!in_sight(c.record, p, n)) return false;
      use(records[c.record], c.weight);
      return true;
    });
  }

  /// visit(record, weight) for each record valid at p, but for the leak test, until it returns false.
  template <class Visit>
  void visit_unseen(const Vec3& p, const Vec3& n, const Visit& visit) const {
    std::uint32_t cell = 0;
    DVec3 cell_lo = lo;
    double side = side_m;
    const DVec3 point(p);
    while (cell != kNone) {
      for (const Entry& e : cells[cell].entries) {
        const float w = unseen_weight_of(e, p, n);
        if (w > 0 && !visit(e.record, w * records[e.record].weight)) return;
      }
      side /= 2;
      const unsigned o = octant_of(point, cell_lo + side);
      cell_lo = corner_of(cell_lo, side, o);
      cell = cells[cell].child[o];
    }
  }
};

RecordTree::RecordTree(const Bounds& bounds, double accuracy, const RayScene* leak_test)
    : impl_(std::make_unique<Impl>()) {
  PHOS_CHECK(accuracy > 0 && std::isfinite(accuracy), "accuracy ", accuracy);
  impl_->accuracy = static_cast<float>(accuracy);
  impl_->leak_test = leak_test;
  const DVec3 centre = bounds.empty() ? DVec3(0) : DVec3(bounds.centre());
  const double side = std::max(static_cast<double>(max_component(bounds.size())), 1e-30);
  impl_->side_m = side;
  impl_->lo = centre - side / 2;
}
RecordTree::~RecordTree() = default;

RecordTree RecordTree::widened(double factor, Widen widen) const {
  RecordTree wide(Bounds(), factor * static_cast<double>(impl_->accuracy), impl_->leak_test);
  wide.impl_->lo = impl_->lo, wide.impl_->side_m = impl_->side_m;
  if (widen == Widen::along_plane) wide.impl_->off_plane = impl_->accuracy;
  for (const IrradianceRecord& r : impl_->records) wide.insert(r);
  return wide;
}
RecordTree::RecordTree(RecordTree&&) noexcept = default;

void RecordTree::insert(const IrradianceRecord& r) {
  PHOS_CHECK(r.radius_m > 0 && is_finite(r.position), "radius ", r.radius_m);
  impl_->records.push_back(r);
  impl_->hang(static_cast<std::uint32_t>(impl_->records.size() - 1));
}

void RecordTree::shrink(std::size_t record, float radius_m) {
  PHOS_CHECK(record < impl_->records.size() && radius_m > 0 && radius_m <= impl_->records[record].radius_m,
             "record ", record, " radius ", radius_m);
  impl_->each_cell_of(static_cast<std::uint32_t>(record), [&](Cell& c) {
    const auto own = [&](const Entry& e) { return e.record == record; };
    std::find_if(c.entries.begin(), c.entries.end(), own)->radius_m = radius_m;
  });
  const float hung_m = impl_->hung_radius_m[record];
  const bool was_misplaced = impl_->records[record].radius_m < hung_m / 2;
  impl_->records[record].radius_m = radius_m;
  if (!was_misplaced && radius_m < hung_m / 2 && ++impl_->misplaced > 64 + impl_->records.size() / 8)
    impl_->hang_all();
}

std::size_t RecordTree::size() const { return impl_->records.size(); }
std::span<const IrradianceRecord> RecordTree::records() const { return impl_->records; }

bool RecordTree::covered(const Vec3& p, const Vec3& n) const {
  bool found = false;
  impl_->visit_valid(p, n, [&](const IrradianceRecord&, float) {
    found = true;
    return false;
  });
  return found;
}

bool RecordTree::covered(const Vec3& p, const Vec3& n, std::size_t& record) const {
  if (record < impl_->records.size()) {
    const IrradianceRecord& r = impl_->records[record];
    if (impl_->weight_of({r.position, r.radius_m, r.normal, static_cast<std::uint32_t>(record)}, p, n) > 0)
      return true;
  }
  bool found = false;
  impl_->visit_valid(p, n, [&](const IrradianceRecord& r, float) {
    found = true, record = static_cast<std::size_t>(&r - impl_->records.data());
    return false;
  });
  return found;
}

void RecordTree::valid(const Vec3& p, const Vec3& n, std::vector<const IrradianceRecord*>& found) const {
  found.clear();
  impl_->visit_valid(p, n, [&](const IrradianceRecord& r, float) {
    found.push_back(&r);
    return true;
  });
}

RecordIndex RecordTree::index() const {
  RecordIndex index;
  index.box = {impl_->lo.x, impl_->lo.y, impl_->lo.z, impl_->side_m};
  // Breadth first: the children of a cell follow each other.
  std::vector<std::uint32_t> order{0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Cell& cell = impl_->cells[order[i]];
    index.cell.push_back(static_cast<std::uint32_t>(order.size()));
    index.cell.push_back(static_cast<std::uint32_t>(index.entry.size()));
    unsigned mask = 0;
    for (unsigned o = 0; o < 8; ++o) {
      if (cell.child[o] == kNone) continue;
      mask |= 1u << o;
      order.push_back(cell.child[o]);
    }
    index.children.push_back(static_cast<std::uint8_t>(mask));
    for (const Entry& e : cell.entries) index.entry.push_back(e.record);
  }
  index.cell.push_back(static_cast<std::uint32_t>(order.size()));
  index.cell.push_back(static_cast<std::uint32_t>(index.entry.size()));
  return index;
}

void RecordTree::add(const Vec3& p, const Vec3& n, Interpolated& sum) const {
  impl_->visit_valid(p, n, [&](const IrradianceRecord& r, float w) {
    sum.add(r, w, p, n);
    return true;
  });
}

void RecordTree::add_few(const Vec3& p, const Vec3& n, Interpolated& sum, float most_height) const {
  impl_->each_serving(p, n, most_height, [&](const IrradianceRecord& r, float w) { sum.add(r, w, p, n); });
}

Rgb RecordTree::irradiance(const Vec3& p, const Vec3& n, float& weight) const {
  Rgb sum(0);
  weight = 0;
  impl_->visit_valid(p, n, [&](const IrradianceRecord& r, float w) {
    sum += w * extrapolate(r, p, n);
    weight += w;
    return true;
  });
  return weight > 0 ? sum / weight : sum;
}

Interpolated RecordTree::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated sum;
  add(p, n, sum);
  sum.finish();
  return sum;
}

}  // namespace phos::inline record
