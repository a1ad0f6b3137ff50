// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// A client of the WebSocket protocol of Foxglove, which goes on trying when the connection ends.

const shortest = 500, longest = 5000; // [ms] between attempts
const writer = new TextEncoder();
const reader = new TextDecoder();

export class Connection {
  // events: {state(connected, reason), channel({id, topic, schemaName, schema}), message(id, ns, DataView), status(text)}
  constructor(url, events) {
    this.url = url;
    this.events = events;
    this.pause = shortest;
    this.calls = new Map();
    this.services = new Map();
    this.nextCall = 1;
    this.open();
  }

  open() {
    const socket = new WebSocket(this.url, ['foxglove.sdk.v1', 'foxglove.websocket.v1']);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => { this.pause = shortest; this.events.state(true, ''); };
    socket.onmessage = (event) => typeof event.data === 'string' ? this.text(JSON.parse(event.data)) : this.binary(event.data);
    socket.onclose = (event) => {
      for (const call of this.calls.values()) call.reject(new Error('the connection has ended'));
      this.calls.clear();
      this.services.clear();
      this.events.state(false, event.reason || (event.code === 1006 ? '' : 'code ' + event.code));
      setTimeout(() => this.open(), this.pause);
      this.pause = Math.min(2 * this.pause, longest);
    };
  }

  text(message) {
    switch (message.op) {
      case 'serverInfo': this.events.server?.(message); break;
      case 'advertise':
        for (const channel of message.channels) {
          if (this.events.channel(channel)) this.subscribe(channel.id);
        }
        break;
      case 'advertiseServices':
        for (const service of message.services) this.services.set(service.name, service.id);
        this.events.services?.();
        break;
      case 'serviceCallFailure':
        this.calls.get(message.callId)?.reject(new Error(message.message));
        this.calls.delete(message.callId);
        break;
      case 'status': this.events.status(message.message, message.level); break;
    }
  }

  binary(buffer) {
    const view = new DataView(buffer);
    if (view.getUint8(0) === 1) {
      this.events.message(view.getUint32(1, true), Number(view.getBigUint64(5, true)), new DataView(buffer, 13));
    } else if (view.getUint8(0) === 3) {
      const length = view.getUint32(9, true);
      const id = view.getUint32(5, true);
      this.calls.get(id)?.resolve(JSON.parse(reader.decode(new Uint8Array(buffer, 13 + length))));
      this.calls.delete(id);
    }
  }

  // Subscriptions have the ids of their channels.
  subscribe(id) {
    this.socket.send(JSON.stringify({ op: 'subscribe', subscriptions: [{ id, channelId: id }] }));
  }

  call(name, request) {
    const service = this.services.get(name);
    if (service === undefined) return Promise.reject(new Error('this server does not ' + name));
    const body = writer.encode(JSON.stringify(request));
    const bytes = new Uint8Array(17 + body.length);
    const view = new DataView(bytes.buffer);
    const id = this.nextCall++;
    view.setUint8(0, 2);
    view.setUint32(1, service, true);
    view.setUint32(5, id, true);
    view.setUint32(9, 4, true);
    bytes.set(writer.encode('json'), 13);
    bytes.set(body, 17);
    this.socket.send(bytes);
    return new Promise((resolve, reject) => this.calls.set(id, { resolve, reject }));
  }
}
