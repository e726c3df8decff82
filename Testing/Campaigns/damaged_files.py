"""Damaged files of every format that is read, through the program: each is read or refused in one line with the right
exit code, in time and in memory that the file's size allows.

usage: damaged_files.py VOXELCORE [--totals FILE] [--minutes M] [--count N] [--first SEED]
       [--formats a,b] [--keep DIR]

--keep: files with which something was found. Goes on where the totals say."""

import argparse
import gzip
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import foreign_seeds
from campaign import Totals, checked
from faults import make_png

NUMBERS = [b"-1", b"0", b"1", b"7", b"255", b"65536", b"2147483647", b"2147483648", b"4294967295", b"4294967296",
           b"9223372036854775807", b"-9223372036854775808", b"18446744073709551615",
           b"99999999999999999999999", b"1e308", b"1e999", b"nan", b"inf", b"", b"../../etc/passwd", b"%s%n",
           b"\xff\xfe"]
MEGABYTES = 1500  # of address space; a small run maps half of it


def damaged(data, draw):
    """One to four changes: bits, numbers of text, numbers of 1 to 8 bytes, parts lost, doubled, swapped, cut off."""
    data = bytearray(data)
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 4))):
        if not data:
            break
        # Headers are what matters: half of all changes are there.
        place = draw.randrange(min(len(data), 400)) if draw.random() < 0.5 else draw.randrange(len(data))
        kind = draw.randrange(9)
        if kind <= 1:
            data[place] ^= 1 << draw.randrange(8)
        elif kind == 2:
            data[place] = draw.choice((0, 1, 127, 128, 255, 10, 32))
        elif kind == 3:
            width = draw.choice((1, 2, 4, 8))
            value = draw.choice((0, 1, 2**31 - 1, 2**31, 2**32 - 1, 2**63 - 1, 2**63, 2**64 - 1)) % 256**width
            data[place:place + width] = value.to_bytes(width, draw.choice(("little", "big")))
        elif kind == 4:
            del data[place:place + draw.randrange(1, 40)]
        elif kind == 5:
            data[place:place] = data[place:place + draw.randrange(1, 200)]
        elif kind == 6:
            other = draw.randrange(len(data))
            width = draw.randrange(1, 30)
            data[place:place + width], data[other:other + width] = (data[other:other + width],
                                                                    data[place:place + width])
        elif kind == 7 and draw.random() < 0.4:
            del data[place:]
        else:
            digits = [at for at in range(place, min(place + 200, len(data))) if 48 <= data[at] < 58]
            if digits:
                end = digits[0]
                while end < len(data) and chr(data[end]) in "0123456789.-+e":
                    end += 1
                data[digits[0]:end] = draw.choice(NUMBERS)
    return bytes(data)


