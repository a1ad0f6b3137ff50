// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Opens a recording as Foxglove's own libraries do: the stream with all checksums, the index, and each message by the
// schema that stands in the file. Prints what it found as one JSON object; throws at anything that is wrong.
//   node mcap.mjs FILE
import { createRequire } from "node:module";
import fs from "node:fs/promises";

const require = createRequire(import.meta.url);
const { McapStreamReader, McapIndexedReader } = require("@mcap/core");
const { loadDecompressHandlers } = require("@mcap/support");
const { FileHandleReadable } = require("@mcap/nodejs");
const { MessageReader } = require("@foxglove/omgidl-serialization");
const { parseIDL } = require("@foxglove/omgidl-parser");
const protobuf = require("protobufjs");
const { FileDescriptorSet } = require("protobufjs/ext/descriptor");

function decoder(schema) {
  if (schema.encoding === "omgidl") {
    const reader = new MessageReader(schema.name, parseIDL(new TextDecoder().decode(schema.data)));
    return (data) => reader.readMessage(data);
  }
  if (schema.encoding === "protobuf") {
    const type = protobuf.Root.fromDescriptor(FileDescriptorSet.decode(schema.data)).lookupType(schema.name);
    return (data) => type.decode(data);
  }
  throw new Error(`schema of encoding ${schema.encoding}`);
}

async function main(file) {
  const decompressHandlers = await loadDecompressHandlers();
  const found = { topics: {}, metadata: {}, attachments: [] };

  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(await fs.readFile(file));
  let streamed = 0;
  for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
    if (record.type === "Message") ++streamed;
    if (record.type === "Attachment") found.attachments.push(record.name);
  }
  if (!stream.done()) throw new Error("the stream does not end as it should");

  const handle = await fs.open(file, "r");
  const indexed = await McapIndexedReader.Initialize({ readable: new FileHandleReadable(handle), decompressHandlers });
  const decoders = new Map();
  let indexedMessages = 0;
  for await (const message of indexed.readMessages({ validateCrcs: true })) {
    const channel = indexed.channelsById.get(message.channelId);
    const schema = indexed.schemasById.get(channel.schemaId);
    if (!decoders.has(channel.schemaId)) decoders.set(channel.schemaId, decoder(schema));
    const decoded = decoders.get(channel.schemaId)(message.data);
    const topic = (found.topics[channel.topic] ??= { schema: schema.name, messages: 0, elements: 0 });
    ++topic.messages;
    for (const field of ["lines", "corners", "ranges", "entities"]) topic.elements += decoded[field]?.length ?? 0;
    ++indexedMessages;
  }
  for await (const metadata of indexed.readMetadata()) found.metadata[metadata.name] = Object.fromEntries(metadata.metadata);
  await handle.close();
  const statistics = Number(indexed.statistics.messageCount);
  if (streamed !== indexedMessages || streamed !== statistics) {
    throw new Error(`${streamed} messages in the stream, ${indexedMessages} in the index, ${statistics} in the statistics`);
  }
  found.messages = streamed;
  process.stdout.write(JSON.stringify(found, undefined, 1) + "\n");
}

main(process.argv[2]).catch((error) => {
  process.stderr.write(`${error.stack}\n`);
  process.exitCode = 1;
});
