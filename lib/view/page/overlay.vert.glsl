// The place of a record (one vertex), or the edge of its zone (a loop).
layout(location = 0) in vec3 position;
layout(location = 1) in float inverse_radius;
layout(location = 2) in vec3 normal;
uniform vec3 eye;
uniform mat3 axes;
uniform vec2 half_size;
uniform float accuracy;
uniform bool perspective;
uniform int corners;                      // of the loop; 0: the place
out float along;
void main() {
  vec3 p = position;
  if (corners > 0) {
    vec3 x = normalize(abs(normal.x) < 0.6 ? cross(normal, vec3(1.0, 0.0, 0.0)) : cross(normal, vec3(0.0, 1.0, 0.0)));
    float angle = 6.283185307 * float(gl_VertexID) / float(corners);
    p += accuracy / inverse_radius * (cos(angle) * x + sin(angle) * cross(normal, x));
  }
  vec3 v = axes * (p - eye);
  along = -v.z;
  float w = perspective ? -v.z : 1.0;
  gl_Position = vec4(v.xy / half_size, 0.0, w);
  gl_PointSize = 5.0;
}
