#include "photon/photon_map.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "file/shards.h"
#include "photon/photon_file.h"
#include "photon/tree/kd_tree.h"
#include "photon/tree/space_order.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kRowChunk = 1 << 14;

// One column at a time by way of the same memory, so that only one is held twice.
template <class T>
void permute(std::span<T> column, std::span<const std::uint32_t> order, std::span<std::byte> memory) {
  const std::span<T> sorted(reinterpret_cast<T*>(memory.data()), column.size());
  parallel_for(order.size(), kRowChunk, [&](std::size_t i) { sorted[i] = column[order[i]]; });
  parallel_chunks(order.size(), kRowChunk, [&](std::size_t begin, std::size_t end) {
    std::copy(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
              sorted.begin() + static_cast<std::ptrdiff_t>(end),
              column.begin() + static_cast<std::ptrdiff_t>(begin));
  });
}

void permute(Photons& p, std::span<const std::uint32_t> order) {
  Column<std::byte> memory(sizeof(Vec3) * order.size());
  for_columns([&](auto& column) { permute(std::span(column), order, memory); }, p);
  if (!p.family.empty()) permute(std::span(p.family), order, memory);
}

void require_equal_lengths(const Photons& p) {
  const std::size_t n = p.size();
  const Flights& f = p.flights;
  PHOS_CHECK(p.flux.size() == n && p.direction.size() == n && p.normal.size() == n &&
                 p.distance.size() == n && p.source_normal.size() == n && p.path.size() == n &&
                 p.bounce.size() == n && (p.family.empty() || p.family.size() == n) &&
                 f.flux.size() == f.size() && f.direction.size() == f.size() && f.length.size() == f.size(),
             "columns of unequal length, position has ", n);
}

}  // namespace

struct PhotonMap::Impl {
  Photons photons;  // empty when the columns lie in `file`
  std::optional<Container> file;
  KdTree tree;
};

PhotonMap::PhotonMap() : impl_(std::make_unique<Impl>()) {}
PhotonMap::~PhotonMap() = default;
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;
PhotonMap& PhotonMap::operator=(PhotonMap&&) noexcept = default;

PhotonMap PhotonMap::build(Photons photons, const PhotonTotals& totals) {
  require_equal_lengths(photons);
  PhotonMap map;
  // Over photons that lie in memory as they do in space a tree is made four to six times as fast, and answers
  // for many neighbours twice as fast, as over photons in the order of their paths.
  KdTree::require_fit(photons.position);
  permute(photons, space_order(photons.position));
  Impl& impl = *map.impl_;
  impl.photons = std::move(photons);
  impl.tree = KdTree::build(impl.photons.position);
  const PhotonColumns c = columns_of(impl.photons);
  map.position = c.position, map.flux = c.flux, map.direction = c.direction, map.normal = c.normal;
  map.source_normal = c.source_normal, map.distance = c.distance, map.path = c.path, map.bounce = c.bounce;
  map.flights = c.flights, map.family = c.family;
  map.totals = totals;
  return map;
}

PhotonMap PhotonMap::open(const std::string& path) {
  PhotonMap map;
  Impl& impl = *map.impl_;
  impl.file = Container::open(path, FileKind::photons);
  const Container& file = *impl.file;
  if (file.form() == FileForm::shard)
    throw Error(ExitCode::bad_input, path,
                text("is shard ", share_of(file),
                     " of a run; join all its shards first: phos-merge SHARD... -o ALL.photons"));
  const PhotonColumns c = columns_of(file);
  const std::span<const std::uint8_t> tree = TensorReader(file).values<std::uint8_t>("kdtree");
  map.position = c.position, map.flux = c.flux, map.direction = c.direction, map.normal = c.normal;
  map.source_normal = c.source_normal, map.distance = c.distance, map.path = c.path, map.bounce = c.bounce;
  map.flights = c.flights, map.family = c.family;
  map.totals = totals_of(file, c.position.size());
  file.require_sound();
  impl.tree = KdTree::load(map.position, std::as_bytes(tree), path);
  return map;
}

void PhotonMap::in_sphere(const Vec3& p, float radius_m, std::vector<std::uint32_t>& rows) const {
  impl_->tree.in_sphere(p, radius_m, rows);
}

void PhotonMap::nearest(const Vec3& p, std::size_t k, std::vector<std::uint32_t>& rows,
                        std::vector<float>& distance2_m2, float most_m) const {
  impl_->tree.nearest(p, k, rows, distance2_m2, most_m);
}

bool PhotonMap::has_caustics() const {
  return flights.size() > 0 || std::any_of(path.begin(), path.end(), [](std::uint8_t p) {
           return is_caustic(static_cast<PhotonPath>(p));
         });
}

const Container* PhotonMap::container() const { return impl_->file ? &*impl_->file : nullptr; }

void PhotonMap::write(const std::string& path, Provenance provenance) const {
  throw_if_interrupted();  // FLANN builds without looking up
  describe_map(provenance, totals, bounds_to_json(position));
  const std::vector<std::byte> tree = impl_->tree.save();
  TensorWriter writer(FileKind::photons);
  add_columns(writer, {position, flux, direction, normal, source_normal, distance, this->path, bounce, family,
                       flights});
  writer.add<std::uint8_t>("kdtree", {reinterpret_cast<const std::uint8_t*>(tree.data()), tree.size()});
  writer.write(path, provenance);
}

}  // namespace phos::inline photon
