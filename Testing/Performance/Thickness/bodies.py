"""Bodies whose local thickness is known everywhere, drawn at any turn and spacing, and maps read back."""
import gzip

import numpy as np


def write_nrrd(path, mask, spacing):
    """mask[z, y, x]"""
    nz, ny, nx = mask.shape
    header = (
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
        f"sizes: {nx} {ny} {nz}\n"
        f"space directions: ({spacing[0]},0,0) (0,{spacing[1]},0) (0,0,{spacing[2]})\n"
        "encoding: raw\nspace origin: (0,0,0)\n\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode() + np.ascontiguousarray(mask, dtype=np.uint8).tobytes())


def read_nrrd(path):
    """float32 [z, y, x]"""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"\n\n")
    fields = dict(line.split(": ", 1) for line in data[:end].decode().split("\n") if ": " in line and line[0] != "#")
    size = [int(n) for n in fields["sizes"].split()]
    body = data[end + 2:]
    if fields["encoding"] == "gzip":
        body = gzip.decompress(body)
    types = {"float": "<f4", "float32": "<f4", "uint8": "u1", "uint32": "<u4"}
    return np.frombuffer(body, dtype=types[fields["type"]]).reshape(size[2], size[1], size[0])


def random_turn(random):
    """A rotation matrix, uniform over all (Shoemake 1992)."""
    u = random.random(3)
    q = [
        np.sqrt(1 - u[0]) * np.sin(2 * np.pi * u[1]),
        np.sqrt(1 - u[0]) * np.cos(2 * np.pi * u[1]),
        np.sqrt(u[0]) * np.sin(2 * np.pi * u[2]),
        np.sqrt(u[0]) * np.cos(2 * np.pi * u[2]),
    ]
    x, y, z, w = q
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def places(size, spacing, shift, turn):
    """Voxel centres in the body's axes, mm, from its middle."""
    axes = [(np.arange(n) + 0.5) * s for n, s in zip(size, spacing)]
    middle = [n * s / 2 + d for n, s, d in zip(size, spacing, shift)]
    z, y, x = np.meshgrid(axes[2] - middle[2], axes[1] - middle[1], axes[0] - middle[0], indexing="ij")
    return [turn[0][k] * x + turn[1][k] * y + turn[2][k] * z for k in range(3)]


def make(kind, thickness, spacing, random):
    """(mask, where the thickness is known, its value): all lengths in mm, which are voxels across the first axis."""
    turn = random_turn(random)
    side = max(40, int(4 * thickness) + 12)
    size = [int(np.ceil(side / s)) for s in spacing]
    shift = [(random.random() - 0.5) * s for s in spacing]
    p = places(size, spacing, shift, turn)
    half = side / 2 - 4
    if kind == "plate":
        reach = half / 1.5
        mask = (np.abs(p[2]) < thickness / 2) & (np.hypot(p[0], p[1]) < reach)
        known = mask & (np.hypot(p[0], p[1]) < reach - thickness)
    elif kind == "rod":
        mask = (np.hypot(p[0], p[1]) < thickness / 2) & (np.abs(p[2]) < half)
        known = mask & (np.abs(p[2]) < half - thickness)
    elif kind == "sphere":
        mask = np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2) < thickness / 2
        known = mask
    elif kind == "shell":
        radius = half - thickness
        distance = np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2)
        mask = (distance > radius) & (distance < radius + thickness)
        known = mask
    return mask, known
