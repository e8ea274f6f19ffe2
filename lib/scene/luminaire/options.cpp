#include "scene/luminaire/options.h"

#include "core/text/named_files.h"
#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

void declare_options(Options& options, LuminaireOptions& luminaires) {
  options.named_files("luminaire", luminaires.of_lights,
                      "gives the light NAME of the scene (point, spot or EXT_lights_ies) the measured "
                      "distribution and lumens of the luminaire FILE: IES LM-63 (.ies) or EULUMDAT (.ldt). A "
                      "point light then hangs straight down, with C0 along the node's x axis; a spot light "
                      "keeps its direction. Several may be given; give them to every stage",
                      Adopted::site);
  options.choice("luminaires-as", luminaires.as,
                 {{"openings", LuminairesAs::openings}, {"points", LuminairesAs::points}},
                 "emitting shape of measured luminaires: openings: the luminous opening that the file "
                 "states, right near by and seen in pictures; points: a point",
                 {Recorded::if_given, Adopted::site});
}

std::vector<std::string> luminaire_files(const LuminaireOptions& options) {
  std::vector<std::string> files;
  for (const NamedFile& w : named_files(options.of_lights, "--luminaire"))
    for (std::string& file : photometric_files(w.file)) files.push_back(std::move(file));
  return files;
}

std::vector<std::string> luminaire_words(const LuminaireOptions& options) {
  std::vector<std::string> words;
  for (const std::string& word : options.of_lights) words.insert(words.end(), {"--luminaire", word});
  if (options.as == LuminairesAs::points) words.insert(words.end(), {"--luminaires-as", "points"});
  return words;
}

}  // namespace phos::inline scene
