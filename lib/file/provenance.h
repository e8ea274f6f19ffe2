// What a file says about how it was made, and whether it belongs to a scene.
#pragma once

#include <map>
#include <string>

#include "core/counters.h"
#include "core/json.h"
#include "file/kinds/kind.h"

namespace phos::inline file {

class Container;

/// What a file says about how it was made (its __metadata__). Nothing volatile.
struct Provenance {
  FileKind kind = FileKind::image;
  int version = 1;    ///< of the kind's layout
  std::string tool;   ///< "phos-photons 0.1.0"
  int algorithm = 0;  ///< of the tool: raised when the same command would give other numbers; 0 = not stated
  std::string command;                        ///< rebuilt from the resolved parameters
  Json parameters;                            ///< object
  std::map<std::string, std::string> inputs;  ///< role ("scene", "photons") -> content hash
  std::string scene_hash;
  Json scene_parts;  ///< the parts of the scene hash, so that a mismatch can be named (see scene/scene.h)
  Json history = Json::Array{};  ///< the provenance of each earlier stage, oldest first
  std::string key;               ///< the value that --reuse compares
  Json extra;                    ///< kind-specific scalars (object): totals, bounds, shard, ...
  Counters counters;
};

/// Provenance as text by name (the header of a container, the attributes of an EXR image): strings as they
/// are, the rest as JSON text. Empty values have no entry.
using Metadata = std::map<std::string, std::string>;
Metadata to_metadata(const Provenance& provenance);
/// Throws Error(bad_input) for an entry of another type.
Provenance from_metadata(const Metadata& metadata, const std::string& where);
/// What a later stage keeps of this one in its history.
Json history_entry(const Provenance& provenance);

/// Throws Error(mismatch) if the two scene hashes differ, saying which part changed ("node \"lamp\" moved").
void require_same_scene(const Container& file, const std::string& scene_path, const std::string& scene_hash,
                        const Json& scene_parts);

}  // namespace phos::inline file
