// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Debian's Chromium looks at the page of a running viewer. Prints one JSON object of what it saw; the test judges.
//   node browser.mjs URL FOLDER      pictures go into FOLDER
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { startChromium } from './chromium.mjs';

const [url, folder] = process.argv.slice(2);
const { context, close } = await startChromium({
  viewport: { width: 1280, height: 800 },
});
const seen = { console: [], requests: [] };
const page = await context.newPage();
page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) seen.console.push(message.text()); });
page.on('pageerror', (error) => seen.console.push(String(error)));
page.on('request', (request) => seen.requests.push(request.url()));

await page.emulateMedia({ colorScheme: 'light' });
await page.goto(url);
await page.waitForFunction(() => window.quoin.items().some((item) => item.kind === 'corner'), null, { timeout: 60000 });
// From the opening of the page to the first picture with corners.
seen.first_picture_ms = await page.evaluate(() => Math.round(performance.now()));

// What does not move: a scan that is held.
await page.click('#pause');
await page.waitForTimeout(300);
const shown = () => page.evaluate(() => {
  const rows = [];
  for (const item of window.quoin.items()) {
    rows.push({
      kind: item.kind, service: item.layer.topic.service, x: item.x ?? item.x1, y: item.y ?? item.y1,
      major: item.value.ellipse95_major, minor: item.value.ellipse95_minor, direction: item.value.ellipse95_direction,
      world: item.kind === 'corner' ? [item.value.x, item.value.y] : null,
    });
  }
  return rows;
});
seen.items = await shown();
seen.view = await page.evaluate(() => window.quoin.view());
seen.ellipse_scale = await page.evaluate(() => Number(document.getElementById('ellipse-scale').textContent.slice(2)));
const svg = await page.evaluate(() => window.quoin.svg());
writeFileSync(join(folder, 'page.svg'), svg);
seen.svg = await page.evaluate((text) => {
  const picture = new DOMParser().parseFromString(text, 'image/svg+xml');
  return {
    lines: picture.querySelectorAll('g[class^="lines "] > line').length,
    ellipses: [...picture.querySelectorAll('g[class^="corners "] > ellipse')].map((ellipse) => ({
      cx: Number(ellipse.getAttribute('cx')), cy: Number(ellipse.getAttribute('cy')),
      rx: Number(ellipse.getAttribute('rx')), ry: Number(ellipse.getAttribute('ry')),
      turn: Number(/rotate\((-?[\d.]+)/.exec(ellipse.getAttribute('transform'))[1]),
    })),
  };
}, svg);
// On the canvas itself, in the middle of a corner.
seen.pixel = await page.evaluate(() => {
  const corner = window.quoin.items().find((item) => item.kind === 'corner');
  const canvas = document.getElementById('canvas');
  const ratio = devicePixelRatio;
  const { data } = canvas.getContext('2d').getImageData(Math.round(corner.x * ratio), Math.round(corner.y * ratio), 1, 1);
  return [...data];
});

// Pointing at a corner shows its values with units.
const corner = seen.items.find((item) => item.kind === 'corner');
const box = await page.locator('#canvas').boundingBox();
await page.mouse.move(box.x + corner.x, box.y + corner.y);
await page.waitForSelector('#tip:not([hidden])');
seen.tip = await page.locator('#tip').innerText();
await page.mouse.move(box.x + 5, box.y + 5);
await page.screenshot({ path: join(folder, 'light.png') });

await page.emulateMedia({ colorScheme: 'dark' });
await page.click('#pause');
await page.waitForTimeout(400);
seen.pill = await page.locator('#pill').innerText();
seen.health = await page.locator('#services tr').count();
seen.health_summary = await page.locator('#health-summary').innerText();
await page.screenshot({ path: join(folder, 'dark.png') });

// By keys alone: the next thing, zoom, one scan back.
await page.focus('#canvas');
await page.keyboard.press('n');
seen.selected = await page.locator('#details-title').innerText();
await page.keyboard.press(',');
await page.waitForTimeout(300);
seen.paused = await page.locator('#pill').innerText();
await page.keyboard.press('Space');

const before = await page.evaluate(() => window.quoin.frames());
await page.waitForTimeout(2000);
const after = await page.evaluate(() => window.quoin.frames());
seen.frames_per_second = (after.frames - before.frames) / 2;
seen.frame_ms = (after.drawing - before.drawing) / Math.max(1, after.frames - before.frames);

if (await page.locator('#why:not([hidden])').count() > 0) {
  await page.click('#why');
  await page.mouse.click(box.x + box.width / 2 + 40, box.y + box.height / 2 + 10);
  await page.waitForSelector('.answer', { timeout: 20000 });
  seen.answer = await page.locator('#details').innerText();
  await page.screenshot({ path: join(folder, 'why.png') });
  await page.keyboard.press('Escape');
}

// A telephone.
await page.setViewportSize({ width: 390, height: 844 });
await page.waitForTimeout(300);
await page.click('#tab-health');
await page.waitForTimeout(400);
seen.narrow_overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
await page.screenshot({ path: join(folder, 'narrow_dark.png') });
await page.emulateMedia({ colorScheme: 'light' });
await page.click('#tab-layers');
await page.click('#fit');
await page.waitForTimeout(400);
await page.screenshot({ path: join(folder, 'narrow_light.png') });

console.log(JSON.stringify(seen));
await close();
