"""Results in the forms of other libraries, each imported when it is asked for."""

import numpy

KINDS = ("tip", "junction", "loop", "isolated", "surface")


def library(name, package):
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError:
        raise ImportError(f"this needs the package {package}; install it, for example by pip") from None


def triangles(offsets, corners):
    """(t, 3) int64: each polygon as the fan of triangles from its first corner, in the order of the polygons."""
    offsets = numpy.asarray(offsets, numpy.int64)
    corners = numpy.asarray(corners, numpy.int64)
    counts = numpy.diff(offsets) - 2
    face = numpy.repeat(numpy.arange(len(counts)), counts)
    place = numpy.arange(len(face)) - numpy.repeat(numpy.cumsum(counts) - counts, counts)
    first = offsets[:-1][face]
    return numpy.stack([corners[first], corners[first + place + 1], corners[first + place + 2]], 1), face


def pyvista(result):
    return library("pyvista", "pyvista").wrap(result.to_polydata())


def trimesh(core):
    faces, of_face = triangles(core.face_offsets, core.face_vertices)
    return library("trimesh", "trimesh").Trimesh(
        vertices=core.vertices,
        faces=faces,
        process=False,
        vertex_attributes={"radius": numpy.array(core.radius), "lambda": numpy.array(core.lambda_vertices)},
        face_attributes={"lambda": core.lambda_faces[of_face]},
        metadata={"units": core.unit, "label": core.label},
    )


def napari_of_core(core):
    faces, _ = triangles(core.face_offsets, core.face_vertices)
    name = f"medial surface of label {core.label}"
    surface = (core.vertices[:, ::-1], faces, numpy.array(core.radius)), {"name": name, "metadata": _told(core)}
    free = core.free_edges()
    if len(free) == 0:
        return [(*surface, "surface")]
    lines = core.vertices[core.edges[free]][:, :, ::-1]
    return [
        (*surface, "surface"),
        (list(lines), {"name": name + ", lines", "shape_type": "path", "metadata": _told(core)}, "shapes"),
    ]


def napari_of_skeleton(skeleton):
    table = skeleton.measure()
    paths = [skeleton.branch(number)[:, ::-1] for number in range(len(skeleton.branch_nodes))]
    nodes = skeleton.points[skeleton.node_points][:, ::-1]
    kinds = numpy.array(KINDS)[skeleton.node_kinds]
    name = f"skeleton of label {skeleton.label}"
    features = {column: values for column, values in table.items() if len(values) == len(paths)}
    return [
        (paths, {"name": name, "shape_type": "path", "features": features, "metadata": _told(skeleton)}, "shapes"),
        (nodes, {"name": name + ", nodes", "features": {"kind": kinds}, "metadata": _told(skeleton)}, "points"),
    ]


def _told(result):
    return {"unit": result.unit, "axes": "z, y, x (LPS)", "label": result.label}


def networkx(skeleton):
    graph = library("networkx", "networkx").MultiGraph(label=skeleton.label, unit=skeleton.unit)
    places, sections = skeleton.points, skeleton.radius
    for node, point in enumerate(skeleton.node_points):
        graph.add_node(
            node,
            pos=tuple(places[point].tolist()),
            radius=float(sections[point]),
            kind=KINDS[skeleton.node_kinds[node]],
        )
    table = skeleton.measure()
    for number, (a, b) in enumerate(skeleton.branch_nodes.tolist()):
        begin, end = skeleton.branch_offsets[number : number + 2]
        points = skeleton.branch_points[begin:end]
        numbers = {name: values[number] for name, values in table.items()}
        numbers = {name: value.item() if hasattr(value, "item") else value for name, value in numbers.items()}
        graph.add_edge(a, b, key=number, **numbers, points=places[points], radii=sections[points])
    return graph


def pandas(skeleton):
    return library("pandas", "pandas").DataFrame(table_of(skeleton))


def table_of(skeleton):
    """The columns of the program's table of branches, in its order."""
    from ._measuring import columns

    measured = skeleton.measure()
    places = skeleton.points[skeleton.node_points[skeleton.branch_nodes]]
    labels = skeleton.branch_labels
    names = skeleton.names
    values = dict(
        measured,
        label=labels,
        name=[names.get(int(label), "") for label in labels],
        part=numpy.full(len(labels), skeleton.component),
        branch_id=numpy.arange(len(labels)),
        node_id_src=skeleton.branch_nodes[:, 0].astype(int),
        node_id_dst=skeleton.branch_nodes[:, 1].astype(int),
    )
    for end, which in (("src", 0), ("dst", 1)):
        for axis, letter in enumerate("xyz"):
            values[f"coord_{end}_{letter}"] = places[:, which, axis]
    return {name: values[name] for name in columns(skeleton.unit)}


def skeleton_edges(skeleton):
    """(e, 2): neighbours along branches."""
    runs = numpy.diff(skeleton.branch_offsets.astype(numpy.int64))
    ends = numpy.ones(len(skeleton.branch_points), bool)
    ends[numpy.cumsum(runs) - 1] = False  # the last point of a branch begins no edge
    begins = numpy.flatnonzero(ends)
    return numpy.stack([skeleton.branch_points[begins], skeleton.branch_points[begins + 1]], 1)


def osteoid(skeleton, scale):
    """Vertices, edges between neighbours along branches, radii."""
    edges = skeleton_edges(skeleton)
    return library("osteoid", "osteoid").Skeleton(
        vertices=(skeleton.points * scale).astype(numpy.float32),
        edges=edges.astype(numpy.uint32),
        radii=(skeleton.radius * scale).astype(numpy.float32),
        segid=skeleton.label,
        space="physical",
    )


def save_arrays(result, path, overwrite):
    """The arrays of a result, and its report as text, in an .npz file, which is whole or not there."""
    import json
    import os

    path = os.fsdecode(path)
    if not overwrite and os.path.exists(path):
        raise OSError(f"{path}: exists already; give overwrite=True to replace it, or another name")
    arrays = {}
    for kind in type(result).__mro__:
        for name, member in vars(kind).items():
            if isinstance(member, property) and isinstance(value := getattr(result, name), numpy.ndarray):
                arrays[name] = value
    with open(path + ".part", "wb") as file:
        numpy.savez_compressed(file, report=json.dumps(result.report), **arrays)
    os.replace(path + ".part", path)
