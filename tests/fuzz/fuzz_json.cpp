// JSON: what is read, written and read again is the same.
#include "file/json_parse.h"
#include "reading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  return fuzz::answers([&] {
    const Json json = parse_json(fuzz::characters(data, size), "input");
    const std::string text = json.dump();
    PHOS_CHECK(parse_json(text, "again").dump() == text, text);
    PHOS_CHECK(parse_json(json.dump(2), "again").dump() == text, text);
  });
}
