#include "splat/gl/shaders.h"

namespace phos::inline splat::shaders {

const char* const scene_vertex = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 uv01;
layout(location = 2) in float vertex_alpha;
uniform vec3 eye;
uniform mat3 axes[1];       // world to view, scaled to the size of the scene
uniform vec4 lens;          // scale and shift of x and y
uniform vec2 depth;         // clip z = depth.x + depth.y * distance along the view
uniform int perspective;
out vec4 uv;
out float alpha;
void main() {
  // First the difference: exact where it matters, near the eye.
  vec3 v = axes[0] * (position - eye);
  float w = perspective != 0 ? -v.z : 1.0;
  gl_Position = vec4(v.xy * lens.xy + lens.zw * w, depth.x - depth.y * v.z, w);
  uv = uv01;
  alpha = vertex_alpha;
}
)";

const char* const scene_fragment = R"(#version 450 core
uniform uint first_triangle;
layout(location = 0) out uint triangle;
void main() { triangle = first_triangle + uint(gl_PrimitiveID); }
)";

const char* const masked_fragment = R"(#version 450 core
in vec4 uv;
in float alpha;
uniform uint first_triangle;
uniform vec2 mask;          // factor, cutoff
uniform vec4 uv_matrix;     // of KHR_texture_transform: its two columns
uniform vec2 uv_offset;
uniform int uv_set;
uniform int textured;
layout(binding = 0) uniform sampler2D alpha_map;
layout(location = 0) out uint triangle;
void main() {
  vec2 t = uv_set == 0 ? uv.xy : uv.zw;
  t = uv_matrix.xy * t.x + uv_matrix.zw * t.y + uv_offset;
  float there = mask.x * alpha * (textured != 0 ? textureLod(alpha_map, t, 0.0).r : 1.0);
  if (there < mask.y) discard;
  triangle = first_triangle + uint(gl_PrimitiveID);
}
)";

const char* const splat_vertex = R"(#version 450 core
layout(location = 0) in vec4 rect;        // of the picture, in [-1,1]: x0, y0, x1, y1
layout(location = 1) in vec4 position;    // and 1 / radius
layout(location = 2) in vec4 normal;      // and the limit of the in-front test
layout(location = 3) in vec4 irradiance;  // and the record's own weight
layout(location = 4) in vec4 error;       // and the part that records share
layout(location = 5) in vec3 turn_r;
layout(location = 6) in vec3 turn_g;
layout(location = 7) in vec4 turn_b;      // and the limit of what lies over its plane
layout(location = 8) in vec3 translation_r;
layout(location = 9) in vec3 translation_g;
layout(location = 10) in vec3 translation_b;
flat out vec4 a, b, e, s, rb;
flat out vec3 rr, rg, tr, tg, tb;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(rect.xy, rect.zw, corner), 0.5, 1.0);
  a = position, b = normal, e = irradiance, s = error;
  rr = turn_r, rg = turn_g, rb = turn_b;
  tr = translation_r, tg = translation_g, tb = translation_b;
}
)";

const char* const splat_fragment = R"(
flat in vec4 a, b, e, s, rb;
flat in vec3 rr, rg, tr, tg, tb;
uniform vec4 rule;                        // 1 / accuracy, least weight, limit of growth, 1 / unit of squares
layout(binding = 0) uniform sampler2D position_map;
layout(binding = 1) uniform sampler2D normal_map;
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 error;
layout(location = 2) out vec4 spread;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 d = texelFetch(position_map, pixel, 0).xyz - a.xyz;
  vec3 n = texelFetch(normal_map, pixel, 0).xyz;
  vec3 turn = n - b.xyz;
  float left = weight_left(disc_error(d, turn, a.w), rule.x, rule.y);
  float w = weight_if_lit(left, d, n, b.xyz, b.w, rb.w) * e.w;
  vec3 value = vec3(carried_light(e.r, turn, rr, d, tr, rule.z * e.r),
                    carried_light(e.g, turn, rg, d, tg, rule.z * e.g),
                    carried_light(e.b, turn, rb.xyz, d, tb, rule.z * e.b));
  light = vec4(w * value, w);
  error = vec4(w * s.rgb, w > 0.0 ? 1.0 : 0.0);
  float relative = dot(vec3(0.2126, 0.7152, 0.0722) * rule.w, value);
  spread = vec4(w * w, w * s.w, w * relative * relative, 0.0);
}
)";

