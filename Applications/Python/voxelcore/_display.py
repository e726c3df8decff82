"""Results as pictures, by matplotlib, and as what notebooks show."""

import base64
import html
import io

import numpy

from . import _exchange

_MOST_FACES = 200_000  # that matplotlib draws within a few seconds


def _unit(result):
    return "vox" if result.unit == "voxel" else "mm"


def _axes(axes):
    if axes is not None:
        return axes
    pyplot = _exchange.library("matplotlib.pyplot", "matplotlib")
    return pyplot.figure().add_subplot(projection="3d")


def _frame(axes, points, result, mappable, name):
    """Equal scales, names of axes and a bar."""
    if len(points):
        low, high = points.min(0), points.max(0)
        middle, half = (low + high) / 2, max((high - low).max() / 2, 1e-9)
        for limit, centre in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle):
            limit(centre - half, centre + half)
    axes.set_box_aspect((1, 1, 1))
    for label, letter in zip((axes.set_xlabel, axes.set_ylabel, axes.set_zlabel), "xyz"):
        label(f"{letter} (LPS, {_unit(result)})")
    axes.figure.colorbar(mappable, ax=axes, shrink=0.7, label=f"{name} ({_unit(result)})")
    return axes


def plot_skeleton(skeleton, axes=None):
    axes = _axes(axes)
    art = _exchange.library("mpl_toolkits.mplot3d.art3d", "matplotlib")
    lines, radii = [], []
    for begin, end in zip(skeleton.branch_offsets[:-1], skeleton.branch_offsets[1:]):
        points = skeleton.branch_points[begin:end]
        lines += list(numpy.stack([skeleton.points[points[:-1]], skeleton.points[points[1:]]], 1))
        radii.append((skeleton.radius[points[:-1]] + skeleton.radius[points[1:]]) / 2)
    collection = art.Line3DCollection(lines, array=numpy.concatenate(radii) if radii else numpy.zeros(0), linewidths=2)
    axes.add_collection3d(collection)
    return _frame(axes, skeleton.points, skeleton, collection, "radius")


def plot_core(core, axes=None):
    axes = _axes(axes)
    art = _exchange.library("mpl_toolkits.mplot3d.art3d", "matplotlib")
    faces = [
        core.face_vertices[begin:end] for begin, end in zip(core.face_offsets[:-1], core.face_offsets[1:])
    ]
    step = max(1, -(-len(faces) // _MOST_FACES))
    faces = faces[::step]
    free = core.edges[core.free_edges()]
    values = numpy.array([core.radius[face].mean() for face in faces] or [0.0])
    mappable = _exchange.library("matplotlib.cm", "matplotlib").ScalarMappable()
    mappable.set_array(numpy.concatenate([values, core.radius]))
    mappable.autoscale()
    if faces:
        axes.add_collection3d(
            art.Poly3DCollection([core.vertices[face] for face in faces], facecolors=mappable.to_rgba(values))
        )
    if len(free):
        axes.add_collection3d(
            art.Line3DCollection(core.vertices[free], colors=mappable.to_rgba(core.radius[free].mean(1)))
        )
    return _frame(axes, core.vertices, core, mappable, "radius")


def _picture(result, plot):
    """An <img> of a plot; empty without matplotlib."""
    try:
        figure = _exchange.library("matplotlib.figure", "matplotlib").Figure(figsize=(5, 4), dpi=90)
        canvas = _exchange.library("matplotlib.backends.backend_agg", "matplotlib").FigureCanvasAgg(figure)
    except ImportError:
        return ""
    plot(result, figure.add_subplot(projection="3d"))
    png = io.BytesIO()
    canvas.print_png(png)
    return f'<img alt="" src="data:image/png;base64,{base64.b64encode(png.getvalue()).decode()}">'


def _table(rows):
    cells = "".join(f"<tr><th>{html.escape(name)}</th><td>{html.escape(value)}</td></tr>" for name, value in rows)
    return f"<table>{cells}</table>"


def _of_label(result):
    one = result.report["labels"][0]
    euler, betti = result.topology["euler"], result.topology["betti"]
    return [("label", f"{result.label} {one.get('name', '')}".strip()),
            ("pieces, loops, cavities", ", ".join(map(str, betti))), ("Euler number", str(euler))]  # fmt: skip


def html_of_skeleton(skeleton):
    numbers, unit = skeleton.numbers, _unit(skeleton)
    rows = _of_label(skeleton) + [
        (name, str(numbers[name])) for name in ("branches", "tips", "junctions", "cycles") if name in numbers
    ]
    rows += [(name.replace("total_", "").replace("_", " "), f"{numbers[name]:.4g} {unit}")
             for name in ("total_length", "mean_radius")]  # fmt: skip
    return _picture(skeleton, plot_skeleton) + _table(rows)


def html_of_core(core):
    rows = _of_label(core) + [
        ("vertices, edges, faces", f"{len(core.vertices)}, {len(core.edges)}, {len(core.face_offsets) - 1}"),
        ("greatest radius", f"{core.radius.max() if len(core.radius) else 0:.4g} {_unit(core)}"),
    ]
    return _picture(core, plot_core) + _table(rows)
