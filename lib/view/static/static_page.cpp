#include "view/static/static_page.h"

#include <string_view>

#include "core/error.h"
#include "core/text/base64.h"
#include "view/limits.h"
#include "view/static/deflate.h"
#include "view/static/packed_message.h"

namespace phos::inline view {
namespace {

constexpr std::string_view kCharset = "<meta charset=\"utf-8\">\n";
constexpr std::string_view kPolicy =
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline' "
    "data:; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'\">\n";
constexpr std::string_view kStyle = "<link rel=\"stylesheet\" href=\"/";
constexpr std::string_view kScript = "<script type=\"module\" src=\"/";
/// Before the names of modules: a page from disk has no address that they could be relative to.
constexpr std::string_view kModules = "page/";

void replace_all(std::string& s, std::string_view old, std::string_view by) {
  for (std::size_t at = 0; (at = s.find(old, at)) != std::string::npos; at += by.size())
    s.replace(at, old.size(), by);
}

/// Replaces `begin`NAME`end`, of which there is one, by `by`(NAME).
template <class By>
void replace_one(std::string& s, std::string_view begin, std::string_view end, By by) {
  const std::size_t at = s.find(begin), name = at + begin.size();
  PHOS_CHECK(at != std::string::npos && s.find(begin, name) == std::string::npos, begin);
  const std::size_t after = s.find(end, name);
  PHOS_CHECK(after != std::string::npos, begin, end);
  s.replace(at, after + end.size() - at, by(s.substr(name, after - name)));
}

std::string_view text_of(const PageFiles& files, const std::string& path) {
  const std::optional<ServedFile> file = files.find(path);
  PHOS_CHECK(file, path);
  return file->bytes;
}

/// The text of an element, which ends where its tag does.
std::string_view element_text(std::string_view s) {
  PHOS_CHECK(s.find("</s") == std::string_view::npos, s.substr(0, 60));
  return s;
}

std::string module_address(std::string_view script) {
  std::string s(script);
  for (const char* quote : {"'", "\""})
    for (const char* word : {"from ", "import ", "import("})
      replace_all(s, text(word, quote, "./"), text(word, quote, kModules));
  return "data:text/javascript;base64," + base64(s);
}

std::string file_element(std::string_view path, std::string_view bytes) {
  const bool packed = is_message(bytes);
  return text("<script type=\"application/octet-stream\" id=\"", path,
              packed ? "\" data-form=\"packed\"" : "\"", ">",
              base64(deflated(packed ? packed_message(bytes) : bytes)), "</script>\n");
}

}  // namespace

std::string static_page(const PageFiles& files, const Json& provenance) {
  Json modules = Json::Object{};
  std::string held;
  for (const std::string_view path : files.paths()) {
    const std::string_view bytes = files.find(path)->bytes;
    if (path.ends_with(".js"))
      modules[text(kModules, path.substr(1))] = module_address(bytes);
    else if (path != "/" && !path.ends_with(".html") && !path.ends_with(".css"))
      held += file_element(path, bytes);
  }
  Json map = Json::Object{};
  map["imports"] = modules;
  std::string json = provenance.dump(1);
  replace_all(json, "<", "\\u003c");  // the end of an element cannot stand in it

  std::string page(text_of(files, "/index.html"));
  replace_one(page, kCharset, "", [](const std::string&) { return text(kCharset, kPolicy); });
  replace_one(page, kStyle, "\">", [&](const std::string& name) {
    return text("<style>\n", element_text(text_of(files, "/" + name)), "</style>");
  });
  replace_one(page, kScript, "\"></script>\n", [&](const std::string& name) {
    return text("<script type=\"application/json\" id=\"provenance\">\n", json, "\n</script>\n",
                "<script type=\"importmap\">\n", map.dump(1), "\n</script>\n",
                "<script type=\"module\">import '", kModules, name, "';</script>\n");
  });
  replace_one(page, "</html>", "", [&](const std::string&) { return held + "</html>"; });
  if (page.size() > kMostStaticBytes.as<std::size_t>())
    throw Error(ExitCode::usage, "--static",
                text("makes a page of ", page.size() >> 20, " MiB, and browsers open at most ",
                     kMostStaticBytes.most >> 20, "; give fewer records, or a smaller --texture-size"));
  return page;
}

}  // namespace phos::inline view
