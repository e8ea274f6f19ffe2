#include "scene/spectral/band_options.h"

#include <cstdlib>

#include "core/error.h"
#include "scene/spectral/bands.h"

namespace phos::inline scene {

void declare_options(Options& options, BandOptions& bands) {
  options.integer(
      "bands", bands.number, "N",
      "number of equal bands of 380 to 780 nm in which light is computed instead of RGB; 0: RGB. Each run of "
      "the stages computes three bands (--triplet), and phos-bands joins the results. A material or light "
      "without a spectrum gets a smooth one of its RGB colour under D65",
      {0, Bands::kMost}, {Recorded::if_given, Adopted::site});
  options.integer("triplet", bands.triplet, "K",
                  "required with --bands: computes bands 3 K - 2 to 3 K. Lux, lumens and cd/m2 then count "
                  "the light in these bands alone",
                  {1, (Bands::kMost + 2) / 3}, {Recorded::if_given, Adopted::site});
  options.named_files(
      "spectrum", bands.spectra,
      "with --bands: gives NAME the spectrum FILE: the reflectance of a material (0 to 1), or the relative "
      "power of a light, a luminaire, the environment, or the emission of a material or node; lumens stay as "
      "they are. CSV with the columns wavelength_nm,value; several may be given; give them to every stage",
      Adopted::site);
}

std::vector<std::string> band_words(const BandOptions& options) {
  std::vector<std::string> words;
  if (!options.any()) return words;
  words = {"--bands", std::to_string(options.number), "--triplet", std::to_string(options.triplet)};
  for (const std::string& word : options.spectra) words.insert(words.end(), {"--spectrum", word});
  return words;
}

void read_band_word(const std::string& word, const std::string& value, BandOptions& options) {
  if (word == "--bands") options.number = std::strtoll(value.c_str(), nullptr, 10);
  if (word == "--triplet") options.triplet = std::strtoll(value.c_str(), nullptr, 10);
  if (word == "--spectrum") options.spectra.push_back(value);
}

void check(const BandOptions& o) {
  if (!o.any()) {
    if (o.triplet > 0) throw Error(ExitCode::usage, "--triplet", "needs --bands; give both");
    if (!o.spectra.empty())
      throw Error(ExitCode::usage, "--spectrum", "needs --bands, as RGB has no spectra; give both");
    return;
  }
  if (o.number < Bands::kLeast)
    throw Error(
        ExitCode::usage, "--bands",
        text("is ", o.number, "; it must be ", Bands::kLeast, " to ", Bands::kMost, ", or 0 for RGB"));
  const std::int64_t triplets = (o.number + 2) / 3;
  if (o.triplet < 1)
    throw Error(ExitCode::usage, "--triplet",
                text("is missing; ", o.number, " bands are computed in ", triplets, " runs, --triplet 1 to ",
                     triplets, " (pipelines/bands.sh makes them all)"));
  if (o.triplet > triplets)
    throw Error(ExitCode::usage, "--triplet",
                text("is ", o.triplet, ", but ", o.number, " bands have ", triplets, " triplets; give 1 to ",
                     triplets));
}

}  // namespace phos::inline scene
