// The page: loads the scene, draws when something has changed, and asks for the light under the cursor.
//
// The address may hold ?camera=N&width=W&height=H, a picture of that size without the panel. With &dump=Q (the
// number of a quantity) its values, 32-bit floats from the top in base64, become the text of #dump; a second dump=Q that
// of #dump-1, and so on. &dump=isolux&step=LX gives 1 where a line is. &weight=NAME:W dims a group of lamps (?weight=W:
// caches without names), &wipe=SHARE sets the wipe, and ?bench=FRAMES measures frames, whose times become the text of
// #bench. &grow=FRAMES lets the cache grow before the values are dumped, for so many frames.
import {bench} from './bench.js';
import {Dimming} from './dimming.js';
import {Distance} from './distance.js';
import {Drawing, loadShaders, MEASURED} from './drawing.js';
import {exposureOf, number, scaleEnd} from './exposure.js';
import {load, served} from './files.js';
import {Growth} from './growth.js';
import {labelsOf, stepFor} from './isolux.js';
import {LightQuestions} from './light.js';
import {Messages, names} from './message.js';
import {Overlay} from './overlay.js';
import {PictureLight} from './picture_light.js';
import {followTheme} from './theme.js';
import {Eye, Walk} from './walk.js';
import {Wipe} from './wipe.js';

const $ = (id) => document.getElementById(id);
const UNITS = ['cd/m²', 'lx', 'lx', 'lx', 'cd/m²'];
const asked = new URLSearchParams(location.search);
const DUMPS = asked.getAll('dump');
const WITHOUT_LAMPS = DUMPS.length > 0 && DUMPS.every((what) => ['2', '4'].includes(what));  // quantities of records alone
const PLACES_A_FRAME = DUMPS.length ? Infinity : 4;  // places of lamps whose shadow maps a frame draws

function pictureSize({clientWidth, clientHeight}) {
  const width = Number(asked.get('width')) || Math.round(clientWidth * devicePixelRatio);
  const height = Number(asked.get('height')) || Math.round(clientHeight * devicePixelRatio);
  return [Math.max(width, 1), Math.max(height, 1)];
}

class View {
  constructor(drawing, scene, about, messages) {
    Object.assign(this, {drawing, scene, about});
    this.canvas = drawing.canvas;
    this.eye = new Eye();
    this.walk = new Walk(this.canvas, this.eye, drawing.size / 8, () => this.change());
    this.accuracy = drawing.records.accuracy;
    this.exposure = {key: 1, white: 1};
    this.stale = true;
    this.overlay = new Overlay($('over'));
    this.distance = new Distance($('distance'));
    const {sets} = drawing, relight = () => { this.change(); this.askAgain(); };
    this.wipe = new Wipe({section: $('wipe-section'), slider: $('wipe'), line: $('wipe-line'), labels: $('wipe-labels')},
                         sets, Number(asked.get('wipe') ?? 0.5), relight);
    this.dimming = new Dimming({section: $('groups'), list: $('group-list'), all: $('all-on')}, sets,
                               asked.getAll('weight'), relight);
    this.fillPanel();
    this.listen();
    this.takeCamera(Number(asked.get('camera') ?? 0));
    const tell = (reading) => this.tell(reading);
    this.questions = served ? new LightQuestions(messages, tell, () => $('state').textContent = 'phos-view has ended')
                            : new PictureLight(drawing, tell);
    if (about.growth)
      this.growth = new Growth(about.growth, messages, drawing, {section: $('growth'), text: $('grown'), grows: $('grows'),
                                                                 save: $('save'), saved: $('saved')}, () => this.change());
  }

  get quantity() { return Number($('quantity').value); }

  // Of the records, as they are drawn: smaller than `accuracy` where many have been made.
  get reach() { return this.accuracy * (this.growth?.share ?? 1); }

  // Something has moved: the light is computed anew.
  change() { this.stale = true; }

  fillPanel() {
    const {camera, camera_name} = this.scene;
    const list = names(camera.name_end, camera_name.utf8);
    (list.length ? list : ['outside']).forEach((name, i) => $('camera').add(new Option(name || `camera ${i}`, i)));
    $('title').textContent = document.title = this.about.title;
    $('count').textContent = this.drawing.sets.map((set) =>
      `${set.count} irradiance records of ${set.holdsDirect ? 'all' : 'indirect'} light`).join(' | ');
    Object.assign($('accuracy'), {min: this.accuracy / 4, max: this.accuracy * 2, value: this.accuracy});
    $('a').textContent = number(this.accuracy);
    for (const note of this.about.notes) {
      const item = document.createElement('li');
      item.textContent = note;
      $('notes').querySelector('ul').append(item);
    }
    $('notes').hidden = this.about.notes.length === 0;
    const scale = $('scale').getContext('2d');
    for (let i = 0; i < 256; ++i) {
      scale.fillStyle = `rgb(${this.about.palette.slice(3 * i, 3 * i + 3).join(' ')})`;
      scale.fillRect(i, 0, 1, 1);
    }
  }

