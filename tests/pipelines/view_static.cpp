// The page without a server, opened from disk: it draws the picture of the served page.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "support/browser.h"
#include "support/run.h"
#include "support/view_program.h"

namespace phos::test {
namespace {

constexpr int kSide = 128;
constexpr double kEdges = 0.005;  // of the pixels

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string address_of(const std::string& file) { return "file://" + file; }

std::string dump_of(std::initializer_list<int> quantities) {
  const std::string side = std::to_string(kSide);
  std::string words = "?width=" + side + "&height=" + side;
  for (const int quantity : quantities) words += "&dump=" + std::to_string(quantity);
  return words;
}

/// Root mean square of the difference over the mean, but for the share of pixels that differ most: at an edge
/// of a shadow or a surface, rounding puts a pixel on one side or on the other.
double difference(const std::vector<float>& a, const std::vector<float>& b, double edges) {
  EXPECT_EQ(a.size(), static_cast<std::size_t>(kSide * kSide));
  EXPECT_EQ(a.size(), b.size());
  if (a.size() != b.size() || a.empty()) return 1e9;
  std::vector<double> square;
  double mean = 0, sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    square.push_back(d * d), mean += static_cast<double>(b[i]) / static_cast<double>(a.size());
  }
  std::sort(square.begin(), square.end());
  square.resize(static_cast<std::size_t>((1 - edges) * static_cast<double>(square.size())));
  for (const double s : square) sum += s;
  EXPECT_GT(mean, 0);
  return std::sqrt(sum / static_cast<double>(square.size())) / mean;
}

/// A scene with a cache, and its page.
struct Place {
  Place(const std::string& name, const std::string& model, const std::vector<std::string>& photons,
        const std::vector<std::string>& records)
      : folder(scratch(name)), scene(model), cache(folder + "/a.irradiance"), page(folder + "/a.html") {
    make({"photons", scene, "-o", folder + "/a.photons"}, photons);
    make({"irradiance", scene, folder + "/a.photons", "-o", cache}, records);
    make({"view", scene, cache, "--static", page}, {});
  }
  ~Place() { std::filesystem::remove_all(folder); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  static void make(std::vector<std::string> command, const std::vector<std::string>& options) {
    command.insert(command.end(), options.begin(), options.end());
    const Run run = run_tool(command);
    EXPECT_EQ(run.code, 0) << run.err;
  }
  Shown open(const std::string& query) const { return open_page(address_of(page) + query); }

  std::string folder, scene, cache, page;
};

class StaticPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (has_chromium())
      box_ = std::make_unique<Place>("static-box", data("cornell-measured.glb"),
                                     std::vector<std::string>{"--photons", "100000"},
                                     std::vector<std::string>{"--place", "surface"});
  }
  static void TearDownTestSuite() { box_.reset(); }
  void SetUp() override {
    if (!has_chromium())
      GTEST_SKIP() << "chromium is not installed; pipelines/install.sh --tests installs it";
  }
  /// Differences of luminance and of indirect illuminance to the served page.
  /// `edges`: are there so few edges of surfaces that pixels on them count too, in light of records alone?
  static void expect_the_served_picture(const Place& place, const char* what, bool edges) {
    const ViewProgram view({place.scene, place.cache});
    ASSERT_NE(view.port(), 0u);
    const double begin = seconds();
    const Shown alone = place.open(dump_of({0, 2}));
    const double took = seconds() - begin;
    EXPECT_EQ(alone.console, "");
    const Shown served = open_page(view.url() + dump_of({0, 2}));
    for (const int number : {0, 1}) {
      const std::vector<float> is = values_of(alone, number), was = values_of(served, number);
      const double all = difference(is, was, 0), most = difference(is, was, kEdges);
      std::printf("[ FIGURES  ] %s, quantity %d: off by %.5f, without edges %.5f; the browser took %.1f s\n",
                  what, 2 * number, all, most, took);
      EXPECT_LT(most, 0.003);
      EXPECT_TRUE(!edges || number == 0 || all < 0.003) << all;
    }
  }

