// Shares of light that a mirror or glass reflects or passes, at 33 cosines of incidence (view/message/format.cpp).
vec3 share_at(vec3 table[33], float cosine) {
  float at = clamp(cosine, 0.0, 1.0) * 32.0;
  int low = min(int(at), 31);
  return mix(table[low], table[low + 1], at - float(low));
}
