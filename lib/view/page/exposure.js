// Exposure and the ends of scales from the values of a picture, in rising order.

const at = (values, share) => values.length ? values[Math.round(share * (values.length - 1))] : 0;

// Luminance that becomes a middle grey (log average), and luminance that becomes white (image/tone_map.cpp).
export function exposureOf(values) {
  const white = at(values, 0.995);
  const lit = values.filter((v) => v > 0);
  if (!lit.length || !(white > 0)) return {key: 1, white: 1};
  const key = Math.exp(lit.reduce((sum, v) => sum + Math.log(Math.max(v, 1e-4 * white)), 0) / lit.length);
  return {key, white};
}

// 1, 2 or 5 times a power of ten, not below v.
export function roundUp(v) {
  if (!(v > 0)) return 1;
  const ten = 10 ** Math.floor(Math.log10(v));
  return [1, 2, 5, 10].map((m) => m * ten).find((r) => r >= v * (1 - 1e-9));
}

// The upper end of a scale: the 98th percentile, rounded up.
export const scaleEnd = (values) => roundUp(at(values, 0.98));

// Four digits at most.
export function number(v) {
  if (!Number.isFinite(v)) return 'unknown';
  return Math.abs(v) >= 1000 && Math.abs(v) < 1e6 ? v.toFixed(0) : String(+v.toPrecision(4));
}
