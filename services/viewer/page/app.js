// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The page: what comes by the connection is kept by the scene and drawn as the view says.

import { Connection } from './connection.js';
import { Scene } from './scene.js';
import { Layers } from './layers.js';
import { Picture, itemAt } from './draw.js';
import { CanvasPainter, SvgPainter } from './painter.js';
import { HealthPanel, LayerPanel, describe, detailTable, headingOf, make } from './panels.js';
import { PlaybackBar } from './playback.js';
import { answerOf } from './why.js';

const $ = (id) => document.getElementById(id);
const scene = new Scene();
const layers = new Layers();
const canvas = $('canvas');
const scales = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const staleAfter = 1000; // [ms] without a message

const state = {
  view: { width: 1, height: 1, x: 0, y: 0, scale: 60 },
  fitted: false,     // the view was chosen, by itself or by hand
  moved: false,      // by hand
  follow: false,
  at: null,          // stamp [ns] that is shown; null: the newest
  connected: false,
  reason: '',
  ellipseScale: 0,   // 0: to be chosen
  hover: null,
  selected: null,    // {layer, kind, index}
  why: false,
  pin: null,
  dirty: true,
  items: [],
  mountings: {},     // of sensors, by the service that follows the robot
};

// ---- theme ----

let colors = {};
function readColors() {
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue('--' + name).trim();
  colors = Object.fromEntries(['background', 'text', 'faint', 'grid', 'axis', 'point', 'sensor', 'map', 'circle'].map((name) => [name, color(name)]));
  colors.hues = Array.from({ length: 8 }, (_, i) => color('hue' + i));
  colors.runs = Array.from({ length: 6 }, (_, i) => color('run' + i));
  state.dirty = true;
}
const prefersDark = matchMedia('(prefers-color-scheme: dark)');
let theme = 'auto';
try { theme = localStorage.getItem('theme') ?? 'auto'; } catch { /* storage is off */ }
function applyTheme() {
  const dark = theme === 'dark' || (theme === 'auto' && prefersDark.matches);
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  $('theme').textContent = dark ? 'Light' : 'Dark';
  readColors();
}
function switchTheme() {
  theme = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
  try { localStorage.setItem('theme', theme); } catch { /* for this time only */ }
  applyTheme();
}
prefersDark.onchange = applyTheme;
applyTheme();

// ---- connection ----

const scheme = location.protocol === 'https:' ? 'wss://' : 'ws://';
const connection = new Connection(scheme + location.host + '/' + location.search, {
  state(connected, reason) {
    state.connected = connected;
    state.reason = reason;
    if (!connected) scene.forgetChannels();
    $('why').hidden = true;
    state.dirty = true;
  },
  server(info) {
    $('name').textContent = info.name;
    document.title = (info.name ? info.name + ' – ' : '') + 'Quoin';
  },
  services() {
    $('why').hidden = !connection.services.has('explain');
    if (connection.services.has('mountings')) connection.call('mountings', {}).then((mountings) => { state.mountings = mountings; state.dirty = true; }, () => {});
    refresh();
  },
  channel: (channel) => scene.addChannel(channel),
  message(id, time, bytes) {
    scene.receive(id, time, bytes);
    state.dirty = true;
  },
  status(text, level) { if (level > 0) scene.problems.set('server', text); },
});

// ---- what is shown ----

const shownStamp = () => state.at ?? scene.newestStamp();

