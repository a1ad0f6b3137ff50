// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes message definitions of ROS 2, as an npm package publishes them, as .msg files: each type named and all that it is
// made of. Prints them, one "PACKAGE NAME" a line, each behind those that it needs.
//   node write_messages.mjs NODE_MODULES FOLDER PACKAGE/NAME...
import {createRequire} from 'node:module';
import {mkdirSync, writeFileSync} from 'node:fs';

const [modules, folder, ...wanted] = process.argv.slice(2);
const require = createRequire(modules + '/');
const {ros2jazzy} = require('@foxglove/rosmsg-msgs-common');
const basic = {time: 'builtin_interfaces/Time', duration: 'builtin_interfaces/Duration'};

const written = new Set();
function write(type) {
  if (written.has(type)) return;
  written.add(type);
  const definition = ros2jazzy[type];
  if (!definition) throw new Error(`no definition of ${type}`);
  const lines = [];
  for (const field of definition.definitions) {
    if (field.isConstant) continue;
    const name = basic[field.type] ?? field.type;
    if (name.includes('/')) write(name);
    const array = field.isArray ? `[${field.arrayLength ?? ''}]` : '';
    lines.push(`${name}${array} ${field.name}`);
  }
  const [pack, short] = type.split('/');
  mkdirSync(`${folder}/${pack}/msg`, {recursive: true});
  writeFileSync(`${folder}/${pack}/msg/${short}.msg`, lines.join('\n') + '\n');
  console.log(`${pack} ${short}`);
}
wanted.forEach(write);