const char* const footprint_fragment = R"(
struct Axis {
  vec4 slope;                             // and 1 / length
  vec4 half_bend, turn_slope, half_turn_bend;
};
layout(std140, binding = 0) uniform Record {
  vec4 position;                          // and the longest axis over the radius
  vec4 normal;                            // and the limit of the in-front test
  vec4 irradiance;                        // and the record's own weight
  vec4 stderr_lx;                         // and the part that records share
  vec4 axis_x;                            // and 1 / the shortest axis
  vec4 axis_y;                            // and the limit of what lies over its plane
  Axis axes[8];
};
uniform vec4 rule;                        // 1 / accuracy, least weight, nothing, 1 / unit of squares
layout(binding = 0) uniform sampler2D position_map;
layout(binding = 1) uniform sampler2D normal_map;
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 error;
layout(location = 2) out vec4 spread;

void shares_of_axes(float x, float y, out float w[8]) {
  w[0] = share_of_axis(x, y), w[4] = share_of_axis(-x, y);
  w[2] = share_of_axis(y, x), w[6] = share_of_axis(-y, x);
  w[1] = share_of_diagonal(x, y), w[3] = share_of_diagonal(-x, y);
  w[5] = share_of_diagonal(-x, -y), w[7] = share_of_diagonal(x, -y);
}

float total(float w[8]) { return w[0] + w[1] + w[2] + w[3] + w[4] + w[5] + w[6] + w[7]; }

void main() {
  light = vec4(0.0), error = vec4(0.0), spread = vec4(0.0);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 d = texelFetch(position_map, pixel, 0).xyz - position.xyz;
  vec3 n = texelFetch(normal_map, pixel, 0).xyz, turn = n - normal.xyz;
  vec2 p = vec2(dot(d, axis_x.xyz), dot(d, axis_y.xyz));
  float w[8], inwards[8];
  shares_of_axes(p.x, p.y, w);
  float along = total(w), per_along = 1.0 / (along > 0.0 ? along : 1.0);
  for (int k = 0; k < 8; ++k) inwards[k] = w[k] * axes[k].slope.w, w[k] *= per_along;
  float reach = border_reach(p.x, p.y, per_along, total(inwards)), height = dot(d, normal.xyz) * axis_x.w;
  float left = weight_left(footprint_error(reach, height, sqrt(dot(turn, turn)), position.w), rule.x, rule.y);
  float weight = weight_if_lit(left, d, n, normal.xyz, normal.w, axis_y.w) * irradiance.w;
  if (!(weight > 0.0)) return;

  // Beyond the axes the light of the border stands.
  float limit = slope_share(reach, 1.0), curve = bend_share(reach, 1.0);
  vec3 value = irradiance.rgb;
  for (int k = 0; k < 8; ++k)
    value += inwards[k] * limit * axes[k].slope.rgb + w[k] * curve * axes[k].half_bend.rgb;
  if (dot(turn, turn) > 0.0) {
    vec2 t = vec2(dot(n, axis_x.xyz), dot(n, axis_y.xyz));
    shares_of_axes(t.x, t.y, w);
    float sine = sqrt(dot(t, t)), turned_along = total(w);
    float less = slope_share(sine, kMostTurnSine);
    float turned_curve = bend_share(sine, kMostTurnSine) / (turned_along > 0.0 ? turned_along : 1.0);
    for (int k = 0; k < 8; ++k)
      value += w[k] * (less * axes[k].turn_slope.rgb + turned_curve * axes[k].half_turn_bend.rgb);
  }
  value = max(value, vec3(0.0));
  light = vec4(weight * value, weight);
  error = vec4(weight * stderr_lx.rgb, 1.0);
  float relative = dot(vec3(0.2126, 0.7152, 0.0722) * rule.w, value);
  spread = vec4(weight * weight, weight * stderr_lx.w, weight * relative * relative, 0.0);
}
)";

const char* const one_record_vertex = R"(#version 450 core
layout(location = 0) in vec4 rect;        // of the picture, in [-1,1]: x0, y0, x1, y1
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(mix(rect.xy, rect.zw, corner), 0.5, 1.0);
}
)";

const char* const gloss_fragment = R"(
layout(std140, binding = 0) uniform Record {
  vec4 position;                          // and 1 / radius
  vec4 normal;                            // and the limit of the in-front test
  vec4 axis_x;                            // and the steepness
  vec4 axis_y;                            // and the record's own weight
#ifdef FOOTPRINT
  vec4 inverse_straight;                  // 1 / length of the axes along x, y, -x, -y
  vec4 inverse_diagonal;                  // of the axes after each of them
  vec4 shape;                             // 1 / the shortest axis, the longest axis over the radius
#endif
  vec4 numbers[3 * COUNT];                // of each coefficient: light, change along x, along y;
                                          // the first also holds the limit of what lies over its plane
};
uniform vec4 rule;                        // 1 / accuracy, least weight, first and end row of the class
uniform vec4 unit;                        // x: 1 / that of light in squares
layout(binding = 0) uniform sampler2D position_map;
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D lobe_map;    // row, share of the next, cosine and sine of the azimuth
layout(binding = 3) uniform sampler2D table;       // rows of lobes, l (l + 1) / 2 + m; first w: bands
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 error;
layout(location = 2) out vec4 spread;

