// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Films the picture of a running page as an animated PNG.
//   node animate.mjs URL FILE [FRAMES]
import { writeFileSync } from 'node:fs';
import zlib from 'node:zlib';
import { startChromium } from './chromium.mjs';

const [url, file, count = '14'] = process.argv.slice(2);
const pause = 300; // [ms] between frames

// The chunks of a PNG file: {type, data}.
function chunksOf(png) {
  const chunks = [];
  for (let at = 8; at < png.length;) {
    const length = png.readUInt32BE(at);
    chunks.push({ type: png.toString('latin1', at + 4, at + 8), data: png.subarray(at + 8, at + 8 + length) });
    at += 12 + length;
  }
  return chunks;
}

const table = Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
// node before 22.2 has none.
const checksum = zlib.crc32 ?? ((bytes) => {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = table[(crc ^ byte) & 255] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
});

function chunk(type, data) {
  const bytes = Buffer.alloc(12 + data.length);
  bytes.writeUInt32BE(data.length, 0);
  bytes.write(type, 4, 'latin1');
  data.copy(bytes, 8);
  bytes.writeUInt32BE(checksum(bytes.subarray(4, 8 + data.length)), 8 + data.length);
  return bytes;
}

const numbers = (...values) => {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => bytes.writeUInt32BE(value, 4 * i));
  return bytes;
};

// https://www.w3.org/TR/png-3/#apng-frame-based-animation
function animated(frames) {
  const first = chunksOf(frames[0]);
  const header = first.find((each) => each.type === 'IHDR').data;
  const [width, height] = [header.readUInt32BE(0), header.readUInt32BE(4)];
  let sequence = 0;
  const parts = [Buffer.from('89504e470d0a1a0a', 'hex'), chunk('IHDR', header), chunk('acTL', numbers(frames.length, 0))];
  frames.forEach((frame, i) => {
    const timing = Buffer.alloc(6);
    timing.writeUInt16BE(pause, 0);
    timing.writeUInt16BE(1000, 2);
    parts.push(chunk('fcTL', Buffer.concat([numbers(sequence++, width, height, 0, 0), timing])));
    for (const each of chunksOf(frame).filter(({ type }) => type === 'IDAT')) {
      parts.push(i === 0 ? chunk('IDAT', each.data) : chunk('fdAT', Buffer.concat([numbers(sequence++), each.data])));
    }
  });
  parts.push(chunk('IEND', Buffer.alloc(0)));
  return Buffer.concat(parts);
}

const { context, close } = await startChromium({
  viewport: { width: 980, height: 430 },
  colorScheme: 'light',
});
const page = await context.newPage();
await page.goto(url);
await page.waitForFunction(() => window.quoin.items().some((item) => item.kind === 'corner'), null, { timeout: 60000 });
await page.click('#wider');
await page.locator('#tools').evaluate((tools) => { tools.hidden = true; });
await page.waitForTimeout(500);
const frames = [];
for (let i = 0; i < Number(count); ++i) {
  const began = Date.now();
  frames.push(await page.locator('#stage').screenshot());
  await page.waitForTimeout(Math.max(0, pause - (Date.now() - began)));
}
writeFileSync(file, animated(frames));
await close();
