// What the server of a walk serves: the page and its data, and nothing else.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/json.h"
#include "view/server.h"

namespace phos::inline view {

class PageFiles {
 public:
  /// The files of the page (embedded_files()), "/" for index.html; "/weight.glsl", the weight of records
  /// (record/weight.inc) with its constants; "/format.json", the format of messages; "/palette.bin", the
  /// colours of a scale, 256 x 3 bytes; "/scene.bin" and "/records.bin", messages; "/about.json".
  PageFiles(std::string scene_message, std::string records_message, const Json& about);

  /// Another message: "/records-1.bin".
  void add(const std::string& path, std::string message);

  std::optional<ServedFile> find(std::string_view path) const;

 private:
  struct Owned {
    std::string_view type;
    std::string bytes;
  };
  std::map<std::string, Owned, std::less<>> files_;
};

}  // namespace phos::inline view
