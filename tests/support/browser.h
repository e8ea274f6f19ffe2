// Pages in a browser without a screen.
#pragma once

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "support/chromium.h"

namespace phos::test {

inline bool has_chromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

/// A promise, in a page, that is kept once a condition holds. It is looked at whenever the document changes.
inline std::string once(const std::string& condition) {
  return "new Promise((done) => { const look = () => { if (" + condition +
         ") watch.disconnect(), done(); }; const watch = new MutationObserver(look);"
         " watch.observe(document, {subtree: true, childList: true, characterData: true, attributes: true});"
         " look(); })";
}

/// Kept once values, or times, are there, or the page says why not.
inline std::string answered() {
  return once(
      "document.querySelector('#dump, #bench') || "
      "document.getElementById('state').textContent.includes('cannot be shown')");
}

/// Opens an address in the Chromium of this test program.
inline Shown open_page(const std::string& url, const std::string& promise = answered()) {
  static Chromium browser;
  return browser.open(url, promise);
}

inline std::vector<float> from_base64(const std::string& text) {
  std::string bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) break;
    value = value << 6 | static_cast<unsigned>(digit);
    if ((bits += 6) >= 8) bits -= 8, bytes += static_cast<char>(value >> bits & 255);
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

/// What the page says in an element: "dump"; "" where there is none.
inline std::string words_of(const Shown& shown, const std::string& id) {
  const std::string begin = "<pre id=\"" + id + "\">";
  const std::size_t at = shown.page.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t from = at + begin.size();
  return shown.page.substr(from, shown.page.find('<', from) - from);
}

/// The values of a quantity that the page says: of the first, or of another "dump" of its address.
inline std::vector<float> values_of(const Shown& shown, int number = 0) {
  return from_base64(words_of(shown, number ? "dump-" + std::to_string(number) : "dump"));
}

}  // namespace phos::test
