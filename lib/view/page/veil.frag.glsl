// The share of light that a pane passes straight through, after specular.glsl. Blending multiplies the panes.
in vec3 at, facing;
in float depth;
uniform vec3 eye;
uniform mat3 axes;
uniform bool perspective;
uniform vec3 passes[33];
layout(location = 0) out vec4 passed;
void main() {
  vec3 towards = perspective ? normalize(eye - at) : vec3(axes[0].z, axes[1].z, axes[2].z);
  passed = vec4(share_at(passes, abs(dot(normalize(facing), towards))), 1.0);
  gl_FragDepth = depth;
}
