// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The lists beside the picture: layers, what is pointed at, how the services are.

import { countOf, distanceBetween } from './layers.js';
import { elementType, formatted, rowsOf } from './values.js';

// An element with properties and children.
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith('aria-') || name === 'role' || name === 'for') element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children);
  return element;
}

// Keeps the elements of a list by key, so that what has the focus keeps it.
class KeyedList {
  constructor(parent, create) {
    this.parent = parent;
    this.create = create;
    this.rows = new Map();
  }
  update(keys, fill) {
    for (const [key, row] of this.rows) {
      if (!keys.includes(key)) { row.element.remove(); this.rows.delete(key); }
    }
    keys.forEach((key, i) => {
      let row = this.rows.get(key);
      if (!row) { row = this.create(key); this.rows.set(key, row); }
      if (this.parent.children[i] !== row.element) this.parent.insertBefore(row.element, this.parent.children[i] ?? null);
      fill(key, row);
    });
  }
}

const setText = (element, text) => { if (element.textContent !== text) element.textContent = text; };

export class LayerPanel {
  constructor(parent, layers, changed) {
    this.layers = layers;
    this.list = new KeyedList(parent, (name) => {
      const layer = layers.byName.get(name);
      const box = make('input', { type: 'checkbox', checked: layer.visible });
      box.onchange = () => { layer.visible = box.checked; changed(); };
      const swatch = make('span', { className: 'swatch ' + layer.kind });
      const count = make('span', { className: 'count' });
      const distance = make('span', { className: 'distance' });
      const label = make('label', {}, box, swatch,
        make('span', { className: 'name' }, make('b', {}, layer.topic.service), ' ' + layer.label), count);
      const element = make('li', {}, label, distance);
      let choose = null;
      if (layer.kind === 'corners') {
        choose = make('button', { type: 'button', className: 'reference', title: 'compare the others with this one' }, 'ref');
        choose.onclick = () => { layers.reference = name; changed(); };
        label.after(choose);
      }
      return { element, box, swatch, count, distance, choose };
    });
  }

  update(scene, stamp) {
    const all = this.layers.all();
    const reference = this.layers.byName.get(this.layers.reference);
    const against = reference && stamp !== null ? scene.valueAt(reference.topic, stamp) : null;
    const several = this.layers.of('corners').length > 1;
    this.list.update(all.map((layer) => layer.name), (name, row) => {
      const layer = this.layers.byName.get(name);
      row.box.checked = layer.visible;
      row.swatch.dataset.hue = layer.hue;
      const value = stamp === null ? null : layer.kind === 'map' ? { lines: scene.mapLines(layer.topic) } : scene.valueAt(layer.topic, stamp);
      setText(row.count, value ? countOf(layer.kind, value) : '');
      if (!row.choose) return;
      row.choose.hidden = !several;
      row.choose.setAttribute('aria-pressed', String(layer === reference));
      let text = '';
      if (several && layer !== reference && value && against) {
        const d = distanceBetween(value.corners, against.corners);
        const [median, unit] = formatted(d.median, 'm', 2);
        text = d.matched > 0 ? `Δ ${median} ${unit} median, ${d.matched} of ${d.of} matched` : 'no corner near one of the reference';
      }
      setText(row.distance, text);
    });
  }
}

// What an item is: a heading and rows.
export function describe(item) {
  const topic = item.layer.topic;
  if (item.kind === 'pose') return rowsOf(topic.types, topic.type, item.value);
  const field = { line: 'lines', corner: 'corners', circle: 'circles', 'map line': 'lines' }[item.kind];
  return rowsOf(topic.types, elementType(topic.types, topic.type, field), item.value);
}

export function headingOf(item) {
  return `${item.kind} ${item.index} of ${item.layer.topic.service}`;
}

export function detailTable(rows) {
  const body = make('tbody');
  for (const row of rows) {
    body.append(make('tr', { title: row.doc }, make('th', { scope: 'row' }, row.name), make('td', {}, row.text),
      make('td', { className: 'unit' }, row.unit)));
  }
  return make('table', { className: 'details' }, body);
}

const stateText = (state) => String(state).replace('STATE_', '').toLowerCase();
const overdue = 3000; // [ms] heartbeats come once a second

export class HealthPanel {
  constructor(parent, summary) {
    this.summary = summary;
    this.list = new KeyedList(parent, () => {
      const cells = {};
      const element = make('tr');
      for (const name of ['service', 'state', 'rate', 'published', 'lost', 'latency', 'memory', 'age']) {
        cells[name] = make(name === 'service' ? 'th' : 'td', { className: name });
        element.append(cells[name]);
      }
      cells.service.scope = 'row';
      return { element, cells };
    });
  }

  update(scene) {
    const now = performance.now();
    const names = [...scene.services.keys()].sort();
    let bad = 0, lost = 0;
    this.list.update(names, (name, { element, cells }) => {
      const { status, received } = scene.services.get(name);
      const age = now - received;
      const state = stateText(status.state);
      const ended = state === 'finished' || state === 'stopped';
      const silent = age > overdue && !ended;
      const failed = state === 'failed' || silent || status.incompatible_qos.length > 0;
      bad += failed ? 1 : 0;
      lost += status.lost;
      element.className = failed ? 'bad' : ended ? 'ended' : status.lost > 0 ? 'warned' : '';
      setText(cells.service, name);
      cells.service.title = status.kind + (status.method ? '/' + status.method : '') + ' on ' + status.host + ', process ' + status.pid;
      setText(cells.state, silent ? 'silent' : state);
      cells.state.title = [status.detail, ...status.incompatible_qos].filter((text) => text).join('; ');
      setText(cells.rate, status.rate.toFixed(1));
      setText(cells.published, String(status.outputs.length > 0 ? status.published : '–'));
      setText(cells.lost, String(status.lost));
      cells.lost.title = status.losses.filter((loss) => loss.count > 0).map((loss) => loss.count + ' ' + loss.cause).join(', ');
      const has = status.latency_p99 > 0;
      setText(cells.latency, has ? (status.latency_p50 * 1e3).toFixed(1) + ' / ' + (status.latency_p99 * 1e3).toFixed(1) : '–');
      setText(cells.memory, (status.resident_memory / 1048576).toFixed(0));
      setText(cells.age, (age / 1000).toFixed(0) + ' s');
    });
    const text = names.length === 0 ? 'no heartbeat yet' :
      bad > 0 ? `${bad} of ${names.length} services need a look` :
        `${names.length} services` + (lost > 0 ? `, ${lost} scans lost` : ', nothing lost');
    setText(this.summary, text);
    this.summary.className = bad > 0 ? 'bad' : lost > 0 ? 'warned' : 'good';
  }
}
