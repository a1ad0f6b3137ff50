// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Holds idl/foxglove/foxglove.proto against the schemas that Foxglove publishes: names, numbers and types of all fields.
//   node foxglove_schemas.mjs IDL_FOLDER
import { createRequire } from "node:module";
import path from "node:path";

const require = createRequire(import.meta.url);
const { foxgloveEnumSchemas, foxgloveMessageSchemas, generateProto } = require("@foxglove/schemas/internal");
const protobuf = require("protobufjs");

/** All that goes over the wire of a message. */
function wire(type) {
  const fields = type.fieldsArray.map((f) => `${f.id} ${f.name} ${f.type.replace("foxglove.", "")} ${f.repeated}`).sort();
  const enums = type.nestedArray.filter((e) => e instanceof protobuf.Enum).map((e) => e.name + JSON.stringify(e.values));
  return [...fields, ...enums].join("\n");
}

const root = new protobuf.Root();
root.resolvePath = (_origin, target) => (target.startsWith("google") ? target : path.join(process.argv[2], target));
root.loadSync("foxglove/foxglove.proto");
let messages = 0;
for (const ours of root.lookup("foxglove").nestedArray) {
  if (!(ours instanceof protobuf.Type)) continue;
  const schema = foxgloveMessageSchemas[ours.name];
  const enums = Object.values(foxgloveEnumSchemas).filter((e) => e.parentSchemaName === ours.name);
  const text = generateProto(schema, enums);
  const theirs = protobuf.parse(text, new protobuf.Root()).root.lookupType(`foxglove.${ours.name}`);
  ++messages;
  if (wire(ours) === wire(theirs)) continue;
  process.stderr.write(`${ours.name}:\n${wire(ours)}\nbut published is\n${wire(theirs)}\n`);
  process.exitCode = 1;
}
process.stdout.write(`${messages} messages compared\n`);
