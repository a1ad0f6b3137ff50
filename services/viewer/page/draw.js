// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Draws what the services published at one time, with a painter, and says where each thing is.

const probability95 = 5.991464547107979; // chi square of two degrees of freedom

// The ellipse of a 2x2 covariance that holds 95 %: semi-axes and direction of the major one.
export function ellipseOf(xx, xy, yy) {
  const mean = (xx + yy) / 2;
  const difference = Math.hypot((xx - yy) / 2, xy);
  return {
    major: Math.sqrt(Math.max(0, (mean + difference) * probability95)),
    minor: Math.sqrt(Math.max(0, (mean - difference) * probability95)),
    direction: 0.5 * Math.atan2(2 * xy, xx - yy),
  };
}

// x and y of each valid ray.
function pointsOf(bearings, ranges, least, most) {
  const points = [];
  for (let i = 0; i < bearings.length; ++i) {
    const range = ranges[i];
    if (!(range > least) || !(range < most) || !Number.isFinite(range)) continue;
    points.push(range * Math.cos(bearings[i]), range * Math.sin(bearings[i]));
  }
  return points;
}

export class Picture {
  // view: {width, height, x, y (world at the centre) [m], scale [pixel/m]}. ranks: of each layer among those of its kind,
  // [rank, count]: of services that see the same, the first is drawn widest, so that all show.
  constructor(painter, view, colors, ellipseScale, ranks = new Map()) {
    Object.assign(this, { painter, view, colors, ellipseScale, ranks });
    this.items = []; // what can be pointed at: {kind, layer, value, index, x, y} or with x1, y1, x2, y2
    this.pose = { x: 0, y: 0, yaw: 0 };
  }

  wider(layer) {
    const [rank, count] = this.ranks.get(layer) ?? [0, 1];
    return 1.2 * Math.min(3, count - 1 - rank);
  }

  toScreen(x, y) {
    const v = this.view;
    return [v.width / 2 + (x - v.x) * v.scale, v.height / 2 - (y - v.y) * v.scale];
  }
  // Of a point in the sensor's frame.
  sensed(x, y) {
    const { x: px, y: py, cos, sin } = this.pose;
    return this.toScreen(px + cos * x - sin * y, py + sin * x + cos * y);
  }
  usePose(pose) {
    this.pose = { ...pose, cos: Math.cos(pose.yaw), sin: Math.sin(pose.yaw) };
  }

