// Tables as textures (data.js).
vec4 datum(sampler2D map, int i) {
  int width = textureSize(map, 0).x;
  return texelFetch(map, ivec2(i % width, i / width), 0);
}
// Texel k of the material that the position's w names (materials.js).
vec4 of_material(sampler2D map, float w, int k) { return datum(map, 3 * (int(w) - 1) + k); }
