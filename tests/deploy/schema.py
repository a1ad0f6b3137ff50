#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Quoin authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the schema of `quoin schema` accepts the examples, and refuses what is wrong.

    schema.py QUOIN EXAMPLES_FOLDER
"""
import json
import pathlib
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError as error:
    print(f"{error}: python3-jsonschema and python3-yaml of tests/packages.txt are not there")
    sys.exit(77)  # skipped

schema = json.loads(subprocess.check_output([sys.argv[1], "schema"]))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)

failed = False
examples = sorted(pathlib.Path(sys.argv[2]).glob("*.yaml"))
assert examples, "no examples"
for example in examples:
    for error in validator.iter_errors(yaml.safe_load(example.read_text())):
        print(f"{example.name}: {'/'.join(map(str, error.path))}: {error.message[:300]}")
        failed = True

service = {"name": "walls", "kind": "segmentation", "input": "front", "method": "iepf"}
wrong = {
    "unknown key": {**service, "colour": "red"},
    "unknown kind": {**service, "kind": "segmentatoin"},
    "unknown method": {**service, "method": "ipef"},
    "unknown parameter": {**service, "parameters": {"split_distnace": 0.04}},
    "parameter of another method": {**service, "parameters": {"votes": 3}},
    "no name": {"kind": "segmentation"},
    "sensor of no source": {**service, "sensor": {"range_stddev": 0.01}},
}
assert validator.is_valid({"version": 1, "services": [service]})
for what, entry in wrong.items():
    if validator.is_valid({"version": 1, "services": [entry]}):
        print(f"accepted: {what}")
        failed = True
sys.exit(failed)
