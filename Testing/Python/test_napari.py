"""napari's side: the manifest keeps npe2's published rules, the reader and the panels give layers that napari takes,
with the bits of the package's own functions. napari itself is not in Debian: a stand-in has what is called of it."""

import fnmatch
import importlib
import inspect
import json
import pathlib
import re
import sys
import types
import typing

import numpy
import pytest
import voxelcore
from conftest import blobs, run, write_nrrd

NAPARI = importlib.import_module("voxelcore._napari")
MANIFEST = json.loads((pathlib.Path(voxelcore.__file__).parent / "napari.json").read_text())
# Of LayerDataTuple: what napari's Viewer.add_<type> takes, as far as we give it.
TAKEN = {
    "surface": {"name", "metadata", "colormap"},
    "shapes": {"name", "metadata", "shape_type", "features"},
    "points": {"name", "metadata", "features"},
    "labels": {"name", "metadata", "affine"},
    "image": {"name", "metadata", "affine", "colormap"},
}


class Layer:
    """What is asked of napari's Labels layer."""

    def __init__(self, data, affine=None, name="mask", metadata=None):
        self.data, self.name, self.metadata, self.ndim = data, name, metadata or {}, data.ndim
        self.affine = numpy.eye(4) if affine is None else affine

    def data_to_world(self, point):
        return tuple(self.affine[:3, :3] @ point + self.affine[:3, 3])


@pytest.fixture
def workers(monkeypatch):
    """napari.qt.threading.create_worker, which does not start a worker: who gets it does."""
    threading = types.ModuleType("napari.qt.threading")
    threading.create_worker = lambda work: types.SimpleNamespace(work=work)
    for name, module in (("napari", None), ("napari.qt", None), ("napari.qt.threading", threading)):
        monkeypatch.setitem(sys.modules, name, module or types.ModuleType(name))


def same(layers, expected):
    assert [layer[2] for layer in layers] == [layer[2] for layer in expected]
    for (ours, shown, kind), (theirs, _, _) in zip(layers, expected):
        assert set(shown) <= TAKEN[kind]
        for a, b in zip(ours, theirs) if isinstance(ours, (tuple, list)) else [(ours, theirs)]:
            assert numpy.array_equal(a, b)


def test_manifest_keeps_the_rules_of_npe2():
    assert set(MANIFEST) == {"name", "display_name", "schema_version", "contributions"}
    assert MANIFEST["name"] == "voxelcore"  # the package's, by which napari finds it
    assert re.fullmatch(r"[^\W_][\w -~]{1,88}[^\W_]", MANIFEST["display_name"])
    assert re.fullmatch(r"\d+\.\d+\.\d+", MANIFEST["schema_version"])
    offered = MANIFEST["contributions"]
    assert set(offered) == {"commands", "readers", "widgets"}
    fields = {
        "commands": {"id", "title", "python_name"},
        "readers": {"command", "filename_patterns", "accepts_directories"},
        "widgets": {"command", "display_name", "autogenerate"},
    }
    for kind, names in fields.items():
        assert offered[kind] and all(set(one) == names for one in offered[kind])
    commands = {one["id"]: one["python_name"] for one in offered["commands"]}
    assert len(commands) == len(offered["commands"])
    for identifier, name in commands.items():
        assert re.fullmatch(r"voxelcore\.[a-zA-Z_][\w-]+", identifier)
        module, _, function = name.partition(":")
        assert callable(getattr(importlib.import_module(module), function))
    used = [one["command"] for kind in ("readers", "widgets") for one in offered[kind]]
    assert sorted(used) == sorted(commands)
    shown = [one["display_name"] for one in offered["widgets"]]
    assert shown == ["Medial surface", "Curve skeleton", "Local thickness"]


