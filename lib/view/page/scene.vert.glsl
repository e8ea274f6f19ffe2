// Triangles of the scene, through a camera or from a lamp.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 colour;
uniform vec3 eye;
uniform mat3 axes;         // world to view: right, up, backward
uniform vec4 lens;         // scale and shift of x and y
uniform vec2 range;        // nearest and farthest distance along the view, m
uniform bool perspective;
out vec3 at, facing;
out vec4 texture_place, tint;
out float depth;           // 0 to 1, even along the view
void main() {
  vec3 v = axes * (position - eye);  // first the difference: exact near the eye
  float w = perspective ? -v.z : 1.0;
  gl_Position = vec4(v.xy * lens.xy + lens.zw * w, perspective ? w - 2.0 * range.x : -v.z / range.y, w);
  depth = perspective ? -v.z / range.y : 0.5 - 0.5 * v.z / range.y;
  at = position, facing = normal, texture_place = uv, tint = colour;
}
