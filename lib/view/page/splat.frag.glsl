// Weight and light of a record at a pixel, after weight.glsl (as splat/gl/shaders.cpp: splat_fragment).
flat in vec4 a, b, e;
flat in float over;
flat in vec3 rr, rg, rb, tr, tg, tb;
uniform float inverse_accuracy;
uniform sampler2D position_map;
uniform sampler2D normal_map;
layout(location = 0) out vec4 light;      // and the weight
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 d = texelFetch(position_map, pixel, 0).xyz - a.xyz;
  vec3 n = texelFetch(normal_map, pixel, 0).xyz;
  vec3 turn = n - b.xyz;
  float left = weight_left(disc_error(d, turn, a.w), inverse_accuracy, kLeastWeight);
  float w = weight_if_lit(left, d, n, b.xyz, b.w, over) * e.w;
  vec3 value = vec3(carried_light(e.r, turn, rr, d, tr, kGrowthLimit * e.r),
                    carried_light(e.g, turn, rg, d, tg, kGrowthLimit * e.g),
                    carried_light(e.b, turn, rb, d, tb, kGrowthLimit * e.b));
  light = vec4(w * value, w);
}
