// The visible surface of each pixel.
uniform vec3 eye;
uniform vec3 gloss;
uniform vec3 emission;
uniform float lamp_number;               // 1 more than the row of the lamp; 0: of none
uniform bool two_sided;
uniform bool emission_textured;
uniform int emission_set;
uniform vec2 emission_place[3];
uniform float material;                  // its number and 1
uniform vec4 cut;                        // a plane: nothing below it is drawn
uniform bool mirrored;                   // a view in a mirror, where fronts look like backs
uniform sampler2D emission_map;
layout(location = 0) out vec4 position;  // w: number of the material and 1; 0: nothing is visible
layout(location = 1) out vec4 normal;    // smooth normal; w: the facet's normal, with reflectance.w
layout(location = 2) out vec4 reflectance;
layout(location = 3) out vec4 emitted;   // w: lamp_number

vec2 octahedral(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 s = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * s;
}

void main() {
  if (dot(cut, vec4(at, 1.0)) < 0.0) discard;
  vec4 base = base_colour();
  if (masked && base.a < cutoff) discard;
  vec3 facet = normalize(cross(dFdx(at), dFdy(at)));
  if (dot(facet, eye - at) < 0.0) facet = -facet;
  vec3 n = normalize(facing);
  if (dot(n, facet) < 0.0) n = -n;
  vec2 packed_facet = octahedral(facet);
  position = vec4(at, material);
  normal = vec4(n, packed_facet.x);
  reflectance = vec4(base.rgb + gloss, packed_facet.y);
  vec3 light = emission;
  if (emission_textured) light *= texture(emission_map, place_of(emission_set, emission_place)).rgb;
  emitted = vec4(gl_FrontFacing != mirrored || two_sided ? light : vec3(0.0), lamp_number);
  gl_FragDepth = depth;
}
