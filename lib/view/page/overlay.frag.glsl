in float along;
uniform vec3 eye;
uniform vec3 backward;
uniform vec4 ink;
uniform sampler2D position_map;
layout(location = 0) out vec4 shown;
void main() {
  vec4 p = texelFetch(position_map, ivec2(gl_FragCoord.xy), 0);
  // Behind what is seen there, but for half a percent, which evens out rounding.
  if (p.w > 0.0 && along > -dot(p.xyz - eye, backward) * 1.005) discard;
  shown = ink;
}
