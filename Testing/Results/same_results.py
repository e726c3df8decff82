#!/usr/bin/env python3
"""Holds every output of a list of runs (runs.txt) against what is recorded of it (digests.json).

usage: same_results.py VOXELCORE SOURCE_DIR [--record | --against OTHER_VOXELCORE] [--only NAME,...]
       [--leave-out NAME,...]

Without an option each output's SHA-256 must be the recorded one. --record writes what was run into
digests.json; a change that alters results on purpose records them and says so in its message. --against compares two
programs byte by byte instead.
What varies from run to run (times, memory, paths, version) is taken out of JSON, CSV and text first.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
VARYING = {"seconds", "peak_memory_mb", "voxelcore", "path", "command", "output", "memory_bytes", "threads",
           "seconds_expected", "memory_expected", "started", "ended", "host", "program", "version", "prediction",
           "core_memory_bytes", "core_seconds"}
SKIPPED = {".png", ".html"}  # drawn by the machine's own libraries


def without_varying(value):
    if isinstance(value, dict):
        return {key: without_varying(item) for key, item in value.items() if key not in VARYING}
    if isinstance(value, list):
        return [without_varying(item) for item in value]
    return value


def unpacked(data):
    """A .vtp with its arrays as they are: the record in it names the version, which varies."""
    begin = data.index(b"_", data.index(b"<AppendedData")) + 1
    head, parts, arrays, done = data[:begin], [], b"", 0
    for found in re.finditer(rb' offset="(\d+)"( *)', head):
        at = begin + int(found[1])
        count, size, last = struct.unpack_from("<3Q", data, at)
        lengths = struct.unpack_from(f"<{count}Q", data, at + 24)
        at += 24 + 8 * count
        array = b""
        for length in lengths:
            array += zlib.decompress(data[at:at + length])
            at += length
        assert len(array) == (count - (last > 0)) * size + last
        offset = b'%d"' % len(arrays)
        parts += [head[done:found.start()], b' offset="' + (offset.ljust(21) if found[2] else offset)]
        arrays += struct.pack("<Q", len(array)) + array
        done = found.end()
    head = b"".join(parts + [head[done:]]).replace(b' compressor="vtkZLibDataCompressor"', b"")
    return head + arrays + data[data.rindex(b"\n  </AppendedData>"):]


def content(path, folder):
    data = path.read_bytes()
    if path.suffix == ".vtp":
        data = unpacked(data)
    if path.suffix == ".json" and not path.name.endswith(".mrk.json"):
        text = data.decode().replace(str(folder.parent), "RUNS")
        return json.dumps(without_varying(json.loads(text)), sort_keys=True).encode()
    if path.name == "study.csv":
        rows = [line.split(",") for line in data.decode().splitlines()]
        kept = [i for i, name in enumerate(rows[0]) if not re.match("seconds|peak_memory", name)]
        return "\n".join(",".join(row[i] for i in kept) for row in rows).encode()
    if path.suffix in (".csv", ".mrml", ".swc"):
        text = data.decode().replace(str(folder), "OUT")
        return re.sub(r"VoxelCore [0-9.]+", "VoxelCore", text).encode()
    if path.suffix == ".rsml":  # says when the scan was written
        data = re.sub(rb"<last-modified>[^<]*", b"<last-modified>", data)
    return re.sub(rb'("version": ?"|VoxelCore )[0-9.]+', rb"\1", data)


def outputs(folder):
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if not path.is_file() or path.suffix in SKIPPED or name.endswith(
                "_finished.jsonl") or "/." in "/" + name or name.startswith("cohort/"):
            if not (name.startswith("cohort/") and path.suffix in (".vtp", ".swc")):
                continue
        found[name] = hashlib.sha256(content(path, folder)).hexdigest()
    return found


def run_list(program, source, only, left_out=frozenset()):
    """Runs the list; gives {run: {output: digest}} and the names of runs passed over."""
    foreign = os.environ.get("VOXELCORE_TEST_DATA", "/nonexistent")
    results, missing = {}, []
    with tempfile.TemporaryDirectory(prefix="voxelcore-results-") as place:
        for line in (HERE / "runs.txt").read_text().splitlines():
            if not line or line.startswith("#"):
                continue
            name, command = line.split(None, 1)
            if (only and name not in only) or name in left_out:
                continue
            folder = pathlib.Path(place) / name
            folder.mkdir()
            words = [word.format(d=source / "Data", f=foreign, m="/usr/share/mricron/templates", o=folder, p=place)
                     for word in command.split()]
            if any(word.startswith((foreign, "/usr/share/mricron")) and not os.path.exists(word) for word in words):
                missing.append(name)
                continue
            done = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True, timeout=900)
            results[name] = outputs(folder)
            results[name]["exit"] = str(done.returncode)
            if done.returncode != 0:
                print(f"{name}: exit {done.returncode}: {done.stderr.strip()}")
            if name.startswith(("verify", "info")):
                text = re.sub(r"(?m)^note: .*, or this build has no VTK\n", "", done.stdout)
                if name.startswith("info"):
                    text = json.dumps(without_varying(json.loads(text)), sort_keys=True)
                results[name]["stdout"] = hashlib.sha256(text.encode()).hexdigest()
    return results, missing


def differences(expected, found):
    for name, files in found.items():
        before = expected.get(name)
        if before is None:
            yield f"{name}: not recorded"
            continue
        for file in sorted(set(files) | set(before)):
            if files.get(file) != before.get(file):
                yield f"{name}: {file} " + ("is new"
                                            if file not in before else "is gone" if file not in files else "differs")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--against")
    parser.add_argument("--only", type=lambda text: set(text.split(",")))
    parser.add_argument("--leave-out", type=lambda text: set(text.split(",")), default=frozenset())
    arguments = parser.parse_args()
    found, missing = run_list(os.path.abspath(arguments.program), arguments.source.resolve(), arguments.only,
                              arguments.leave_out)
    for name in missing:
        print(f"{name}: passed over, its scan is not there")
    digests = HERE / "digests.json"
    if arguments.record:
        # What was not run keeps its record; what is no longer in the list loses it.
        names = {line.split(None, 1)[0] for line in (HERE / "runs.txt").read_text().splitlines()
                 if line and not line.startswith("#")}
        kept = {name: files for name, files in json.loads(digests.read_text()).items()
                if name in names and name not in found}
        digests.write_text(json.dumps({**kept, **found}, indent=1, sort_keys=True) + "\n")
        print(f"{len(found)} runs recorded, {len(kept)} kept as they were")
        return 0
    if arguments.against:
        expected, _ = run_list(os.path.abspath(arguments.against), arguments.source.resolve(), arguments.only,
                              arguments.leave_out)
    else:
        expected = json.loads(digests.read_text())
    problems = list(differences(expected, found))
    print("\n".join(problems) if problems else f"{len(found)} runs, all outputs equal")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
