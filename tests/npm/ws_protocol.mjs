// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Foxglove's own client of its WebSocket protocol. Subscribes to every channel and counts for some seconds.
//   node ws_protocol.mjs URL SECONDS SUBPROTOCOL
import protocol from '@foxglove/ws-protocol';
import WebSocket from 'ws';

const { FoxgloveClient } = protocol;
const [url, seconds, subprotocol] = process.argv.slice(2);
const socket = new WebSocket(url, [subprotocol]);
const client = new FoxgloveClient({ ws: socket });
const seen = { subprotocol: '', server: '', channels: {}, messages: {}, statuses: [], errors: [] };
const topics = new Map();
client.on('open', () => { seen.subprotocol = socket.protocol; });
client.on('error', (error) => seen.errors.push(String(error?.message ?? error)));
client.on('serverInfo', (info) => { seen.server = info.name; });
client.on('status', (status) => seen.statuses.push(status.message));
client.on('advertise', (channels) => {
  for (const channel of channels) {
    seen.channels[channel.topic] = { encoding: channel.encoding, schema: channel.schemaName, schemaEncoding: channel.schemaEncoding };
    topics.set(client.subscribe(channel.id), channel.topic);
  }
});
client.on('message', ({ subscriptionId, data }) => {
  const topic = topics.get(subscriptionId);
  seen.messages[topic] ??= { count: 0, bytes: 0 };
  seen.messages[topic].count += 1;
  seen.messages[topic].bytes += data.byteLength;
});
setTimeout(() => {
  console.log(JSON.stringify(seen));
  client.close();
}, Number(seconds) * 1000);
