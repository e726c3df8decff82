#!/usr/bin/env python3
"""`roots` on real crowns whose authors published a skeleton, made solid: one row each.
usage: root_crowns.py PROGRAM   (python3-numpy, python3-scipy; data in VOXELCORE_TEST_DATA, skipped without)"""
import os
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

import numpy

from root_truth import compare, read_published, read_rsml, stem_path

# Scan, published skeleton, and what is added to its places to find them in the scan.
CROWNS = {"353-10": ("rootgui_353-10_rasterised.nrrd", "rootgui_353-10_skeleton.ply", (-97, -61, 5))}


def main():
    data = pathlib.Path(os.environ.get("VOXELCORE_TEST_DATA", "")) / "real" / "roots"
    crowns = {name: files for name, files in CROWNS.items() if (data / files[0]).is_file()}
    if not crowns:
        print("skipped: no crowns in VOXELCORE_TEST_DATA/real/roots")
        return
    print("| crown | stem path % | tips found % | spurious % | length % | on its level % | roots | levels |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, (scan, skeleton, offset) in crowns.items():
        places, level, radius, ends = read_published(data / skeleton)
        places = places + numpy.array(offset)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.argv[1], "roots", data / scan, "--no-pictures", "-q", "-o", folder + "/r"], check=True)
            found = read_rsml(folder + "/r/roots.rsml")
        tips = numpy.array([vertex for vertex, count in Counter(ends.ravel().tolist()).items() if count == 1])
        figures = compare(found, places[ends].mean(1), level[ends].max(1),
                          numpy.linalg.norm(places[ends[:, 0]] - places[ends[:, 1]], axis=1), radius[ends].mean(1),
                          places[tips], radius[tips])
        stem = numpy.flatnonzero(level == 0)
        path, _ = stem_path(found, places[stem], radius[stem])
        print(f"| {name} | {path:.0f} | {figures['tips found %']:.1f} | {figures['spurious %']:.1f} | "
              f"{figures['length %']:.1f} | {figures['level %']:.1f} | {figures['roots']} | {figures['levels']} |")


if __name__ == "__main__":
    main()
