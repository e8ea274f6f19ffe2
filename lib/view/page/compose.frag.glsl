// The light of a group of lamps, times its weight. Alpha: 1 where its records reach.
uniform sampler2D group_map;
uniform float weight;
layout(location = 0) out vec4 light;
void main() {
  vec4 splat = texelFetch(group_map, ivec2(gl_FragCoord.xy), 0);
  light = splat.w > 0.0 ? vec4(weight * splat.rgb / splat.w, 1.0) : vec4(0.0);
}