class Seeds:
    """Whole files of each format, the command that reads them, and which of their files are damaged."""

    def __init__(self, program, folder):
        self.program, self.folder, self.all = program, folder, {}
        scan = self.path("scan.nrrd")
        self.make("phantom", "torus", "--size", "12", "-o", scan)
        self.info("nrrd", "scan.nrrd")
        self.make("phantom", "torus", "--size", "12", "-o", self.path("mask.nii.gz"))
        self.info("nii.gz", "mask.nii.gz")
        for name in ("a.nii", "a.mha", "a.mhd", "a.tif"):
            self.make("phantom", "torus", "--size", "12", "-o", self.path(name))
            self.info(name[2:], name)
        with open(self.path("gz.nrrd"), "wb") as file:
            head, body = open(scan, "rb").read().split(b"\n\n", 1)
            lines = [line for line in head.split(b"\n") if not line.startswith(b"encoding")]
            body = gzip.decompress(body) if b"encoding: gz" in head else body
            file.write(b"\n".join(lines) + b"\nencoding: gzip\n\n" + gzip.compress(body))
        self.info("nrrd gzip", "gz.nrrd")
        with open(self.path("raw.nrrd"), "wb") as file:
            file.write(b"\n".join(lines) + b"\nencoding: raw\n\n" + body)
        self.info("nrrd raw", "raw.nrrd")
        with open(self.path("text.nrrd"), "wb") as file:
            file.write(b"\n".join(lines) + b"\nencoding: ascii\n\n" + b" ".join(b"%d" % (byte & 1) for byte in body))
        self.info("nrrd text", "text.nrrd")
        os.mkdir(self.path("slices"))
        for k in range(4):
            make_png(self.path(f"slices/s{k}.png"),
                     [[255 if k in (1, 2) and 2 < x < 8 and 2 < y < 9 else 0 for x in range(12)] for y in range(12)])
        self.add("png slices", ["info", "slices"], [f"slices/s{k}.png" for k in range(4)])
        cube = ("8 6 0", [(x, y, z) for z in (0, 3) for y in (0, 4) for x in (0, 5)],
                [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
        self.write("a.off", "OFF\n" + cube[0] + "\n" + "".join(f"{x} {y} {z}\n" for x, y, z in cube[1])
                   + "".join("4 %d %d %d %d\n" % face for face in cube[2]))
        self.write("a.obj", "".join(f"v {x} {y} {z}\n" for x, y, z in cube[1])
                   + "".join("f %d %d %d %d\n" % tuple(i + 1 for i in face) for face in cube[2]))
        self.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
                   "float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n"
                   + "".join(f"{x} {y} {z}\n" for x, y, z in cube[1])
                   + "".join("4 %d %d %d %d\n" % face for face in cube[2]))
        self.write("a.stl", "solid a\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % cube[1][i] for i in corners)
            + "endloop\nendfacet\n" for face in cube[2] for corners in (face[:3], (face[0], *face[2:])))
            + "endsolid a\n")
        self.write("a.vtk", "# vtk DataFile Version 3.0\ncube\nASCII\nDATASET POLYDATA\nPOINTS 8 float\n"
                   + "".join(f"{x} {y} {z}\n" for x, y, z in cube[1]) + "POLYGONS 6 30\n"
                   + "".join("4 %d %d %d %d\n" % face for face in cube[2]))
        for kind in ("off", "obj", "ply", "stl", "vtk"):
            self.add(kind + " mesh", ["voxelize", "a." + kind, "--resolution", "6", "-o", "OUT/v.nrrd"], ["a." + kind])
        for kind in ("vtp", "vtk"):
            self.make("core", scan, "--lambda", "0", "-o", self.path("core." + kind))
        self.make("core", scan, "--lambda", "0", "--keep-edges", "-o", self.path("edges.vtp"), "--with-skeleton")
        self.add("core .vtp", ["prune", "edges.vtp", "--lambda", "1vox", "-o", "OUT/p.vtp"], ["edges.vtp"])
        self.add("core .vtk", ["skeleton", "core.vtk", "-o", "OUT/s.vtp"], ["core.vtk"])
        self.add("core verified", ["verify", "scan.nrrd", "edges.vtp"], ["edges.vtp"], (0, 3, 4))
        self.add("skeleton .vtp", ["measure", "edges_skeleton.vtp", "-o", "OUT/m.csv"], ["edges_skeleton.vtp"])
        for block in ("1", "2"):
            self.make("core", scan, "--blocks", "2", "--block", block, "-o", self.path("parts/"))
        parts = [os.path.join("parts", name) for name in sorted(os.listdir(self.path("parts")))]
        self.add("block parts", ["core", "scan.nrrd", "--join", "parts", "-o", "OUT/j.vtp"], parts, (0, 3, 4))
        foreign_seeds.make(folder)
        self.write("edits.txt", "+1,2,3\n-4,5,6x2\n+2,2,2\n")
        self.add("voxel edits", ["core", "scan.nrrd", "--change-voxels", "edits.txt", "-o", "OUT/c.vtp"],
                 ["edits.txt"], (0, 3))
        self.write("manifest.csv", "id,scan,lambda\none,scan.nrrd,1vox\ntwo,mask.nii.gz,2vox\n")
        self.add("manifest", ["batch", "manifest.csv", "-o", "OUT/b", "--list"], ["manifest.csv"], (0, 1, 2, 3))

    def path(self, name):
        return os.path.join(self.folder, name)

    def make(self, *arguments):
        checked([self.program, *arguments, "-q"])

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def info(self, kind, name):
        files = [name] if not name.endswith(".mhd") else [name, *(other for other in os.listdir(self.folder)
                                                                  if other.startswith("a.") and "raw" in other)]
        self.add(kind, ["info", name], files)
        self.add(kind + " core", ["core", name, "--lambda", "1vox", "-o", "OUT/c.vtp"], files)

    def add(self, kind, command, files, codes=(0, 3)):
        self.all[kind] = (command, files, codes)


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--totals")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--count", type=int, default=10**12)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--formats")
    parser.add_argument("--keep")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    totals = Totals(options.totals, "damaged files")
    before = len(totals.of["found"])
    until = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory(prefix="voxelcore-damaged-") as folder:
        whole = os.path.join(folder, "whole")
        os.mkdir(whole)
        seeds = Seeds(program, whole)
        kinds = options.formats.split(",") if options.formats else list(seeds.all)
        for kind in kinds:  # each whole file is taken: else nothing is tested
            command, _, _ = seeds.all[kind]
            os.makedirs(os.path.join(whole, "OUT"))
            done = subprocess.run([program, *command], cwd=whole, capture_output=True)
            if done.returncode != 0:
                raise SystemExit(f"{kind}: {command}: exit {done.returncode}: {done.stderr.decode()}")
            shutil.rmtree(os.path.join(whole, "OUT"))
        seed = max(options.first, totals.place("seed"))
        end = seed + options.count
        while time.monotonic() < until and seed < end:
            kind = kinds[seed % len(kinds)]
            command, files, codes = seeds.all[kind]
            draw = random.Random(seed)
            work = os.path.join(folder, "work")
            shutil.rmtree(work, ignore_errors=True)
            shutil.copytree(whole, work)
            os.mkdir(os.path.join(work, "OUT"))
            name = os.path.join(work, draw.choice(files))
            with open(name, "rb") as file:
                data = file.read()
            with open(name, "wb") as file:
                file.write(damaged(data, draw))
            began = time.monotonic()
            process = subprocess.Popen([program, *command], cwd=work, stdin=subprocess.DEVNULL, preexec_fn=limited,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
            try:
                _, said = process.communicate(timeout=60)
                code = process.returncode
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, 9)
                _, said = process.communicate()
                code = None
            lines = [line for line in said.decode(errors="replace").split("\n") if line]
            errors = [line for line in lines if line.startswith("voxelcore: ")]
            trouble = None
            if code is None:
                trouble = "it hangs"
            elif code < 0:
                trouble = f"signal {-code}"
            elif code not in codes:
                trouble = f"exit {code}: {lines[:3]}"
            elif code == 3 and (len(errors) < 1 or "std::" in said.decode(errors="replace")):
                trouble = f"exit 3: {lines[:3]}"
            elif any(ord(c) < 32 and c != "\t" for line in lines for c in line):
                trouble = f"control characters in {lines[:3]}"
            elif any(".part-" in other for _, _, names in os.walk(work) for other in names):
                trouble = "a temporary file is left"
            totals.ran()
            totals.count(f"{kind}, " + ("read" if code == 0 else "refused"))
            if trouble:
                totals.found(f"seed {seed}, {kind}: {trouble}"[:500])
                if options.keep:
                    os.makedirs(options.keep, exist_ok=True)
                    shutil.copy(name, os.path.join(options.keep, f"{seed}-{os.path.basename(name)}"))
            if time.monotonic() - began > 10:
                totals.count("longer than 10 s")
            seed += 1
            totals.place("seed", seed)
            if seed % 50 == 0:
                totals.save()
    totals.save()
    print(totals.of["runs"], "files,", len(totals.of["found"]), "found")
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
