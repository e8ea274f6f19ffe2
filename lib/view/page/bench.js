// How long frames take: a turn about the camera, each frame drawn anew and waited for.

const share = (sorted, s) => sorted[Math.min(sorted.length - 1, Math.floor(s * sorted.length))];

// {frames, frames_per_second, ms: {median, p95, most}} of times in ms.
export function summaryOf(times) {
  const sorted = [...times].sort((a, b) => a - b), sum = times.reduce((a, b) => a + b, 0);
  return {frames: times.length, frames_per_second: 1000 * times.length / sum,
          ms: {median: share(sorted, 0.5), p95: share(sorted, 0.95), most: share(sorted, 1)}};
}

// `draw` draws a frame of the turn (angle in radians), and `finish` waits for the graphics card.
export function bench(frames, draw, finish) {
  const times = [];
  draw(0);
  finish();
  for (let i = 1; i <= frames; ++i) {
    const start = performance.now();
    draw(2 * Math.PI / frames);
    finish();
    times.push(performance.now() - start);
  }
  return summaryOf(times);
}