// The pose of the sensor in the map, at the time that is shown; null when nobody knows it.
function poseAt(topic, stamp) {
  const value = scene.valueAt(topic, stamp);
  const pose = value?.pose;
  if (!pose || !Number.isFinite(pose.x)) return null;
  return { x: pose.x, y: pose.y, yaw: pose.theta, xx: pose.covariance_xx, xy: pose.covariance_xy, yy: pose.covariance_yy, value };
}
// Of the pose of a robot that of its sensor, where the deployment says how that is mounted.
function sensorOf(pose, service) {
  const mounting = state.mountings[service] ?? Object.values(state.mountings)[0];
  if (!mounting || scene.list('scan').some((topic) => topic.entries.at(-1)?.header.frame === pose.value.child_frame)) return pose;
  const [c, s] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
  return { ...pose, x: pose.x + c * mounting.x - s * mounting.y, y: pose.y + s * mounting.x + c * mounting.y, yaw: pose.yaw + mounting.yaw };
}
// Where the sensor is: in the map, or by its wheels where nobody knows more and that is shown.
function sensorPose(stamp) {
  if (stamp === null) return null;
  // A source gives the truth of a simulation; what was made of scans goes with the map.
  const stages = (layer) => layer.topic.entries.at(-1)?.header.trace.length ?? 0;
  const known = [...layers.of('pose').sort((a, b) => stages(b) - stages(a)), ...layers.of('odometry').filter((layer) => layer.visible)];
  for (const layer of known) {
    const pose = poseAt(layer.topic, stamp);
    if (pose) return { layer, pose: sensorOf(pose, layer.topic.service), robot: pose };
  }
  return null;
}
function trailOf(topic, stamp) {
  const result = [];
  for (const entry of topic.entries) {
    if (entry.header.stamp > stamp) break;
    const pose = scene.value(topic, entry)?.pose;
    if (pose) result.push(pose);
  }
  return result;
}

function draw(painter, view) {
  const shown = layers.all().filter((layer) => layer.visible);
  const ranks = new Map();
  for (const kind of ['lines', 'corners', 'circles']) {
    const same = shown.filter((layer) => layer.kind === kind);
    same.forEach((layer, rank) => ranks.set(layer, [rank, same.length]));
  }
  const picture = new Picture(painter, view, colors, state.ellipseScale || 1, ranks);
  picture.grid();
  const stamp = shownStamp();
  if (stamp === null) return picture;
  const pose = sensorPose(stamp);
  for (const layer of shown.filter((each) => each.kind === 'map')) picture.map(layer, { lines: scene.mapLines(layer.topic) });
  for (const layer of shown.filter((each) => each.kind === 'odometry')) picture.trail(trailOf(layer.topic, stamp), colors.faint, [3, 4]);
  for (const layer of shown.filter((each) => each.kind === 'pose')) picture.trail(trailOf(layer.topic, stamp), colors.sensor);
  picture.usePose(pose?.pose ?? { x: 0, y: 0, yaw: 0 });
  for (const layer of shown) {
    if (['map', 'odometry', 'pose'].includes(layer.kind)) continue;
    const value = scene.valueAt(layer.topic, stamp);
    if (!value) continue;
    if (layer.kind === 'scan') picture.scan(value);
    if (layer.kind === 'segments') picture.segments(value);
    if (layer.kind === 'lines') picture.lines(layer, value);
    if (layer.kind === 'circles') picture.circles(layer, value);
    if (layer.kind === 'corners') picture.corners(layer, value);
  }
  if (pose && pose.layer.visible) picture.poseEllipse(pose.layer, pose.robot, pose.robot.value);
  picture.sensor();
  if (state.pin) picture.pin(state.pin.x, state.pin.y);
  return picture;
}

// Everything of the newest scan, with a margin.
function fit() {
  const view = state.view;
  const stamp = shownStamp();
  let box = null;
  const include = (x, y) => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    box ??= [x, y, x, y];
    box = [Math.min(box[0], x), Math.min(box[1], y), Math.max(box[2], x), Math.max(box[3], y)];
  };
  if (stamp !== null) {
    // Where things are with a metre to a pixel about the origin.
    const probe = new Picture(new CanvasPainter(document.createElement('canvas').getContext('2d')),
      { width: 0, height: 0, x: 0, y: 0, scale: 1 }, colors, 1);
    probe.usePose(sensorPose(stamp)?.pose ?? { x: 0, y: 0, yaw: 0 });
    const point = (x, y) => { const [sx, sy] = probe.sensed(x, y); include(sx, -sy); };
    for (const topic of scene.list('scan')) {
      const scan = scene.valueAt(topic, stamp);
      if (!scan) continue;
      for (let i = 0; i < scan.ranges.length; ++i) {
        const range = scan.ranges[i];
        if (range > scan.range_min && range < scan.range_max) point(range * Math.cos(scan.bearings[i]), range * Math.sin(scan.bearings[i]));
      }
    }
    for (const topic of scene.list('lines')) {
      for (const line of scene.valueAt(topic, stamp)?.lines ?? []) { point(line.start.x, line.start.y); point(line.end.x, line.end.y); }
    }
    for (const topic of scene.list('map')) {
      for (const line of scene.mapLines(topic)) { include(line.start.x, line.start.y); include(line.end.x, line.end.y); }
    }
  }
  if (!box) return false;
  view.x = (box[0] + box[2]) / 2;
  view.y = (box[1] + box[3]) / 2;
  view.scale = 0.86 * Math.min(view.width / Math.max(1, box[2] - box[0]), (view.height - 20) / Math.max(1, box[3] - box[1]));
  state.dirty = true;
  return true;
}

