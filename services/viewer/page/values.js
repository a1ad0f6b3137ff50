// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// Numbers for people: with the unit that the IDL gives, scaled to what can be read.

const digits = (value, count = 4) => {
  if (!Number.isFinite(value)) return String(value);
  if (value === 0) return '0';
  const text = Math.abs(value) >= 1e5 || Math.abs(value) < 1e-4 ? value.toExponential(count - 1) : value.toPrecision(count);
  return text.includes('e') ? text : text.replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '');
};

// Text and unit.
export function formatted(value, unit, count = 5) {
  if (typeof value === 'boolean') return [value ? 'yes' : 'no', ''];
  if (typeof value !== 'number') return [String(value), unit];
  if (Number.isInteger(value) && unit === '') return [String(value), ''];
  switch (unit) {
    case 'm': return Math.abs(value) < 0.1 ? [digits(value * 1e3, Math.min(4, count)), 'mm'] : [digits(value, count), 'm'];
    case 'm^2': return [digits(value * 1e6), 'mm²'];
    case 'rad': return [digits(value * 180 / Math.PI, 5), '°'];
    case 'rad^2': return [digits(value * (180 / Math.PI) ** 2), '°²'];
    case 'rad m': return [digits(value * 180 / Math.PI * 1e3), '° mm'];
    case 's': return Math.abs(value) < 1 ? [digits(value * 1e3), 'ms'] : [digits(value), 's'];
    default: return [digits(value), unit];
  }
}

// Rows {name, text, unit, doc} of a value of that structure; structures in it become several rows.
export function rowsOf(types, type, value, prefix = '') {
  const rows = [];
  for (const field of types.get(type).fields) {
    const name = prefix + field.name.replaceAll('_', ' ');
    const inner = value[field.name];
    if (field.type.kind === 'named' && types.get(field.type.name).kind === 'struct') {
      rows.push(...rowsOf(types, field.type.name, inner, name + ' '));
    } else if (!Array.isArray(inner) && !ArrayBuffer.isView(inner)) {
      const [text, unit] = formatted(inner, field.unit);
      rows.push({ name, text, unit, doc: field.doc });
    }
  }
  // Standard deviations, which nobody computes in his head.
  for (const field of types.get(type).fields) {
    if (!field.name.startsWith('covariance_') || typeof value[field.name] !== 'number' || value[field.name] < 0) continue;
    const part = field.name.slice('covariance_'.length);
    const unit = { 'm^2': 'm', 'rad^2': 'rad' }[field.unit];
    if (!unit) continue;
    const half = part.length % 2 === 0 && part.slice(0, part.length / 2) === part.slice(part.length / 2);
    if (part.includes('_') || (part.length === 2 && !half)) continue;
    const [text, shown] = formatted(Math.sqrt(value[field.name]), unit);
    rows.push({ name: 'sigma ' + (half ? part.slice(0, part.length / 2) : part), text, unit: shown, doc: 'square root of the covariance' });
  }
  return rows;
}

// The structure of the elements of a field of a message.
export function elementType(types, type, field) {
  return types.get(type).fields.find((each) => each.name === field)?.type.element?.name;
}
