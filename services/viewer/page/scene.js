// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// What has come: for each topic the messages of the last minute as bytes, decoded when they are looked at.

import { parseIdl } from './idl.js';
import { decode, decodeHeader } from './cdr.js';

const kept = 60e3;          // [ms]
const keptBytes = 200e6;    // of all topics
const fitsTogether = 0.3e9; // [ns] a service that is farther behind the newest is not waited for

const kinds = {
  Scan: 'scan', Segments: 'segments', Lines: 'lines', Corners: 'corners', Circles: 'circles',
  LineMap: 'map', Pose: 'pose', Odometry: 'odometry', ServiceStatus: 'status',
};

export class Scene {
  constructor() {
    this.topics = new Map(); // by channel
    this.services = new Map(); // newest heartbeat by label, with when it came
    this.idl = new Map();
    this.bytes = 0;
    this.lastData = 0; // performance.now() of the last message of data
    this.problems = new Map();
  }

  // True when the topic can be shown.
  addChannel(channel) {
    if (channel.schemaEncoding !== 'omgidl' || channel.encoding !== 'cdr') return false;
    if (!this.idl.has(channel.schema)) this.idl.set(channel.schema, parseIdl(channel.schema));
    const types = this.idl.get(channel.schema);
    if (!types.has(channel.schemaName)) return false;
    const parts = channel.topic.split('/');
    const before = [...this.topics.values()].find((topic) => topic.name === channel.topic);
    const topic = before ?? {
      name: channel.topic,
      service: parts.length > 1 ? parts[parts.length - 2] : channel.topic,
      entries: [],
    };
    Object.assign(topic, { kind: kinds[channel.schemaName.split('::').pop()] ?? 'other', types, type: channel.schemaName });
    this.topics.set(channel.id, topic);
    return topic.kind !== 'other';
  }

  // After the connection was lost: ids may mean something else.
  forgetChannels() {
    const topics = [...this.topics.values()];
    this.topics.clear();
    topics.forEach((topic, i) => this.topics.set(-1 - i, topic));
  }

  receive(id, time, bytes) {
    const topic = this.topics.get(id);
    if (!topic) return;
    const now = performance.now();
    try {
      if (topic.kind === 'status') {
        const status = decode(topic.types, topic.type, bytes);
        this.services.set(status.service, { status, received: now });
        return;
      }
      const header = decodeHeader(topic.types, topic.type, bytes);
      const entry = { time, bytes, header, received: now, value: null };
      if (topic.kind === 'map') this.addPart(topic, entry);
      const last = topic.entries.at(-1);
      // A connection that was made anew begins with the newest message once more.
      if (topic.kind !== 'map' && last && header.stamp === last.header.stamp && header.origins[0]?.sequence_number === last.header.origins[0]?.sequence_number) return;
      if (last && header.stamp < last.header.stamp) topic.entries.length = 0; // a replay began again
      topic.entries.push(entry);
      this.bytes += bytes.byteLength;
      this.lastData = now;
      while (topic.entries.length > 1 && (topic.entries[0].received < now - kept || this.bytes > keptBytes)) {
        this.bytes -= topic.entries.shift().bytes.byteLength;
      }
    } catch (error) {
      this.problems.set(topic.name, error.message);
    }
  }

  // A map comes in parts, of which the newest counts; another map takes the place of all.
  addPart(topic, entry) {
    const value = decode(topic.types, topic.type, entry.bytes);
    if (!topic.parts || topic.begun !== value.begun) topic.parts = new Map();
    topic.begun = value.begun;
    topic.parts.set(value.part ?? 0, value.lines);
  }
  mapLines(topic) {
    return [...(topic.parts?.values() ?? [])].flat();
  }

  value(topic, entry) {
    if (!entry.value) {
      try {
        entry.value = decode(topic.types, topic.type, entry.bytes);
      } catch (error) {
        this.problems.set(topic.name, error.message);
        return null;
      }
    }
    return entry.value;
  }

  list(kind) {
    return [...this.topics.values()].filter((topic) => topic.kind === kind).sort((a, b) => a.name < b.name ? -1 : 1);
  }

  // The topic by which is stepped: scans, or what there is.
  primary() {
    for (const kind of ['scan', 'segments', 'lines', 'corners', 'circles', 'pose', 'odometry', 'map']) {
      const topic = this.list(kind).find((each) => each.entries.length > 0);
      if (topic) return topic;
    }
    return null;
  }

  // The newest stamp [ns] that all services have come to which are not far behind.
  newestStamp() {
    let newest = -Infinity;
    const stamps = [];
    for (const topic of this.topics.values()) {
      if (!['scan', 'segments', 'lines', 'corners', 'circles'].includes(topic.kind) || topic.entries.length === 0) continue;
      const stamp = topic.entries.at(-1).header.stamp;
      stamps.push(stamp);
      newest = Math.max(newest, stamp);
    }
    const together = Math.min(...stamps.filter((stamp) => stamp >= newest - fitsTogether));
    if (stamps.length > 0) return together;
    return this.primary()?.entries.at(-1).header.stamp ?? null;
  }

  // The newest entry of a topic at that time; null when there is none.
  entryAt(topic, stamp) {
    const entries = topic.entries;
    let low = 0, high = entries.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (entries[middle].header.stamp <= stamp) low = middle + 1; else high = middle;
    }
    return low > 0 ? entries[low - 1] : null;
  }

  valueAt(topic, stamp) {
    const entry = this.entryAt(topic, stamp);
    return entry ? this.value(topic, entry) : null;
  }

  // [Hz] of a topic over the last two seconds.
  rate(topic) {
    const since = performance.now() - 2000;
    let count = 0;
    for (let i = topic.entries.length - 1; i >= 0 && topic.entries[i].received > since; --i) ++count;
    return count / 2;
  }
}
