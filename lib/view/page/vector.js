// Vectors of three numbers, as arrays.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(...a);
export const normalized = (a) => scale(a, 1 / length(a));
export const row = (values, i, n = 3) => Array.from(values.subarray(i * n, i * n + n));

// Column-major matrix whose rows are x, y and z.
export const matrixOfRows = (x, y, z) => [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]];

// Two unit vectors at right angles to n and to each other.
export function across(n) {
  const x = normalized(cross(Math.abs(n[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0], n));
  return [x, cross(n, x)];
}
