// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Decodes what ros2_peer printed with another implementation of ROS 2's serialization, by the definitions of a distribution
// or of our own package.
//   node decode.mjs NODE_MODULES OWN_PACKAGE OUTPUT_OF_PEER jazzy|humble TOPIC=TYPE...
// prints {"topic": ..., "message": ...} for each sample; fails when one has other than the bytes of its type.
import {createRequire} from 'node:module';
import {readFileSync} from 'node:fs';
import {definitionsOf, textOf} from './definitions.mjs';

const [modules, own, printed, distro, ...pairs] = process.argv.slice(2);
const require = createRequire(modules + '/');
const {MessageReader, MessageWriter} = require('@foxglove/rosmsg2-serialization');
const definitionOf = definitionsOf(modules, own, distro);

const readers = new Map();
for (const pair of pairs) {
  const [topic, type] = pair.split('=');
  const definition = definitionOf(type);
  readers.set(topic, {reader: new MessageReader(definition), writer: new MessageWriter(definition)});
}

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
  console.log(textOf({topic, message}));
}
