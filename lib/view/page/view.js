// The page: loads the scene, draws when something has changed, and asks for the light under the cursor.
//
// The address may hold ?camera=N&width=W&height=H, a picture of that size without the panel. With &dump=Q (the
// number of a quantity) its values, 32-bit floats from the top in base64, become the text of #dump.
import {Drawing, loadShaders} from './drawing.js';
import {exposureOf, number, scaleEnd} from './exposure.js';
import {load, served} from './files.js';
import {LightQuestions} from './light.js';
import {Messages, names} from './message.js';
import {PictureLight} from './picture_light.js';
import {Eye, Walk} from './walk.js';

const $ = (id) => document.getElementById(id);
const UNITS = ['cd/m²', 'lx', 'lx', 'lx'];
const PLACES_A_FRAME = 4;  // places of lamps whose shadow maps a frame draws
const asked = new URLSearchParams(location.search);

class View {
  constructor(drawing, scene, about, messages) {
    Object.assign(this, {drawing, scene, about});
    this.canvas = drawing.canvas;
    this.eye = new Eye();
    this.walk = new Walk(this.canvas, this.eye, drawing.size / 8, () => this.change());
    this.accuracy = drawing.records.accuracy;
    this.exposure = {key: 1, white: 1};
    this.stale = true;
    this.fillPanel();
    this.listen();
    this.takeCamera(Number(asked.get('camera') ?? 0));
    const tell = (reading) => this.tell(reading);
    this.questions = served ? new LightQuestions(messages, tell, () => $('state').textContent = 'phos-view has ended')
                            : new PictureLight(drawing, tell);
  }

  get quantity() { return Number($('quantity').value); }

  // Something has moved: the light is computed anew.
  change() { this.stale = true; }

  fillPanel() {
    const {camera, camera_name} = this.scene;
    const list = names(camera.name_end, camera_name.utf8);
    (list.length ? list : ['outside']).forEach((name, i) => $('camera').add(new Option(name || `camera ${i}`, i)));
    $('title').textContent = document.title = this.about.title;
    const {records} = this.drawing;
    $('count').textContent = `${records.count} irradiance records of ${records.holdsDirect ? 'all' : 'indirect'} light`;
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
    for (const id of ['exposure', 'false', 'low', 'high', 'logarithmic', 'overlay', 'holes']) $(id).oninput = () => this.show();
    addEventListener('resize', () => this.change());
    this.canvas.addEventListener('pointermove', (event) => {
      if (this.walk.dragging) return;
      const box = this.canvas.getBoundingClientRect();
      const x = 2 * (event.clientX - box.left) / box.width - 1, y = 1 - 2 * (event.clientY - box.top) / box.height;
      this.questions.ask(this.eye.ray(x, y, box.width / box.height), [x, y]);
    });
    this.canvas.addEventListener('webglcontextlost', () => {
      $('state').textContent = 'The browser has given the graphics memory away; load the page anew';
      this.lost = true;
    });
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
    }, $('overlay').value, this.accuracy);
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
    if (!this.drawing.records.holdsDirect && this.drawing.lamps.drawn < this.drawing.lamps.places.length) {
      const {lamps} = this.drawing;
      lamps.prepare(PLACES_A_FRAME);
      $('state').textContent = lamps.drawn < lamps.places.length ? `Shadows: ${lamps.drawn} of ${lamps.places.length}` : '';
      this.measures = true;
      this.change();
    }
    if (!this.stale) return false;
    this.stale = false;
    const width = Number(asked.get('width')) || Math.round(this.canvas.clientWidth * devicePixelRatio);
    const height = Number(asked.get('height')) || Math.round(this.canvas.clientHeight * devicePixelRatio);
    this.drawing.resize(Math.max(width, 1), Math.max(height, 1));
    this.drawing.light(this.eye, this.accuracy);
    if (this.measures) this.automatic(); else this.show();
    this.measures = false;
    return true;
  }

  // Values of a quantity as text of the page.
  dump(quantity) {
    const bytes = new Uint8Array(this.drawing.pixels(quantity).buffer);
    let binary = '';
    for (const byte of bytes) binary += String.fromCharCode(byte);
    const text = document.createElement('pre');
    text.id = 'dump', text.textContent = btoa(binary);
    document.body.append(text);
  }
}

try {
  document.body.classList.toggle('bare', asked.has('width') || asked.has('height'));
  const [format, about, scene, records, palette, shaders] = await Promise.all([
    load('/format.json', 'json'), load('/about.json', 'json'), load('/scene.bin', 'arrayBuffer'),
    load('/records.bin', 'arrayBuffer'), load('/palette.bin', 'arrayBuffer'), loadShaders((path) => load(path, 'text'))]);
  const messages = new Messages(format), colours = new Uint8Array(palette);
  const read = messages.read(scene, 'scene');
  const drawing = new Drawing($('picture'), shaders, read, messages.read(records, 'records'), colours);
  const view = new View(drawing, read, {...about, palette: Array.from(colours)}, messages);
  $('state').textContent = '';
  if (asked.has('dump')) {
    while (view.frame(0));
    view.dump(Number(asked.get('dump')));
  } else {
    const next = (now) => { view.frame(now); requestAnimationFrame(next); };
    requestAnimationFrame(next);
  }
} catch (error) {
  $('state').textContent = `The scene cannot be shown: ${error.message}`;
  console.error(error);
}
