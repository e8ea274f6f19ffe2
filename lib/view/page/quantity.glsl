// Illuminance and luminance of a pixel.
uniform sampler2D position_map;
uniform sampler2D normal_map;
uniform sampler2D reflectance_map;
uniform sampler2D emission_map;
uniform sampler2D direct_map;
uniform sampler2D splat_map;
uniform sampler2D gloss_map;              // light of radiance records towards the eye, and weight
uniform sampler2D glint_map;              // light of lamps in gloss, towards the eye
uniform sampler2D material_map;
uniform sampler2D veil_map;               // share of light that comes through the panes before it
uniform sampler2D shine_map;              // light that mirrors and panes reflect towards the eye
uniform bool has_gloss, has_veil, has_shine;
uniform sampler2D sky_map;
uniform bool has_sky;
uniform sampler2D lamp_weight_map;        // 1024 lamps a row
uniform int sky_lamp_number;
uniform vec3 eye;
uniform mat3 axes;
uniform vec2 half_size;
uniform bool perspective;
uniform int quantity;                     // 0 luminance, 1 illuminance, 2 its indirect part, 3 its direct part, 4 light of radiance records

bool covered(ivec2 pixel) { return texelFetch(position_map, pixel, 0).w > 0.0; }
bool is_hole(ivec2 pixel) { return covered(pixel) && !(texelFetch(splat_map, pixel, 0).w > 0.0); }

float lamp_weight(int number) {
  return number == 0 ? 1.0 : texelFetch(lamp_weight_map, ivec2((number - 1) % 1024, (number - 1) / 1024), 0).r;
}

vec3 sky_towards(vec3 d) {
  return lamp_weight(sky_lamp_number) * texture(sky_map, vec2(atan(d.z, d.x) / 6.283185307 + 0.5, acos(clamp(d.y, -1.0, 1.0)) / 3.141592654)).rgb;
}

vec3 before_panes(ivec2 pixel, vec3 light) {
  if (has_veil) light *= texelFetch(veil_map, pixel, 0).rgb;
  return has_shine ? light + texelFetch(shine_map, pixel, 0).rgb : light;
}

vec3 quantity_at(ivec2 pixel, vec2 size) {
  vec4 p = texelFetch(position_map, pixel, 0);
  if (p.w == 0.0) {
    if (quantity != 0) return vec3(0.0);
    vec2 ndc = (vec2(pixel) + 0.5) / size * 2.0 - 1.0;
    vec3 view = perspective ? vec3(ndc * half_size, -1.0) : vec3(0.0, 0.0, -1.0);
    // axes are orthonormal: the transpose leads back
    return before_panes(pixel, has_sky ? sky_towards(normalize(view * axes)) : vec3(0.0));
  }
  vec4 splat = texelFetch(splat_map, pixel, 0);
  vec3 indirect = splat.w > 0.0 ? splat.rgb / splat.w : vec3(0.0);
  vec3 direct = texelFetch(direct_map, pixel, 0).rgb;
  if (quantity == 2) return indirect;
  if (quantity == 3) return direct;
  if (quantity == 1) return indirect + direct;
  vec4 gloss = has_gloss ? texelFetch(gloss_map, pixel, 0) : vec4(0.0);
  if (quantity == 4) return gloss.w > 0.0 ? gloss.rgb / gloss.w : vec3(0.0);
  vec3 reflectance = texelFetch(reflectance_map, pixel, 0).rgb / 3.141592654;
  vec4 mean_gloss = of_material(material_map, p.w, 0);  // w: how lamps shine in it
  vec3 matt = max(reflectance - mean_gloss.rgb / 3.141592654, 0.0);
  vec4 emission = texelFetch(emission_map, pixel, 0);
  vec3 light = emission.rgb * lamp_weight(int(emission.w));
  light += mean_gloss.w > 0.0 ? matt * direct + texelFetch(glint_map, pixel, 0).rgb : reflectance * direct;
  // Lobes of coats take light from the matt part; less than none is ringing of the harmonics.
  light += gloss.w > 0.0 ? max(matt * indirect + gloss.rgb / gloss.w, 0.0) : reflectance * indirect;
  return before_panes(pixel, light);
}

float luminance_of(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
