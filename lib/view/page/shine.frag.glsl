// Light that a mirror or a pane reflects towards the eye, after specular.glsl: of a mirrored view of the scene, or of a
// cube map about it. The cube map holds distances too, with which the reflected ray is followed to the surface that it meets
// (Szirmay-Kalos et al. 2005, approximate ray-tracing with distance impostors).
in vec3 at, facing;
in float depth;
uniform vec3 eye;
uniform mat3 axes;
uniform bool perspective;
uniform vec3 reflects[33];
uniform bool by_cube;
uniform sampler2D mirrored_map;
uniform samplerCube cube_map;             // w: distance from its middle, m
uniform vec3 cube_middle;
layout(location = 0) out vec4 shine;

// Is a place behind the surface that the cube map shows there?
bool behind(vec3 d) { return length(d) >= textureLod(cube_map, d, 0.0).w; }

vec3 from_cube(vec3 way) {
  vec3 start = at - cube_middle;
  float near = 0.0, far = max(0.25 * length(start), 0.02 * min(textureLod(cube_map, way, 0.0).w, 10.0));
  int steps = 0;
  while (steps < 24 && !behind(start + far * way)) near = far, far *= 1.3, ++steps;
  if (steps == 24) return textureLod(cube_map, way, 0.0).rgb;  // far away, where the place does not matter
  for (int i = 0; i < 8; ++i) {
    float middle = 0.5 * (near + far);
    if (behind(start + middle * way)) far = middle; else near = middle;
  }
  return textureLod(cube_map, start + far * way, 0.0).rgb;
}

void main() {
  vec3 towards = perspective ? normalize(eye - at) : vec3(axes[0].z, axes[1].z, axes[2].z);
  vec3 n = normalize(facing);
  if (dot(n, towards) < 0.0) n = -n;
  vec3 seen = by_cube ? from_cube(2.0 * dot(n, towards) * n - towards)
                      : texelFetch(mirrored_map, ivec2(gl_FragCoord.xy), 0).rgb;
  shine = vec4(share_at(reflects, dot(n, towards)) * seen, 0.0);
  gl_FragDepth = depth * 0.99999;         // nearer than the same surface in the G-buffer
}
