// Luminaires of measured distribution, hung in a scene.
#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/luminaire/options.h"
#include "scene/luminaire/photometric_file.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// The distributions that options give to lights. Reads each file once; its warnings go to the first scene.
class GivenLuminaires {
 public:
  /// Throws Error(usage) for words not of the form NAME=FILE, Error(bad_input) for files.
  explicit GivenLuminaires(const LuminaireOptions& options);
  /// Null where the options name no such light.
  std::shared_ptr<const PhotometricFile> find(const std::string& light);
  /// Throws Error(usage) if a name was never asked for, naming the lights that were.
  void require_all_found() const;

 private:
  std::map<std::string, std::shared_ptr<const PhotometricFile>> file_;
  std::map<std::string, bool> asked_;
};

/// Where a luminaire hangs. Its axes in `to_world` (from the scene's origin) are as in photometry.h, as in
/// EXT_lights_ies: it shines down its z axis, C0 lies along x. What scales it scales its opening; its candela
/// stay.
struct LuminairePlace {
  std::string name;
  glm::dmat4 to_world{1};
  Rgb colour{1};  ///< multiplies the file's light
};
/// Colour of a light, of luminance 1; white for a black one.
Rgb hue(const Rgb& colour);
/// Straight down, C0 towards world direction `across`, as far as that is horizontal.
glm::dmat4 hanging_down(const DVec3& position, const DVec3& across, double scale);
/// Shining along `direction`, C0 about towards `across`.
glm::dmat4 aimed(const DVec3& position, const DVec3& direction, const DVec3& across);

/// Adds a luminaire to a scene that is not finalized: an instance for its opening, else a light of kind
/// measured. Its light is multiplied by the file's factor for its tilt out of hanging straight down (-Y).
void hang_luminaire(Scene& scene, std::shared_ptr<const PhotometricFile> file, const LuminairePlace& place,
                    LuminairesAs as);

}  // namespace phos::inline scene
