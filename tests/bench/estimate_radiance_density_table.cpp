// Light through glossy lobes from the photons of one zone: root mean square errors, relative to the truth by
// quadrature, over the lobes of support/photon_lobes.h seen from four sides. CSV, by scene, photons in the
// zone and bands:
//   fit       CosineFit (PhotonProjector), in the middle of the zone
//   bias      of that
//   plain     each photon divided by its own cosine
//   still     the fit as it is, half a zone's radius aside
//   moved     by its gradient, at that place
#include <cstdio>

#include "estimate/radiance_density.h"
#include "support/photon_lobes.h"

namespace phos {
namespace {

constexpr double kZone = 0.2;  // m; what shines is 1 m to 2 m away
constexpr int kTimes = 100;
const Vec2 kAside(0.08f, 0.06f);

struct Error {
  double sum = 0, squares = 0, n = 0;
  void add(double relative) { sum += relative, squares += relative * relative, n += 1; }
};

struct Lobe {
  std::vector<double> coefficients;
  double middle, aside;  // luminance that leaves by it
  Error fit, plain, still, moved;
};

std::vector<Lobe> lobes_of(const test::GradientScene& scene, int order) {
  std::vector<Lobe> lobes;
  for (const float azimuth : {20.f, 110.f, 200.f, 290.f})
    for (const test::NamedLobe& lobe : test::glossy_lobes(azimuth))
      lobes.push_back({test::coefficients(lobe, order),
                       test::outgoing(scene, lobe, DVec3(0)),
                       test::outgoing(scene, lobe, DVec3(kAside, 0)),
                       {},
                       {},
                       {},
                       {}});
  return lobes;
}

void measure(const test::GradientScene& scene, const test::PhotonSource& source, int photons, int order) {
  std::vector<Lobe> lobes = lobes_of(scene, order);
  PhotonProjector projector(order);
  double brightest = 0;  // errors are relative to it: some lobes see next to nothing
  for (const Lobe& lobe : lobes) brightest = std::max(brightest, lobe.middle);
  ZonePhotons zone;
  for (std::uint64_t i = 0; i < kTimes; ++i) {
    RandomStream random(13, Stage::test, i);
    source.draw_poisson(photons, random, zone);
    const std::vector<std::uint8_t> used(zone.size(), 1);
    const RadianceRecord r =
        projector.project(zone, used, source.area_m2(), 0, Vec2(0), Frame(), RadianceGradient::analytic);
    const std::vector<double> fit = test::channel(r.light), x = test::channel(r.gradient_x),
                              y = test::channel(r.gradient_y),
                              plain = test::by_inverse_cosines(zone, source.area_m2(), order);
    for (Lobe& lobe : lobes) {
      const auto through = [&](const std::vector<double>& light) {
        return test::through(lobe.coefficients, light);
      };
      const double here = through(fit), step = double(kAside.x) * through(x) + double(kAside.y) * through(y);
      lobe.fit.add((here - lobe.middle) / brightest),
          lobe.plain.add((through(plain) - lobe.middle) / brightest);
      lobe.still.add((here - lobe.aside) / brightest), lobe.moved.add((here + step - lobe.aside) / brightest);
    }
  }
  double bias = 0;
  const auto rms = [&](Error Lobe::*which) {
    double sum = 0;
    for (const Lobe& lobe : lobes) sum += (lobe.*which).squares / (lobe.*which).n / double(lobes.size());
    return std::sqrt(sum);
  };
  for (const Lobe& lobe : lobes) bias += std::pow(lobe.fit.sum / lobe.fit.n, 2) / double(lobes.size());
  std::printf("%s,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f\n", scene.name.c_str(), photons, order, rms(&Lobe::fit),
              std::sqrt(bias), rms(&Lobe::plain), rms(&Lobe::still), rms(&Lobe::moved));
}

}  // namespace
}  // namespace phos

int main() {
  std::printf("scene,photons,order,fit,bias,plain,still,moved\n");
  for (const char* name : {"rect_ceiling", "rect_wall_x1", "closed_box_5L", "white_furnace"}) {
    const phos::test::GradientScene scene = phos::test::gradient_scene(name);
    const phos::test::PhotonSource source(scene, phos::kZone);
    for (const int photons : {100, 300, 1000})
      for (const int order : {5, 7, 10}) phos::measure(scene, source, photons, order);
  }
}
