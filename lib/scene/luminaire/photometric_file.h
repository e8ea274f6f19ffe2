// What a file of a luminaire's photometry says: LM-63 (.ies) or EULUMDAT (.ldt).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/json.h"
#include "scene/luminaire/luminous_opening.h"
#include "scene/luminaire/photometry.h"

namespace phos::inline scene {

/// Factor on the light of a luminaire that is tilted out of the position it was measured in; linear between
/// its angles, constant beyond them. Empty: 1 always.
struct TiltTable {
  std::vector<std::pair<double, double>> factor_at_deg;
  double factor(double tilt_deg) const;
};

struct PhotometricFile {
  std::string format;                             ///< "LM-63-2002, type C", "EULUMDAT"
  std::string maker, luminaire, catalogue, lamp;  ///< "" where not stated
  std::shared_ptr<const Photometry> photometry;   ///< in cd, all of the file's factors applied
  LuminousOpening opening;
  TiltTable tilt;
  bool absolute = false;              ///< measured with its lamps: it was not measured by `lamp_lm`
  double lamp_lm = 0;                 ///< of all lamps of the luminaire together; 0 where not stated
  double watts = 0;                   ///< input; 0 where not stated
  std::vector<std::string> warnings;  ///< faults that were accepted though the format does not allow them

  /// Maker and luminaire, or one of them; `absent` if neither is there.
  std::string title(const std::string& absent) const;
};

/// Returns the bytes of a file that the photometry names (TILT=file). Throws Error.
using ReadBeside = std::function<std::string(const std::string& name)>;

/// From a file's bytes; the format is told from them. `where` names it in errors, which are
/// Error(bad_input, "where:line"): truncated, counts that do not fit, angles out of order, negative or
/// non-finite values, ... Memory is taken only for values that are there. Without `beside`, a file that names
/// another one is refused.
PhotometricFile parse_photometry(std::string_view bytes, const std::string& where,
                                 const ReadBeside& beside = {});
/// From a file, and the file of tilt factors beside it if it names one.
PhotometricFile read_photometry(const std::string& path);
/// `path` and the files that it names, as far as they exist.
std::vector<std::string> photometric_files(const std::string& path);

/// Is it likely to be one? (Errors are for parse_photometry to tell.)
bool looks_like_photometry(std::string_view bytes);
/// Of a file, by its beginning; false where it cannot be read.
bool is_photometry(const std::string& path);

/// Figures for people and scripts: lumens, share of the lamps' light, greatest intensity and where, beam and
/// field angles of both planes, opening, the file's own description, warnings.
Json describe_photometry(const PhotometricFile& file);
std::string photometry_text(const Json& description);

}  // namespace phos::inline scene
