// Accuracy (share of energy) against the number of coefficients for HSH, SH, even SH, Zernike's and
// Makhotkin's functions, as CSV: the lobes of Gautron et al. 2004, figures 4 (cos^5) and 5 (Ward 0.2 / 0.5),
// raw and weighted by the cosine, and their means over outgoing directions. Degrees without functions of odd
// l + m are listed with those that exist, and even SH with all of SH again ("even-sh-all").
//   build/tests/hsh_figures_table > figures.csv
#include <cstdio>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "support/lobes.h"

namespace {

using namespace phos;

constexpr int kMost = 110;  // coefficients

struct Case {
  std::string name;
  std::vector<test::WeightedLobe> lobes;
};

std::vector<Case> cases() {
  const double degree = std::numbers::pi / 180;
  std::vector<Case> all;
  for (const bool cosine : {false, true}) {
    const std::string weighted = cosine ? " cosine" : " raw";
    for (const int theta : {0, 30, 45, 60, 80}) {
      all.push_back(
          {text("phong5", weighted, " theta ", theta), {{test::phong_lobe(5, theta * degree, cosine), 1}}});
    }
    all.push_back({"phong5" + weighted + " mean", test::phong_means(cosine)});
    for (const int theta : {0, 30, 45, 60}) {
      for (const int phi : {0, 90}) {
        all.push_back({text("ward", weighted, " theta ", theta, " phi ", phi),
                       {{test::ward_lobe(.2, .5, theta * degree, phi * degree, cosine), 1}}});
      }
    }
    all.push_back({"ward" + weighted + " mean", test::ward_means(cosine)});
  }
  return all;
}

/// By order, the weighted mean over the lobes.
std::vector<double> accuracies(const std::vector<test::WeightedLobe>& lobes, ComparisonBasis basis,
                               int order) {
  static const Quadrature q = hemisphere_quadrature(96, 192);
  std::vector<double> mean(static_cast<std::size_t>(order));
  double weight = 0;
  for (const test::WeightedLobe& lobe : lobes) weight += lobe.weight;
  for (const test::WeightedLobe& lobe : lobes) {
    const std::vector<double> one = accuracy_by_order(lobe.f, basis, order, q);
    for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += one[n] * lobe.weight / weight;
  }
  return mean;
}

std::string rows(const Case& c) {
  std::string out;
  for (const ComparisonBasis basis : kComparisonBases) {
    int order = 1;
    while (comparison_count(basis, order + 1) <= kMost) ++order;
    const std::vector<double> accuracy = accuracies(c.lobes, basis, order);
    for (int n = 1; n <= order; ++n) {
      char share[32];
      std::snprintf(share, sizeof share, "%.6f\n", accuracy[static_cast<std::size_t>(n - 1)]);
      out += text(c.name, ",", name(basis), ",", comparison_count(basis, n), ",", share);
      if (basis == ComparisonBasis::even_sh && n * n <= kMost) {
        out += text(c.name, ",even-sh-all,", n * n, ",", share);
      }
    }
  }
  return out;
}

}  // namespace

int main() {
  const std::vector<Case> all = cases();
  std::vector<std::string> out(all.size());
  parallel_for(all.size(), 1, [&](std::size_t i) { out[i] = rows(all[i]); });
  std::printf("lobe,basis,coefficients,accuracy\n");
  for (const std::string& lines : out) std::fputs(lines.c_str(), stdout);
}