#ifdef FOOTPRINT
float error_in_footprint(vec3 d, vec3 turn) {
  float x = dot(d, axis_x.xyz), y = dot(d, axis_y.xyz);
  vec4 straight = vec4(share_of_axis(x, y), share_of_axis(y, x), share_of_axis(-x, y), share_of_axis(-y, x));
  vec4 diagonal = vec4(share_of_diagonal(x, y), share_of_diagonal(-x, y), share_of_diagonal(-x, -y),
                       share_of_diagonal(x, -y));
  float along = dot(straight + diagonal, vec4(1.0));
  float inwards = dot(straight, inverse_straight) + dot(diagonal, inverse_diagonal);
  float reach = border_reach(x, y, 1.0 / (along > 0.0 ? along : 1.0), inwards);
  return footprint_error(reach, dot(d, normal.xyz) * shape.x, sqrt(dot(turn, turn)), shape.y);
}
#endif

vec3 coefficient(int i, vec3 shares) {
  return shares.x * numbers[3 * i].rgb + shares.y * numbers[3 * i + 1].rgb + shares.z * numbers[3 * i + 2].rgb;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  light = vec4(0.0), error = vec4(0.0), spread = vec4(0.0);
  vec4 lobe = texelFetch(lobe_map, pixel, 0);
  if (lobe.x < rule.z || lobe.x >= rule.w) return;
  vec3 d = texelFetch(position_map, pixel, 0).xyz - position.xyz;
  vec3 n = texelFetch(normal_map, pixel, 0).xyz;
#ifdef FOOTPRINT
  float left = weight_left(error_in_footprint(d, n - normal.xyz), rule.x, rule.y);
#else
  float left = weight_left(disc_error(d, n - normal.xyz, position.w), rule.x, rule.y);
#endif
  float w = weight_if_lit(left, d, n, normal.xyz, normal.w, numbers[0].w) * axis_y.w;
  if (!(w > 0.0)) return;
  float share = axis_x.w > 0.0 ? w * step_share(d, axis_x.w) : 0.0;
  vec3 shares = vec3(w, share * dot(d, axis_x.xyz), share * dot(d, axis_y.xyz));
  int row = int(lobe.x);
  int order = int(max(texelFetch(table, ivec2(0, row), 0).w, texelFetch(table, ivec2(0, row + 1), 0).w));
  vec2 angle = vec2(1.0, 0.0);            // cosine and sine of m times the azimuth
  vec3 sum = vec3(0.0);
  for (int m = 0; m < order; ++m) {
    for (int l = m; l < order; ++l) {
      int column = l * (l + 1) / 2 + m;
      vec3 t = mix(texelFetch(table, ivec2(column, row), 0).rgb, texelFetch(table, ivec2(column, row + 1), 0).rgb,
                   lobe.y);
      vec3 c = angle.x * coefficient(l * l + l + m, shares);
      if (m > 0) c += angle.y * coefficient(l * l + l - m, shares);
      sum += t * c;
    }
    angle = vec2(angle.x * lobe.z - angle.y * lobe.w, angle.x * lobe.w + angle.y * lobe.z);
  }
  light = vec4(sum, w);
  float value = dot(sum, vec3(0.2126, 0.7152, 0.0722)) * unit.x / w;
  spread.z = w * value * value;
}
)";

const char* const picture_vertex = R"(#version 450 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
)";

const char* const shadow_fragment = R"(#version 450 core
layout(binding = 0) uniform sampler2D position_map;   // w = 0 where nothing is visible
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D facet_map;      // geometric normal on the seen side
layout(binding = 3) uniform sampler2DArray depth_map;
layout(binding = 4) uniform sampler2D share_map;      // of colour, by degrees of azimuth and from straight down
uniform mat3 luminaire_axes;  // rows are its x, y and up
uniform int face_count;
uniform mat3 axes[6];
uniform vec3 eye;
uniform vec4 lens;
uniform vec2 depth;
uniform int perspective;
uniform float bias;          // half a texel: of the distance (perspective), or of the depth range
uniform int kind;            // 0 area, 1 point, 2 spot, 3 directional, 4 by map, 5 area by map
uniform vec3 colour;         // lm/sr over the scale of the scene squared; directional: lx
uniform vec3 forward;        // normal of an area light; axis of a spot or directional light
uniform vec2 cone;           // cosines of the outer and the inner half angle
uniform int two_sided;
uniform int taps;            // texels each way that are asked
layout(location = 0) out vec4 illuminance;

