#include "splat/caches.h"

#include <algorithm>

#include "core/error.h"

namespace phos {

namespace {

bool is_brdf(const Container& file) { return file.provenance().kind == "brdf"; }

}  // namespace

std::vector<Container> open_caches(const std::vector<std::string>& paths) {
  std::vector<Container> files;
  for (const std::string& path : paths) {
    files.push_back(Container::open(path));
    if (!is_brdf(files.back())) files.back() = Container::open(path, "irradiance");
  }
  if (std::all_of(files.begin(), files.end(), is_brdf))
    throw Error(ExitCode::bad_input, paths.empty() ? "CACHE" : paths.front(),
                "is no irradiance cache; give one too (phos-irradiance makes it)");
  return files;
}

SplatCaches read_caches(const std::vector<Container>& files) {
  SplatCaches caches;
  IrradianceCache& all = caches.irradiance;
  const Container* first = nullptr;
  for (const Container& file : files) {
    if (is_brdf(file)) {
      for (BrdfTable& table : read_brdf(file)) caches.brdf.push_back(std::move(table));
      continue;
    }
    const IrradianceCache more = read_irradiance(file);
    if (first && more.quantity != all.quantity)
      throw Error(ExitCode::mismatch, file.path(),
                  text("holds ", more.quantity, " light, ", first->path(), " holds ", all.quantity,
                       "; make both with the same --paths of phos-irradiance"));
    all.accuracy = first ? std::min(all.accuracy, more.accuracy) : more.accuracy;
    all.quantity = more.quantity;
    all.records.insert(all.records.end(), more.records.begin(), more.records.end());
    first = &file;
  }
  return caches;
}

}  // namespace phos