  listen() {
    $('camera').onchange = () => this.takeCamera(Number($('camera').value));
    $('quantity').onchange = () => this.automatic();
    $('automatic').onclick = () => this.automatic();
    $('accuracy').oninput = () => {
      this.accuracy = Number($('accuracy').value);
      $('a').textContent = number(this.accuracy);
      this.change();
    };
    for (const id of ['exposure', 'false', 'low', 'high', 'logarithmic', 'overlay', 'holes', 'isolux', 'isolux-step']) $(id).oninput = () => this.show();
    addEventListener('resize', () => this.change());
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.walk.dragging) return;
      this.cursor = this.placeOf(event);
      this.askAgain();
    });
    this.canvas.addEventListener('pointerleave', () => this.cursor = null);
    let pressed = null;
    this.canvas.addEventListener('pointerdown', (event) => pressed = [event.clientX, event.clientY]);
    this.canvas.addEventListener('pointerup', (event) => {
      if ($('measure').checked && pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 4)
        this.takePoint(this.placeOf(event));
    });
    this.canvas.addEventListener('keydown', (event) => {
      if (event.code === 'KeyM' && !event.ctrlKey && !event.metaKey && !event.altKey) this.takePoint(this.cursor ?? [0.5, 0.5]);
    });
    $('take-point').onclick = () => this.takePoint([0.5, 0.5]);
    $('clear-distance').onclick = () => { this.distance.clear(); this.show(); };
    followTheme($('theme'));
    this.canvas.addEventListener('webglcontextlost', () => {
      $('state').textContent = 'The browser has given the graphics memory away; load the page anew';
      this.lost = true;
    });
  }

  // From 0 to 1 from the upper left of the picture.
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  takePoint([x, y]) {
    this.distance.take(this.drawing.pointAt(x, y));
    this.show();
  }

  // The light under the cursor, of the set that is seen there.
  askAgain() {
    if (!this.cursor) return;
    const [x, y] = this.cursor, set = this.wipe.setAt(x);
    this.questions.ask(this.eye.ray(2 * x - 1, 1 - 2 * y, this.canvas.clientWidth / this.canvas.clientHeight), set,
                       this.drawing.sets[set].weights, [x, y]);
  }

  takeCamera(i) {
    if (i < this.scene.camera.rows) this.eye.take(this.scene.camera, i);
    else this.eye.takeOutside(this.drawing.centre, this.drawing.size);
    $('camera').value = i;
    this.measures = true;
    this.change();
  }

  // Exposure and scale for what is seen now.
  automatic() {
    const values = this.drawing.values(this.quantity);
    this.exposure = exposureOf(values);
    $('exposure').value = 0;
    const high = scaleEnd(values);
    $('isolux-step').value = stepFor(scaleEnd(this.quantity === 0 ? this.drawing.values(1) : values));
    $('high').value = high, $('low').value = $('logarithmic').checked ? high / 1000 : 0;
    this.show();
  }

  show() {
    if (this.lost) return;
    const stops = Number($('exposure').value), factor = 2 ** -stops, logarithmic = $('logarithmic').checked;
    const high = Math.max(Number($('high').value), 1e-30);
    const low = Math.min(Math.max(Number($('low').value), logarithmic ? high / 1e4 : 0), high * 0.999);
    $('stops').textContent = stops;
    $('legend').hidden = !$('false').checked;
    const middle = logarithmic ? Math.sqrt(low * high) : (low + high) / 2;
    $('marks').replaceChildren(...[low, middle, high].map((v, i) => {
      const mark = document.createElement('span');
      mark.textContent = number(v) + (i === 2 ? ` ${UNITS[this.quantity]}` : '');
      return mark;
    }));
    this.drawing.show({
      quantity: this.quantity, false_colour: $('false').checked, logarithmic, scale_ends: [low, high],
      key: this.exposure.key * factor, white: this.exposure.white * factor, show_holes: $('holes').checked,
      isolux_step: this.isoluxStep,
    }, $('overlay').value, this.reach);
    this.drawOver();
  }

  get isoluxStep() { return $('isolux').checked ? Math.max(Number($('isolux-step').value), 0) : 0; }

  // Numbers of isolux lines, and the distance that is measured.
  drawOver() {
    this.overlay.clear();
    if (this.isoluxStep > 0) {
      const grid = this.drawing.measure(this.quantity || 1);
      const there = (i) => grid[4 * i + 1] > 0 && grid[4 * i + 2] === 0;
      for (const {x, y, level} of labelsOf({size: MEASURED, value: (i) => grid[4 * i], there}, this.isoluxStep))
        this.overlay.word([x, 1 - y], number(level));
    }
    this.distance.draw(this.overlay, this.eye, this.canvas.width / this.canvas.height);
  }

  tell(reading) {
    const with_error = (value, error, unit) => number(value) + (error === undefined ? '' : ` ± ${number(error)}`) + ` ${unit}`;
    const hit = reading.hit !== 0;
    $('illuminance').textContent = hit ? with_error(reading.illuminance, reading.illuminance_stderr, 'lx') : '—';
    $('direct').textContent = hit ? `${number(reading.direct)} lx` : '—';
    $('indirect').textContent = hit ? `${number(reading.indirect)} lx` : '—';
    $('luminance').textContent = hit ? with_error(reading.luminance, reading.luminance_stderr, 'cd/m²') +
        (reading.has_gloss ? ', without gloss' : '') : '—';
    const origin = this.scene.scene.origin;
    $('place').textContent = hit ? Array.from(reading.position, (p, k) => (p + origin[k]).toFixed(3)).join(', ') + ' m' : '—';
  }

  // One frame. True where there is more to do at once.
  frame(now) {
    if (this.lost) return false;
    if (this.walk.step(now)) this.change();
    // The first frame shows the light of records at once.
    if (this.seen && !WITHOUT_LAMPS && this.drawing.needsLamps && this.drawing.lamps.drawn < this.drawing.lamps.places.length) {
      const {lamps} = this.drawing;
      lamps.prepare(PLACES_A_FRAME);
      $('state').textContent = lamps.drawn < lamps.places.length ? `Shadows: ${lamps.drawn} of ${lamps.places.length}` : '';
      this.measures = true;
      this.change();
    }
    if (!this.stale) return false;
    this.stale = false;
    this.drawing.resize(...pictureSize(this.canvas));
    this.drawing.share = this.wipe.share;
    this.drawing.light(this.eye, this.reach);
    if (this.measures) this.automatic(); else this.show();
    this.measures = false, this.seen = true;
    return true;
  }

  // Values of a quantity as text of the page, or lines; `number`: of dumps before.
  dump(what, number) {
    const values = what === 'isolux' ? this.drawing.isoluxPixels(1, Number(asked.get('step'))) : this.drawing.pixels(Number(what));
    const bytes = new Uint8Array(values.buffer);
    let binary = '';
    for (const byte of bytes) binary += String.fromCharCode(byte);
    this.print(number ? `dump-${number}` : 'dump', btoa(binary));
  }

  bench(frames) {
    const times = bench(frames, (angle) => {
      this.eye.turn(angle, 0);
      this.change();
      this.frame(0);
    }, () => this.drawing.finish());
    const {width, height} = this.canvas;
    this.print('bench', JSON.stringify({width, height, ...times}));
    $('state').textContent = `${number(times.frames_per_second)} frames a second, ${width} x ${height}`;
  }

  print(id, words) {
    const text = document.createElement('pre');
    text.id = id, text.textContent = words;
    document.body.append(text);
  }
}

