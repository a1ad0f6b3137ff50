// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Types of an IDL text: modules, structures, enumerations, primitive types, strings, sequences and arrays. Comments
// behind a field are kept, for they say what it is and in which unit.

const primitives = {
  'boolean': 'bool', 'char': 'uint8', 'octet': 'uint8', 'int8': 'int8', 'uint8': 'uint8',
  'short': 'int16', 'int16': 'int16', 'unsigned short': 'uint16', 'uint16': 'uint16',
  'long': 'int32', 'int32': 'int32', 'unsigned long': 'uint32', 'uint32': 'uint32',
  'long long': 'int64', 'int64': 'int64', 'unsigned long long': 'uint64', 'uint64': 'uint64',
  'float': 'float32', 'double': 'float64',
};

function* tokens(text) {
  const pattern = /\/\*[\s\S]*?\*\/|\/\/([^\n]*)|\n|#[^\n]*|@\w+(\([^)]*\))?|::|\w+|[{}<>,;[\]]/g;
  let fresh = true;
  for (let match; (match = pattern.exec(text));) {
    const word = match[0];
    if (word === '\n') { fresh = true; continue; }
    if (word.startsWith('//')) {
      if (!fresh) yield { comment: match[1].trim() };
      continue;
    }
    if (word.startsWith('/*') || word.startsWith('#') || word.startsWith('@')) continue;
    fresh = false;
    yield { word };
  }
}

// "[m] of the centre" -> unit and description.
function documented(field, comment) {
  const match = /^\[([^\]]*)\]\s*(.*)$/.exec(comment);
  field.unit = match ? match[1] : '';
  field.doc = match ? match[2] : comment;
}

// A map from full names to {kind: 'struct', fields} or {kind: 'enum', names}.
export function parseIdl(text) {
  const list = [...tokens(text)];
  const types = new Map();
  const modules = [];
  let i = 0;
  let last = null; // field that a comment is about
  const skipComments = () => {
    while (i < list.length && list[i].comment !== undefined) {
      if (last) { documented(last, list[i].comment); last = null; }
      ++i;
    }
  };
  const next = () => { skipComments(); return list[i++]?.word; };
  const peek = () => { skipComments(); return list[i]?.word; };
  const expect = (word) => { const got = next(); if (got !== word) throw new Error('IDL: ' + word + ' expected, not ' + got); };
  const full = (name) => [...modules, name].join('::');

  const resolve = (name) => {
    for (let k = modules.length; k >= 0; --k) {
      const candidate = [...modules.slice(0, k), name].join('::');
      if (types.has(candidate)) return candidate;
    }
    throw new Error('IDL: unknown type ' + name);
  };
  const parseType = () => {
    let word = next();
    if (word === 'sequence') {
      expect('<');
      const element = parseType();
      if (peek() === ',') { next(); next(); }
      expect('>');
      return { kind: 'sequence', element };
    }
    if (word === 'string') {
      if (peek() === '<') { next(); next(); expect('>'); }
      return { kind: 'string' };
    }
    if (word === 'unsigned' || word === 'long') {
      while (peek() === 'long' || peek() === 'short') word += ' ' + next();
    }
    if (primitives[word]) return { kind: 'primitive', type: primitives[word] };
    while (peek() === '::') { next(); word += '::' + next(); }
    return { kind: 'named', name: resolve(word) };
  };

  while (i < list.length) {
    const word = next();
    if (word === undefined) break;
    if (word === 'module') { modules.push(next()); expect('{'); continue; }
    if (word === '}') { modules.pop(); if (peek() === ';') next(); continue; }
    if (word === 'enum') {
      const name = next();
      const names = [];
      expect('{');
      while (peek() !== '}') { names.push(next()); if (peek() === ',') next(); }
      expect('}'); expect(';');
      types.set(full(name), { kind: 'enum', names });
      continue;
    }
    if (word === 'struct') {
      const name = next();
      const fields = [];
      expect('{');
      while (peek() !== '}') {
        let type = parseType();
        const field = { name: next(), unit: '', doc: '' };
        while (peek() === '[') {
          next();
          type = { kind: 'array', length: Number(next()), element: type };
          expect(']');
        }
        expect(';');
        field.type = type;
        fields.push(field);
        last = field;
      }
      last = null;
      expect('}'); expect(';');
      types.set(full(name), { kind: 'struct', name: full(name), fields });
      continue;
    }
    throw new Error('IDL: unexpected ' + word);
  }
  return types;
}
