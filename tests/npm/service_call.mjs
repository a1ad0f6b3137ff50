// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Calls services of a page by Foxglove's own client, one after the other, and prints their answers as a list.
//   node service_call.mjs URL NAME JSON [NAME JSON ...]
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';

const { FoxgloveClient } = protocol;
const [url, ...calls] = process.argv.slice(2);
const client = new FoxgloveClient({ ws: new WebSocket(url, ['foxglove.websocket.v1']) });
const answers = [];
let offered = new Map();
function next() {
  const at = 2 * answers.length;
  if (at >= calls.length) {
    console.log(JSON.stringify({ offered: [...offered.keys()], answers }));
    return client.close();
  }
  const serviceId = offered.get(calls[at]);
  if (serviceId === undefined) { answers.push('not offered'); return next(); }
  const data = new DataView(new TextEncoder().encode(calls[at + 1]).buffer);
  client.sendServiceCallRequest({ serviceId, callId: at + 1, encoding: 'json', data });
}
client.on('advertiseServices', (services) => {
  offered = new Map(services.map((service) => [service.name, service.id]));
  next();
});
client.on('serviceCallResponse', ({ data }) => {
  answers.push(JSON.parse(new TextDecoder().decode(data)));
  next();
});
client.on('serviceCallFailure', ({ message }) => { answers.push(message); next(); });
setTimeout(() => { console.error('no answer in time'); process.exit(1); }, 20000).unref();
