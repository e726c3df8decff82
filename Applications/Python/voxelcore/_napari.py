"""What napari.json offers napari: a reader, and functions of which napari makes panels. Points and affine maps are in
napari's order z, y, x. Work is done beside napari's window, by its workers."""

import os
import typing

import numpy

from ._making import core, read
from ._making import skeleton as make_skeleton
from ._measuring import thickness as measure_thickness
from ._volume import Volume

_MM = {"unit": "mm"}


def _layers(found):
    """Layers of a result, or of a dict of results."""
    results = found.values() if isinstance(found, dict) else [found]
    return [layer for result in results for layer in result.to_napari()]


def reader(path):
    """napari's question who reads `path`: a function that gives layers, or None."""
    return _opened if isinstance(path, (str, os.PathLike)) else None


def _opened(path):
    found = read(path)
    if not isinstance(found, Volume):
        return _layers(found)
    matrix = numpy.eye(4)
    matrix[:3, :3] = (found.direction * (found.spacing or 1))[::-1, ::-1]
    matrix[:3, 3] = found.origin[::-1]
    name = os.path.basename(os.fspath(path))
    shown = {"name": name, "affine": matrix, "metadata": _MM if found.spacing else {}}
    return [(found.array.T, shown, "labels" if found.array.dtype.kind in "bui" else "image")]


def _placed(layer):
    """The layer's matrix from voxels [k, j, i] to its world, and it as arguments of core()."""
    if layer.ndim != 3:
        raise ValueError(f"the layer '{layer.name}' has {layer.ndim} dimensions; choose one with three")
    origin = numpy.array(layer.data_to_world((0, 0, 0)))
    columns = numpy.array([layer.data_to_world(step) for step in numpy.eye(3)]).T - origin[:, None]
    matrix = numpy.eye(4)
    matrix[:3, :3] = columns
    matrix[:3, 3] = origin
    spacing = numpy.linalg.norm(columns, axis=0)
    known = layer.metadata.get("unit") == "mm" or (spacing != 1).any()  # napari calls a voxel 1 where it knows no size
    place = {
        "axes": "kji",
        "spacing": spacing[::-1] if known else None,
        "origin": origin[::-1],
        "direction": (columns / spacing)[::-1, ::-1],
    }
    return matrix, place


def _worker(work):
    from napari.qt.threading import create_worker

    return create_worker(work)


def _label(number):
    return int(number) if number else "all"


def medial_surface(
    labels: "napari.layers.Labels",
    label: int = 0,
    tolerance: typing.Annotated[float, {"widget_type": "FloatSlider", "max": 6.0, "step": 0.1}] = 1.2,
    fill_cavities: bool = False,
) -> "napari.qt.threading.FunctionWorker[typing.List[napari.types.LayerDataTuple]]":
    """The medial surface of a label.

    Parameters
    ----------
    labels
        Where the shapes are.
    label
        Its number; 0: every label.
    tolerance
        How far the boundary may lie from the balls that remain, in voxel diagonals.
    fill_cavities
        Fill closed holes first.
    """
    place = _placed(labels)[1]
    options = dict(place, label=_label(label), tolerance=f"{tolerance}diag", fill_cavities=fill_cavities)
    return _worker(lambda: _layers(core(labels.data, **options)))


def skeleton(
    labels: "napari.layers.Labels", label: int = 0, prune_branches: str = "1r"
) -> "napari.qt.threading.FunctionWorker[typing.List[napari.types.LayerDataTuple]]":
    """The curve skeleton of a label.

    Parameters
    ----------
    labels
        Where the shapes are.
    label
        Its number; 0: every label.
    prune_branches
        Branches that reach less far beyond the ball they begin in are left out: '1r' is that ball's radius.
    """
    options = dict(_placed(labels)[1], prune_branches=prune_branches)

    def work():
        values = [int(label)] if label else [int(value) for value in numpy.unique(labels.data) if value]
        return _layers({value: make_skeleton(labels.data, label=value, **options) for value in values})

    return _worker(work)


def thickness(
    labels: "napari.layers.Labels", label: int = 0
) -> "napari.qt.threading.FunctionWorker[typing.List[napari.types.LayerDataTuple]]":
    """The diameter of the largest ball inside that holds a voxel's centre, as an image.

    Parameters
    ----------
    labels
        Where the shapes are.
    label
        Its number; 0: every label.
    """
    matrix, place = _placed(labels)
    shown = {"name": f"thickness of {labels.name}", "affine": matrix, "colormap": "viridis"}
    options = {"axes": "kji", "spacing": place["spacing"], "label": _label(label)}
    return _worker(lambda: [(measure_thickness(labels.data, **options).map, shown, "image")])
