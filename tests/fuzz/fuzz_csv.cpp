// Tables: comma-separated values, points of sensors, spectra, and plots of columns.
#include "file/csv.h"
#include "image/plot/csv_plot.h"
#include "reading.h"
#include "scene/point_table.h"
#include "scene/spectral/spectrum.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string_view bytes = fuzz::characters(data, size);
  fuzz::answers([&] {
    const PointTable points = parse_points(bytes, "input");
    PHOS_CHECK(points.position.size() == points.normal.size(), points.normal.size());
    for (const Vec3& p : points.position) PHOS_CHECK(is_finite(p), p.x, " ", p.y, " ", p.z);
  });
  for (const SpectrumKind kind : {SpectrumKind::reflectance, SpectrumKind::power})
    fuzz::answers([&] {
      const Spectrum spectrum = parse_spectrum(bytes, "input", kind);
      const double mean = spectrum.mean(kCieFirst_nm, kCieLast_nm);
      PHOS_CHECK(mean >= 0 && (kind == SpectrumKind::power || mean <= 1 + 1e-9), mean);
    });
  fuzz::answers([&] {
    const CsvTable table = parse_csv(bytes, "input");
    for (const auto& row : table.rows) PHOS_CHECK(row.size() == table.columns.size(), row.size());
    CsvPlotOptions options;
    options.x = table.columns.front(), options.y = {table.columns.back()};
    options.log_y = size % 2 == 0;
    const Plot plot = plot_of(table, options);
    fuzz::use(plot);
  });
  return 0;
}
