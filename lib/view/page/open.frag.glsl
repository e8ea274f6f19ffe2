// Points that no record reaches, at evenly spaced pixels.
uniform vec2 picture_size, looked_size;
uniform vec2 shift;                       // of the pixels, in [0, 1) of their distances
uniform sampler2D position_map;
uniform sampler2D normal_map;
uniform sampler2D reach_map;              // w: the sum of weights
layout(location = 0) out vec4 position;   // w: 1 where no record reaches
layout(location = 1) out vec4 normal;
void main() {
  ivec2 pixel = ivec2((gl_FragCoord.xy - 0.5 + shift) / looked_size * picture_size);
  vec4 p = texelFetch(position_map, pixel, 0);
  bool open = p.w > 0.0 && !(texelFetch(reach_map, pixel, 0).w > 0.0);
  position = vec4(p.xyz, open ? 1.0 : 0.0);
  normal = vec4(texelFetch(normal_map, pixel, 0).xyz, 0.0);
}
