#include "photon/disk/merge_on_disk.h"

#include <algorithm>
#include <utility>

#include "core/progress.h"
#include "photon/disk/sorted_rows.h"
#include "photon/tree/kd_tree.h"
#include "photon/tree/split.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kRowsAtATime = 1 << 14;

/// One file a column.
struct ColumnFiles {
  explicit ColumnFiles(const std::string& output)
      : position(output),
        flux(output),
        direction(output),
        normal(output),
        source_normal(output),
        distance(output),
        path(output),
        bounce(output),
        family(output),
        flight_from(output),
        flight_flux(output),
        flight_direction(output),
        flight_length(output) {}

  ScratchFile position, flux, direction, normal, source_normal, distance, path, bounce, family;
  ScratchFile flight_from, flight_flux, flight_direction, flight_length;

  PhotonColumns mapped() {
    return {position.map_values<Vec3>(),
            flux.map_values<Rgb>(),
            direction.map_values<std::uint32_t>(),
            normal.map_values<std::uint32_t>(),
            source_normal.map_values<std::uint32_t>(),
            distance.map_values<float>(),
            path.map_values<std::uint8_t>(),
            bounce.map_values<std::uint8_t>(),
            family.map_values<std::uint32_t>(),
            {flight_from.map_values<Vec3>(), flight_flux.map_values<Rgb>(),
             flight_direction.map_values<std::uint32_t>(), flight_length.map_values<float>()}};
  }
};

template <class T>
void write_column(ScratchFile& file, std::span<const PhotonRow> rows, T PhotonRow::*member) {
  Column<T> column;
  for (const PhotonRow& row : rows) column.push_back(row.*member);
  file.write_values<T>(column);
}

/// Calls act(part) for parts of a shard's column, and takes each out of memory.
template <class T, class Act>
void for_parts(const Container& file, std::span<const T> column, const Act& act) {
  while (!column.empty()) {
    const std::span<const T> part = column.first(std::min(column.size(), kRowsAtATime));
    act(part);
    file.release(std::as_bytes(part));
    column = column.subspan(part.size());
  }
}

}  // namespace

struct MergeOnDisk::Impl {
  Impl(const std::vector<std::string>& paths, std::string o, std::uint64_t m)
      : shards(open_photon_shards(paths)),
        header(header_of_merged(shards)),
        output(std::move(o)),
        memory_bytes(m),
        columns(output),
        points(output),
        tree(output) {}

  Bounds checked_bounds() const;
  void write_rows(std::span<const PhotonRow> rows, std::size_t first);
  void write_flights();

  std::vector<PhotonShard> shards;
  MergedHeader header;
  std::string output;
  std::uint64_t memory_bytes;
  ColumnFiles columns;
  ScratchFile points, tree;  // of the kd-tree
  Bounds bounds;             // as PhotonMap::write() finds them
};

MergeOnDisk::MergeOnDisk(const std::vector<std::string>& shards, std::string output,
                         std::uint64_t memory_bytes)
    : impl_(std::make_unique<Impl>(shards, std::move(output), memory_bytes)) {}
MergeOnDisk::~MergeOnDisk() = default;

const PhotonTotals& MergeOnDisk::totals() const { return impl_->header.totals; }

/// Of all positions, after a look at every number of every shard.
Bounds MergeOnDisk::Impl::checked_bounds() const {
  Bounds found;
  Progress progress("checking shards", shards.size(), "shards");
  for (const PhotonShard& s : shards) {
    const Container& file = s.shard.file;
    file.require_sound_in(std::clamp<std::size_t>(memory_bytes / 8, 4096, std::size_t{16} << 20));
    for_parts(file, s.columns.position, [&](std::span<const Vec3> part) {
      for (const Vec3& p : part) found.include(p);
    });
    progress.advance();
  }
  KdTree::require_fit(static_cast<std::size_t>(header.totals.stored));
  return found;
}

void MergeOnDisk::Impl::write_rows(std::span<const PhotonRow> rows, std::size_t first) {
  write_column(columns.position, rows, &PhotonRow::position);
  write_column(columns.flux, rows, &PhotonRow::flux);
  write_column(columns.direction, rows, &PhotonRow::direction);
  write_column(columns.normal, rows, &PhotonRow::normal);
  write_column(columns.source_normal, rows, &PhotonRow::source_normal);
  write_column(columns.distance, rows, &PhotonRow::distance);
  write_column(columns.path, rows, &PhotonRow::path);
  write_column(columns.bounce, rows, &PhotonRow::bounce);
  if (header.has_families) write_column(columns.family, rows, &PhotonRow::family);
  Column<TreePoint> of_tree;
  for (const PhotonRow& row : rows) {
    of_tree.push_back({row.position, static_cast<std::int32_t>(first + of_tree.size())});
    bounds.include(row.position);
  }
  points.write_values<TreePoint>(of_tree);
}

void MergeOnDisk::Impl::write_flights() {
  for (const PhotonShard& s : shards) {
    const FlightColumns& f = s.columns.flights;
    const auto append = [&]<class T>(ScratchFile& file, std::span<const T> column) {
      for_parts(s.shard.file, column, [&](std::span<const T> part) { file.write_values<T>(part); });
    };
    append(columns.flight_from, f.from), append(columns.flight_flux, f.flux);
    append(columns.flight_direction, f.direction), append(columns.flight_length, f.length);
  }
}

void MergeOnDisk::sort() {
  const Bounds all = impl_->checked_bounds();
  SortedRows sorted(impl_->shards, all, impl_->memory_bytes, impl_->output);
  Progress progress("merging photons", impl_->header.totals.stored, "photons");
  Column<PhotonRow> memory(kRowsAtATime);
  std::size_t first = 0;
  for (std::span<const PhotonRow> rows; !(rows = sorted.take(memory)).empty(); first += rows.size()) {
    impl_->write_rows(rows, first);
    progress.advance(rows.size());
  }
  impl_->write_flights();
  impl_->shards.clear();
}

void MergeOnDisk::build_tree() {
  KdTree::save_on_disk(impl_->points, static_cast<std::size_t>(impl_->header.totals.stored),
                       impl_->memory_bytes, impl_->output, impl_->tree);
}

void MergeOnDisk::write() {
  Provenance provenance = impl_->header.provenance;
  describe_map(provenance, impl_->header.totals, bounds_to_json(impl_->bounds));
  TensorWriter writer(FileKind::photons);
  add_columns(writer, impl_->columns.mapped());
  writer.add<std::uint8_t>("kdtree", impl_->tree.map_values<std::uint8_t>());
  writer.write_mapped(impl_->output, provenance);
}

}  // namespace phos::inline photon
