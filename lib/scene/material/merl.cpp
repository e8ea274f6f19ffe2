#include "scene/material/merl.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "core/error.h"
#include "core/parallel.h"
#include "file/atomic_file.h"
#include "file/hash.h"
#include "file/lfs_pointer.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kCells = std::size_t{MerlBrdf::kThetaH} * MerlBrdf::kThetaD * MerlBrdf::kPhiD;
constexpr std::size_t kHeaderBytes = 3 * sizeof(std::int32_t);
constexpr std::size_t kFileBytes = kHeaderBytes + 3 * kCells * sizeof(double);
/// Of red, green and blue, as the database's own reader multiplies them.
constexpr double kScale[3] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

constexpr std::size_t cell_of(int h, int d, int p) {
  return (static_cast<std::size_t>(h) * MerlBrdf::kThetaD + static_cast<std::size_t>(d)) * MerlBrdf::kPhiD +
         static_cast<std::size_t>(p);
}

std::array<int, 3> indices_of(std::size_t cell) {
  return {static_cast<int>(cell / (MerlBrdf::kThetaD * MerlBrdf::kPhiD)),
          static_cast<int>(cell / MerlBrdf::kPhiD % MerlBrdf::kThetaD),
          static_cast<int>(cell % MerlBrdf::kPhiD)};
}

/// Are both directions of the middle of a cell above the surface?
bool reachable(std::size_t cell) {
  const auto [h, d, p] = indices_of(cell);
  const double root = (h + 0.5) / MerlBrdf::kThetaH;
  const double theta_h = root * root * M_PI / 2, theta_d = (d + 0.5) / MerlBrdf::kThetaD * M_PI / 2;
  const double phi_d = (p + 0.5) / MerlBrdf::kPhiD * M_PI;
  return std::cos(theta_h) * std::cos(theta_d) >
         std::fabs(std::sin(theta_h) * std::sin(theta_d) * std::cos(phi_d));
}

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw Error(ExitCode::bad_input, path, message);
}

void check_layout(std::string_view bytes, const std::string& path) {
  if (is_lfs_pointer(bytes)) fail(path, text("not a MERL file, but ", kLfsPointer));
  if (bytes.size() < kHeaderBytes) fail(path, "truncated: not a MERL file; copy it again");
  std::int32_t n[3];
  std::memcpy(n, bytes.data(), sizeof n);
  if (n[0] != MerlBrdf::kThetaH || n[1] != MerlBrdf::kThetaD || n[2] != MerlBrdf::kPhiD) {
    fail(path, text("not a MERL file: it says ", n[0], " x ", n[1], " x ", n[2],
                    " samples, which should be 90 x 90 x 180; give a .binary file of the MERL database"));
  }
  if (bytes.size() != kFileBytes) {
    fail(path, text(bytes.size() < kFileBytes ? "truncated: " : "too long: ", bytes.size(), " of ",
                    kFileBytes, " bytes are there; copy the MERL file again"));
  }
}

/// The two cells around x (a place in cells, whose middles are at 0.5, 1.5, ...) and the share of the second.
struct Between {
  int low, high;
  float share;
};

Between between_clamped(float x, int n) {
  const float at = std::clamp(x - 0.5f, 0.f, static_cast<float>(n - 1));
  const int low = std::min(static_cast<int>(at), n - 2);
  return {low, low + 1, at - static_cast<float>(low)};
}

Between between_periodic(float x, int n) {
  const float at = std::clamp(x, 0.f, static_cast<float>(n)) + 0.5f;  // 1 cell up: stays positive
  const int low = static_cast<int>(at);
  return {(low + n - 1) % n, low % n, at - static_cast<float>(low)};
}

}  // namespace

MerlBrdf::MerlBrdf(std::string_view bytes, const std::string& path) {
  check_layout(bytes, path);
  contents_ = hash_text(bytes).hex();
  value_.resize(kCells);
  std::vector<bool> empty(kCells, false);
  for (int c = 0; c < 3; ++c) {
    const char* channel = bytes.data() + kHeaderBytes + static_cast<std::size_t>(c) * kCells * sizeof(double);
    for (std::size_t i = 0; i < kCells; ++i) {
      double v;
      std::memcpy(&v, channel + i * sizeof v, sizeof v);
      const auto scaled = static_cast<float>(v * kScale[c]);
      if (!std::isfinite(scaled)) {
        fail(path,
             text("sample ", i, " of channel ", c, " is not a finite number; copy the MERL file again"));
      }
      if (v < 0) empty[i] = true;
      value_[i][c] = scaled;
    }
  }
  fill_empty(empty);
  if (empty_cells_ == kCells) fail(path, "every sample is negative: the file holds no data");
  digest();
}

