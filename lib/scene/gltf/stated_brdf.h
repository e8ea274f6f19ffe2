// A reflection model as extras.phos of a glTF material states it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/json.h"
#include "core/vector.h"

namespace phos::inline scene {

struct Material;

/// Throws with `what` for colours that are negative or not finite.
using Fail = std::function<void(const std::string&)>;
void check_colour(const Rgb& colour, const std::string& what, const Fail& fail);

class StatedBrdf {
 public:
  struct Owner {
    Fail fail;  ///< throws
    Fail warn;
    std::function<void()> read_measured;  ///< the table that `file` names, into the material
  };
  /// `base`: base colour of the core material. Holds references.
  StatedBrdf(const Json& phos, const Rgb& base, const Owner& owner)
      : phos_(phos), base_(base), owner_(owner) {}

  const Json* find(const char* key) const { return phos_.find(key); }
  const Rgb& base() const { return base_; }
  /// Not negative, or it fails.
  float number(const char* key, double absent) const;
  std::optional<Rgb> colour(const char* key) const;
  /// "alpha" (one number or two), or "ax" and "ay".
  void read_alpha(Material& material) const;
  void read_measured() const { owner_.read_measured(); }
  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message) const { owner_.warn(message); }

 private:
  const Json& phos_;
  const Rgb base_;
  const Owner& owner_;
};

}  // namespace phos::inline scene
