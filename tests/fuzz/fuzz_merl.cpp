// Measured reflection. Files are 35 MB, so an input stands for one: its first 12 bytes are the sizes, the
// thirteenth says whether the file has its full length, and the rest are samples that repeat.
#include <cstring>

#include "reading.h"
#include "scene/material/merl.h"

namespace {

std::string file_of(std::string_view input) {
  constexpr std::size_t kSizes = 12, kSamples = 3 * sizeof(double) * phos::MerlBrdf::kThetaH *
                                                phos::MerlBrdf::kThetaD * phos::MerlBrdf::kPhiD;
  std::string file(input.substr(0, kSizes));
  if (input.size() <= kSizes) return file;
  const bool full = input[kSizes] != 0;
  std::string_view samples = input.substr(kSizes + 1);
  samples = samples.substr(0, samples.size() / sizeof(double) * sizeof(double));
  if (!full || samples.empty()) return file + std::string(samples);
  file.resize(kSizes + kSamples);
  for (std::size_t at = 0; at < kSamples; at += samples.size())
    std::memcpy(file.data() + kSizes + at, samples.data(), std::min(samples.size(), kSamples - at));
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string file = file_of(fuzz::characters(data, size));
  return fuzz::answers([&] {
    const MerlBrdf brdf(file, "input");
    const Vec3 o(0.6f, 0, 0.8f);
    Vec3 i;
    PHOS_CHECK(is_finite(brdf.evaluate(o, {0, 0.6f, 0.8f})), "a value that is not finite");
    PHOS_CHECK(is_finite(brdf.albedo(0.5f)) && brdf.gloss_density(o, o) > 0, "no density");
    if (brdf.glossy()) fuzz::use(brdf.sample_gloss(o, {0.3f, 0.7f}, i));
  });
}
