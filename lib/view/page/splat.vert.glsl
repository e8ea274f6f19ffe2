// One rectangle per record, over every pixel in which a point of its zone can be seen.
layout(location = 0) in vec3 position;
layout(location = 1) in float inverse_radius;
layout(location = 2) in vec3 normal;
layout(location = 3) in float front_limit;
layout(location = 4) in vec3 irradiance;
layout(location = 5) in float own_weight;
layout(location = 6) in float over_limit;
layout(location = 7) in vec3 turn_r;
layout(location = 8) in vec3 turn_g;
layout(location = 9) in vec3 turn_b;
layout(location = 10) in vec3 translation_r;
layout(location = 11) in vec3 translation_g;
layout(location = 12) in vec3 translation_b;
uniform vec3 eye;
uniform mat3 axes;
uniform vec2 half_size;                   // of the picture: tangents, or m where orthographic
uniform vec2 margin;                      // a pixel, in halves of the picture
uniform float accuracy;
uniform bool perspective;
flat out vec4 a, b, e;
flat out float over;
flat out vec3 rr, rg, rb, tr, tg, tb;

// Slopes of the tangents from the eye to a circle, before the eye (splat/projection.cpp).
vec2 slopes(float across, float along, float radius) {
  float apart = length(vec2(across, along));
  if (apart <= radius) return vec2(-1e9, 1e9);
  float middle = atan(across, along), half_angle = asin(radius / apart);
  float lo = middle - half_angle, hi = middle + half_angle;
  if (lo >= 1.570796 || hi <= -1.570796) return vec2(1e9, -1e9);
  return vec2(lo <= -1.570796 ? -1e9 : tan(lo), hi >= 1.570796 ? 1e9 : tan(hi));
}

void main() {
  vec3 c = axes * (position - eye);
  float radius = accuracy / inverse_radius * 1.0001;
  vec2 x = vec2(c.x - radius, c.x + radius), y = vec2(c.y - radius, c.y + radius);
  if (perspective) x = slopes(c.x, -c.z, radius), y = slopes(c.y, -c.z, radius);
  vec2 lo = vec2(x.x, y.x) / half_size - margin, hi = vec2(x.y, y.y) / half_size + margin;
  vec2 corner = mix(lo, hi, vec2(gl_VertexID & 1, gl_VertexID >> 1));
  bool empty = x.x > x.y || y.x > y.y || (!perspective && -c.z + radius <= 0.0);
  gl_Position = empty ? vec4(2.0, 2.0, 0.0, 1.0) : vec4(clamp(corner, -1.0, 1.0), 0.5, 1.0);
  a = vec4(position, inverse_radius), b = vec4(normal, front_limit), e = vec4(irradiance, own_weight);
  over = over_limit;
  rr = turn_r, rg = turn_g, rb = turn_b;
  tr = translation_r, tg = translation_g, tb = translation_b;
}
