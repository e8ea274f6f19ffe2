#include "radiance/cache.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/parallel.h"
#include "hsh/rotation.h"
#include "radiance/check.h"
#include "radiance/columns.h"
#include "radiance/compact_columns.h"

namespace phos::inline radiance {
namespace {

constexpr const char* kOrderEntry = "order";  // of a header
/// E = first x c_00 + second x c_10.
constexpr double kFirst = 1.2533141373155003;   // sqrt(pi / 2)
constexpr double kSecond = 0.7236012545582676;  // sqrt(pi / 6)

std::size_t count_of(int order) { return static_cast<std::size_t>(harmonic_count(order)); }

bool all_finite(const std::vector<float>& v) {
  return std::all_of(v.begin(), v.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

const char* what_is_wrong(const RadianceRecord& r) {
  const NoFloatTraps traps;  // files may hold numbers that are not finite
  const std::size_t n = 3 * count_of(r.order()), slopes = r.gradient_x.size();
  if (r.stderr_light.size() % 3 != 0 || r.light.size() != n || r.gradient_y.size() != slopes ||
      (slopes != 0 && slopes != n))
    return "coefficients that are not of one order";
  if (!is_finite(r)) return "a value that is not finite";
  if (!(r.radius_m > 0) || !(r.distance_m >= 0)) return "a radius that is not positive";
  if (r.footprint_m && !are_lengths(*r.footprint_m)) return "a footprint's axis of no length";
  constexpr float kSlack = 1e-3f;
  if (std::fabs(glm::length(r.frame.x) - 1) > kSlack || std::fabs(glm::length(r.frame.z) - 1) > kSlack ||
      std::fabs(glm::dot(r.frame.x, r.frame.z)) > kSlack)
    return "a frame that is not of unit length and rectangular";
  if (!(r.shared >= 0 && r.shared <= 1)) return "a shared part of the variance outside of 0 .. 1";
  if (std::any_of(r.stderr_light.begin(), r.stderr_light.end(), [](float x) { return x < 0; }))
    return "a negative standard error";
  return nullptr;
}

int require_radiance_order(int order) {
  if (order >= 1 && order <= HshRotator::kMaxOrder) return order;
  throw Error(ExitCode::usage, "",
              text("order ", order, ": radiance records are of order 1 .. ", HshRotator::kMaxOrder));
}

bool is_finite(const RadianceRecord& r) {
  return phos::is_finite(r.position) && phos::is_finite(r.frame.x) && phos::is_finite(r.frame.z) &&
         all_finite(r.light) && all_finite(r.gradient_x) && all_finite(r.gradient_y) &&
         all_finite(r.stderr_light) && std::isfinite(r.radius_m) && !std::isnan(r.distance_m);
}

Rgb irradiance_of(std::span<const float> light) {
  constexpr std::size_t kZonal = 3 * harmonic_index(1, 0);
  Rgb e;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = kFirst * static_cast<double>(light[c]);
    if (light.size() > kZonal) sum += kSecond * static_cast<double>(light[kZonal + c]);
    e[static_cast<int>(c)] = static_cast<float>(sum);
  }
  return e;
}

IrradianceRecord irradiance_of(const RadianceRecord& r) {
  IrradianceRecord e;
  e.position = r.position, e.normal = r.frame.z;
  e.distance_m = r.distance_m, e.radius_m = r.radius_m, e.weight = r.weight;
  e.irradiance = glm::max(irradiance_of(r.light), Rgb(0));
  e.shared = r.shared;
  for (int c = 0; c < 3; ++c) {
    const auto at = static_cast<std::size_t>(c);
    const float second = r.order() > 1 ? r.stderr_light[3 + at] : 0;
    e.stderr_lx[c] =
        std::hypot(static_cast<float>(kFirst) * r.stderr_light[at], static_cast<float>(kSecond) * second);
  }
  Rgb x(0), y(0);
  if (!r.gradient_x.empty()) {
    x = irradiance_of(r.gradient_x), y = irradiance_of(r.gradient_y);
    for (int c = 0; c < 3; ++c) e.translation_gradient[c] = x[c] * r.frame.x + y[c] * r.frame.y;
  }
  if (!r.footprint_m) return e;
  AdaptiveFootprint::Axes axes;
  for (int k = 0; k < AdaptiveFootprint::kAxes; ++k) {
    const Vec2 u = AdaptiveFootprint::direction(k);
    const float length_m = (*r.footprint_m)[static_cast<std::size_t>(k)];
    axes[static_cast<std::size_t>(k)] = {.length_m = length_m, .slope = length_m * (u.x * x + u.y * y)};
  }
  e.footprint = std::make_shared<AdaptiveFootprint>(r.frame.x, r.frame.z, axes);
  return e;
}

IrradianceCache irradiance_of(const RadianceCache& radiance) {
  IrradianceCache cache;
  cache.accuracy = radiance.accuracy;
  cache.scene_hash = radiance.scene_hash;
  cache.caustics = radiance.caustics;
  for (const RadianceRecord& r : radiance.records) cache.records.push_back(irradiance_of(r));
  return cache;
}

int RadianceCache::order() const {
  int most = 0;
  for (const RadianceRecord& r : records) most = std::max(most, r.order());
  return most;
}

void settle_slopes(RadianceRecord& r, double accuracy) {
  if (r.gradient_x.empty()) return;
  const double raised =
      r.footprint_m ? 1
                    : static_cast<double>(r.radius_m) /
                          static_cast<double>(std::max(r.distance_m, std::numeric_limits<float>::min()));
  const double turn = std::sqrt(0.3) * accuracy * std::max(1.0, raised);
  for (std::size_t l = 1; l < static_cast<std::size_t>(r.order()); ++l) {
    const double spread = static_cast<double>(l) * turn;
    const auto kept = static_cast<float>(std::exp(-spread * spread / 2));
    for (std::size_t i = 3 * l * l; i < 3 * (l + 1) * (l + 1); ++i)
      r.gradient_x[i] *= kept, r.gradient_y[i] *= kept;
  }
}

void write_radiance(const std::string& path, const RadianceCache& cache, Provenance provenance, Store store,
                    TensorWriter file) {
  const std::size_t n = cache.records.size(), bands = static_cast<std::size_t>(cache.order()),
                    count = count_of(cache.order());
  const bool gradients = n > 0 && !cache.records.front().gradient_x.empty();
  std::vector<Vec3> position(n), frame(2 * n);
  std::vector<float> distance(n), radius(n), shared(n), light(3 * n * count), error(3 * n * bands);
  std::vector<float> along[2], footprint;
  for (auto& g : along) g.resize(gradients ? light.size() : 0);
  const bool shaped = n > 0 && cache.records.front().footprint_m;
  std::vector<std::uint8_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    const RadianceRecord& r = cache.records[i];
    const std::size_t own = 3 * count_of(r.order()), expected = gradients ? own : 0;
    PHOS_CHECK(r.order() >= 1 && r.light.size() == own && r.gradient_x.size() == expected &&
                   r.gradient_y.size() == expected,
               "record ", i, " is of another shape");
    PHOS_CHECK(what_is_wrong(r) == nullptr, "record ", i, " has ", what_is_wrong(r));
    PHOS_CHECK(r.footprint_m.has_value() == shaped, "records with and without footprints, such as ", i);
    if (shaped) footprint.insert(footprint.end(), r.footprint_m->begin(), r.footprint_m->end());
    position[i] = r.position, frame[2 * i] = r.frame.x, frame[2 * i + 1] = r.frame.z;
    distance[i] = r.distance_m, radius[i] = r.radius_m, shared[i] = r.shared;
    order[i] = static_cast<std::uint8_t>(r.order());
    to_column(r.light, &light[3 * i * count], count);
    to_column(r.stderr_light, &error[3 * i * bands], bands);
    if (!gradients) continue;
    to_column(r.gradient_x, &along[0][3 * i * count], count);
    to_column(r.gradient_y, &along[1][3 * i * count], count);
  }
  file.extent("n", n), file.extent("N", bands);
  file.add_vectors("position", position);
  file.add_vectors("frame", frame);
  const HalfColumns halves = store == Store::compact ? HalfColumns(n, {light, error}) : HalfColumns(0, {});
  const ByteColumns bytes = store == Store::compact && gradients ? ByteColumns(n, bands, {along[0], along[1]})
                                                                 : ByteColumns(0, 0, {});
  if (store == Store::compact) {
    file.add<float>("light_scale", halves.unit);
    file.add<Half>("coefficients", halves.columns[0]);
    file.add<Half>("stderr", halves.columns[1]);
  } else {
    file.add<float>("coefficients", light);
    file.add<float>("stderr", error);
  }
  if (gradients && store == Store::compact) {
    file.add<std::int8_t>("gradient_exponent", bytes.exponent);
    file.add<std::int8_t>("gradient_x", bytes.columns[0]);
    file.add<std::int8_t>("gradient_y", bytes.columns[1]);
  } else if (gradients) {
    file.add<float>("gradient_x", along[0]);
    file.add<float>("gradient_y", along[1]);
  }
  if (std::any_of(order.begin(), order.end(), [&](std::uint8_t o) { return o != order.front(); }))
    file.add<std::uint8_t>("order", order);
  file.add<float>("distance", distance);
  file.add<float>("radius", radius);
  if (std::any_of(shared.begin(), shared.end(), [](float s) { return s != kSharedByZones; }))
    file.add<float>("shared", shared);
  if (shaped) file.add<float>("footprint_length", footprint);
  add_caustics(cache.caustics, file, provenance);
  provenance.scene_hash = cache.scene_hash;
  provenance.extra[kAccuracyEntry] = cache.accuracy;
  provenance.extra[kQuantityEntry] = name_of(Quantity::indirect);
  provenance.extra[kOrderEntry] = cache.order();
  provenance.extra["records"] = n;
  provenance.extra["basis"] =
      "hsh, orthonormal, Condon-Shortley phase, index l*l+l+m, x and z of frame, y = z cross x";
  file.write(path, provenance);
}

RadianceCache read_radiance(const Container& file, FileForm form) {
  return read_radiance_rows(file, form, nullptr);
}

RadianceCache read_radiance_rows(const Container& file, FileForm form, const std::vector<std::size_t>* rows) {
  if (file.kind() != FileKind::radiance)
    throw Error(ExitCode::bad_input, file.path(),
                text("holds ", name_of(file.kind()), ", not radiance; give the output of phos-radiance"));
  require_form(form, file);
  file.require_sound();
  const TensorReader tensors(file);
  const std::size_t n = static_cast<std::size_t>(tensors.extent("n")),
                    bands = static_cast<std::size_t>(tensors.extent("N")), count = bands * bands;
  const std::optional<double> accuracy = accuracy_of(file);
  const Json* order = file.provenance().extra.find(kOrderEntry);
  if (!accuracy || !order || !order->is_integer() || order->as_integer() < (n > 0 ? 1 : 0) ||
      order->as_integer() > HshRotator::kMaxOrder)
    throw Error(ExitCode::bad_input, file.path(),
                text("its header does not say accuracy, and an order from 1 to ", HshRotator::kMaxOrder,
                     "; make the file again"));
  if (static_cast<std::size_t>(order->as_integer()) != bands)
    throw Error(ExitCode::bad_input, file.path(),
                text("its header says order ", order->as_integer(), ", and its tensors are of order ", bands,
                     "; make the file again"));
  const auto column = [&](const char* name) { return tensors.values<float>(name).data(); };
  const std::span<const Vec3> position = tensors.vectors("position");
  const float *frame = column("frame"), *distance = column("distance"), *radius = column("radius");
  const StoredColumn light(tensors, "coefficients", "light_scale"), error(tensors, "stderr", "light_scale");
  const float* shared = tensors.has("shared") ? column("shared") : nullptr;
  const float* footprint = tensors.has("footprint_length") ? column("footprint_length") : nullptr;
  std::vector<StoredColumn> along;
  if (tensors.has("gradient_x"))
    for (const char* name : {"gradient_x", "gradient_y"})
      along.emplace_back(tensors, name, "gradient_exponent");
  const std::uint8_t* own_order =
      tensors.has("order") ? tensors.values<std::uint8_t>("order").data() : nullptr;
  RadianceCache cache;
  cache.accuracy = *accuracy;
  cache.scene_hash = file.provenance().scene_hash;
  cache.caustics = caustics_of(file);
  cache.records.resize(rows ? rows->size() : n);
  std::vector<const char*> wrong(cache.records.size());
  const auto row_of = [&](std::size_t record) { return rows ? (*rows)[record] : record; };
  parallel_for(cache.records.size(), 256, [&](std::size_t record) {
    RadianceRecord& r = cache.records[record];
    const std::size_t i = row_of(record);
    const std::size_t own_bands = own_order ? own_order[i] : bands, own = own_bands * own_bands;
    if (own < 1 || own_bands > bands) {
      wrong[record] = "no order that the file holds";
      return;
    }
    std::vector<float> space;
    const auto take = [&](const StoredColumn& of_all, std::size_t stride, std::size_t used) {
      const float* row = of_all.row(i, space);
      if (!rest_is_zero(row, stride, used)) wrong[record] = "numbers beyond its own order";
      return from_column(row, stride, used);
    };
    const float* f = frame + 6 * i;
    r.position = position[i];
    r.frame.x = {f[0], f[1], f[2]}, r.frame.z = {f[3], f[4], f[5]};
    r.frame.y = glm::cross(r.frame.z, r.frame.x);
    r.distance_m = distance[i], r.radius_m = radius[i];
    if (shared) r.shared = shared[i];
    if (footprint) {
      AdaptiveFootprint::Lengths& lengths_m = r.footprint_m.emplace();
      std::copy_n(footprint + lengths_m.size() * i, lengths_m.size(), lengths_m.begin());
    }
    r.light = take(light, count, own);
    r.stderr_light = take(error, bands, own_bands);
    if (!along.empty()) r.gradient_x = take(along[0], count, own), r.gradient_y = take(along[1], count, own);
  });
  for (std::size_t record = 0; record < wrong.size(); ++record) {
    if (wrong[record]) {
      throw Error(ExitCode::bad_input, file.path(),
                  text("record ", row_of(record), " has ", wrong[record],
                       "; the file is damaged or was made by a faulty program: make it again"));
    }
  }
  return cache;
}

}  // namespace phos::inline radiance
