// Boundary bias before and after: errors of the hull and of the classical kernels near a border of the
// surface and near the edge of a shadow, as CSV. Bias with its 95 % interval and root mean square error, in
// percent of the irradiance on the lit side.
//   build/tests/photon_border_table > borders.csv
#include <cstdio>

#include "support/zone_borders.h"

namespace {

using namespace phos;

constexpr int kZones = 4000;

void print(const char* edge, double distance, int photons, const char* estimator, const test::EdgeErrors& e) {
  std::printf("%s,%g,%d,%s,%.2f,%.2f,%.2f\n", edge, distance, photons, estimator, 100 * e.bias,
              196 * e.bias_error, 100 * e.rmse);
}

}  // namespace

int main() {
  std::printf("edge,distance_radii,photons_of_whole_zone,estimator,bias_percent,interval_95,rmse_percent\n");
  std::uint64_t item = 0;
  for (const test::ZoneEdge edge : {test::ZoneEdge::border, test::ZoneEdge::shadow}) {
    const char* name = edge == test::ZoneEdge::border ? "border" : "shadow";
    for (const double distance : {1.0, 0.5, 0.25, 0.1, 0.0, -0.1, -0.25, -0.5}) {
      if (distance < 0 && edge == test::ZoneEdge::border) continue;
      for (const int photons : {100, 1000}) {
        ++item;
        using enum Kernel;
        print(name, distance, photons, "disc",
              test::kernel_errors(disc, edge, distance, photons, kZones, item));
        print(name, distance, photons, "epanechnikov",
              test::kernel_errors(epanechnikov, edge, distance, photons, kZones, item));
        print(name, distance, photons, "cone",
              test::kernel_errors(cone, edge, distance, photons, kZones, item));
        print(name, distance, photons, "hull", test::hull_errors(edge, distance, photons, kZones, item));
      }
    }
  }
}