// Is the map's texel, carried on to the plane of the receiver, nearer to the light than that plane?
bool shadowed(vec3 v, vec3 n, int face, ivec2 texel, ivec2 size, float w, float bias) {
  texel = clamp(texel, ivec2(0), size - 1);
  float stored = texelFetch(depth_map, ivec3(texel, face), 0).r;
  vec2 centre = (((vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0) - lens.zw) / lens.xy;
  if (perspective != 0) {
    float here = depth.x / w;
    float carried = depth.x * dot(n, vec3(centre, -1.0)) / dot(n, v);
    carried = clamp(carried, 0.5 * here, 2.0 * here);
    return stored > carried * (1.0 + bias);
  }
  float here = depth.x - depth.y * v.z;
  float z = (dot(n, v) - dot(n.xy, centre)) / n.z;
  float carried = clamp(depth.x - depth.y * z, here - 8.0 * bias, here + 8.0 * bias);
  return stored > carried + bias;
}

// The share of texels about a point that are not nearer to the light (percentage-closer filtering). A texel
// further off the point lies on facets beside it the more.
float lit_share(vec3 v, vec3 n, int face) {
  float w = perspective != 0 ? -v.z : 1.0;
  if (w <= 0.0) return 1.0;
  vec2 ndc = (v.xy * lens.xy + lens.zw * w) / w;
  ivec2 size = textureSize(depth_map, 0).xy;
  if (taps == 1) return shadowed(v, n, face, ivec2(floor((ndc * 0.5 + 0.5) * vec2(size))), size, w, bias) ? 0.0 : 1.0;
  ivec2 first = ivec2(floor((ndc * 0.5 + 0.5) * vec2(size) - 0.5 * float(taps - 1)));
  int lit = 0;
  for (int y = 0; y < taps; ++y)
    for (int x = 0; x < taps; ++x)
      if (!shadowed(v, n, face, first + ivec2(x, y), size, w, bias * float(taps))) ++lit;
  return float(lit) / float(taps * taps);
}

// What a luminaire's map says of a direction away from it.
float share_towards(vec3 direction) {
  vec3 d = luminaire_axes * direction;
  vec2 size = vec2(textureSize(share_map, 0) - 1);
  float turn = atan(d.y, d.x) / 6.283185307;
  vec2 at = vec2(turn - floor(turn), atan(length(d.xy), -d.z) / 3.141592654) * size;
  ivec2 low = ivec2(clamp(floor(at), vec2(0.0), size - 1.0));
  vec2 t = at - vec2(low);
  return mix(mix(texelFetch(share_map, low, 0).r, texelFetch(share_map, low + ivec2(1, 0), 0).r, t.x),
             mix(texelFetch(share_map, low + ivec2(0, 1), 0).r, texelFetch(share_map, low + ivec2(1, 1), 0).r, t.x),
             t.y);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 p = texelFetch(position_map, pixel, 0);
  illuminance = vec4(0.0);
  if (p.w == 0.0) return;
  vec3 n = texelFetch(normal_map, pixel, 0).xyz, facet = texelFetch(facet_map, pixel, 0).xyz;
  int face = 0;
  vec3 v = axes[0] * (p.xyz - eye);
  vec3 value = colour;
  vec3 to_light = -forward;
  if (kind != 3) {
    for (int f = 1; f < face_count; ++f) {
      vec3 other = axes[f] * (p.xyz - eye);
      if (other.z < v.z) v = other, face = f;
    }
    float square = dot(v, v);
    if (square == 0.0) return;
    to_light = normalize(eye - p.xyz);
    value /= square;
    float along = -dot(to_light, forward);
    if (kind >= 4) value *= share_towards(-to_light);
    if (kind == 0 || kind == 5) value *= two_sided != 0 ? abs(along) : max(along, 0.0);
    if (kind == 2) {
      float rise = max(cone.y - cone.x, 1e-12);  // above 0 where the edge is hard
      float falloff = along >= cone.y ? 1.0 : along <= cone.x ? 0.0 : (along - cone.x) / rise;
      value *= falloff * falloff;
    }
  }
  float cosine = dot(n, to_light);
  if (cosine <= 0.0 || dot(facet, to_light) <= 0.0 || value == vec3(0.0)) return;
  float share = lit_share(v, axes[face] * facet, face);
  if (share == 0.0) return;
  illuminance = vec4(value * cosine * share, 0.0);
}
)";

}  // namespace phos::inline splat::shaders
