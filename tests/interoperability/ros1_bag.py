#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a bag by ROS 1's own library: three scans, with odometry before and between them.

    ros1_bag.py FILE none|bz2|lz4
"""
import sys

import genpy
import rosbag
from nav_msgs.msg import Odometry
from sensor_msgs.msg import LaserScan


def main(file, compression):
    with rosbag.Bag(file, "w", compression=compression) as bag:
        for i in range(3):
            time = genpy.Time(1600000000 + i, 250000000)
            odometry = Odometry()
            odometry.header.stamp = time
            odometry.header.frame_id = "odom"
            odometry.child_frame_id = "base_footprint"
            odometry.pose.pose.position.x = 0.5 * i
            odometry.pose.pose.orientation.w = 1.0
            odometry.pose.covariance[0] = 0.01
            bag.write("/odom", odometry, time)
            scan = LaserScan()
            scan.header.stamp = time
            scan.header.frame_id = "laser"
            scan.angle_min = -1.5
            scan.angle_max = 1.5
            scan.angle_increment = 0.5
            scan.range_min = 0.1
            scan.range_max = 30.0
            scan.ranges = [1.0 + i, 2.0, 3.0, float("inf"), 3.0, 2.0, 1.0]
            scan.intensities = [float(ray) for ray in range(7)]
            bag.write("/scan", scan, time)


if __name__ == "__main__":
    main(*sys.argv[1:])
