// The quantity itself, at evenly spaced pixels.
uniform vec2 picture_size, measured_size;
layout(location = 0) out vec4 value;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy / measured_size * picture_size);
  vec3 c = quantity_at(pixel, picture_size);
  value = vec4(luminance_of(c), covered(pixel) ? 1.0 : 0.0, is_hole(pixel) ? 1.0 : 0.0, 0.0);
}