// So that the median ellipse can be seen.
function chooseEllipseScale(stamp) {
  const axes = [];
  for (const topic of scene.list('corners')) axes.push(...(scene.valueAt(topic, stamp)?.corners ?? []).map((corner) => corner.ellipse95_major));
  if (axes.length === 0) return;
  axes.sort((a, b) => a - b);
  const wanted = 18 / (axes[axes.length >> 1] * state.view.scale);
  setEllipseScale(Math.max(0, scales.findLastIndex((scale) => scale <= wanted)));
}
function setEllipseScale(index) {
  state.ellipseScale = scales[index];
  $('ellipses').value = index;
  $('ellipse-scale').textContent = '× ' + scales[index];
  state.dirty = true;
}

function sameItem(a, b) { return a && b && a.layer === b.layer && a.kind === b.kind && a.index === b.index; }

function render() {
  requestAnimationFrame(render);
  if (!state.dirty) return;
  state.dirty = false;
  const began = performance.now();
  layers.update(scene);
  if (!state.fitted) state.fitted = fit();
  const stamp = shownStamp();
  if (state.ellipseScale === 0 && stamp !== null && state.fitted) chooseEllipseScale(stamp);
  const { view } = state;
  if (state.follow && stamp !== null) {
    const pose = sensorPose(stamp)?.pose;
    view.x = pose?.x ?? 0;
    view.y = pose?.y ?? 0;
  }
  const ratio = devicePixelRatio;
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = colors.background;
  context.fillRect(0, 0, view.width, view.height);
  const picture = draw(new CanvasPainter(context), view);
  state.items = picture.items;
  const marked = state.items.find((item) => sameItem(item, state.hover)) ?? state.items.find((item) => sameItem(item, state.selected));
  if (marked) picture.highlight(marked);
  ++frames;
  drawing += performance.now() - began;
}
let frames = 0;
let drawing = 0; // [ms] that all frames took

// ---- what is written beside it ----

const layerPanel = new LayerPanel($('layers'), layers, () => { state.dirty = true; });
const playbackBar = new PlaybackBar(
  { bar: $('playback'), pause: $('replay-pause'), step: $('replay-step'), speed: $('replay-speed'), where: $('replay-where') },
  (request) => connection.call('playback', request).then(() => scene.problems.delete('replay'), (error) => scene.problems.set('replay', error.message)));
const healthPanel = new HealthPanel($('services'), $('health-summary'));

function setPill(kind, text) {
  if ($('pill').className !== kind) $('pill').className = kind;
  if ($('pill').textContent !== text) $('pill').textContent = text;
}
function setBanner(kind, title, text) {
  const banner = $('banner');
  banner.hidden = !title;
  if (!title || banner.dataset.text === title + text) return;
  banner.dataset.text = title + text;
  banner.className = kind;
  banner.replaceChildren(title, make('small', {}, text));
}

