"""Runs the examples of every command's --help (the manual pages have the same), one after the other, on small inputs of
the names they use. Options that README.md and the guide name are there.
usage: help_test.py VOXELCORE SOURCE_DIR"""
import gzip
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from module_test_tools import SIZE, check, run, two_blocks, write_nrrd

# A needle, so that 1024 voxels along it are few; triangles turn outwards.
CORNERS = [(10 * (c & 1), 0.2 * (c >> 1 & 1), 0.2 * (c >> 2)) for c in range(8)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [(a, b, c) for a, b, c, d in SIDES] + [(a, c, d) for a, b, c, d in SIDES]


def write_nifti(path, size, voxels):
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *size, 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 2, 8)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 0, 0, 0, 0)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2  # mm
    struct.pack_into("<2h", header, 252, 0, 1)
    for row in range(3):
        struct.pack_into("<f", header, 280 + 20 * row, 1)
    header[344:348] = b"n+1\0"
    path.write_bytes(gzip.compress(bytes(header + voxels), 1))


def write_segmentation(path, names):
    write_nrrd(path, two_blocks())
    header, data = path.read_bytes().split(b"\n\n", 1)
    for number, (value, name) in enumerate(names.items()):
        header += ("\nSegment%d_ID:=s%d\nSegment%d_Name:=%s\nSegment%d_LabelValue:=%d\nSegment%d_Layer:=0"
                   % (number, number, number, name, number, value, number)).encode()
    path.write_bytes(header + b"\n\n" + data)


def write_slice(path, rows):
    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))) + chunk(b"IEND", b""))


def write_inputs(program):
    blocks = two_blocks()
    write_nifti(Path("atlas.nii.gz"), SIZE, bytes(4 if value == 3 else 7 if value == 8 else 0 for value in blocks))
    write_segmentation(Path("scan.seg.nrrd"), {3: "lung", 8: "liver"})
    voxels = Path("scan.seg.nrrd").read_bytes()
    Path("scan.seg.nrrd").write_bytes(voxels.replace(b"\x03", b"\x04").replace(b"LabelValue:=3", b"LabelValue:=4"))
    write_segmentation(Path("vessels.seg.nrrd"), {3: "artery", 8: "vein"})
    tooth = lambda i, j, k: 2 <= k < 6 and (120 <= i < 140 or 150 <= i < 170) and 100 <= j < 112
    write_nifti(Path("teeth.nii.gz"), (310, 230, 8),
                bytes(tooth(i, j, k) for k in range(8) for j in range(230) for i in range(310)))
    # A ball with a soft rim.
    with open("ct.nrrd", "w") as file:
        file.write("NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\nspace: left-posterior-superior\n"
                   "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: ascii\n\n")
        file.writelines("%d\n" % (1000 - 100 * ((i - 9.6)**2 + (j - 9.4)**2 + (k - 9.5)**2)**0.5)
                        for k in range(20) for j in range(20) for i in range(20))
    Path("slices").mkdir()
    for k in range(5):
        write_slice(Path("slices/%d.png" % k),
                    [[255 * (3 < i < 17 and 2 < j < 9) for i in range(20)] for j in range(12)])
    with open("part.stl", "w") as file:
        file.write("solid part\n")
        for triangle in TRIANGLES:
            file.write("facet normal 0 0 0\nouter loop\n")
            file.writelines("vertex %g %g %g\n" % CORNERS[c] for c in triangle)
            file.write("endloop\nendfacet\n")
        file.write("endsolid part\n")
    with open("part.ply", "w") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
                   "element face 12\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines("%g %g %g\n" % corner for corner in CORNERS)
        file.writelines("3 %d %d %d\n" % triangle for triangle in TRIANGLES)
    with open("part.obj", "w") as file:
        file.writelines("v %g %g %g\n" % (x, 20 * y, 20 * z) for x, y, z in CORNERS)
        file.writelines("f %d %d %d\n" % tuple(c + 1 for c in triangle) for triangle in TRIANGLES)
    for name, kind in (("scan.nii.gz", "torus"), ("root.nii.gz", "root"), ("root.nrrd", "root"), ("huge.nrrd", "root"),
                       ("bone.nrrd", "tanglecube"), ("circle-of-willis.nii.gz", "vessels"), ("chest.nii.gz", "torus")):
        run(program, "phantom", kind, "--size", 32, "-o", name, "-q")
    run(program, "core", "root.nrrd", "--lambda", 0, "-o", "core.vtp", "-q")
    run(program, "core", "atlas.nii.gz", "-o", "atlas.vtp", "-q")
    run(program, "skeleton", "chest.nii.gz", "-o", "aorta.vtp", "--also", "swc", "-q")
    Path("aorta.swc").rename("traced.swc")
    for name in ("truth.nii.gz", "network.nii.gz"):
        shutil.copy("scan.nii.gz", name)
    for name in ("day0.nii.gz", "day7.nii.gz"):
        shutil.copy("root.nii.gz", name)
    for name in ("before.vtp", "after.vtp"):
        run(program, "skeleton", "root.nrrd", "-o", name, "-q")
    shutil.copy("root.nrrd", "softmax.nrrd")  # a map that is sure of each voxel
    Path("scans").mkdir()
    shutil.copy("scan.nii.gz", "scans")
    Path("cohort.csv").write_text("id,scan,lambda\na,scan.nii.gz,1vox\nb,bone.nrrd,\n")
    Path("bones").mkdir()
    shutil.copy("bone.nrrd", "bones/femur.nrrd")
    Path("season.csv").write_text("id,scan,stems\nmaize1,root.nii.gz,1\n")


