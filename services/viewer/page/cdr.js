// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Messages from their bytes (XCDR1) and their IDL. Integers of 64 bits become numbers: exact to some hundred
// nanoseconds for times since 1970.

const sizes = { bool: 1, int8: 1, uint8: 1, int16: 2, uint16: 2, int32: 4, uint32: 4, int64: 8, uint64: 8, float32: 4, float64: 8 };
const text = new TextDecoder();

class Reader {
  constructor(bytes) {
    this.view = bytes;
    this.little = (bytes.getUint8(1) & 1) === 1;
    if (bytes.getUint8(0) !== 0 || bytes.getUint8(1) > 1) throw new Error('not plain CDR');
    this.offset = 4;
  }
  take(size, alignment = size) {
    const at = 4 + Math.ceil((this.offset - 4) / alignment) * alignment;
    if (at + size > this.view.byteLength) throw new Error('the message is cut short');
    this.offset = at + size;
    return at;
  }
  number(type) {
    const at = this.take(sizes[type]);
    const v = this.view;
    switch (type) {
      case 'bool': return v.getUint8(at) !== 0;
      case 'int8': return v.getInt8(at);
      case 'uint8': return v.getUint8(at);
      case 'int16': return v.getInt16(at, this.little);
      case 'uint16': return v.getUint16(at, this.little);
      case 'int32': return v.getInt32(at, this.little);
      case 'uint32': return v.getUint32(at, this.little);
      case 'int64': return Number(v.getBigInt64(at, this.little));
      case 'uint64': return Number(v.getBigUint64(at, this.little));
      case 'float32': return v.getFloat32(at, this.little);
      default: return v.getFloat64(at, this.little);
    }
  }
  string() {
    const length = this.number('uint32');
    const at = this.take(length, 1);
    return text.decode(new Uint8Array(this.view.buffer, this.view.byteOffset + at, Math.max(0, length - 1)));
  }
  floats(count) {
    if (count === 0) return new Float32Array();
    const at = this.take(4 * count, 4) + this.view.byteOffset;
    if (this.little) return new Float32Array(this.view.buffer.slice(at, at + 4 * count));
    return Float32Array.from({ length: count }, (_, i) => this.view.getFloat32(at - this.view.byteOffset + 4 * i, false));
  }
  value(types, type) {
    switch (type.kind) {
      case 'primitive': return this.number(type.type);
      case 'string': return this.string();
      case 'sequence': return this.list(types, type.element, this.number('uint32'));
      case 'array': return this.list(types, type.element, type.length);
      default: {
        const named = types.get(type.name);
        if (named.kind === 'enum') { const value = this.number('uint32'); return named.names[value] ?? value; }
        return this.struct(types, named);
      }
    }
  }
  list(types, element, count) {
    if (element.kind === 'primitive' && element.type === 'float32') return this.floats(count);
    if (count > this.view.byteLength) throw new Error('the message is cut short');
    const values = [];
    for (let i = 0; i < count; ++i) values.push(this.value(types, element));
    return values;
  }
  struct(types, type) {
    const object = {};
    for (const field of type.fields) object[field.name] = this.value(types, field.type);
    return object;
  }
}

export function decode(types, name, bytes) {
  return new Reader(bytes).struct(types, types.get(name));
}

// Only the header, which our messages of data begin with; null for others.
export function decodeHeader(types, name, bytes) {
  const first = types.get(name).fields[0];
  if (first.name !== 'header') return null;
  return new Reader(bytes).value(types, first.type);
}
