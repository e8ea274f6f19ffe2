// Bytes as text: the test vectors of RFC 4648, and any byte there and back.
#include <gtest/gtest.h>

#include "core/text/base64.h"
#include "support/from_base64.h"

namespace phos {
namespace {

TEST(Base64, IsThatOfTheStandard) {
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, coded] : known) EXPECT_EQ(base64(bytes), coded);
}

TEST(Base64, EveryByteComesBack) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  for (std::size_t n = 253; n <= 256; ++n)
    EXPECT_EQ(test::bytes_from_base64(base64(bytes.substr(0, n))), bytes.substr(0, n));
}

}  // namespace
}  // namespace phos
