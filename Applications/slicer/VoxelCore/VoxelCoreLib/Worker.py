"""A step of the work by the Python package voxelcore, in a process of its own: as the program of that name would do it.
usage: Worker.py COMMAND VOLUME.nrrd -o OUT [--report OUT.json] [--table OUT.csv] [--also csv] [--OPTION VALUE ...]
VOLUME.nrrd is one that Segments.writeNrrd wrote. Progress is told on stderr, a line of JSON each; the last other line
says what went wrong."""

import csv
import json
import sys

KEYWORDS_OF_FILES = ("o", "report", "table", "also")


def readVolume(path):
    """Voxels [k, j, i], spacing, origin, direction; LPS mm."""
    import numpy

    with open(path, "rb") as file:
        head = {}
        for line in iter(file.readline, b"\n"):
            if not line:
                raise ValueError(f"{path}: it ends within its header")
            name, colon, value = line.decode().rstrip("\n").partition(": ")
            if colon:
                head[name] = value
        start = file.tell()
    sizes = [int(word) for word in head["sizes"].split()]
    columns = [[float(word) for word in vector.strip("()").split(",")] for vector in head["space directions"].split()]
    origin = [float(word) for word in head["space origin"].strip("()").split(",")]
    matrix = numpy.array(columns).T
    spacing = numpy.linalg.norm(matrix, axis=0)
    voxels = numpy.memmap(path, numpy.uint8, "r", start, tuple(reversed(sizes)))
    return voxels, spacing, origin, matrix / spacing


def parse(words):
    command, volume, *rest = words
    options = {}
    while rest:
        word = rest.pop(0)
        name = word.lstrip("-").replace("-", "_")
        options[name] = rest.pop(0) if rest and not rest[0].startswith("--") else True
    return command, volume, options


def tell(stage, fraction):
    sys.stderr.write(json.dumps({"stage": stage, "fraction": round(float(fraction), 4)}) + "\n")
    sys.stderr.flush()


def writeThickness(found, spacing, origin, direction, output, table):
    import numpy

    columns = " ".join(
        "(" + ",".join(repr(float(value)) for value in direction[:, axis] * spacing[axis]) + ")" for axis in range(3)
    )
    place = ",".join(repr(float(value)) for value in origin)
    map = numpy.ascontiguousarray(found.map, "<f4")
    with open(output, "wb") as file:
        file.write(
            (
                "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\n"
                f"sizes: {' '.join(str(length) for length in reversed(map.shape))}\n"
                f"space directions: {columns}\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
                f"space origin: ({place})\n\n"
            ).encode()
        )
        file.write(map.tobytes())
    with open(table, "w", newline="", encoding="utf-8") as file:
        rows = [dict(label=label, of="thickness", **numbers) for label, numbers in found.numbers.items()]
        rows = [{name: value for name, value in row.items() if numpy.isscalar(value)} for row in rows]
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def main(words):
    import voxelcore

    command, path, options = parse(words)
    voxels, spacing, origin, direction = readVolume(path)
    files = {name: options.pop(name) for name in KEYWORDS_OF_FILES if name in options}
    threads = int(options.pop("threads", 0))
    common = dict(spacing=spacing, axes="kji", threads=threads, progress=tell)
    if command == "thickness":
        writeThickness(
            voxelcore.thickness(voxels, **common, **options), spacing, origin, direction, files["o"], files["table"]
        )
        return
    place = dict(common, origin=origin, direction=direction)
    if command == "core":
        result = voxelcore.core(voxels, **place, **options)
        result.save(files["o"], overwrite=True)
    elif command == "skeleton":
        result = voxelcore.skeleton(voxels, **place, **options)
        result.save(files["o"], also="csv", overwrite=True)
    else:
        raise ValueError(f"unknown command {command!r}")
    with open(files["report"], "w", encoding="utf-8") as file:
        json.dump(result.report, file)


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit(130)
    except MemoryError:
        sys.exit("not enough memory for this segment")
    except Exception as error:
        lines = str(error).strip().splitlines() or [type(error).__name__]
        sys.stderr.write(lines[0] + "\n")
        sys.exit(1)
