#include "file/kinds/page.h"

#include <vector>

#include "core/error.h"
#include "core/text/append_item.h"
#include "file/kinds/shape_pattern.h"
#include "file/kinds/tables.h"

namespace phos::inline file {

namespace {

std::vector<std::string_view> words_of(std::string_view list) {
  std::vector<std::string_view> words;
  while (!list.empty()) {
    const std::size_t space = std::min(list.find(' '), list.size());
    words.push_back(list.substr(0, space));
    list.remove_prefix(std::min(space + 1, list.size()));
  }
  return words;
}

std::string programs(const KindRow& kind) {
  std::string out;
  for (const std::string_view program : words_of(kind.programs)) append_item(out, text('`', program, '`'));
  return out;
}

/// "a7" to "[A7](../methods.md#a7)".
std::string methods(std::string_view anchors) {
  std::string out;
  for (const std::string_view anchor : words_of(anchors)) {
    std::string shown(anchor);
    shown[0] = static_cast<char>(shown[0] - 'a' + 'A');
    out += text(out.empty() ? " (" : ", ", '[', shown, "](../methods.md#", anchor, ')');
  }
  return out.empty() ? out : out + ')';
}

std::string row_line(const TensorRow& row) {
  const std::string_view check = row.check.words;
  return text("| `", row.name, "` | ", type_words(row), ' ', shape_words(row), " | ", row.unit, " | ",
              check.empty() ? "any" : check, " | ", row.meaning, methods(row.methods), " |\n");
}

constexpr const char* kTableHead =
    "\n| tensor | type | unit | every number is | meaning |\n|---|---|---|---|---|\n";

/// The first kind in whose section the group's tensors are explained.
const KindRow& home_of(const TensorGroup& group) {
  for (const KindRow& kind : all_kinds())
    for (const TensorGroup& other : kind.groups)
      if (other.rows.data() == group.rows.data()) return kind;
  PHOS_CHECK(false, "a group is of no kind");
}

std::string section(const KindRow& kind) {
  std::string out = text("<a id=\"", name_of(kind.kind), "\"></a>\n## ", kind.heading, "\n\nFormat `phos/",
                         name_of(kind.kind), '/', kind.version, "`, written by ", programs(kind), ".\n");
  if (!kind.explanation.empty()) out += text('\n', kind.explanation, '\n');
  std::string elsewhere, head = kTableHead;
  for (const TensorGroup& group : kind.groups) {
    if (home_of(group).kind != kind.kind) {
      for (const TensorRow& row : group.rows) append_item(elsewhere, text('`', row.name, '`'));
      continue;
    }
    if (!group.title.empty()) out += text('\n', group.title, '\n');
    if (!group.title.empty() || !head.empty()) out += kTableHead;
    head = "";
    for (const TensorRow& row : group.rows) out += row_line(row);
  }
  if (!elsewhere.empty()) out += text("\nThese tensors are as in files of irradiance: ", elsewhere, ".\n");
  return out;
}

}  // namespace

std::string kind_line(const KindRow& kind) {
  const std::string anchor = kind.kind == FileKind::image ? "pictures" : name_of(kind.kind);
  return text("| [`", kind.ending, "`](#", anchor, ") | ", programs(kind), " | ", kind.holds, " |\n");
}

std::string kind_sections() {
  std::string out;
  for (const KindRow& kind : all_kinds())
    if (!kind.groups.empty()) append_item(out, section(kind), "\n");
  return out;
}

}  // namespace phos::inline file