try {
  document.body.classList.toggle('bare', asked.has('width') || asked.has('height'));
  const [format, about, scene, palette, shaders] = await Promise.all([
    load('/format.json', 'json'), load('/about.json', 'json'), load('/scene.bin', 'arrayBuffer'),
    load('/palette.bin', 'arrayBuffer'), loadShaders((path) => load(path, 'text'))]);
  const messages = new Messages(format), colours = new Uint8Array(palette);
  const read = messages.read(scene, 'scene');
  const message = async (path, name) => messages.read(await load(path, 'arrayBuffer'), name);
  const sets = await Promise.all(about.sets.map(async ({label, groups}) => ({
    label, groups: await Promise.all(groups.map(async (group) =>
      ({...group, records: await message(group.records, 'records'), gloss: await message(group.gloss, 'gloss')}))),
  })));
  const drawing = new Drawing($('picture'), shaders, read, sets, colours, Math.max(...pictureSize($('picture'))));
  const view = new View(drawing, read, {...about, palette: Array.from(colours)}, messages);
  $('state').textContent = '';
  if (DUMPS.length) {
    const draw = () => { while (view.frame(0)); };
    draw();
    if (asked.has('grow'))
      await view.growth.settle(Number(asked.get('grow')), view.accuracy, draw, () => load('/about.json', 'json'));
    DUMPS.forEach((what, number) => view.dump(what, number));
  } else {
    if (asked.has('bench')) {
      while (view.frame(0));
      view.bench(Number(asked.get('bench')) || 120);
    }
    const next = (now) => {
      view.frame(now);
      if (!view.lost) view.growth?.step(now, view.eye, view.accuracy);
      requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  }
} catch (error) {
  $('state').textContent = `The scene cannot be shown: ${error.message}`;
  console.error(error);
}
