// Lines where illuminance passes a multiple of a step: a white pixel before the step, a black one after it.
uniform vec2 picture_size;
uniform float isolux_step;
layout(location = 0) out vec4 shown;

float level_at(ivec2 pixel) { return floor(luminance_of(quantity_at(pixel, picture_size)) / isolux_step); }

// Lines end at edges: light is another beyond.
bool is_same_surface(ivec2 a, ivec2 b) {
  vec4 p = texelFetch(position_map, a, 0), q = texelFetch(position_map, b, 0);
  vec3 n = texelFetch(normal_map, a, 0).xyz, m = texelFetch(normal_map, b, 0).xyz, way = q.xyz - p.xyz;
  return p.w > 0.0 && q.w > 0.0 && !is_hole(a) && !is_hole(b) && dot(n, m) > 0.9 && abs(dot(n, way)) <= 0.2 * length(way);
}

bool passes(ivec2 pixel, ivec2 step) {
  ivec2 other = pixel + step;
  if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, ivec2(picture_size)))) return false;
  return level_at(pixel) != level_at(other) && is_same_surface(pixel, other);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (passes(pixel, ivec2(1, 0)) || passes(pixel, ivec2(0, 1))) shown = vec4(1.0);
  else if (passes(pixel, ivec2(-1, 0)) || passes(pixel, ivec2(0, -1))) shown = vec4(0.0, 0.0, 0.0, 1.0);
  else discard;
}
