#include "radiance/brdf/report.h"

#include <cmath>

#include "core/error.h"
#include "core/text/quantity.h"

namespace phos::inline radiance {
namespace {

std::string title(const BrdfTable& table) {
  return table.material.empty() ? text("material ", table.material_index) : text('"', table.material, '"');
}

}  // namespace

Json header_of(const BrdfTable& table) {
  Json j;
  j["material"] = table.material;
  j["index"] = table.material_index;
  j["isotropic"] = table.isotropic;
  j["resolution"] = table.resolution;
  j["order"] = table.order;
  j["albedo"] = table.albedo;
  if (!table.note.empty()) j["note"] = table.note;
  return j;
}

Json figures_of(const BrdfTable& table, const std::string& model) {
  const BrdfSummary s = summarize(table);
  Json j = header_of(table);
  j["model"] = model;
  j["order_least"] = s.least_order;
  j["order_greatest"] = s.greatest_order;
  j["order_mean"] = s.mean_order;
  j["traced_share"] = s.traced_share;
  j["error_mean"] = s.mean_error;
  j["error_worst"] = s.worst_error;
  j["bytes"] = s.bytes;
  return j;
}

std::string sentence_of(const BrdfTable& table, const std::string& model) {
  const BrdfSummary s = summarize(table);
  std::string out = text(title(table), ": ", model, table.isotropic ? ", " : ", anisotropic, ");
  if (s.greatest_order == 0) {
    out += "every direction is to be traced (--max-order or --error would have to be higher)";
  } else {
    out += text("orders ", s.least_order, " to ", s.greatest_order, ", mean ",
                std::round(10 * s.mean_order) / 10, "; ", percent_to_tenths(s.traced_share),
                " of directions traced; the others leave out ", percent_to_tenths(s.mean_error),
                " of the energy, at most ", percent_to_tenths(s.worst_error));
  }
  out += text("; ", s.bytes, " bytes");
  return table.note.empty() ? out : text(out, "; ", table.note);
}

std::vector<std::string> warnings_of(const BrdfTable& table, const Counters& counters) {
  std::vector<std::string> warnings;
  if (const std::uint64_t n = counters[kGainsEnergyEvent]; n > 0) {
    warnings.push_back(text(title(table), " gains energy: it reflects up to ", table.albedo,
                            " of the light that reaches it (", n, " of ", table.entries(),
                            " directions above 1); lower its reflectances"));
  }
  if (const std::uint64_t n = counters[kIntricateLobeEvent]; n > 0) {
    warnings.push_back(text(title(table), " is too intricate for the quadrature towards ", n, " of ",
                            table.entries(), " directions: they are traced"));
  }
  return warnings;
}

}  // namespace phos::inline radiance
