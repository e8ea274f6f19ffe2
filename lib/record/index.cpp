#include "record/index.h"

#include <bit>

#include "core/error.h"
#include "record/in_sight.h"
#include "record/tree.h"
#include "scene/rays.h"

namespace phos::inline record {

RecordIndex index_records(std::span<const IrradianceRecord> records, double accuracy) {
  Bounds bounds;
  for (const IrradianceRecord& r : records) bounds.include(r.position);
  RecordTree tree(bounds, accuracy);
  for (const IrradianceRecord& r : records) tree.insert(r);
  return tree.index();
}

void add_index(TensorWriter& file, const RecordIndex& index) {
  file.add<double>("index_box", index.box);
  file.add<std::uint8_t>("index_children", index.children);
  file.add<std::uint32_t>("index_cells", index.cell);
  file.add<std::uint32_t>("index_entries", index.entry);
}

RecordLookup::RecordLookup(const Container& file, const RayScene* leak_test)
    : records_(file), leak_test_(leak_test), accuracy_(reading_accuracy(records_.accuracy())) {
  const Json* made_for = file.provenance().extra.find(kIndexAccuracy);
  if (file.has("index_box") && made_for && made_for->is_number() && made_for->as_number() == accuracy_) {
    use_stored();
    return;
  }
  made_ = index_records(read_irradiance(file).records, accuracy_);
  lo_ = {made_.box[0], made_.box[1], made_.box[2]};
  side_m_ = made_.box[3];
  children_ = made_.children, cell_ = made_.cell, entry_ = made_.entry;
}

void RecordLookup::use_stored() {
  const TensorReader file(records_.file());
  const auto box = file.values<double>("index_box");
  lo_ = {box[0], box[1], box[2]};
  side_m_ = box[3];
  children_ = file.values<std::uint8_t>("index_children");
  cell_ = file.values<std::uint32_t>("index_cells");
  entry_ = file.values<std::uint32_t>("index_entries");
  check_stored();
}

/// A lookup can neither leave the arrays nor run in circles if this passes, whoever wrote them.
void RecordLookup::check_stored() const {
  const auto require = [&](bool good, const char* what) {
    if (good) return;
    throw Error(ExitCode::bad_input, records_.file().path(),
                text("its index is damaged (", what, "); make the file again"));
  };
  require(side_m_ > 0, "the root has no size");
  const std::size_t cells = children_.size();
  require(cells > 0, "it has no cells");
  std::size_t next_child = 1, next_entry = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    // Every cell but the root is the child of exactly one before it.
    require(cell_[2 * i] == next_child && next_child > i, "a cell's children are not where they belong");
    require(cell_[2 * i + 1] >= next_entry, "a cell's entries are not where they belong");
    next_child += static_cast<std::size_t>(std::popcount(children_[i]));
    next_entry = cell_[2 * i + 1];
  }
  require(cell_[1] == 0 && next_child == cells && cell_[2 * cells] == cells, "cells are missing");
  require(cell_[2 * cells + 1] == entry_.size() && next_entry <= entry_.size(), "entries are missing");
  int depth = 0;
  for (std::size_t begin = 0, end = 1; begin < cells; ++depth) {
    begin = end;
    end = cell_[2 * begin];  // the row after the last level is the one after the last cell
    if (begin == cells) break;
  }
  require(depth <= kDeepestCell + 1, "it is too deep");
  std::vector<bool> listed(records_.size());
  for (const std::uint32_t e : entry_) {
    require(e < records_.size(), "it lists a record that is not there");
    listed[e] = true;
  }
  for (const bool one : listed) require(one, "it lacks a record");
}

/// visit(record number, weight) for each record valid at p, but for the leak test, until it returns false.
template <class Visit>
void RecordLookup::visit_unseen(const Vec3& p, const Vec3& n, const Visit& visit) const {
  DVec3 lo = lo_;
  double side = side_m_;
  const DVec3 point(p);
  const auto accuracy = static_cast<float>(accuracy_);
  for (std::size_t cell = 0;;) {
    const std::uint32_t end = cell_[2 * cell + 3];
    for (std::uint32_t e = cell_[2 * cell + 1]; e < end; ++e) {
      const std::uint32_t i = entry_[e];
      float w = weight_at(records_.position(i), records_.normal(i), records_.radius_m(i), accuracy, p, n);
      if (!(w > kLeastWeight)) continue;
      const IrradianceRecord r = records_[i];
      if (r.footprint) w = weight_within(*r.footprint, r, accuracy, p, n);
      if (!(w > kLeastWeight)) continue;
      if (record_apart(r, p, n)) continue;
      if (!visit(i, r, w * r.weight)) return;
    }
    side /= 2;
    const unsigned o = octant_of(point, lo + side);
    if ((children_[cell] >> o & 1u) == 0) return;
    lo = corner_of(lo, side, o);
    const unsigned before = children_[cell] & ((1u << o) - 1u);
    cell = cell_[2 * cell] + static_cast<std::size_t>(std::popcount(before));
  }
}

bool RecordLookup::covered(const Vec3& p, const Vec3& n) const {
  bool found = false;
  visit_unseen(p, n, [&](std::uint32_t, const IrradianceRecord& r, float) {
    found = !leak_test_ || record_in_sight(*leak_test_, r, p, n);
    return !found;
  });
  return found;
}

void RecordLookup::add_few(const Vec3& p, const Vec3& n, Interpolated& sum, float most_height) const {
  std::vector<Candidate> candidates;
  visit_unseen(p, n, [&](std::uint32_t i, const IrradianceRecord& r, float w) {
    if (!(height_over(r, p) <= most_height)) return true;
    if (leak_test_)
      candidates.push_back({w, i});
    else
      sum.add(r, w, p, n);
    return true;
  });
  serve_in_sight(candidates, [&](const Candidate& c) {
    const IrradianceRecord r = records_[c.record];
    if (!record_in_sight(*leak_test_, r, p, n)) return false;
    sum.add(r, c.weight, p, n);
    return true;
  });
}

Interpolated RecordLookup::interpolate(const Vec3& p, const Vec3& n) const {
  Interpolated sum;
  add_few(p, n, sum);
  sum.finish();
  return sum;
}

}  // namespace phos::inline record
