// One rectangle per radiance record, after rectangle.glsl.
layout(location = 0) in vec3 position;
layout(location = 1) in float inverse_radius;
layout(location = 2) in vec3 normal;
layout(location = 3) in float front_limit;
layout(location = 4) in vec3 axis_x;
layout(location = 5) in float over_limit;
layout(location = 6) in vec4 own;         // steepness, weight, order, first number
uniform float accuracy;
flat out vec4 a, b, c, numbers;
void main() {
  gl_Position = corner_about(position, accuracy / inverse_radius * 1.0001, gl_VertexID);
  a = vec4(position, inverse_radius), b = vec4(normal, front_limit), c = vec4(axis_x, over_limit);
  numbers = own;
}
