// Messages (view/message/format.h), by the table that the server gives at /format.json.

const HEADER_BYTES = 16;
const ARRAYS = {u8: Uint8Array, u32: Uint32Array, f32: Float32Array};
const padded = (bytes) => Math.ceil(bytes / 8) * 8;

export class Messages {
  constructor(format) { this.format = format; }

  layout(name) { return this.format.kinds.find((kind) => kind.name === name); }

  // {table: {rows, field: typed array}} of a message. Throws an Error for another message than `name`.
  read(buffer, name) {
    const layout = this.layout(name), view = new DataView(buffer);
    if (buffer.byteLength < HEADER_BYTES || view.getUint32(0, false) !== 0x70686f76) throw new Error('not a message');
    if (view.getUint16(4, true) !== this.format.version) throw new Error('a message of another version');
    if (view.getUint16(6, true) !== layout.kind) throw new Error(`not a message of ${name}`);
    if (Number(view.getBigUint64(8, true)) !== buffer.byteLength) throw new Error('a message that is cut off');
    const tables = {};
    let at = HEADER_BYTES;
    for (const field of layout.fields) {
      const rows = Number(view.getBigUint64(at, true)), size = rows * field.components, Values = ARRAYS[field.type];
      at += 8;
      const table = tables[field.table] ??= {rows: 0};
      table.rows = Math.max(table.rows, rows);
      table[field.name] = new Values(buffer, at, size);
      at += padded(size * Values.BYTES_PER_ELEMENT);
    }
    return tables;
  }

  // A message of `tables`: {table: {field: array of numbers}}.
  write(name, tables) {
    const layout = this.layout(name);
    const values = layout.fields.map((field) => ARRAYS[field.type].from(tables[field.table]?.[field.name] ?? []));
    const bytes = values.reduce((sum, v) => sum + 8 + padded(v.byteLength), HEADER_BYTES);
    const buffer = new ArrayBuffer(bytes), view = new DataView(buffer);
    view.setUint32(0, 0x70686f76, false);
    view.setUint16(4, this.format.version, true);
    view.setUint16(6, layout.kind, true);
    view.setBigUint64(8, BigInt(bytes), true);
    let at = HEADER_BYTES;
    values.forEach((v, i) => {
      view.setBigUint64(at, BigInt(v.length / layout.fields[i].components), true);
      new v.constructor(buffer, at + 8, v.length).set(v);
      at += 8 + padded(v.byteLength);
    });
    return buffer;
  }
}

// Names that stand one after another, each with its end.
export function names(ends, utf8) {
  const decoder = new TextDecoder();
  return Array.from(ends, (end, i) => decoder.decode(utf8.subarray(i ? ends[i - 1] : 0, end)));
}
