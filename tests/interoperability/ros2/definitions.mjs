// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Definitions of message types, of a distribution or of our own package, and messages as texts.
import {createRequire} from 'node:module';
import {readdirSync, readFileSync} from 'node:fs';
import {basename} from 'node:path';

// `distro`: jazzy or humble. Returns a function from "package/msg/Type" to what MessageReader takes.
export function definitionsOf(modules, own, distro) {
  const require = createRequire(modules + '/');
  const common = require('@foxglove/rosmsg-msgs-common');
  const {parse} = require('@foxglove/rosmsg');
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
  return definitionOf;
}

// JSON has no numbers without value, no typed arrays, and no integers of 64 bits but as they are written.
const plain = (key, value) => {
  if (typeof value === 'bigint') return `@${value}@`;
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value);
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
};
export const textOf = (value) => JSON.stringify(value, plain).replace(/"@(-?\d+)@"/g, '$1');