function refresh() {
  const now = performance.now();
  const primary = scene.primary();
  const quiet = now - scene.lastData;
  const stamp = shownStamp();
  if (!state.connected) {
    setPill('off', 'not connected');
    setBanner('off', 'Not connected to ' + location.host,
      (primary ? 'The picture is old. ' : '') + (state.reason ? state.reason + '. ' : '') +
      'Trying again. Is the deployment running?' + (location.search ? '' : ' Elsewhere than on its own host the address needs its token.'));
  } else if (!primary && playbackBar.holds()) {
    setPill('paused', 'replay paused');
    setBanner('stale', 'The replay is paused', 'Nothing has been published yet: resume or step it below.');
  } else if (!primary) {
    setPill('stale', 'no data');
    setBanner('stale', 'Connected, but nothing has been published yet', scene.services.size > 0 ? 'Services report; see Health.' : 'No heartbeat has come either.');
  } else if (state.at !== null) {
    setPill('paused', 'paused');
    setBanner('', '', '');
  } else if (quiet > staleAfter && playbackBar.holds()) {
    setPill('paused', 'replay paused');
    setBanner('', '', '');
  } else if (quiet > staleAfter) {
    const silent = [...scene.services.values()].filter(({ status, received }) => now - received > 3000 || status.state === 'STATE_FAILED').map(({ status }) => status.service);
    const ended = [...scene.services.values()].filter(({ status }) => ['STATE_FINISHED', 'STATE_STOPPED'].includes(status.state)).map(({ status }) => status.service);
    setPill('stale', 'data has stopped');
    setBanner('stale', `No data for ${(quiet / 1000).toFixed(0)} s`,
      silent.length > 0 ? 'Not heard any more: ' + silent.join(', ') : ended.length > 0 ? 'Finished or stopped: ' + ended.join(', ') : 'The picture is the last that came.');
  } else {
    setPill('live', 'live ' + scene.rate(primary).toFixed(1) + ' Hz');
    setBanner('', '', '');
  }
  if (primary && stamp !== null) {
    const header = scene.entryAt(primary, stamp)?.header;
    const origin = header?.origins[0];
    $('clock').textContent = (origin ? origin.source + ' #' + origin.sequence_number + ' · ' : '') + new Date(stamp / 1e6).toISOString().slice(11, 23) + ' UTC';
    const newest = primary.entries.at(-1).header.stamp;
    const oldest = primary.entries[0].header.stamp;
    $('past').min = Math.min(-1, -(newest - oldest) / 1e9).toFixed(2);
    if (document.activeElement !== $('past')) $('past').value = state.at === null ? 0 : (state.at - newest) / 1e9;
    $('when').textContent = state.at === null ? 'live' : ((state.at - newest) / 1e9).toFixed(2) + ' s';
  }
  $('scale-note').textContent = layers.of('corners').length + layers.of('circles').length > 0 ? `95 % ellipses, ${state.ellipseScale > 1 ? 'enlarged ' + state.ellipseScale + ' times' : 'to scale'}` : '';
  layerPanel.update(scene, stamp);
  healthPanel.update(scene);
  $('notes').replaceChildren(...[...scene.problems].map(([name, text]) => make('li', {}, name + ': ' + text)));
  if (state.selected) showDetails(state.items.find((item) => sameItem(item, state.selected)));
  playbackBar.update(scene.services, connection.services.has('playback'));
  setPressed('pause', state.at !== null);
  setPressed('follow', state.follow);
  setPressed('why', state.why);
}
const setPressed = (id, on) => $(id).setAttribute('aria-pressed', String(on));

function showDetails(item) {
  if (!item) {
    $('details-title').textContent = 'Details';
    return;
  }
  $('details-title').textContent = headingOf(item);
  $('details').replaceChildren(detailTable(describe(item)));
}
function select(item) {
  state.selected = item ? { layer: item.layer, kind: item.kind, index: item.index } : null;
  if (item) {
    showDetails(item);
    showTab('details');
  } else {
    $('details-title').textContent = 'Details';
    $('details').replaceChildren(make('p', { className: 'hint' }, 'Point at a line, a corner or a circle, or tap it.'));
  }
  state.dirty = true;
}

// ---- time ----