def run_examples(command, text, drawn):
    """Gives how many examples were run."""
    section = re.search(r"^Examples?:\n((?:  .*(?:\n|$))+)", text.replace("Example: ", "Example:\n  "), re.M)
    check(section, "%s --help has no examples" % command)
    count = 0
    for line in section[1].splitlines():
        line = re.sub(r"  +\(.*\)$", "", line.strip())
        check(line.startswith("voxelcore "), "what is '%s' in %s --help?" % (line, command))
        target = Path(re.search(r" -o (\S+)", line)[1]) if " -o " in line else None
        if line.startswith("voxelcore render"):
            if not drawn:
                continue
            line += " --size 200x150"
        # Other examples wrote files of these names.
        if target and any(Path().glob(target.stem.split(".")[0] + "[._]*")) and not target.is_dir():
            line += " --force"
        if target == Path("results"):
            shutil.rmtree(target, ignore_errors=True)
        # "and so on to --block 8"
        for block in range(1, 9) if "--block 1 " in line else [1]:
            each = line.replace("--block 1 ", "--block %d " % block)
            result = subprocess.run(["bash", "-c", each], capture_output=True, text=True, stdin=subprocess.DEVNULL)
            check(result.returncode == 0,
                  "%s --help: %s\nends with %d\n%s" % (command, each, result.returncode, result.stderr))
        if target:
            written = list(target.iterdir()) if target.is_dir() else list(
                Path().glob(target.stem.split(".")[0] + "[._]*"))
            check(written, "%s --help: %s\nleaves nothing" % (command, line))
        count += 1
    return count


def main():
    program, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    pages = [source / "README.md", *source.glob("Applications/manual/guide/*.md")]
    helps = {"": run(program, "--help").stdout}
    commands = re.findall(r"^  ([a-z]+) ", re.search(r"^Commands:\n(.*?)(\n\n|\Z)", helps[""], re.M | re.S)[1], re.M)
    check(len(commands) >= 11, "commands: %s" % commands)
    helps.update((command, run(program, command, "--help").stdout) for command in commands)

    # Options of other programs apart.
    others = {"--array", "--build", "--config", "--cores", "--fakeroot", "--find-links", "--heavy", "--install",
              "--no-index", "--out", "--prefix", "--profile", "--rm", "--scans", "--test-dir", "--use-singularity",
              "--userns"}
    known = set(re.findall(r"--[a-z][a-z-]*", " ".join(helps.values())))
    named = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", " ".join(page.read_text() for page in pages))) - others
    check(
        len(named) > 40 and named <= known,
        "README.md or the guide names options there are not: %s" % sorted(named - known))

    drawn = bool(shutil.which("Xvfb")) and "off in this build" not in helps["render"]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        os.symlink(program, "voxelcore")
        os.environ["PATH"] = folder + ":" + os.environ["PATH"]
        write_inputs(program)
        counts = {command or "voxelcore": run_examples(command, text, drawn) for command, text in helps.items()}
        os.chdir("/")
    print(counts)
    check(sum(counts.values()) >= (40 if drawn else 36), "too few examples were found")


main()
