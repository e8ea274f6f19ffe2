// The light under the cursor where no server reads it from the caches: that of the picture, at its pixel.
const SAID = 'Values of the picture at this pixel. This page has no server: the exact value from the caches, and its ' +
    'standard error, need phos-view itself.';

export class PictureLight {
  constructor(drawing, answered) {
    Object.assign(this, {drawing, answered, waiting: null});
    const said = document.createElement('p');
    said.id = 'of-picture', said.textContent = SAID;
    document.getElementById('place').closest('section').append(said);
  }

  // Of a place of the picture, -1 to 1 rightwards and upwards; once a frame, the newest.
  ask(_ray, [x, y]) {
    if (!this.waiting) requestAnimationFrame(() => this.#answer());
    this.waiting = [x, y];
  }

  #answer() {
    const {drawing} = this, {width, height} = drawing.canvas, [x, y] = this.waiting;
    const pixel = [[x, width], [y, height]].map(([v, n]) => Math.min(Math.max(Math.floor((v + 1) / 2 * n), 0), n - 1));
    this.waiting = null;
    if (drawing.view) this.answered(readingAt(drawing, pixel));
  }
}

// As the server's reading (view/message/format.h), without standard errors. Light that no record gives is unknown.
export function readingAt(drawing, pixel) {
  const [luminance, hit, hole] = drawing.valueAt(pixel, 0), [illuminance] = drawing.valueAt(pixel, 1);
  const [indirect] = drawing.valueAt(pixel, 2), [direct] = drawing.valueAt(pixel, 3), all = drawing.records.holdsDirect;
  const unless = (unknown, value) => unknown ? NaN : value;
  return {
    hit, position: drawing.placeAt(pixel), luminance: unless(hole, luminance), illuminance: unless(hole, illuminance),
    indirect: unless(hole || all, indirect), direct: unless(all, direct), has_gloss: 0,
  };
}
