// The distance of what a lamp sees.
void main() {
  if (masked && base_colour().a < cutoff) discard;
  gl_FragDepth = depth;
}
