// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// What is drawn of each topic, in which colour, and how far services that do the same are apart.

const order = ['map', 'scan', 'segments', 'lines', 'circles', 'corners', 'odometry', 'pose'];
const labels = {
  scan: 'scan', segments: 'segments', lines: 'lines', corners: 'corners', circles: 'circles',
  map: 'map', pose: 'pose', odometry: 'odometry',
};
const nearEnough = 0.3; // [m] corners of two services are the same

export class Layers {
  constructor() {
    this.byName = new Map();
    this.reference = ''; // name of a topic of corners
  }

  // The layers of all topics that have messages, from the ground up.
  update(scene) {
    for (const topic of scene.topics.values()) {
      if (!order.includes(topic.kind) || topic.entries.length === 0 || this.byName.has(topic.name)) continue;
      this.byName.set(topic.name, { name: topic.name, topic, kind: topic.kind, label: labels[topic.kind], visible: true, hue: -1 });
    }
    for (const layer of this.byName.values()) {
      layer.topic = [...scene.topics.values()].find((topic) => topic.name === layer.name) ?? layer.topic;
    }
    const lines = this.of('lines');
    lines.forEach((layer, i) => { layer.hue = i % 8; });
    for (const layer of this.of('corners')) {
      // The colour of the lines that they are made of.
      const trace = layer.topic.entries.at(-1)?.header.trace ?? [];
      const from = lines.find((each) => trace.some((stage) => stage.service === each.topic.service));
      layer.hue = from ? from.hue : 0;
    }
    if (!this.byName.has(this.reference)) this.reference = this.of('corners')[0]?.name ?? '';
  }

  of(kind) {
    return [...this.byName.values()].filter((layer) => layer.kind === kind).sort((a, b) => a.name < b.name ? -1 : 1);
  }

  all() {
    return order.flatMap((kind) => this.of(kind));
  }
}

// How far the corners of one message are from the nearest of another: {matched, of, median [m]}.
export function distanceBetween(corners, others) {
  const distances = [];
  for (const corner of corners) {
    let nearest = Infinity;
    for (const other of others) nearest = Math.min(nearest, Math.hypot(corner.x - other.x, corner.y - other.y));
    if (nearest < nearEnough) distances.push(nearest);
  }
  distances.sort((a, b) => a - b);
  return { matched: distances.length, of: others.length, median: distances.length > 0 ? distances[distances.length >> 1] : NaN };
}

// How many things a message has, for the list of layers.
export function countOf(kind, message) {
  switch (kind) {
    case 'scan': return message.ranges.length + ' rays';
    case 'segments': return message.segments.length + ' walls' + (message.arcs.length > 0 ? ', ' + message.arcs.length + ' arcs' : '');
    case 'lines': return message.lines.length + (message.failures.length > 0 ? ', ' + message.failures.length + ' failed' : '');
    case 'corners': return String(message.corners.length);
    case 'circles': return String(message.circles.length);
    case 'map': return String(message.lines?.length ?? '');
    default: return '';
  }
}
