// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes what ros2_peer printed with another implementation of ROS 2's serialization, by the definitions of a distribution
// or of our own package.
//   node decode.mjs NODE_MODULES OWN_PACKAGE OUTPUT_OF_PEER jazzy|humble TOPIC=TYPE...
// prints {"topic": ..., "message": ...} for each sample; fails when one has other than the bytes of its type.
import {createRequire} from 'node:module';
import {readdirSync, readFileSync} from 'node:fs';
import {basename} from 'node:path';

const [modules, own, printed, distro, ...pairs] = process.argv.slice(2);
const require = createRequire(modules + '/');
const common = require('@foxglove/rosmsg-msgs-common');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader, MessageWriter} = require('@foxglove/rosmsg2-serialization');
const definitions = distro === 'humble' ? common.ros2humble : common.ros2jazzy;

// Of our package: the type, and behind it all others, by the names that its fields use.
const pack = basename(own);
function ownDefinition(type) {
  const others = readdirSync(`${own}/msg`).map((file) => file.replace('.msg', '')).filter((name) => name !== type);
  const fields = (name) => parse(readFileSync(`${own}/msg/${name}.msg`, 'utf8'), {ros2: true, skipTypeFixup: true})[0].definitions;
  return [{definitions: fields(type)}, ...others.map((name) => ({name, definitions: fields(name)}))];
}

// Types of the npm package, with what they need behind them.
function definitionOf(type) {
  if (type.startsWith(pack + '/')) return ownDefinition(type.split('/').pop());
  const all = new Map();
  const add = (name) => {
    if (all.has(name)) return;
    all.set(name, definitions[name]);
    for (const field of definitions[name].definitions) if (field.isComplex) add(field.type);
  };
  add(type.replace('/msg/', '/'));
  return [...all.values()].map((each, i) => (i === 0 ? {...each, name: undefined} : each));
}

const readers = new Map();
for (const pair of pairs) {
  const [topic, type] = pair.split('=');
  const definition = definitionOf(type);
  readers.set(topic, {reader: new MessageReader(definition), writer: new MessageWriter(definition)});
}

// JSON has no numbers without value, no typed arrays, and no integers of 64 bits but as they are written.
const plain = (key, value) => {
  if (typeof value === 'bigint') return `@${value}@`;
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value);
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
};
const text = (value) => JSON.stringify(value, plain).replace(/"@(-?\d+)@"/g, '$1');

for (const line of readFileSync(printed, 'utf8').split('\n')) {
  const [word, topic, hex] = line.split(' ');
  if (word !== 'sample' || !readers.has(topic) || !hex) continue;
  const {reader, writer} = readers.get(topic);
  const bytes = Buffer.from(hex, 'hex');
  const message = reader.readMessage(bytes);
  // Nothing is left over but what fills up to four bytes.
  const used = writer.calculateByteSize(message);
  if (bytes.length < used || bytes.length > used + 3) {
    throw new Error(`${topic}: ${bytes.length} bytes, but the message has ${used}`);
  }
  console.log(text({topic, message}));
}
