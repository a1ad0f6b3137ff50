// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// The LaserScans of a topic of a rosbag of ROS 1, one a line, as ros2_peer reads them.
//   node bag_scans.mjs NODE_MODULES BAG TOPIC
import {createRequire} from 'node:module';

const [modules, bag, topic] = process.argv.slice(2);
const require = createRequire(modules + '/');
const {Bag} = require('@foxglove/rosbag');
const {FileReader} = require('@foxglove/rosbag/node');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg-serialization');

const opened = new Bag(new FileReader(bag), {parse: false});
await opened.open();
const connections = [...opened.connections.values()].filter((each) => each.topic === topic);
const reader = new MessageReader(parse(connections[0].messageDefinition));
for await (const {data} of opened.messageIterator({topics: [topic]})) {
  const scan = reader.readMessage(data);
  const numbers = [scan.angle_min, scan.angle_max, scan.angle_increment, scan.time_increment, scan.scan_time,
                   scan.range_min, scan.range_max, scan.ranges.length, ...scan.ranges];
  console.log([scan.header.frame_id, ...numbers].map((each) => String(each).replace('Infinity', 'inf')).join(' '));
}
