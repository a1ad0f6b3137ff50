// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens a recording of ROS 2 as Foxglove's own libraries do, and decodes each message by the schema that stands in the file
// and by the definitions of a distribution or of our own package; fails when the two differ.
//   node mcap_messages.mjs NODE_MODULES OWN_PACKAGE FILE jazzy|humble
// prints {"profile": ...}, then {"topic": ..., "type": ..., "message": ...} for each message.
import {createRequire} from 'node:module';
import {open} from 'node:fs/promises';
import {definitionsOf, textOf} from './definitions.mjs';

const [modules, own, file, distro] = process.argv.slice(2);
const require = createRequire(modules + '/');
const {McapIndexedReader} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const {FileHandleReadable} = require('@mcap/nodejs');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');
const definitionOf = definitionsOf(modules, own, distro);

const handle = await open(file, 'r');
const decompressHandlers = await loadDecompressHandlers();
const recording = await McapIndexedReader.Initialize({readable: new FileHandleReadable(handle), decompressHandlers});
console.log(textOf({profile: recording.header.profile}));
const readers = new Map();
for await (const {channelId, data} of recording.readMessages({validateCrcs: true})) {
  const {topic, messageEncoding, schemaId} = recording.channelsById.get(channelId);
  const schema = recording.schemasById.get(schemaId);
  if (schema.encoding !== 'ros2msg' || messageEncoding !== 'cdr') throw new Error(`${topic}: ${schema.encoding}, ${messageEncoding}`);
  if (!readers.has(schemaId)) {
    const inFile = parse(new TextDecoder().decode(schema.data), {ros2: true});
    readers.set(schemaId, [new MessageReader(inFile), new MessageReader(definitionOf(schema.name))]);
  }
  const [message, same] = readers.get(schemaId).map((reader) => textOf(reader.readMessage(data)));
  if (message !== same) throw new Error(`${topic}: by its schema ${message}, by that of ${distro} ${same}`);
  console.log(`{"topic": ${JSON.stringify(topic)}, "type": ${JSON.stringify(schema.name)}, "message": ${message}}`);
}
await handle.close();
