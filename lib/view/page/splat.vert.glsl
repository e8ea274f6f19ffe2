// One rectangle per record, after rectangle.glsl.
layout(location = 0) in vec3 position;
layout(location = 1) in float inverse_radius;
layout(location = 2) in vec3 normal;
layout(location = 3) in float front_limit;
layout(location = 4) in vec3 irradiance;
layout(location = 5) in float own_weight;
layout(location = 6) in float over_limit;
layout(location = 7) in vec3 turn_r;
layout(location = 8) in vec3 turn_g;
layout(location = 9) in vec3 turn_b;
layout(location = 10) in vec3 translation_r;
layout(location = 11) in vec3 translation_g;
layout(location = 12) in vec3 translation_b;
uniform float accuracy;
flat out vec4 a, b, e;
flat out float over;
flat out vec3 rr, rg, rb, tr, tg, tb;

void main() {
  gl_Position = corner_about(position, accuracy / inverse_radius * 1.0001, gl_VertexID);
  a = vec4(position, inverse_radius), b = vec4(normal, front_limit), e = vec4(irradiance, own_weight);
  over = over_limit;
  rr = turn_r, rg = turn_g, rb = turn_b;
  tr = translation_r, tg = translation_g, tb = translation_b;
}