function pause() {
  state.at = state.at === null ? scene.newestStamp() : null;
  state.dirty = true;
  refresh();
}
function step(by) {
  const primary = scene.primary();
  if (!primary) return;
  const stamp = shownStamp();
  const index = primary.entries.findLastIndex((entry) => entry.header.stamp <= stamp);
  const entry = primary.entries[Math.max(0, Math.min(primary.entries.length - 1, index + by))];
  state.at = entry.header.stamp;
  state.dirty = true;
  refresh();
}
$('pause').onclick = pause;
$('back').onclick = () => step(-1);
$('forth').onclick = () => step(1);
$('past').oninput = () => {
  const primary = scene.primary();
  if (!primary) return;
  const value = Number($('past').value);
  const wanted = primary.entries.at(-1).header.stamp + value * 1e9;
  state.at = value >= 0 ? null : (scene.entryAt(primary, wanted) ?? primary.entries[0]).header.stamp;
  state.dirty = true;
};

// ---- moving about ----

function zoom(factor, x = state.view.width / 2, y = state.view.height / 2) {
  const view = state.view;
  const next = Math.max(2, Math.min(20000, view.scale * factor));
  view.x += (x - view.width / 2) * (1 / view.scale - 1 / next);
  view.y -= (y - view.height / 2) * (1 / view.scale - 1 / next);
  view.scale = next;
  state.fitted = state.moved = true;
  state.dirty = true;
}
function move(dx, dy) {
  state.view.x -= dx / state.view.scale;
  state.view.y += dy / state.view.scale;
  state.follow = false;
  state.fitted = state.moved = true;
  state.dirty = true;
}
$('fit').onclick = () => { state.follow = state.moved = false; fit(); };
$('closer').onclick = () => zoom(1.4);
$('wider').onclick = () => zoom(1 / 1.4);
$('follow').onclick = () => { state.follow = !state.follow; state.dirty = true; refresh(); };
$('why').onclick = () => { state.why = !state.why; canvas.classList.toggle('why', state.why); refresh(); };

const pointers = new Map();
let moved = 0;
canvas.onpointerdown = (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
  moved = 0;
};
canvas.onpointermove = (event) => {
  const before = pointers.get(event.pointerId);
  const here = [event.offsetX, event.offsetY];
  if (!before) return hover(...here);
  const others = [...pointers].filter(([id]) => id !== event.pointerId);
  if (others.length > 0) { // two fingers
    const other = others[0][1];
    const distance = (a) => Math.hypot(a[0] - other[0], a[1] - other[1]);
    zoom(distance(here) / Math.max(1, distance(before)), other[0], other[1]);
  } else {
    moved += Math.hypot(here[0] - before[0], here[1] - before[1]);
    if (moved > 4) move(here[0] - before[0], here[1] - before[1]);
  }
  pointers.set(event.pointerId, here);
};
canvas.onpointerup = canvas.onpointercancel = (event) => {
  pointers.delete(event.pointerId);
  if (event.type === 'pointerup' && moved <= 4) click(event.offsetX, event.offsetY, event.pointerType);
};
canvas.onpointerleave = () => hover(-1e9, -1e9);
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  zoom(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), event.offsetX, event.offsetY);
}, { passive: false });

function hover(x, y) {
  const item = itemAt(state.items, x, y);
  if (!sameItem(item, state.hover)) state.dirty = true;
  state.hover = item;
  const tip = $('tip');
  tip.hidden = !item;
  if (!item) return;
  tip.replaceChildren(make('h3', {}, headingOf(item)), detailTable(describe(item)));
  const right = x + tip.offsetWidth + 24 < state.view.width;
  tip.style.left = (right ? x + 16 : Math.max(4, x - tip.offsetWidth - 16)) + 'px';
  tip.style.top = Math.max(4, Math.min(y - 20, state.view.height - tip.offsetHeight - 8)) + 'px';
}

function click(x, y, pointer) {
  if (state.why) return explain(x, y);
  select(itemAt(state.items, x, y, pointer === 'touch' ? 24 : 12));
}

// ---- why is there no line ----

