// How exact the bases are, as CSV: by band, the largest deviation of values and gradients from the golden
// tables (relative to max(1, |golden|)); by order, how far the basis is from orthonormal.
//   build/tests/hsh_basis_table > exactness.csv
#include <cstdio>

#include "support/harmonics.h"
#include "support/run.h"

namespace {

using namespace phos;

constexpr int kOrder = 60;

void print(const char* basis, const char* precision, const char* measure,
           const std::vector<double>& by_band) {
  for (std::size_t l = 0; l < by_band.size(); ++l) {
    std::printf("%s,%s,%s,%zu,%.3g\n", basis, precision, measure, l + 1, by_band[l]);
  }
}

template <class Real>
void print_all(BasisKind kind, const char* basis, const char* precision) {
  const std::string shared = test::shared("golden/hsh");
  const std::string folder = shared.empty() ? test::data("golden/hsh") : shared;
  print(basis, precision, "value", test::golden_value_deviation<Real>(folder, kind));
  print(basis, precision, "gradient", test::golden_gradient_deviation<Real>(folder, kind));
  const Quadrature q = kind == BasisKind::sh ? sphere_quadrature(kOrder, 2 * kOrder)
                                             : hemisphere_quadrature(2 * kOrder + 1, 2 * kOrder);
  print(basis, precision, "orthonormality", test::gram_residual<Real>(kind, kOrder, q));
}

}  // namespace

int main() {
  std::printf("basis,precision,measure,order,largest_deviation\n");
  print_all<double>(BasisKind::sh, "sh", "double");
  print_all<float>(BasisKind::sh, "sh", "float");
  print_all<double>(BasisKind::hsh, "hsh", "double");
  print_all<float>(BasisKind::hsh, "hsh", "float");
}
