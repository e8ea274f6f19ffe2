// Illuminance of each pixel by one place of a lamp, where its shadow map lets it through (as
// splat/gl/shaders.cpp: shadow_fragment), and the luminance that it has in gloss. After data.glsl and glint.glsl.
uniform sampler2D position_map;
uniform sampler2D normal_map;
uniform sampler2D reflectance_map;       // its w, with the normal's: the facet's normal
uniform sampler2DArray depth_map;
uniform bool veiled;
uniform sampler2DArray veil_map;         // share of light that comes through the panes before the lamp
uniform sampler2DArray veil_depth_map;   // and the distance of the nearest of them
uniform sampler2D share_map;             // of colour, by degrees of azimuth and from straight down
uniform mat3 luminaire_axes;             // rows are its x, y and up
uniform int face_count;
uniform mat3 axes[6];
uniform vec3 eye;
uniform vec4 lens;
uniform float farthest;
uniform float bias;                      // half a texel: of the distance, or m where directional
uniform int shape;                       // 0 area, 1 point, 2 spot, 3 directional, 4 by map, 5 area by map
uniform vec3 colour;                     // cd; directional: lx
uniform vec3 forward;
uniform vec2 cone;                       // cosines of the outer and the inner half angle
uniform bool two_sided;
uniform float spacing;                   // half of that between the lamp's places: m, or an angle where directional
uniform vec3 viewer;                     // the eye
uniform vec3 backward;                   // of a view without perspective
uniform bool view_perspective;
layout(location = 0) out vec4 illuminance;
layout(location = 1) out vec4 glint;

vec3 from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}

// Is the map's texel, carried on to the plane of the receiver, nearer to the lamp than that plane?
bool shadowed(vec3 v, vec3 n, int face) {
  bool perspective = shape != 3;
  float w = perspective ? -v.z : 1.0;
  if (w <= 0.0) return false;
  ivec2 size = textureSize(depth_map, 0).xy;
  vec2 ndc = (v.xy * lens.xy + lens.zw * w) / w;
  ivec2 texel = clamp(ivec2(floor((ndc * 0.5 + 0.5) * vec2(size))), ivec2(0), size - 1);
  float stored = texelFetch(depth_map, ivec3(texel, face), 0).r;
  vec2 centre = (((vec2(texel) + 0.5) / vec2(size) * 2.0 - 1.0) - lens.zw) / lens.xy;
  if (perspective) {
    float carried = clamp(dot(n, v) / dot(n, vec3(centre, -1.0)), 0.5 * w, 2.0 * w);
    return stored * farthest * (1.0 + bias) < carried;
  }
  float carried = -(dot(n, v) - dot(n.xy, centre)) / n.z;
  carried = clamp(carried, -v.z - 8.0 * bias, -v.z + 8.0 * bias);
  return (2.0 * stored - 1.0) * farthest + bias < carried;
}

// What panes leave of the light.
vec3 through_panes(vec3 v, int face) {
  bool perspective = shape != 3;
  float w = perspective ? -v.z : 1.0;
  ivec2 size = textureSize(veil_map, 0).xy;
  vec2 ndc = (v.xy * lens.xy + lens.zw * w) / w;
  ivec3 texel = ivec3(clamp(ivec2(floor((ndc * 0.5 + 0.5) * vec2(size))), ivec2(0), size - 1), face);
  float pane = texelFetch(veil_depth_map, texel, 0).r;
  bool behind = perspective ? pane * farthest < w : (2.0 * pane - 1.0) * farthest < -v.z;
  return behind ? texelFetch(veil_map, texel, 0).rgb : vec3(1.0);
}

// What a luminaire's map says of a direction away from it.
float share_towards(vec3 direction) {
  vec3 d = luminaire_axes * direction;
  vec2 size = vec2(textureSize(share_map, 0) - 1);
  float turn = atan(d.y, d.x) / 6.283185307;
  vec2 place = vec2(turn - floor(turn), atan(length(d.xy), -d.z) / 3.141592654) * size;
  ivec2 low = ivec2(clamp(floor(place), vec2(0.0), size - 1.0));
  vec2 t = place - vec2(low);
  return mix(mix(texelFetch(share_map, low, 0).r, texelFetch(share_map, low + ivec2(1, 0), 0).r, t.x),
             mix(texelFetch(share_map, low + ivec2(0, 1), 0).r, texelFetch(share_map, low + ivec2(1, 1), 0).r, t.x),
             t.y);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  illuminance = glint = vec4(0.0);
  vec4 p = texelFetch(position_map, pixel, 0);
  if (p.w == 0.0) return;
  vec4 normal = texelFetch(normal_map, pixel, 0);
  vec3 n = normal.xyz, facet = from_octahedral(vec2(normal.w, texelFetch(reflectance_map, pixel, 0).w));
  int face = 0;
  vec3 v = axes[0] * (p.xyz - eye);
  vec3 value = colour;
  vec3 to_light = -forward;
  if (shape != 3) {
    for (int f = 1; f < face_count; ++f) {
      vec3 other = axes[f] * (p.xyz - eye);
      if (other.z < v.z) v = other, face = f;
    }
    float square = dot(v, v);
    if (square == 0.0) return;
    to_light = normalize(eye - p.xyz);
    value /= square;
    float along = -dot(to_light, forward);
    if (shape >= 4) value *= share_towards(-to_light);
    if (shape == 0 || shape == 5) value *= two_sided ? abs(along) : max(along, 0.0);
    if (shape == 2) {
      float rise = max(cone.y - cone.x, 1e-12);
      float falloff = along >= cone.y ? 1.0 : along <= cone.x ? 0.0 : (along - cone.x) / rise;
      value *= falloff * falloff;
    }
  }
  float cosine = dot(n, to_light);
  if (cosine <= 0.0 || dot(facet, to_light) <= 0.0 || value == vec3(0.0)) return;
  if (shadowed(v, axes[face] * facet, face)) return;
  if (veiled) value *= through_panes(v, face);
  illuminance = vec4(value * cosine, 0.0);
  vec3 towards = view_perspective ? normalize(viewer - p.xyz) : backward;
  float spread = shape == 3 ? spacing : spacing / length(v);
  glint = vec4(glint_towards(p.w, n, towards, to_light, spread) * value * cosine, 0.0);
}
