#include "photon/photon_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/parallel.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kChunk = 1 << 16;

constexpr std::uint8_t kMostBounces = 255;

/// Photons of more than 16 to 32 times the median are not usual ones.
constexpr int kUsualBinaryOrders = 4;

/// Photons by the binary order of their flux.
class Orders {
 public:
  void add(double lm) {
    if (lm > 0)
      ++count_[static_cast<std::size_t>(std::clamp(std::ilogb(lm), -kLargest, kLargest) + kLargest)];
  }
  void join(const Orders& other) {
    for (std::size_t i = 0; i < count_.size(); ++i) count_[i] += other.count_[i];
  }
  /// The largest that is usual, lm.
  double most_lm() const {
    std::uint64_t all = 0, below = 0;
    for (const std::uint64_t n : count_) all += n;
    std::size_t median = 0;
    while (median + 1 < count_.size() && 2 * (below += count_[median]) < all) ++median;
    return std::ldexp(1, static_cast<int>(median) - kLargest + kUsualBinaryOrders + 1);
  }

 private:
  static constexpr int kLargest = 200;
  std::array<std::uint64_t, 2 * kLargest + 1> count_{};
};

/// What paths carry, of photons counted one by one.
struct Carried {
  std::uint32_t family;
  float lm;
  auto operator<=>(const Carried&) const = default;
};

/// PhotonNoise::pairs of a map with families. `counts(i)`: is photon i among them?
template <class Counts>
double pairs_of_families(const PhotonMap& photons, const Counts& counts) {
  Column<Carried> carried;
  for (std::size_t i = 0; i < photons.size(); ++i)
    if (counts(i)) carried.push_back({photons.family[i], luminance(photons.flux[i])});
  parallel_sort(carried, kChunk);  // photons that are alike in both are the same to the sums
  double all = 0, pairs = 0, path = 0, squares = 0;
  for (std::size_t i = 0; i < carried.size(); ++i) {
    const auto lm = static_cast<double>(carried[i].lm);
    path += lm, squares += lm * lm;
    if (i + 1 < carried.size() && carried[i + 1].family == carried[i].family) continue;
    all += path, pairs += path * path - squares;
    path = squares = 0;
  }
  return all > 0 ? std::max(0.0, pairs) / (all * all) : 0;
}

struct Sums {
  double photons = 0, flux = 0, squares = 0, before = 0;
  double last = 0, beyond = 0;  // photons of one bounce less than can be counted, and of more
};

}  // namespace

PhotonNoise photon_noise(const PhotonMap& photons, bool with_direct) {
  const std::uint32_t first = with_direct ? 0 : 1;
  const auto counts = [&](std::size_t i) {
    return with_direct || photons.path[i] != static_cast<std::uint8_t>(PhotonPath::direct);
  };
  const double most_lm = parallel_reduce<Orders>(
                             photons.size(), kChunk, {},
                             [&](std::size_t begin, std::size_t end) {
                               Orders orders;
                               for (std::size_t i = begin; i < end; ++i)
                                 if (counts(i)) orders.add(static_cast<double>(luminance(photons.flux[i])));
                               return orders;
                             },
                             [](Orders& all, const Orders& part) { all.join(part); })
                             .most_lm();
  const Sums all = parallel_reduce<Sums>(
      photons.size(), kChunk, {},
      [&](std::size_t begin, std::size_t end) {
        Sums s;
        for (std::size_t i = begin; i < end; ++i) {
          if (!counts(i)) continue;
          const auto flux = static_cast<double>(luminance(photons.flux[i]));
          s.photons += 1;
          if (flux <= most_lm) s.flux += flux, s.squares += flux * flux;
          s.last += photons.bounce[i] == kMostBounces - 1, s.beyond += photons.bounce[i] == kMostBounces;
          if (photons.bounce[i] > first) s.before += photons.bounce[i] - first;
        }
        return s;
      },
      [](Sums& sum, const Sums& part) {
        sum.photons += part.photons, sum.flux += part.flux;
        sum.squares += part.squares, sum.before += part.before;
        sum.last += part.last, sum.beyond += part.beyond;
      });
  PhotonNoise noise;
  noise.photons = all.photons;
  if (!(all.photons > 0)) return noise;
  if (all.flux > 0) noise.photon_lm = all.squares / all.flux;
  // Beyond, paths go on as they did at the last bounce that was counted.
  const double uncounted = all.last > 0 ? all.beyond * all.beyond / all.last : 0;
  noise.pairs = 2 * (all.before + uncounted) / (all.photons * all.photons);
  if (!photons.family.empty())
    noise.pairs = pairs_of_families(photons, [&](std::size_t i) {
      return counts(i) && static_cast<double>(luminance(photons.flux[i])) <= most_lm;
    });
  if (photons.totals.emitted > 0)
    noise.common = noise.pairs - 1 / static_cast<double>(photons.totals.emitted);
  return noise;
}

}  // namespace phos::inline photon
