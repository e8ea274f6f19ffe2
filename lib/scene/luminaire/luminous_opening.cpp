#include "scene/luminaire/luminous_opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/error.h"

namespace phos::inline scene {
namespace {

constexpr int kSides = 48;  // of a round opening
/// How far a flat opening stands before its centre, in its larger size.
constexpr float kStandOff = 1e-4f;

using Form = LuminousOpening::Form;

int axis_of(Form form) { return form == Form::cylinder_x ? 0 : form == Form::cylinder_y ? 1 : 2; }

/// One that has area, else a point.
LuminousOpening solid(Form form, const DVec3& size_m) {
  int flat = 0;
  for (int c = 0; c < 3; ++c) {
    if (static_cast<float>(size_m[c]) > 0) continue;
    ++flat;
    if (form == Form::ellipsoid || (form != Form::box && c != axis_of(form))) return {};
  }
  return flat > 1 ? LuminousOpening{} : LuminousOpening{form, Vec3(size_m)};
}

void add_polygon(MeshData& mesh, const std::vector<Vec3>& corner) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  mesh.position.insert(mesh.position.end(), corner.begin(), corner.end());
  const DVec3 across = glm::cross(DVec3(corner[1]) - DVec3(corner[0]), DVec3(corner[2]) - DVec3(corner[0]));
  mesh.normal.insert(mesh.normal.end(), corner.size(),
                     normalized_or_zero(Vec3(across / glm::length(across))));
  for (std::uint32_t k = 2; k < corner.size(); ++k)
    mesh.triangle.push_back({{first, first + k - 1, first + k}});
}

/// Counter-clockwise about `axis` (0: from y to z, and so on round), at a height along it, of half sizes h.
std::vector<Vec3> outline(Form form, int axis, const Vec3& h, float height) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::vector<Vec3> out;
  const auto add = [&](double x, double y) {
    Vec3 p(0);
    p[a] = static_cast<float>(x * static_cast<double>(h[a])),
    p[b] = static_cast<float>(y * static_cast<double>(h[b]));
    p[axis] = height;
    out.push_back(p);
  };
  if (form == Form::box) {
    for (const auto& [x, y] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) add(x, y);
    return out;
  }
  // A polygon with the ellipse's area.
  const double step = 2 * std::numbers::pi / kSides, grow = std::sqrt(step / std::sin(step));
  for (int k = 0; k < kSides; ++k) add(grow * std::cos((k + 0.5) * step), grow * std::sin((k + 0.5) * step));
  return out;
}

MeshData flat_mesh(Form form, int axis, const Vec3& h, const Photometry& photometry, bool& both_sides) {
  Vec3 front(0);
  front[axis] = axis == 2 ? -1.f : 1.f;
  const bool forwards = photometry.shines_towards(front), backwards = photometry.shines_towards(-front);
  both_sides = forwards && backwards;
  if (!forwards && backwards) front = -front;
  const float stand_off = both_sides ? 0.f : front[axis] * kStandOff * 2 * max_component(h);
  std::vector<Vec3> corner = outline(form, axis, h, stand_off);
  if (front[axis] < 0) std::reverse(corner.begin(), corner.end());
  MeshData mesh;
  add_polygon(mesh, corner);
  return mesh;
}

/// A box, or a cylinder along an axis.
MeshData prism(Form form, int axis, const Vec3& h) {
  const std::vector<Vec3> above = outline(form, axis, h, h[axis]);
  std::vector<Vec3> below = outline(form, axis, h, -h[axis]);
  MeshData mesh;
  add_polygon(mesh, above);
  for (std::size_t k = 0; k < above.size(); ++k) {
    const std::size_t next = (k + 1) % above.size();
    add_polygon(mesh, {below[k], below[next], above[next], above[k]});
  }
  std::reverse(below.begin(), below.end());
  add_polygon(mesh, below);
  return mesh;
}