async function explain(x, y) {
  const view = state.view;
  const stamp = shownStamp();
  const pose = sensorPose(stamp)?.pose ?? { x: 0, y: 0, yaw: 0 };
  const dx = view.x + (x - view.width / 2) / view.scale - pose.x;
  const dy = view.y - (y - view.height / 2) / view.scale - pose.y;
  const place = { x: Math.cos(pose.yaw) * dx + Math.sin(pose.yaw) * dy, y: Math.cos(pose.yaw) * dy - Math.sin(pose.yaw) * dx };
  state.pin = place;
  state.selected = null;
  state.dirty = true;
  showTab('details');
  $('details-title').textContent = `Why at ${place.x.toFixed(2)}, ${place.y.toFixed(2)} m?`;
  const answers = [];
  for (const layer of layers.of('lines').filter((each) => each.visible)) {
    try {
      answers.push(answerOf(layer.topic.service, await connection.call('explain', { service: layer.topic.service, stamp, ...place })));
    } catch (error) {
      answers.push(make('p', { className: 'answer' }, make('b', {}, layer.topic.service + ': '), error.message));
    }
  }
  $('details').replaceChildren(...answers);
}

// ---- saving ----

function svg() {
  const painter = new SvgPainter(state.view.width, state.view.height, colors.background);
  draw(painter, state.view);
  return painter.finish();
}
function save(blob, extension) {
  const link = make('a', { href: URL.createObjectURL(blob), download: `quoin-${new Date().toISOString().slice(0, 19).replaceAll(':', '')}.${extension}` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
$('save-svg').onclick = () => save(new Blob([svg()], { type: 'image/svg+xml' }), 'svg');
$('save-png').onclick = () => canvas.toBlob((blob) => save(blob, 'png'), 'image/png');
$('ellipses').oninput = () => setEllipseScale(Number($('ellipses').value));
$('theme').onclick = switchTheme;
$('help').onclick = () => $('keys').showModal();

// ---- tabs of narrow screens, keys, size ----

function showTab(name) {
  for (const each of ['layers', 'details', 'health']) {
    $('panel-' + each).classList.toggle('shown', each === name);
    $('tab-' + each).setAttribute('aria-selected', String(each === name));
  }
}
for (const each of ['layers', 'details', 'health']) $('tab-' + each).onclick = () => showTab(each);
showTab('layers');

const keys = {
  '+': () => zoom(1.25), '=': () => zoom(1.25), '-': () => zoom(0.8), '0': () => $('fit').click(), 'f': () => $('follow').click(),
  ' ': pause, ',': () => step(-1), '.': () => step(1), 'e': () => { if (!$('why').hidden) $('why').click(); },
  's': () => $('save-svg').click(), 't': switchTheme, '?': () => $('help').click(),
  'n': () => selectNext(1), 'p': () => selectNext(-1), 'Escape': () => { state.pin = null; select(null); },
};
const arrows = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
function selectNext(by) {
  if (state.items.length === 0) return;
  const index = state.items.findIndex((item) => sameItem(item, state.selected));
  const next = index < 0 ? (by > 0 ? 0 : state.items.length - 1) : (index + by + state.items.length) % state.items.length;
  select(state.items[next]);
}
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || $('keys').open) return;
  if (['INPUT', 'SELECT'].includes(event.target.tagName) && event.target.type !== 'checkbox') return;
  if (event.key === ' ' && event.target !== canvas && event.target !== document.body) return;
  if (arrows[event.key] && event.target === canvas) { move(...arrows[event.key]); event.preventDefault(); return; }
  const action = keys[event.key];
  if (action) { action(); event.preventDefault(); }
});

new ResizeObserver(() => {
  state.view.width = canvas.clientWidth;
  state.view.height = canvas.clientHeight;
  canvas.width = Math.round(canvas.clientWidth * devicePixelRatio);
  canvas.height = Math.round(canvas.clientHeight * devicePixelRatio);
  if (!state.moved) state.fitted = false;
  state.dirty = true;
}).observe(canvas);

setInterval(refresh, 250);
refresh();
requestAnimationFrame(render);

// For scripts: the picture as SVG, what is in it, frames drawn so far.
window.quoin = { svg, items: () => state.items, view: () => ({ ...state.view }), frames: () => ({ frames, drawing }), scene };
