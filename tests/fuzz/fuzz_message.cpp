// Messages of phos-view and its page.
#include "reading.h"
#include "view/message/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace phos;
  const std::string_view bytes = fuzz::characters(data, size);
  const auto layouts = message_layouts();
  // The kind that a message states; the last where it states none.
  const MessageLayout* layout = &layouts.back();
  for (const MessageLayout& one : layouts)
    if (size > 6 && data[6] == static_cast<std::uint8_t>(one.kind)) layout = &one;
  return fuzz::answers([&] {
    const MessageReader message(bytes, layout->kind);
    for (const MessageField& field : layout->fields) {
      const std::size_t rows = message.rows(field.table);
      std::size_t values = 0;
      if (field.type == FieldType::f32) values = message.floats(field.table, field.name).size();
      if (field.type == FieldType::u32) values = message.numbers(field.table, field.name).size();
      if (field.type == FieldType::u8) values = message.bytes(field.table, field.name).size();
      PHOS_CHECK(values == rows * field.components || (field.optional && values == 0), values, " of ", rows);
    }
  });
}
