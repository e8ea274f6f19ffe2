#include "radiance/brdf/discs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/options.h"
#include "hsh/basis.h"

namespace phos::inline radiance {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// The scale of orders ends here at least, so that it has whole numbers.
constexpr int kLeastOrderScale = 10;
constexpr int kHarmonicPixels = 88;

/// The entry next to a place of the disc.
std::size_t entry_at(const BrdfTable& table, double x, double y) {
  const int n = table.resolution;
  const auto index = [n](double at) { return static_cast<std::size_t>(std::clamp(at, 0.0, n - 1.0)); };
  if (table.isotropic) return index(std::hypot(x, y) * (n - 1) + 0.5);
  return index(0.5 * (y + 1) * n) * static_cast<std::size_t>(n) + index(0.5 * (x + 1) * n);
}

template <class Value>
DiscPlot plot_of(std::span<const BrdfTable> tables, const char* unit, const Value& value) {
  DiscPlot plot{.rows = {}, .title = {}, .unit = unit, .absent = "traced"};
  std::vector<Disc>& row = plot.rows.emplace_back();
  for (const BrdfTable& table : tables)
    row.push_back({table.material, [&table, value](double x, double y) {
                     const std::size_t e = entry_at(table, x, y);
                     return table.orders[e] == 0 ? kNone : value(table, e);
                   }});
  return plot;
}

DiscPlot errors(std::span<const BrdfTable> tables) {
  DiscPlot plot = plot_of(tables, "%", [](const BrdfTable& table, std::size_t e) {
    return 100 * static_cast<double>(table.error[e]);
  });
  double most = 0;
  for (const BrdfTable& table : tables) most = std::max(most, summarize(table).worst_error);
  plot.hi = most > 0 ? round_up_125(100 * most) : 1;
  return plot;
}

DiscPlot orders(std::span<const BrdfTable> tables) {
  DiscPlot plot = plot_of(
      tables, "", [](const BrdfTable& table, std::size_t e) { return static_cast<double>(table.orders[e]); });
  plot.hi = kLeastOrderScale;
  for (const BrdfTable& table : tables) plot.hi = std::max(plot.hi, static_cast<double>(table.order));
  return plot;
}

DiscPlot harmonics(std::span<const BrdfTable> tables) {
  int order = 0;
  for (const BrdfTable& table : tables) order = std::max(order, table.order);
  if (order == 0)
    throw Error(ExitCode::bad_input, "", "all directions are traced: the tables have no harmonics to draw");
  const auto basis = std::make_shared<const HarmonicBasis<double>>(order);
  DiscPlot plot{.rows = {},
                .title = {},
                .unit = "1/sqrt(sr)",
                .about_zero = true,
                .absent = {},
                .diameter = kHarmonicPixels};
  for (int l = 0; l < order; ++l) {
    std::vector<Disc>& row = plot.rows.emplace_back();
    for (int m = -l; m <= l; ++m)
      row.push_back({text(l, ", ", m), [basis, i = harmonic_index(l, m)](double x, double y) {
                       std::vector<double> values(static_cast<std::size_t>(basis->count()));
                       const double r2 = x * x + y * y, s = 2 / (1 + r2);
                       basis->evaluate(BasisKind::hsh, s * x, s * y, (1 - r2) / (1 + r2), values.data());
                       return values[static_cast<std::size_t>(i)];
                     }});
  }
  // The greatest is that of m = 0 in the highest band, at the pole: sqrt((2 l + 1) / (2 pi)).
  plot.hi = round_up_125(std::sqrt((2 * order - 1) / (2 * M_PI)));
  return plot;
}

}  // namespace

void declare_options(Options& options, BrdfDiscs& discs) {
  Names<BrdfDiscs> names{{"none", BrdfDiscs::none}};
  for (const BrdfDiscsRow& row : kBrdfDiscs) names.emplace_back(row.name, row.which);
  options.section("Tables of glossy reflection");
  options.choice<BrdfDiscs>(
      "discs", discs, names,
      "INPUT is a .brdf file: draw on discs, which show the hemisphere from above, the energy of each "
      "material's lobe that the harmonics leave out, or their order, for each direction of view; or the "
      "harmonics themselves, a row for each band; OUTPUT ends in .png");
}

DiscPlot discs_of(std::span<const BrdfTable> tables, BrdfDiscs which) {
  PHOS_CHECK(which != BrdfDiscs::none, "no discs");
  if (tables.empty())
    throw Error(ExitCode::bad_input, "", "the file holds no table: nothing in its scene is glossy");
  DiscPlot plot = which == BrdfDiscs::error   ? errors(tables)
                  : which == BrdfDiscs::order ? orders(tables)
                                              : harmonics(tables);
  plot.title = std::find_if(std::begin(kBrdfDiscs), std::end(kBrdfDiscs), [which](const BrdfDiscsRow& row) {
                 return row.which == which;
               })->title;
  return plot;
}

}  // namespace phos::inline radiance
