// Mutations of glTF that leave its JSON JSON and the frame of a .glb right, mostly.
#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "file/json_parse.h"
#include "mutate_json.h"
#include "reading.h"
#include "support/gltf.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace phos::fuzz {
namespace {

struct Parts {
  std::string json, bin;
  bool binary = false;
};

Parts split(std::string_view bytes) {
  constexpr std::size_t kFrame = 20;  // header, and the head of the first chunk
  if (!bytes.starts_with("glTF") || bytes.size() < kFrame) return {std::string(bytes), "", false};
  std::uint32_t n;
  std::memcpy(&n, bytes.data() + 12, sizeof n);
  const std::size_t json = std::min<std::size_t>(n, bytes.size() - kFrame);
  const std::size_t rest = std::min(bytes.size(), kFrame + json + 8);
  return {std::string(bytes.substr(kFrame, json)), std::string(bytes.substr(rest)), true};
}

void mutate_text(std::string& s) {
  const std::size_t size = s.size();
  s.resize(size + 64);
  s.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(s.data()), size, s.size()));
}

std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Choice choice(seed);
  if (choice.once_in(10)) return LLVMFuzzerMutate(data, size, most);
  Parts parts = split(characters(data, size));
  if (!parts.bin.empty() && choice.once_in(3)) {
    mutate_text(parts.bin);
  } else if (choice.once_in(8)) {
    mutate_text(parts.json);
  } else {
    Json document = parse_json(parts.json, "input");
    for (std::size_t times = 1 + choice.below(3); times > 0; --times) document = mutated(document, choice);
    parts.json = document.dump();
  }
  const std::string out = parts.binary ? test::glb(parts.json, parts.bin) : parts.json;
  return put(out, data, size, most);
}

}  // namespace
}  // namespace phos::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  try {
    return phos::fuzz::mutate(data, size, most, seed);
  } catch (const phos::Error&) {  // no JSON
    return LLVMFuzzerMutate(data, size, most);
  }
}
