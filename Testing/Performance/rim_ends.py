#!/usr/bin/env python3
"""How far the rim of a core by default stays short of the true one, and how much of that its tolerance explains.
usage: PYTHONPATH=BUILD/python rim_ends.py [BODIES [SEED]]   (python3-numpy)

Oblate ellipsoids and lenses of 24 to 60 voxels from the middle to the edge, in random turns, in cubes and in slices 2.5
times as thick. Their true medial surface is a disc, and where on it balls leave the edge no farther off than the
tolerance there is known: 1.2 of the voxel's extent towards the edge. In each of 72 directions the farthest place on
the core's edges is held against both. Prints the seed and, per body, voxels of the shortest side."""
import secrets
import sys

import numpy as np
import voxelcore

PLACES = 20001


def last_needed(reach, edge, radius_at, tolerance):
    """The outermost place on a radius of the disc whose ball leaves the edge farther off than the tolerance."""
    places = np.linspace(0, reach, PLACES)
    return places[edge - places - radius_at(places) >= tolerance].max(initial=0)


def main():
    bodies = int(sys.argv[1]) if len(sys.argv) > 1 else 24
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(10**6)
    random = np.random.default_rng(seed)
    print(f"seed {seed}; mean and worst of 72 directions, voxels\n"
          "| body | slices | edge at | short of the true rim | tolerance explains | short beyond that |\n"
          "| --- | --- | --- | --- | --- | --- |")
    for number in range(bodies):
        spacing = np.array([1, 1, (1, 2.5)[number % 2]])
        edge = random.uniform(24, 60)
        if number // 2 % 2 == 0:
            kind, thick = "ellipsoid", edge * random.uniform(0.2, 0.6)
            rest = edge * edge - thick * thick
            reach = rest / edge
            radius_at = lambda x: thick * np.sqrt(np.maximum(0, 1 - x * x / rest))  # noqa: B023, E731
            holds = lambda x, y, z: (x * x + y * y) / edge**2 + (z / thick)**2 <= 1  # noqa: B023, E731
        else:
            kind, ball = "lens", edge * random.uniform(1.05, 2)
            off = np.sqrt(ball * ball - edge * edge)
            reach = edge
            radius_at = lambda x: ball - np.hypot(x, off)  # noqa: B023, E731
            holds = lambda x, y, z: x * x + y * y + (np.abs(z) + off)**2 <= ball * ball  # noqa: B023, E731
        axes = np.linalg.qr(random.normal(size=(3, 3)))[0]
        size = np.ceil((2 * edge + 6) / spacing).astype(int)
        middle = (size - 1) * spacing / 2 + random.uniform(-0.5, 0.5, 3) * spacing
        places = np.stack(np.indices(size), -1) * spacing - middle
        mask = holds(*np.moveaxis(places @ axes, -1, 0)).astype(np.uint8)
        core = voxelcore.core(mask, spacing=tuple(spacing), axes="ijk")
        ends = ((np.asarray(core.vertices) - middle) @ axes)[np.asarray(core.edges)]
        along = np.linspace(0, 1, 11)[:, None, None]
        x, y, _ = ((1 - along) * ends[:, 0] + along * ends[:, 1]).reshape(-1, 3).T
        part = np.floor((np.arctan2(y, x) / (2 * np.pi) + 0.5) * 72).astype(int) % 72
        rim = np.array([np.hypot(x, y)[part == one].max(initial=0) for one in range(72)])
        turns = ((np.arange(72) + 0.5) / 72 - 0.5) * 2 * np.pi
        extents = np.abs(np.stack([np.cos(turns), np.sin(turns), 0 * turns], -1) @ axes.T) @ spacing
        needed = np.array([last_needed(reach, edge, radius_at, 1.2 * extent) for extent in extents])
        cells = " | ".join(f"{gap.mean():.2f}, {gap.max():.2f}" for gap in (reach - rim, reach - needed, needed - rim))
        print(f"| {kind} | {spacing[2]:g} | {edge:.1f} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
