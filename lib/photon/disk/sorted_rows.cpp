#include "photon/disk/sorted_rows.h"

#include <algorithm>
#include <functional>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"

namespace phos::inline photon {
namespace {

/// Of a row while a run is sorted: the row in its shard, and its cube, twice.
constexpr std::size_t kBytesInRun = sizeof(PhotonRow) + 2 * sizeof(CubeRow);
constexpr std::size_t kRowsOfWriting = 1 << 15;
constexpr std::size_t kChunk = 1 << 12;

/// Rows of a shard that belong to a run.
struct Piece {
  const PhotonShard* shard;
  std::size_t begin, end;  ///< in the shard
  std::size_t at;          ///< of the first, in the run
};

PhotonRow row_of(const PhotonColumns& c, std::size_t i) {
  return {c.position[i],
          c.flux[i],
          c.direction[i],
          c.normal[i],
          c.source_normal[i],
          c.distance[i],
          c.family.empty() ? 0 : c.family[i],
          c.path[i],
          c.bounce[i],
          0};
}

void release(const Piece& piece) {
  const PhotonColumns& c = piece.shard->columns;
  const auto rows = [&](const auto& column) {
    if (!column.empty())
      piece.shard->shard.file.release(std::as_bytes(column.subspan(piece.begin, piece.end - piece.begin)));
  };
  rows(c.position), rows(c.flux), rows(c.direction), rows(c.normal), rows(c.source_normal), rows(c.distance);
  rows(c.family), rows(c.path), rows(c.bounce);
}

std::size_t rows_of(std::span<const PhotonShard> shards) {
  std::size_t rows = 0;
  for (const PhotonShard& s : shards) rows += s.columns.position.size();
  return rows;
}

}  // namespace

SortedRows::SortedRows(std::span<const PhotonShard> shards, const Bounds& bounds, std::uint64_t memory_bytes,
                       const std::string& output)
    : cube_(bounds), file_(output) {
  add_runs(shards, std::max<std::size_t>(memory_bytes / kBytesInRun, 1));
  file_.flush();
  buffer_ = std::clamp<std::size_t>(
      memory_bytes / sizeof(PhotonRow) / 2 / std::max<std::size_t>(runs_.size(), 1), 2, kRowsOfWriting);
  for (std::size_t i = 0; i < runs_.size(); ++i) push_head(i);
}

void SortedRows::add_runs(std::span<const PhotonShard> shards, std::size_t rows_of_run) {
  std::size_t shard = 0, row = 0, rest = rows_of(shards);
  Progress progress("sorting photons", rest, "photons");
  while (rest > 0) {
    const std::size_t count = std::min(rest, rows_of_run);
    add_run(shards, shard, row, count);
    rest -= count;
    progress.advance(count);
    for (row += count; shard < shards.size() && row >= shards[shard].columns.position.size(); ++shard)
      row -= shards[shard].columns.position.size();
  }
}

void SortedRows::add_run(std::span<const PhotonShard> shards, std::size_t first_shard, std::size_t first_row,
                         std::size_t count) {
  std::vector<Piece> pieces;
  for (std::size_t at = 0, s = first_shard, row = first_row; at < count; ++s, row = 0) {
    const std::size_t n = std::min(count - at, shards[s].columns.position.size() - row);
    if (n > 0) pieces.push_back({&shards[s], row, row + n, at});
    at += n;
  }
  Column<CubeRow> order(count);
  for (const Piece& p : pieces)
    parallel_for(p.end - p.begin, kChunk, [&](std::size_t i) {
      order[p.at + i] = {cube_(p.shard->columns.position[p.begin + i]), static_cast<std::uint32_t>(p.at + i)};
    });
  parallel_sort(order, kChunk);
  const auto found = [&](std::uint32_t row) {
    const auto next = std::upper_bound(pieces.begin(), pieces.end(), row,
                                       [](std::uint32_t r, const Piece& p) { return r < p.at; });
    const Piece& p = *(next - 1);
    return row_of(p.shard->columns, p.begin + (row - p.at));
  };
  const std::uint64_t begin = file_.size() / sizeof(PhotonRow);
  Column<PhotonRow> rows;
  for (std::size_t at = 0; at < count; at += rows.size()) {
    throw_if_interrupted();
    rows.resize(std::min(count - at, kRowsOfWriting));
    parallel_for(rows.size(), kChunk, [&](std::size_t i) { rows[i] = found(order[at + i].row); });
    file_.write_values<PhotonRow>(rows);
  }
  std::for_each(pieces.begin(), pieces.end(), release);
  runs_.push_back({begin, begin + count, {}});
}

void SortedRows::push_head(std::size_t i) {
  Run& run = runs_[i];
  if (run.at == run.rows.size()) {
    run.rows.resize(std::min<std::uint64_t>(run.end - run.next, buffer_));
    run.at = 0;
    if (run.rows.empty()) return;
    file_.read_at(run.next * sizeof(PhotonRow), std::as_writable_bytes(std::span(run.rows)));
    run.next += run.rows.size();
  }
  heads_.push_back({cube_(run.rows[run.at].position), i});
  std::push_heap(heads_.begin(), heads_.end(), std::greater<>());
}

std::span<const PhotonRow> SortedRows::take(std::span<PhotonRow> memory) {
  throw_if_interrupted();
  std::size_t n = 0;
  while (n < memory.size() && !heads_.empty()) {
    const std::size_t run = heads_.front().run;
    std::pop_heap(heads_.begin(), heads_.end(), std::greater<>());
    heads_.pop_back();
    memory[n++] = runs_[run].rows[runs_[run].at++];
    push_head(run);
  }
  return memory.first(n);
}

}  // namespace phos::inline photon
