// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The same few marks on a canvas and as SVG. Angles turn counter-clockwise as seen; y points down. A style has
// stroke, width, fill, alpha, fillAlpha and dash.

export class CanvasPainter {
  constructor(context) { this.context = context; }
  group() {}
  end() {}
  #finish(style) {
    const c = this.context;
    if (style.fill) {
      c.globalAlpha = style.fillAlpha ?? style.alpha ?? 1;
      c.fillStyle = style.fill;
      c.fill();
    }
    if (style.stroke) {
      c.globalAlpha = style.alpha ?? 1;
      c.strokeStyle = style.stroke;
      c.lineWidth = style.width ?? 1;
      c.setLineDash(style.dash ?? []);
      c.lineCap = 'round';
      c.stroke();
    }
    c.globalAlpha = 1;
  }
  line(x1, y1, x2, y2, style) {
    this.context.beginPath();
    this.context.moveTo(x1, y1);
    this.context.lineTo(x2, y2);
    this.#finish(style);
  }
  polyline(points, style) {
    if (points.length < 2) return;
    this.context.beginPath();
    points.forEach(([x, y], i) => i === 0 ? this.context.moveTo(x, y) : this.context.lineTo(x, y));
    this.#finish(style);
  }
  dots(points, size, color, alpha = 1) {
    const c = this.context;
    c.globalAlpha = alpha;
    c.fillStyle = color;
    for (let i = 0; i < points.length; i += 2) c.fillRect(points[i] - size / 2, points[i + 1] - size / 2, size, size);
    c.globalAlpha = 1;
  }
  ellipse(x, y, rx, ry, angle, style) {
    this.context.beginPath();
    this.context.ellipse(x, y, Math.max(rx, 0), Math.max(ry, 0), -angle, 0, 2 * Math.PI);
    this.#finish(style);
  }
  arc(x, y, radius, from, to, style) {
    this.context.beginPath();
    this.context.arc(x, y, radius, -from, -to, true);
    this.#finish(style);
  }
  text(x, y, text, color, align = 'left') {
    const c = this.context;
    c.fillStyle = color;
    c.font = '11px system-ui, sans-serif';
    c.textAlign = align;
    c.fillText(text, x, y);
  }
}

const short = (value) => String(Math.round(value * 100) / 100);
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);

export class SvgPainter {
  constructor(width, height, background) {
    this.parts = [
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="11">`,
      `<rect width="${width}" height="${height}" fill="${background}"/>`,
    ];
  }
  group(name) { this.parts.push(`<g class="${escaped(name)}">`); }
  end() { this.parts.push('</g>'); }
  #style(style) {
    let text = `fill="${style.fill ?? 'none'}"`;
    if (style.fill && (style.fillAlpha ?? style.alpha ?? 1) < 1) text += ` fill-opacity="${style.fillAlpha ?? style.alpha}"`;
    if (style.stroke) {
      text += ` stroke="${style.stroke}" stroke-width="${style.width ?? 1}" stroke-linecap="round"`;
      if ((style.alpha ?? 1) < 1) text += ` stroke-opacity="${style.alpha}"`;
      if (style.dash) text += ` stroke-dasharray="${style.dash.join(' ')}"`;
    }
    return text;
  }
  line(x1, y1, x2, y2, style) {
    this.parts.push(`<line x1="${short(x1)}" y1="${short(y1)}" x2="${short(x2)}" y2="${short(y2)}" ${this.#style(style)}/>`);
  }
  polyline(points, style) {
    if (points.length < 2) return;
    this.parts.push(`<polyline points="${points.map(([x, y]) => short(x) + ',' + short(y)).join(' ')}" ${this.#style(style)}/>`);
  }
  dots(points, size, color, alpha = 1) {
    if (points.length === 0) return;
    let path = '';
    for (let i = 0; i < points.length; i += 2) path += `M${short(points[i])} ${short(points[i + 1])}h0`;
    this.parts.push(`<path d="${path}" stroke="${color}" stroke-width="${size}" stroke-linecap="round" stroke-opacity="${alpha}"/>`);
  }
  ellipse(x, y, rx, ry, angle, style) {
    const turn = short(-angle * 180 / Math.PI);
    this.parts.push(`<ellipse cx="${short(x)}" cy="${short(y)}" rx="${short(rx)}" ry="${short(ry)}" transform="rotate(${turn} ${short(x)} ${short(y)})" ${this.#style(style)}/>`);
  }
  arc(x, y, radius, from, to, style) {
    const point = (angle) => short(x + radius * Math.cos(angle)) + ' ' + short(y - radius * Math.sin(angle));
    const large = to - from > Math.PI ? 1 : 0;
    this.parts.push(`<path d="M${point(from)}A${short(radius)} ${short(radius)} 0 ${large} 0 ${point(to)}" ${this.#style(style)}/>`);
  }
  text(x, y, text, color, align = 'left') {
    const anchor = { left: 'start', center: 'middle', right: 'end' }[align];
    this.parts.push(`<text x="${short(x)}" y="${short(y)}" fill="${color}" text-anchor="${anchor}">${escaped(text)}</text>`);
  }
  finish() { return this.parts.join('\n') + '\n</svg>\n'; }
}