MerlBrdf MerlBrdf::recoloured(const std::function<Rgb(const Rgb&)>& colour) const {
  MerlBrdf out(*this);
  parallel_for(kCells, 4096, [&](std::size_t i) { out.value_[i] = colour(kPi * value_[i]) / kPi; });
  out.digest();
  return out;
}

/// What is known of the values as a whole.
void MerlBrdf::digest() {
  find_lambert();
  fit_lobe();
  tabulate_albedo();
}

/// Breadth first from all cells that have data: the nearest in steps of the table, the first in its order
/// among equals. Cells of the same theta_h, which shapes the lobe, come first.
void MerlBrdf::fill_empty(const std::vector<bool>& empty) {
  for (std::size_t i = 0; i < kCells; ++i) {
    if (!empty[i]) continue;
    ++empty_cells_;
    empty_reachable_cells_ += reachable(i);
  }
  if (empty_cells_ == 0 || empty_cells_ == kCells) return;
  std::vector<bool> open = empty;
  std::vector<std::uint32_t> reached;
  reached.reserve(kCells);
  for (const bool across : {false, true}) {
    reached.clear();
    for (std::size_t i = 0; i < kCells; ++i) {
      if (!open[i]) reached.push_back(static_cast<std::uint32_t>(i));
    }
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const std::size_t from = reached[k];
      const auto [h, d, p] = indices_of(from);
      const auto visit = [&](int nh, int nd, int np) {
        if (nh < 0 || nh >= kThetaH || nd < 0 || nd >= kThetaD) return;
        const std::size_t to = cell_of(nh, nd, (np + kPhiD) % kPhiD);
        if (!open[to]) return;
        open[to] = false;
        value_[to] = value_[from];
        reached.push_back(static_cast<std::uint32_t>(to));
      };
      visit(h, d - 1, p), visit(h, d + 1, p);
      visit(h, d, p - 1), visit(h, d, p + 1);
      if (across) visit(h - 1, d, p), visit(h + 1, d, p);
    }
    if (reached.size() == kCells) return;
  }
}

Rgb MerlBrdf::evaluate(const Vec3& o, const Vec3& i) const {
  const Vec3 sum = o + i;
  const float across = std::sqrt(sum.x * sum.x + sum.y * sum.y), length = glm::length(sum);
  const float cos_h = sum.z / length, sin_h = across / length;
  const Vec2 towards = across > 0 ? Vec2(sum.x, sum.y) / across : Vec2(1, 0);
  // i in the frame whose z is h and whose x leans away from the normal.
  const float along = towards.x * i.x + towards.y * i.y;
  const float x = cos_h * along - sin_h * i.z, y = towards.x * i.y - towards.y * i.x;
  const float theta_h = std::atan2(across, sum.z);
  const float theta_d = std::atan2(std::sqrt(x * x + y * y), sin_h * along + cos_h * i.z);
  float phi_d = std::atan2(y, x);
  if (phi_d < 0) phi_d += kPi;
  const Between bh = between_clamped(std::sqrt(theta_h / (0.5f * kPi)) * kThetaH, kThetaH);
  const Between bd = between_clamped(theta_d / (0.5f * kPi) * kThetaD, kThetaD);
  const Between bp = between_periodic(phi_d / kPi * kPhiD, kPhiD);
  const auto along_phi = [&](int a, int b) {
    return (1 - bp.share) * value_[cell_of(a, b, bp.low)] + bp.share * value_[cell_of(a, b, bp.high)];
  };
  const auto along_d = [&](int a) {
    return (1 - bd.share) * along_phi(a, bd.low) + bd.share * along_phi(a, bd.high);
  };
  return (1 - bh.share) * along_d(bh.low) + bh.share * along_d(bh.high);
}

MerlBrdf read_merl(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    fail(path, "is not a file; give a .binary file of the MERL database");
  }
  // No need to read a file that cannot be one.
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > 2 * kFileBytes) {
    fail(path, text("too long: ", size, " bytes, a MERL file has ", kFileBytes));
  }
  return MerlBrdf(read_text(path), path);
}

}  // namespace phos::inline scene
