// The picture on the screen: tone mapped (as image/tone_map.cpp: reinhard), or in false colours.
uniform vec2 picture_size;
uniform bool false_colour;
uniform bool logarithmic;
uniform vec2 scale_ends;                  // of false colours
uniform float key;                        // becomes a middle grey of 0.18
uniform float white;                      // becomes full white
uniform bool show_holes;
uniform sampler2D palette_map;
layout(location = 0) out vec4 shown;

vec3 srgb(vec3 c) {
  return mix(12.92 * c, 1.055 * pow(max(c, vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 tone_mapped(vec3 c) {
  float y = luminance_of(c);
  if (!(y > 0.0)) return vec3(0.0);
  float x = 0.18 * y / key, most = 0.18 * white / key;
  float grey = min(x * (1.0 + x / (most * most)) / (1.0 + x), 1.0);
  c *= grey / y;
  float greatest = max(c.r, max(c.g, c.b));
  if (greatest > 1.0) c = mix(vec3(grey), c, (1.0 - grey) / (greatest - grey));  // mixed with grey until it fits
  return srgb(clamp(c, 0.0, 1.0));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 c = quantity_at(pixel, picture_size);
  if (false_colour) {
    float v = luminance_of(c), lo = scale_ends.x, hi = scale_ends.y;
    float t = logarithmic ? (v > 0.0 ? log(v / lo) / log(hi / lo) : 0.0) : (v - lo) / (hi - lo);
    c = covered(pixel) ? texture(palette_map, vec2(clamp(t, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb
                       : vec3(0.13);
  } else {
    c = tone_mapped(c);
  }
  if (show_holes && is_hole(pixel) && ((pixel.x + pixel.y) & 7) < 3) c = vec3(1.0, 0.0, 1.0);
  shown = vec4(c, 1.0);
}
