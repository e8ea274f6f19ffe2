// The page of phos-view in a browser without a screen: it says no error, and draws the light that phos-splat
// draws.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <future>

#include "image/image.h"
#include "support/run.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

constexpr int kSide = 128;

bool has_chromium() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

struct Shown {
  std::string page;     ///< its text at the end
  std::string console;  ///< what it said
};

/// Opens an address in a Chromium of its own.
Shown open_page(const std::string& url, const std::string& folder) {
  const std::string command =
      "timeout 180 chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader "
      "--disable-dev-shm-usage --enable-logging=stderr --virtual-time-budget=60000 --user-data-dir='" +
      folder + "/profile' --dump-dom '" + url + "' >'" + folder + "/page' 2>'" + folder + "/log'";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(std::system(command.c_str()), 0) << slurp(folder + "/log");
  Shown shown{slurp(folder + "/page"), ""};
  std::istringstream log(slurp(folder + "/log"));
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos) shown.console += line + "\n";
  return shown;
}

std::vector<float> from_base64(const std::string& text) {
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

/// The values of a quantity that the page says.
std::vector<float> values_of(const Shown& shown) {
  const std::string begin = "<pre id=\"dump\">";
  const std::size_t at = shown.page.find(begin);
  return at == std::string::npos ? std::vector<float>() : from_base64(shown.page.substr(at + begin.size()));
}

class Browser : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!has_chromium()) return;
    folder_ = scratch("view-browser");
    const std::string scene = data("cornell-measured.glb");
    EXPECT_EQ(run_tool({"photons", scene, "--photons", "100000", "-o", folder_ + "/box.photons"}).code, 0);
    EXPECT_EQ(run_tool({"irradiance", scene, folder_ + "/box.photons", "--place", "surface", "-o",
                        folder_ + "/box.irradiance"})
                  .code,
              0);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }
  void SetUp() override {
    if (!has_chromium())
      GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
    view_ = std::make_unique<ViewProgram>(
        std::vector<std::string>{data("cornell-measured.glb"), folder_ + "/box.irradiance"});
    ASSERT_NE(view_->port(), 0u);
  }
  Shown open(const std::string& query, const std::string& name = "one") const {
    return open_page(view_->url() + query, folder_ + "/" + name);
  }
  Shown dump(int quantity, const std::string& name = "one") const {
    const std::string side = std::to_string(kSide);
    return open("?width=" + side + "&height=" + side + "&dump=" + std::to_string(quantity), name);
  }
  /// Lux of phos-splat.
  static std::vector<float> splat(std::vector<std::string> options) {
    std::vector<std::string> all = {"splat",
                                    data("cornell-measured.glb"),
                                    folder_ + "/box.irradiance",
                                    "--width",
                                    std::to_string(kSide),
                                    "--height",
                                    std::to_string(kSide),
                                    "--pixel-samples",
                                    "1",
                                    "-o",
                                    folder_ + "/splat.exr"};
    all.insert(all.end(), options.begin(), options.end());
    const test::Run run = run_tool(all);
    EXPECT_EQ(run.code, 0) << run.err;
    const Image image = read_image(folder_ + "/splat.exr");
    const auto lux = image.channel("illuminance.Y");
    return {lux.begin(), lux.end()};
  }
  /// Root mean square of the difference over the mean, but for the share of pixels that differ most: at edges
  /// a pixel's middle falls on one surface or on another.
  static double difference(const std::vector<float>& a, const std::vector<float>& b, double edges) {
    EXPECT_EQ(a.size(), b.size());
    if (a.size() != b.size()) return 1e9;
    std::vector<double> square;
    double mean = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      square.push_back(d * d), mean += static_cast<double>(b[i]);
    }
    std::sort(square.begin(), square.end());
    const auto kept = static_cast<std::size_t>((1 - edges) * static_cast<double>(square.size()));
    double sum = 0;
    for (std::size_t i = 0; i < kept; ++i) sum += square[i];
    EXPECT_GT(mean, 0);
    return std::sqrt(sum / static_cast<double>(kept)) / (mean / static_cast<double>(a.size()));
  }

  static std::string folder_;
  std::unique_ptr<ViewProgram> view_;
};
std::string Browser::folder_;

TEST_F(Browser, LoadsWithoutErrors) {
  const Shown shown = open("");
  EXPECT_EQ(shown.console, "");
  EXPECT_NE(shown.page.find("irradiance records of indirect light"), std::string::npos);
  EXPECT_EQ(shown.page.find("cannot be shown"), std::string::npos);
}

TEST_F(Browser, DrawsTheRecordsAsSplatDoes) {
  const double off = difference(values_of(dump(2)), splat({"--direct", "none"}), 0.005);
  std::printf("[ FIGURES  ] indirect: %.5f\n", off);
  EXPECT_LT(off, 0.01);
}

TEST_F(Browser, DrawsDirectLightAsShadowMapsDo) {
  const std::vector<float> all = splat({"--direct", "shadow-map", "--light-samples", "16"});
  const double off = difference(values_of(dump(1)), all, 0.01);
  std::printf("[ FIGURES  ] all light: %.5f\n", off);
  EXPECT_LT(off, 0.02);
}

TEST_F(Browser, TwoAtOnce) {
  auto other = std::async(std::launch::async, [&] { return values_of(dump(1, "two")); });
  const std::vector<float> values = values_of(dump(1));
  EXPECT_EQ(values.size(), static_cast<std::size_t>(kSide * kSide));
  EXPECT_EQ(values, other.get());
}

}  // namespace
}  // namespace phos::test
