// The message that a packed one stands for (view/static/packed_message.h, with the numbers of Coding).
const HEADER_BYTES = 16;
const BYTES = 0, NUMBERS = 1, ROUNDED = 2, BOX = 3, OCTAHEDRAL = 4;

const padded = (bytes) => Math.ceil(bytes / 8) * 8;

// Numbers of four bytes whose bytes stand apart.
function gathered(bytes, at, count) {
  const values = new Uint32Array(count);
  for (let plane = 0; plane < 4; ++plane, at += count)
    for (let i = 0; i < count; ++i) values[i] |= bytes[at + i] << 8 * plane;
  return values;
}

// Numbers of their differences.
function summed(values) {
  let sum = 0;
  for (let i = 0; i < values.length; ++i) values[i] = sum = sum + (values[i] >>> 1 ^ -(values[i] & 1)) | 0;
  return values;
}

// Component by component to row by row.
function byRow(from, to, components) {
  const rows = from.length / components;
  for (let c = 0; c < components; ++c)
    for (let i = 0; i < rows; ++i) to[i * components + c] = from[c * rows + i];
}

// decode_octahedral() (core/vector.h).
function direction(x, y, to, at) {
  const signed = (v) => Math.max((v << 16 >> 16) / 32767, -1);
  let u = signed(x), v = signed(y);
  const w = 1 - Math.abs(u) - Math.abs(v);
  if (w < 0) [u, v] = [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  const length = Math.hypot(u, v, w);
  to[at] = u / length, to[at + 1] = v / length, to[at + 2] = w / length;
}

// Unpacks a field. `place` makes room in the message: the array of its values. Returns where the next one begins.
function unpackField(view, bytes, at, place) {
  const rows = Number(view.getBigUint64(at, true)), coding = bytes[at + 8], bits = bytes[at + 9];
  const components = view.getUint16(at + 10, true), count = rows * components;
  at += 16;
  if (coding === BYTES) {
    const values = new Uint8Array(count);
    for (let i = 0, sum = 0; i < count; ++i) values[i] = sum = sum + bytes[at + i];
    byRow(values, place(rows, Uint8Array, count), components);
    return at + count;
  }
  const ends = coding === BOX ? Array.from({length: 2 * components}, (_, i) => view.getFloat32(at + 4 * i, true)) : [];
  at += 4 * ends.length;
  const values = gathered(bytes, at, count);
  if (coding === NUMBERS) {
    byRow(summed(values), place(rows, Uint32Array, count), components);
  } else if (coding === ROUNDED) {
    byRow(new Float32Array(values.buffer), place(rows, Float32Array, count), components);
  } else if (coding === BOX) {
    const most = 2 ** bits - 1, real = new Float64Array(summed(values));
    for (let c = 0; c < components; ++c)
      for (let i = c * rows; i < (c + 1) * rows; ++i) real[i] = ends[2 * c] + (ends[2 * c + 1] - ends[2 * c]) * (real[i] / most);
    byRow(real, place(rows, Float32Array, count), components);
  } else if (coding === OCTAHEDRAL) {
    const unit = place(rows, Float32Array, 3 * rows);
    summed(values);
    for (let i = 0; i < rows; ++i) direction(values[i], values[rows + i], unit, 3 * i);
  } else {
    throw new Error('a packed message of another version');
  }
  return at + 4 * count;
}

export function unpack(packed) {
  const view = new DataView(packed), bytes = new Uint8Array(packed);
  const size = packed.byteLength < HEADER_BYTES || view.getUint32(0, false) !== 0x70686f70 ? -1 : Number(view.getBigUint64(8, true));
  if (size < HEADER_BYTES) throw new Error('not a packed message');
  const message = new ArrayBuffer(size), header = new DataView(message);
  new Uint8Array(message).set(bytes.subarray(0, HEADER_BYTES));
  header.setUint32(0, 0x70686f76, false);
  let to = HEADER_BYTES;
  const place = (rows, Values, count) => {
    header.setBigUint64(to, BigInt(rows), true);
    const values = new Values(message, to + 8, count);
    to += 8 + padded(values.byteLength);
    return values;
  };
  for (let at = HEADER_BYTES; at < bytes.length;) at = unpackField(view, bytes, at, place);
  if (to !== size) throw new Error('a packed message that is cut off');
  return message;
}
