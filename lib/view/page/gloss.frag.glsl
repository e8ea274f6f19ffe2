// Weight of a radiance record at a pixel, and the light that it sends through the pixel's lobe, after weight.glsl and
// data.glsl (as splat/gl/shaders.cpp: gloss_fragment). Where the surface has another normal than the record, the lobe
// is the record's own towards the direction that mirrors to the same place.
flat in vec4 a, b, c, numbers;
uniform vec3 eye;
uniform vec3 backward;
uniform bool perspective;
uniform float inverse_accuracy;
uniform sampler2D position_map;
uniform sampler2D normal_map;
uniform sampler2D material_map;           // its texel 1: order, first row and rows of the lobe
uniform sampler2D lobe_row_map;           // bands, first number
uniform sampler2D lobe_number_map;
uniform sampler2D number_map;
layout(location = 0) out vec4 light;      // and the weight

vec3 coefficient(int i, vec3 shares) {
  int at = int(numbers.w) + 3 * i;
  return shares.x * datum(number_map, at).rgb + shares.y * datum(number_map, at + 1).rgb +
         shares.z * datum(number_map, at + 2).rgb;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 p = texelFetch(position_map, pixel, 0);
  if (p.w == 0.0) discard;
  vec4 lobe = of_material(material_map, p.w, 1);
  if (lobe.x == 0.0 || lobe.x != numbers.z) discard;
  vec3 d = p.xyz - a.xyz, n = texelFetch(normal_map, pixel, 0).xyz, normal = b.xyz;
  float left = weight_left(disc_error(d, n - normal, a.w), inverse_accuracy, kLeastWeight);
  float w = weight_if_lit(left, d, n, normal, b.w, c.w) * numbers.y;
  if (!(w > 0.0)) discard;

  vec3 towards = perspective ? normalize(eye - p.xyz) : backward;
  vec3 way = 2.0 * dot(n, towards) * n - towards;
  towards = 2.0 * dot(normal, way) * normal - way;
  vec3 axis_y = cross(normal, c.xyz);
  vec3 local = vec3(dot(towards, c.xyz), dot(towards, axis_y), dot(towards, normal));
  if (!(local.z > 0.0)) discard;
  float across = length(local.xy), last = lobe.z - 1.0;
  float at = min(across / (1.0 + local.z) * last, last);
  float row = min(floor(at), last - 1.0), share = at - row;
  vec4 lower = datum(lobe_row_map, int(lobe.y + row)), upper = datum(lobe_row_map, int(lobe.y + row) + 1);
  if (lower.x == 0.0 || upper.x == 0.0) discard;
  int order = int(max(lower.x, upper.x));
  vec2 azimuth = across > 0.0 ? local.xy / across : vec2(1.0, 0.0);

  float way_share = numbers.x > 0.0 ? w * step_share(d, numbers.x) : 0.0;
  vec3 shares = vec3(w, way_share * dot(d, c.xyz), way_share * dot(d, axis_y));
  vec2 angle = vec2(1.0, 0.0);            // cosine and sine of m times the azimuth
  vec3 sum = vec3(0.0);
  for (int m = 0; m < order; ++m) {
    for (int l = m; l < order; ++l) {
      int column = l * (l + 1) / 2 + m;
      vec3 t = mix(datum(lobe_number_map, int(lower.y) + column).rgb, datum(lobe_number_map, int(upper.y) + column).rgb, share);
      vec3 found = angle.x * coefficient(l * l + l + m, shares);
      if (m > 0) found += angle.y * coefficient(l * l + l - m, shares);
      sum += t * found;
    }
    angle = vec2(angle.x * azimuth.x - angle.y * azimuth.y, angle.x * azimuth.y + angle.y * azimuth.x);
  }
  light = vec4(sum, w);
}