  static std::unique_ptr<Place> box_;
};
std::unique_ptr<Place> StaticPage::box_;

TEST_F(StaticPage, OpensFromDiskWithoutErrors) {
  const Shown shown = box_->open(dump_of({2}));
  EXPECT_EQ(shown.console, "");
  EXPECT_NE(shown.page.find("irradiance records of indirect light"), std::string::npos);
  EXPECT_NE(shown.page.find("standard error, need phos-view itself"), std::string::npos);
  EXPECT_NE(shown.page.find("rounded numbers"), std::string::npos);
  EXPECT_EQ(shown.page.find("cannot be shown"), std::string::npos);
}

TEST_F(StaticPage, DrawsTheServedPicture) { expect_the_served_picture(*box_, "box", true); }

/// Acts on the page once its picture is there.
std::string with_script(const Place& place, const std::string& action) {
  const std::string page = place.folder + "/acted.html";
  spill(page, slurp(place.page) +
                  "<script>const act = () => document.getElementById('dump') ? run() : setTimeout(act, 20);\n"
                  "const run = () => {" +
                  action + "};\nact();</script>");
  return page;
}

TEST_F(StaticPage, ValuesUnderTheCursorAreOfThePicture) {
  constexpr int kX = 40, kY = 100;  // pixels from the top left
  const auto middle_of = [](int pixel) { return std::to_string((pixel + 0.5) / kSide); };
  const std::string page =
      with_script(*box_,
                  "document.querySelector('main').style.minWidth = '400px';"  // #dump is wide
                  "const picture = document.getElementById('picture'), box = picture.getBoundingClientRect();"
                  "picture.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + box.width * " +
                      middle_of(kX) + ", clientY: box.top + box.height * " + middle_of(kY) + "}));");
  const Shown shown = open_page(address_of(page) + dump_of({1}),
                                once("document.getElementById('illuminance').textContent.includes('lx')"));
  const std::vector<float> lux = values_of(shown);
  ASSERT_EQ(lux.size(), static_cast<std::size_t>(kSide * kSide));
  const std::string mark = "id=\"illuminance\">";
  const std::size_t at = shown.page.find(mark);
  ASSERT_NE(at, std::string::npos);
  const std::string said = shown.page.substr(at + mark.size(), 40);
  const double expected = static_cast<double>(lux[kY * kSide + kX]);
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(std::strtod(said.c_str(), nullptr), expected, 0.001 * expected) << said;
  EXPECT_EQ(said.find("±"), std::string::npos) << said;
  EXPECT_NE(said.find(" lx<"), std::string::npos) << said;
}

TEST_F(StaticPage, AsksNobody) {
  const ViewProgram view({box_->scene, box_->cache});
  ASSERT_NE(view.port(), 0u);
  const std::string page =
      with_script(*box_,
                  "document.addEventListener('securitypolicyviolation', (e) => document.body.dataset[e."
                  "effectiveDirective.replace('-', '')] = 'refused');"
                  "fetch('" +
                      view.url() +
                      "').catch(() => {});"
                      "const image = new Image(); image.src = '" +
                      view.url() + "view.css';");
  const Shown shown = open_page(address_of(page) + dump_of({1}),
                                once("document.body.dataset.connectsrc && document.body.dataset.imgsrc"));
  for (const char* refused : {"data-connectsrc=\"refused\"", "data-imgsrc=\"refused\""})
    EXPECT_NE(shown.page.find(refused), std::string::npos) << refused;
}

TEST_F(StaticPage, Sponza) {
  const std::string model = shared("scenes/sponza.glb");
  if (model.empty()) GTEST_SKIP() << "../shared/scenes/sponza.glb is not here";
  const Place place("static-sponza", model, {"--photons", "100000"},
                    {"--place", "photons", "--max-candidates", "4000"});
  std::printf("[ FIGURES  ] Sponza: %.1f MB\n",
              static_cast<double>(std::filesystem::file_size(place.page)) / 1e6);
  expect_the_served_picture(place, "Sponza", false);
}

}  // namespace
}  // namespace phos::test
