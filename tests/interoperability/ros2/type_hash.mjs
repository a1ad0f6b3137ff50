// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Hashes of ROS 2 message types (REP-2011: SHA-256 of the type's description as JSON), from definitions that an npm
// package publishes, or from .msg files of our own package.
//   node type_hash.mjs NODE_MODULES OWN_PACKAGE TYPE...   prints "TYPE HASH" for each
import {createHash} from 'node:crypto';
import {createRequire} from 'node:module';
import {existsSync, readFileSync} from 'node:fs';
import {basename} from 'node:path';

const [modules, own, ...wanted] = process.argv.slice(2);
const require = createRequire(modules + '/');
const {ros2jazzy} = require('@foxglove/rosmsg-msgs-common');
const {parse} = require('@foxglove/rosmsg');

// type_description_interfaces/msg/FieldType; an array of fixed length is 48 more, one without bounds 144.
const ids = {int8: 2, uint8: 3, int16: 4, uint16: 5, int32: 6, uint32: 7, int64: 8, uint64: 9, float32: 10, float64: 11,
             bool: 15, string: 17};
const nested = 1, octet = 16, fixed = 48, unbounded = 144;
const renamed = {time: 'builtin_interfaces/Time', duration: 'builtin_interfaces/Duration'};
// Fields of the type `byte`, which the npm package gives as uint8.
const bytes = new Set(['diagnostic_msgs/DiagnosticStatus.level']);

// Not in the npm package: from Iron on.
const more = {
  'rmw_dds_common/Gid': 'uint8[16] data',
  'rmw_dds_common/NodeEntitiesInfo': 'string<=256 node_namespace\nstring<=256 node_name\nGid[] reader_gid_seq\nGid[] writer_gid_seq',
  'rmw_dds_common/ParticipantEntitiesInfo': 'Gid gid\nNodeEntitiesInfo[] node_entities_info_seq',
};
const boundedString = 21;

function fieldsOf(type) {
  const [pack, short] = type.split('/');
  const file = `${own}/msg/${short}.msg`;
  let text = more[type];
  if (pack === basename(own) && existsSync(file)) text = readFileSync(file, 'utf8');
  const definitions = text === undefined ? ros2jazzy[type]?.definitions : parse(text, {ros2: true, skipTypeFixup: true})[0].definitions;
  if (!definitions) throw new Error(`no definition of ${type}`);
  return definitions.filter((field) => !field.isConstant);
}

function full(type, pack) {
  const name = renamed[type] ?? (type.includes('/') ? type : `${pack}/${type}`);
  return name.replace('/msg/', '/');
}

function describe(type, all) {
  if (all.has(type)) return;
  all.set(type, null);
  const pack = type.split('/')[0];
  const fields = fieldsOf(type).map((field) => {
    let id = ids[field.type], name = '';
    if (bytes.has(`${type}.${field.name}`)) id = octet;
    if (id === undefined) {
      const other = full(field.type, pack);
      describe(other, all);
      id = nested;
      name = other.replace('/', '/msg/');
    }
    let text = 0;
    if (field.type === 'string' && field.upperBound) { id = boundedString; text = field.upperBound; }
    let capacity = 0;
    if (field.isArray) {
      capacity = field.arrayLength ?? 0;
      id += capacity > 0 ? fixed : unbounded;
    }
    return {name: field.name, type: {type_id: id, capacity, string_capacity: text, nested_type_name: name}};
  });
  all.set(type, {type_name: type.replace('/', '/msg/'), fields});
}

// As Python's json.dumps writes it.
function json(value) {
  if (Array.isArray(value)) return '[' + value.map(json).join(', ') + ']';
  if (value !== null && typeof value === 'object') {
    return '{' + Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}: ${json(each)}`).join(', ') + '}';
  }
  return JSON.stringify(value);
}

for (const name of wanted) {
  const type = name.replace('/msg/', '/');
  const all = new Map();
  describe(type, all);
  const referenced = [...all.entries()].filter(([key]) => key !== type).map(([, each]) => each);
  referenced.sort((a, b) => (a.type_name < b.type_name ? -1 : 1));
  const text = json({type_description: all.get(type), referenced_type_descriptions: referenced});
  console.log(`${name} ${createHash('sha256').update(text).digest('hex')}`);
}
