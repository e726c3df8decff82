"""Neuroglancer's precomputed skeletons and meshes.
https://github.com/google/neuroglancer/tree/master/src/datasource/precomputed"""

import json
import os
import struct

import numpy

from . import _exchange


def _nanometres(result):
    if result.unit == "voxel":
        raise ValueError("to_precomputed(): lengths there are in nm, and the scan has no voxel size; give spacing=")
    return 1e6


def skeleton_bytes(skeleton):
    """Points in nm, edges between neighbours along branches, and the radius of each point in nm."""
    scale = _nanometres(skeleton)
    edges = _exchange.skeleton_edges(skeleton).astype("<u4")
    points = (skeleton.points * scale).astype("<f4")
    radii = (skeleton.radius * scale).astype("<f4")
    return struct.pack("<II", len(points), len(edges)) + points.tobytes() + edges.tobytes() + radii.tobytes()


def mesh_bytes(core):
    scale = _nanometres(core)
    triangles = _exchange.triangles(core.face_offsets, core.face_vertices)[0].astype("<u4")
    points = (core.vertices * scale).astype("<f4")
    return struct.pack("<I", len(points)) + points.tobytes() + triangles.tobytes()


def write(results, folder, overwrite, is_skeleton):
    """One folder for all results, each by its label."""
    files = {}
    names = {}
    for one in results:
        key = str(one.label)
        if key in names:
            raise ValueError(f"to_precomputed(): label {key} is there twice; give one result a label")
        names[key] = one.report["labels"][0].get("name", key)
        if is_skeleton:
            files[key] = skeleton_bytes(one)
        else:
            files[key + ":0"] = json.dumps({"fragments": [key + ".mesh"]}).encode()
            files[key + ".mesh"] = mesh_bytes(one)
    if is_skeleton:
        info = {
            "@type": "neuroglancer_skeletons",
            "transform": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0],
            "vertex_attributes": [{"id": "radius", "data_type": "float32", "num_components": 1}],
        }
    else:
        info = {"@type": "neuroglancer_legacy_mesh"}
    info["segment_properties"] = "names"
    values = {"ids": list(names), "properties": [{"id": "label", "type": "label", "values": list(names.values())}]}
    properties = {"@type": "neuroglancer_segment_properties", "inline": values}
    # What says that the folder is whole comes last.
    folder = os.fspath(folder)
    if not overwrite and os.path.exists(os.path.join(folder, "info")):
        raise OSError(f"{folder}: exists already; give overwrite=True to replace it, or another name")
    os.makedirs(os.path.join(folder, "names"), exist_ok=True)
    files[os.path.join("names", "info")] = json.dumps(properties).encode()
    files["info"] = json.dumps(info).encode()
    for name, data in files.items():
        path = os.path.join(folder, name)
        with open(path + ".part", "wb") as file:
            file.write(data)
        os.replace(path + ".part", path)
