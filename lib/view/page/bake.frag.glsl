// Luminance of each pixel, and its distance from the eye, for reflections.
uniform vec2 picture_size;
layout(location = 0) out vec4 baked;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 p = texelFetch(position_map, pixel, 0);
  baked = vec4(quantity_at(pixel, picture_size), p.w > 0.0 ? length(p.xyz - eye) : 1e6);
}