/// An icosahedron with each face divided into 16, on the sphere, as large as the sphere; then stretched.
MeshData ellipsoid(const Vec3& h) {
  const double g = std::numbers::phi;
  const std::vector<DVec3> corner{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<DVec3, 3>> face;
  const double edge2 = 4;
  for (std::size_t a = 0; a < 12; ++a)
    for (std::size_t b = a + 1; b < 12; ++b)
      for (std::size_t c = b + 1; c < 12; ++c) {
        const auto next_to = [&](std::size_t i, std::size_t j) {
          const DVec3 way = corner[i] - corner[j];
          return std::fabs(glm::dot(way, way) - edge2) < 1e-6;
        };
        if (!next_to(a, b) || !next_to(b, c) || !next_to(a, c)) continue;
        const bool outwards =
            glm::dot(glm::cross(corner[b] - corner[a], corner[c] - corner[a]), corner[a]) > 0;
        face.push_back({corner[a], corner[outwards ? b : c], corner[outwards ? c : b]});
      }
  for (int level = 0; level < 2; ++level) {
    std::vector<std::array<DVec3, 3>> finer;
    for (auto& [a, b, c] : face) {
      const DVec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      const DVec3 p = glm::normalize(a), q = glm::normalize(b), r = glm::normalize(c);
      finer.insert(finer.end(), {{p, ab, ca}, {ab, q, bc}, {ca, bc, r}, {ab, bc, ca}});
    }
    face = std::move(finer);
  }
  double area = 0;
  for (const auto& [a, b, c] : face) area += 0.5 * glm::length(glm::cross(b - a, c - a));
  const double grow = std::sqrt(4 * std::numbers::pi / area);
  MeshData mesh;
  for (const auto& f : face) {
    std::vector<Vec3> corners;
    for (const DVec3& p : f) corners.push_back(Vec3(grow * p * DVec3(h)));
    add_polygon(mesh, corners);
  }
  return mesh;
}

}  // namespace

std::string LuminousOpening::describe() const {
  const auto m = [](float v) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.4g", static_cast<double>(v));
    return std::string(digits);
  };
  const Vec3& s = size_m;
  if (form == Form::point) return "point";
  if (form == Form::ellipsoid) {
    if (s.x == s.y && s.y == s.z) return text("sphere ", m(s.x), " m across");
    return text("ellipsoid ", m(s.x), " x ", m(s.y), " x ", m(s.z), " m");
  }
  const int flat = !(s.x > 0) ? 0 : !(s.y > 0) ? 1 : !(s.z > 0) ? 2 : -1;
  if (form == Form::box && flat < 0) return text("box ", m(s.x), " x ", m(s.y), " x ", m(s.z), " m");
  const int axis = form == Form::box ? flat : axis_of(form);
  const float a = s[(axis + 1) % 3], b = s[(axis + 2) % 3];
  const char* upright = axis == 2 ? "" : axis == 0 ? ", upright, facing C0" : ", upright, facing C90";
  if (form == Form::box) return text("rectangle ", m(a), " x ", m(b), " m", upright);
  if (flat >= 0)
    return a == b ? text("disc ", m(a), " m across", upright)
                  : text("ellipse ", m(a), " x ", m(b), " m", upright);
  const std::string across = a == b ? text(m(a), " m across") : text(m(a), " x ", m(b), " m across");
  return text("cylinder ", across, ", ", m(s[axis]), " m ",
              axis == 2   ? "high"
              : axis == 0 ? "along C0"
                          : "along C90");
}

LuminousOpening lm63_opening(const DVec3& width_length_height_m, bool from_2002) {
  const double w = width_length_height_m.x, l = width_length_height_m.y, h = width_length_height_m.z;
  const DVec3 size(std::fabs(l), std::fabs(w), std::fabs(h));
  if (w >= 0 && l >= 0 && h >= 0) return solid(Form::box, size);
  if (h >= 0) {
    // A round outline. Before 2002 a circle had no length, since then it has its diameter twice.
    const double x = l == 0 ? size.y : size.x, y = w == 0 ? size.x : size.y;
    return solid(Form::cylinder_z, {x, y, size.z});
  }
  if (w < 0 && l < 0) return solid(Form::ellipsoid, size);
  if (w < 0 && l == 0)
    return from_2002 ? solid(Form::cylinder_x, {0, size.y, size.z})
                     : solid(Form::ellipsoid, {size.y, size.y, size.z});
  if (w == 0 && l > 0) return solid(Form::cylinder_x, {size.x, size.z, size.z});
  if (w > 0 && l == 0) return solid(Form::cylinder_y, {size.z, size.y, size.z});
  if (w < 0 && l > 0) return solid(from_2002 ? Form::cylinder_x : Form::ellipsoid, size);
  if (w > 0 && l < 0) return solid(from_2002 ? Form::cylinder_y : Form::ellipsoid, size);
  return {};  // no table has it
}

LuminousOpening eulumdat_opening(double length_m, double width_m, double height_m) {
  if (width_m > 0) return solid(Form::box, {width_m, length_m, height_m});
  return solid(Form::cylinder_z, {length_m, length_m, height_m});
}

MeshData opening_mesh(const LuminousOpening& opening, const Photometry& photometry, bool& both_sides) {
  PHOS_CHECK(opening.form != Form::point, "a point has no surface");
  both_sides = false;
  const Vec3 h = 0.5f * opening.size_m;
  if (opening.form == Form::ellipsoid) return ellipsoid(h);
  const int axis = axis_of(opening.form);
  for (int c = 0; c < 3; ++c) {
    if (!(h[c] > 0)) return flat_mesh(opening.form, c, h, photometry, both_sides);
  }
  return prism(opening.form, axis, h);
}

}  // namespace phos::inline scene
