// The rectangle over every pixel in which a point of a record's zone can be seen.
uniform vec3 eye;
uniform mat3 axes;
uniform vec2 half_size;                   // of the picture: tangents, or m where orthographic
uniform vec2 margin;                      // a pixel, in halves of the picture
uniform bool perspective;

// Slopes of the tangents from the eye to a circle, before the eye (splat/projection.cpp).
vec2 slopes(float across, float along, float radius) {
  float apart = length(vec2(across, along));
  if (apart <= radius) return vec2(-1e9, 1e9);
  float middle = atan(across, along), half_angle = asin(radius / apart);
  float lo = middle - half_angle, hi = middle + half_angle;
  if (lo >= 1.570796 || hi <= -1.570796) return vec2(1e9, -1e9);
  return vec2(lo <= -1.570796 ? -1e9 : tan(lo), hi >= 1.570796 ? 1e9 : tan(hi));
}

// A corner, 0 to 3, of the rectangle about a ball; outside the picture where the ball cannot be seen.
vec4 corner_about(vec3 position, float radius, int corner) {
  vec3 c = axes * (position - eye);
  vec2 x = vec2(c.x - radius, c.x + radius), y = vec2(c.y - radius, c.y + radius);
  if (perspective) x = slopes(c.x, -c.z, radius), y = slopes(c.y, -c.z, radius);
  vec2 lo = vec2(x.x, y.x) / half_size - margin, hi = vec2(x.y, y.y) / half_size + margin;
  bool empty = x.x > x.y || y.x > y.y || (!perspective && -c.z + radius <= 0.0);
  if (empty) return vec4(2.0, 2.0, 0.0, 1.0);
  return vec4(clamp(mix(lo, hi, vec2(corner & 1, corner >> 1)), -1.0, 1.0), 0.5, 1.0);
}