def test_panels_can_be_made_of_their_signatures():
    """magicgui makes a field of each argument by its annotation, and shows what a worker returns."""
    names = {one["id"]: one["python_name"] for one in MANIFEST["contributions"]["commands"]}
    for one in MANIFEST["contributions"]["widgets"]:
        module, _, name = names[one["command"]].partition(":")
        signature = inspect.signature(getattr(importlib.import_module(module), name))
        first, *others = signature.parameters.values()
        assert first.annotation == "napari.layers.Labels" and first.default is inspect.Parameter.empty
        for other in others:
            kind = typing.get_args(other.annotation)[0] if typing.get_args(other.annotation) else other.annotation
            assert kind in (int, float, bool, str) and type(other.default) is kind
        assert signature.return_annotation == (
            "napari.qt.threading.FunctionWorker[typing.List[napari.types.LayerDataTuple]]"
        )


@pytest.mark.parametrize("label", [0, 2])
def test_panels_give_the_layers_of_the_package(workers, label):
    volume = blobs(7, labels=2)
    affine = numpy.diag([2.0, 1.0, 0.5, 1.0])
    affine[:3, 3] = [30, -20, 10]
    layer = Layer(volume, affine)
    place = dict(axes="kji", spacing=(0.5, 1, 2), origin=(10, -20, 30), label=label or "all")
    results = voxelcore.core(volume, tolerance="1.2diag", **place)
    expected = [one for result in (results.values() if label == 0 else [results]) for one in result.to_napari()]
    same(NAPARI.medial_surface(layer, label).work(), expected)
    each = [voxelcore.skeleton(volume, **dict(place, label=value)) for value in ([label] if label else [1, 2])]
    expected = [one for result in each for one in result.to_napari()]
    same(NAPARI.skeleton(layer, label).work(), expected)
    found = voxelcore.thickness(volume, axes="kji", spacing=(0.5, 1, 2), label=label or "all").map
    made = NAPARI.thickness(layer, label).work()
    same(made, [(found, {}, "image")])
    assert numpy.array_equal(made[0][1]["affine"], affine)


def test_voxels_without_a_size_stay_voxels(workers):
    volume = blobs(8)
    surface = NAPARI.medial_surface(Layer(volume)).work()[0]
    assert surface[1]["metadata"]["unit"] == "voxel"
    surface = NAPARI.medial_surface(Layer(volume, metadata={"unit": "mm"})).work()[0]
    assert surface[1]["metadata"]["unit"] == "mm"


def test_layer_that_is_no_volume_is_refused_by_name(workers):
    with pytest.raises(ValueError, match="the layer 'mask' has 4 dimensions; choose one with three"):
        NAPARI.skeleton(Layer(numpy.ones((2, 3, 4, 5), int)))


def test_reader_opens_what_the_program_wrote_where_the_scan_lies(workers, tmp_path):
    turned = numpy.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    scan, surface, lines = (str(tmp_path / name) for name in ("scan.nrrd", "core.vtp", "skeleton.vtp"))
    write_nrrd(scan, blobs(9, labels=2), (0.5, 1, 2), (5, -6, 7), turned)
    run("core", scan, "-o", surface)
    run("skeleton", scan, "-o", lines)
    patterns = MANIFEST["contributions"]["readers"][0]["filename_patterns"]
    for path in (scan, surface, lines):
        assert any(fnmatch.fnmatch(path, pattern) for pattern in patterns)
        same(NAPARI.reader(path)(path), NAPARI._opened(path))
    assert NAPARI.reader([scan, surface]) is None
    data, shown, kind = NAPARI.reader(scan)(scan)[0]
    assert kind == "labels"
    # What a panel makes of that layer is what the program made of the file.
    expected = [one for result in voxelcore.read(surface).values() for one in result.to_napari()]
    made = NAPARI.medial_surface(Layer(data, shown["affine"], metadata=shown["metadata"])).work()
    assert [layer[2] for layer in made] == [layer[2] for layer in expected]
    for (ours, _, _), (theirs, _, _) in zip(made, expected):
        for a, b in zip(ours, theirs):
            # The layer's affine map is one of rounded products, not spacing and direction apart.
            assert numpy.allclose(a, b, rtol=0, atol=1e-9)