  grid() {
    const { painter, view, colors } = this;
    const least = 56 / view.scale;
    const power = 10 ** Math.floor(Math.log10(least));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= least);
    const digits = Math.max(0, -Math.floor(Math.log10(step)));
    painter.group('grid');
    const left = view.x - view.width / 2 / view.scale, right = view.x + view.width / 2 / view.scale;
    const low = view.y - view.height / 2 / view.scale, high = view.y + view.height / 2 / view.scale;
    for (let i = Math.ceil(left / step); i * step <= right; ++i) {
      const [x] = this.toScreen(i * step, 0);
      painter.line(x, 0, x, view.height, { stroke: i === 0 ? colors.axis : colors.grid });
      painter.text(x + 3, view.height - 6, (i * step).toFixed(digits), colors.faint);
    }
    for (let i = Math.ceil(low / step); i * step <= high; ++i) {
      const [, y] = this.toScreen(0, i * step);
      painter.line(0, y, view.width, y, { stroke: i === 0 ? colors.axis : colors.grid });
      painter.text(4, y - 3, (i * step).toFixed(digits), colors.faint);
    }
    painter.end();
    const [, bar] = [0, view.height - 26];
    const length = step * view.scale;
    painter.line(view.width - 16 - length, bar, view.width - 16, bar, { stroke: colors.text, width: 2 });
    painter.text(view.width - 16 - length / 2, bar - 6, step < 1 ? (step * 100).toFixed(0) + ' cm' : step + ' m', colors.text, 'center');
  }

  scan(message) {
    const size = Math.min(4, Math.max(2, this.view.scale / 30));
    const points = pointsOf(message.bearings, message.ranges, message.range_min, message.range_max);
    this.painter.group('scan');
    this.painter.dots(this.screen(points), size, this.colors.point);
    this.painter.end();
  }
  screen(points) {
    const result = new Array(points.length);
    for (let i = 0; i < points.length; i += 2) [result[i], result[i + 1]] = this.sensed(points[i], points[i + 1]);
    return result;
  }

  segments(message) {
    const size = Math.min(6, Math.max(3, this.view.scale / 20));
    const run = (range) => this.screen(pointsOf(
      message.bearings.subarray(range.begin, range.end), message.ranges.subarray(range.begin, range.end), 0, Infinity));
    this.painter.group('segments');
    message.segments.forEach((range, i) => this.painter.dots(run(range), size, this.colors.runs[i % this.colors.runs.length], 0.75));
    for (const range of message.arcs) this.painter.dots(run(range), size, this.colors.circle, 0.75);
    this.painter.end();
  }

  lines(layer, message) {
    const color = this.colors.hues[layer.hue];
    this.painter.group('lines ' + layer.topic.service);
    message.lines.forEach((value, index) => {
      const [x1, y1] = this.sensed(value.start.x, value.start.y);
      const [x2, y2] = this.sensed(value.end.x, value.end.y);
      this.painter.line(x1, y1, x2, y2, { stroke: color, width: 2 + this.wider(layer) });
      this.items.push({ kind: 'line', layer, value, index, x1, y1, x2, y2 });
    });
    this.painter.end();
  }

  // An ellipse in metres about a point of the sensor's frame.
  uncertainty(layer, x, y, major, minor, direction, color, dash) {
    const enlarged = this.view.scale * this.ellipseScale;
    const [sx, sy] = this.sensed(x, y);
    this.painter.ellipse(sx, sy, major * enlarged, minor * enlarged, direction + this.pose.yaw,
      { stroke: color, width: 1.3 + this.wider(layer), fill: color, fillAlpha: 0.16 / (this.ranks.get(layer)?.[1] ?? 1), dash });
    return [sx, sy];
  }

  corners(layer, message) {
    const color = this.colors.hues[layer.hue];
    this.painter.group('corners ' + layer.topic.service);
    message.corners.forEach((value, index) => {
      const [x, y] = this.uncertainty(layer, value.x, value.y, value.ellipse95_major, value.ellipse95_minor, value.ellipse95_direction,
        color, value.seen ? undefined : [4, 3]);
      this.painter.dots([x, y], 4, color);
      this.items.push({ kind: 'corner', layer, value, index, x, y });
    });
    this.painter.end();
  }

  circles(layer, message) {
    const color = this.colors.circle;
    this.painter.group('circles ' + layer.topic.service);
    message.circles.forEach((value, index) => {
      const [x, y] = this.sensed(value.x, value.y);
      const radius = value.radius * this.view.scale;
      this.painter.ellipse(x, y, radius, radius, 0, { stroke: color, width: 1, alpha: 0.5, dash: [2, 4] });
      this.painter.arc(x, y, radius, value.arc_start + this.pose.yaw, value.arc_end + this.pose.yaw, { stroke: color, width: 2 });
      const shape = ellipseOf(value.covariance_xx, value.covariance_xy, value.covariance_yy);
      this.uncertainty(layer, value.x, value.y, shape.major, shape.minor, shape.direction, color);
      this.painter.dots([x, y], 4, color);
      this.items.push({ kind: 'circle', layer, value, index, x, y, radius });
    });
    this.painter.end();
  }

  map(layer, message) {
    this.painter.group('map');
    (message.lines ?? []).forEach((value, index) => {
      if (!value.start || !value.end) return;
      const [x1, y1] = this.toScreen(value.start.x, value.start.y);
      const [x2, y2] = this.toScreen(value.end.x, value.end.y);
      this.painter.line(x1, y1, x2, y2, { stroke: this.colors.map, width: 5, alpha: 0.45 });
      this.items.push({ kind: 'map line', layer, value, index, x1, y1, x2, y2 });
    });
    this.painter.end();
  }

  trail(poses, color, dash) {
    this.painter.group('trail');
    this.painter.polyline(poses.map((pose) => this.toScreen(pose.x, pose.y)), { stroke: color, width: 1.5, alpha: 0.8, dash });
    this.painter.end();
  }

  poseEllipse(layer, pose, value) {
    const enlarged = this.view.scale * this.ellipseScale;
    const shape = ellipseOf(pose.xx, pose.xy, pose.yy);
    const [x, y] = this.toScreen(pose.x, pose.y);
    this.painter.group('pose');
    this.painter.ellipse(x, y, shape.major * enlarged, shape.minor * enlarged, shape.direction,
      { stroke: this.colors.sensor, width: 1.3, fill: this.colors.sensor, fillAlpha: 0.16 });
    this.painter.end();
    this.items.push({ kind: 'pose', layer, value, index: 0, x, y });
  }

  sensor() {
    const [x, y] = this.sensed(0, 0);
    const [tipX, tipY] = [x + 14 * Math.cos(this.pose.yaw), y - 14 * Math.sin(this.pose.yaw)];
    this.painter.group('sensor');
    this.painter.line(x, y, tipX, tipY, { stroke: this.colors.sensor, width: 2.5 });
    this.painter.ellipse(x, y, 5.5, 5.5, 0, { fill: this.colors.sensor, stroke: this.colors.background, width: 1.5 });
    this.painter.end();
  }

  pin(x, y) {
    const [sx, sy] = this.sensed(x, y);
    this.painter.ellipse(sx, sy, 9, 9, 0, { stroke: this.colors.text, width: 2 });
    this.painter.line(sx - 14, sy, sx + 14, sy, { stroke: this.colors.text });
    this.painter.line(sx, sy - 14, sx, sy + 14, { stroke: this.colors.text });
  }

  highlight(item) {
    const style = { stroke: this.colors.text, width: 2 };
    if (item.x1 !== undefined) {
      this.painter.line(item.x1, item.y1, item.x2, item.y2, { stroke: this.colors.text, width: 5, alpha: 0.5 });
    } else {
      this.painter.ellipse(item.x, item.y, 10, 10, 0, style);
    }
  }
}

// The nearest thing within `reach` pixels; corners before lines.
export function itemAt(items, x, y, reach = 12) {
  let best = null;
  let least = reach;
  for (const item of items) {
    let distance;
    if (item.x1 !== undefined) {
      const dx = item.x2 - item.x1, dy = item.y2 - item.y1;
      const t = Math.max(0, Math.min(1, ((x - item.x1) * dx + (y - item.y1) * dy) / (dx * dx + dy * dy || 1)));
      distance = Math.hypot(x - item.x1 - t * dx, y - item.y1 - t * dy) + 3;
    } else {
      distance = Math.hypot(x - item.x, y - item.y);
      if (item.radius !== undefined) distance = Math.min(distance, Math.abs(distance - item.radius) + 2);
    }
    if (distance < least) { least = distance; best = item; }
  }
  return best;
}
