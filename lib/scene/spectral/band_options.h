// Options by which light is computed in bands of wavelength.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/options.h"

namespace phos::inline scene {

struct BandOptions {
  std::int64_t number = 0;           ///< of bands; 0: RGB
  std::int64_t triplet = 0;          ///< which of them, from 1; 0: not told
  std::vector<std::string> spectra;  ///< NAME=FILE

  bool any() const { return number > 0; }
};
void declare_options(Options& options, BandOptions& bands);
/// The words of a command line that mean the same.
std::vector<std::string> band_words(const BandOptions& options);
/// Takes over a word of a command line and its value, where it is of bands. The values must have been read by
/// declare_options() before.
void read_band_word(const std::string& word, const std::string& value, BandOptions& options);
/// Throws Error(usage) where options are missing, contradict each other, or there is no such triplet.
void check(const BandOptions& options);

}  // namespace phos::inline scene
