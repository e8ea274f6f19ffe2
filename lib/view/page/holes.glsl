// Is the surface there? Put before a fragment shader of the scene.
in vec3 at, facing;
in vec4 texture_place, tint;
in float depth;
uniform vec4 diffuse;            // and alpha
uniform bool masked;
uniform float cutoff;
uniform bool colour_textured;
uniform int colour_set;
uniform vec2 colour_place[3];    // offset, and the columns of the matrix
uniform sampler2D colour_map;
vec2 place_of(int set, vec2 place[3]) {
  vec2 t = set == 0 ? texture_place.xy : texture_place.zw;
  return place[0] + place[1] * t.x + place[2] * t.y;
}
vec4 base_colour() {
  vec4 c = diffuse * tint;
  return colour_textured ? c * texture(colour_map, place_of(colour_set, colour_place)) : c;
}
