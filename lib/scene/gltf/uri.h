// What a glTF "uri" stands for: bytes within it, or a file beside the scene.
#pragma once

#include <optional>
#include <string>

namespace phos::inline scene {

/// Is it "data:..."?
bool is_data_uri(const std::string& uri);
/// Bytes of a base64 data URI; nothing if it is malformed.
std::optional<std::string> decode_data_uri(const std::string& uri);
/// Path of the file a relative URI names, from the folder of `scene_path`; nothing for an absolute path,
/// another scheme, or an empty URI. %20 and the like are decoded.
std::optional<std::string> uri_file(const std::string& scene_path, const std::string& uri);
/// The same for a file in the scene's folder or below it: nothing for one that climbs out ("../x").
std::optional<std::string> file_below(const std::string& scene_path, const std::string& uri);
/// Bytes of a file that a scene refers to. Throws Error(bad_input) if it cannot be read, or is no regular
/// file: a device would be read for ever.
std::string read_referred(const std::string& path);
/// Path of `name` in the folder of `scene_path`.
std::string beside(const std::string& scene_path, const std::string& name);

}  // namespace phos::inline scene
