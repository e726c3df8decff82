"""Whatever the array looks like in memory, the core is that of its values; or there is one clear line."""

import re
import time

import numpy
import pytest
import voxelcore
from conftest import blobs

WHOLE = ["bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"]


def same(a, b):
    names = ["vertices", "radius", "edges", "face_offsets", "face_vertices", "face_edges"]
    names += ["lambda_vertices", "lambda_edges", "lambda_faces"]
    return all(getattr(a, name).tobytes() == getattr(b, name).tobytes() for name in names)


@pytest.fixture
def expected(volume):
    core = voxelcore.core(numpy.asfortranarray(volume))
    assert len(core.vertices) > 20
    return core


@pytest.mark.parametrize("dtype", WHOLE)
@pytest.mark.parametrize("order", ["C", "F"])
def test_any_type_and_memory_order(volume, expected, dtype, order):
    assert same(voxelcore.core(numpy.array(volume, dtype, order=order)), expected)


@pytest.mark.parametrize("dtype", [">u2", ">i4", ">f8", ">u8", "<i2"])
def test_any_byte_order(volume, expected, dtype):
    assert same(voxelcore.core(volume.astype(dtype)), expected)


def test_views_with_any_strides(volume, expected):
    wide = numpy.full((60, 50, 44), 9, numpy.int16)
    view = wide[2:58:2, 48:0:-2, 1:41:2]
    view[...] = volume
    assert view.shape == volume.shape and min(view.strides) < 0
    assert same(voxelcore.core(view), expected)
    for axes in [(0, 2, 1), (1, 0, 2), (2, 1, 0), (1, 2, 0), (2, 0, 1)]:
        inner = numpy.ascontiguousarray(volume.transpose(axes))
        assert same(voxelcore.core(inner.transpose(numpy.argsort(axes))), expected)
    assert same(voxelcore.core(volume[::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1]), expected)


def test_read_only_unaligned_and_broadcast_arrays(volume, expected):
    volume.setflags(write=False)
    assert same(voxelcore.core(volume), expected)
    unaligned = numpy.ndarray(volume.shape, numpy.int32, bytearray(volume.size * 4 + 1), 1, order="F")
    unaligned[...] = volume
    assert not unaligned.flags.aligned
    assert same(voxelcore.core(unaligned), expected)
    slab = numpy.broadcast_to(numpy.uint8([1, 1, 1]), (9, 8, 3))
    assert 0 in slab.strides
    assert same(voxelcore.core(slab), voxelcore.core(slab.copy()))


def test_whatever_numpy_can_make_an_array_of():
    nested = [[[1, 1], [1, 1]], [[1, 1], [1, 0]]]
    assert same(voxelcore.core(nested, lambda_=0), voxelcore.core(numpy.array(nested), lambda_=0))


@pytest.mark.parametrize("order", ["C", "F"])
def test_slabs_of_rows_join_without_a_seam(order):
    # Rows of 1 MB: a slice is several slabs, and none may run into the next slice.
    array = numpy.zeros((1 << 17, 7, 3), numpy.int64, order=order)
    array[5000:5030, 1:6, 1] = 1
    array[5010:5020, 3:7, 0:3] = 1
    core = voxelcore.core(array, lambda_=0)
    part = voxelcore.core(array[4990:5050], lambda_=0, origin=(4990, 0, 0))
    assert core.voxels == array.sum() and same(core, part)


@pytest.mark.parametrize(
    "array, words",
    [
        (numpy.zeros((3, 3), numpy.uint8), "2 dimensions"),
        (numpy.zeros((3, 3, 3, 1), numpy.uint8), r"4 dimensions.*a\[\.\.\., 0\]"),
        (numpy.zeros((3, 0, 3), numpy.uint8), "empty"),
        (numpy.zeros((3, 3, 3), numpy.uint8), "background"),
        (numpy.full((3, 3, 3), "x"), "its type is"),
        (numpy.full((3, 3, 3), None), "its type is object"),
        (numpy.ones((3, 3, 3), numpy.float16), "float16"),
        (numpy.ones((3, 3, 3), numpy.longdouble), "longdouble|float128"),
        (numpy.ones((3, 3, 3), complex), "complex128"),
        (numpy.ones((3, 3, 3), "datetime64[s]"), "datetime64"),
        (numpy.ones((3, 3, 3), [("a", int)]), "its type is"),
        (numpy.full((3, 3, 3), 0.5), r"0\.5"),
        (numpy.full((3, 3, 3), numpy.nan), "nan"),
        (numpy.full((3, 3, 3), -1), "-1"),
        (7, "single value"),
        ("scan.nii.gz", r"scan\.nii\.gz: no such file"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(array, words):
    with pytest.raises(ValueError, match=words) as caught:
        voxelcore.core(array)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "options, words",
    [
        (dict(spacing=(1, 1)), "spacing"),
        (dict(spacing=(1, 1, 0)), "spacing|0"),
        (dict(spacing="abc"), "spacing"),
        (dict(spacing="5 parsecs"), "spacing"),
        (dict(spacing=0), "spacing|0"),
        (dict(lambda_="2 parsecs"), "parsecs"),
        (dict(lambda_=-1), "-1"),
        (dict(lambda_="0,1mm"), "give a list"),
        (dict(lambda_=[]), "empty"),
        (dict(lambda_=[1, None]), "None"),
        (dict(lambda_=[0, 1], tolerance=1), "one value"),
        (dict(tolerance="x"), "x"),
        (dict(label=77), "77"),
        (dict(label=1.5), r"1\.5"),
        (dict(label="one"), "one"),
        (dict(label=numpy.nan), "label nan"),
        (dict(label={1, 2}), "label {1, 2}"),
        (dict(label=numpy.zeros((2, 2))), "label array"),
        (dict(axes="xyz"), "xyz"),
        (dict(engine="magic"), "magic"),
        (dict(threads=-2), "-2"),
        (dict(direction=numpy.eye(2)), "3 by 3"),
        (dict(direction=[[1, 0.2, 0], [0, 1, 0], [0, 0, 1]]), "degrees|right"),
        (dict(threshold=(3, 1)), "LO <= HI"),
        (dict(threshold=(1, 2), label=1), "only one"),
        (dict(origin=(0, 0, numpy.inf)), "origin|inf"),
    ],
)
def test_options_that_make_no_sense_are_refused_in_one_line(volume, options, words):
    with pytest.raises(ValueError, match=words) as caught:
        voxelcore.core(volume, **options)
    assert "\n" not in str(caught.value)


def test_a_grey_array_asks_for_a_threshold():
    x, y, z = numpy.mgrid[:32, :32, :32] - 15.5
    inside = x**2 + y**2 + z**2 < 100
    grey = numpy.where(inside, 150, 60) + numpy.random.default_rng(5).normal(0, 8, inside.shape)
    for array in (grey.astype(numpy.uint8), grey.astype(numpy.int16) - 1000, grey.astype(numpy.float32)):
        with pytest.raises(ValueError, match=r"looks like a grey scan.*threshold=\((-?[\d.]+), numpy.inf\)") as caught:
            voxelcore.core(array)
        low = float(re.search(r"threshold=\((-?[\d.]+)", str(caught.value)).group(1))
        core = voxelcore.core(array, threshold=(low, numpy.inf), tolerance="1.2diag")
        assert abs(core.voxels - inside.sum()) < 0.02 * inside.sum()


def test_several_labels_ask_for_a_choice():
    three = blobs(3, labels=3)
    with pytest.raises(ValueError, match=r"3 labels \(1, 2, 3\)"):
        voxelcore.core(three)
    assert same(voxelcore.core(three, label=2), voxelcore.core(three == 2))
    assert same(voxelcore.core(three, label="any"), voxelcore.core(three > 0))
    assert voxelcore.core(three, label=numpy.int16(2)).label == 2


@pytest.mark.parametrize("form", [tuple, numpy.array, lambda values: range(values[0], values[-1] + 1)])
def test_several_values_come_as_lists_ranges_or_arrays(form):
    three = blobs(3, labels=3)
    cores = voxelcore.core(three, label=form([2, 3]), lambda_=form([0, 1]))
    listed = voxelcore.core(three, label=[2, 3], lambda_=[0, 1])
    assert list(cores) == [2, 3]
    assert all(same(a, b) for label in cores for a, b in zip(cores[label], listed[label]))
    assert list(voxelcore.thickness(three, label=form([2, 3])).numbers) == [2, 3]


@pytest.mark.parametrize("dtype", ["uint8", "int16", "float32", "bool"])
def test_what_a_mask_hides_is_background(volume, dtype):
    hidden = blobs(6) > 0
    masked = numpy.ma.MaskedArray(volume.astype(dtype), hidden)
    assert same(voxelcore.core(masked), voxelcore.core(numpy.where(hidden, 0, volume).astype(dtype)))
    assert same(voxelcore.core(numpy.ma.MaskedArray(volume)), voxelcore.core(volume))
    assert same(voxelcore.core(masked.T, axes="kji"), voxelcore.core(masked))
    with pytest.raises(ValueError, match="background"):
        voxelcore.core(numpy.ma.MaskedArray(volume, True))


@pytest.mark.parametrize(
    "dtype, threshold", [("int16", (0, 1)), ("uint8", (0, 1)), ("float32", (-numpy.inf, 1)), ("bool", (0, 1))]
)
def test_what_a_mask_hides_is_outside_any_threshold(volume, dtype, threshold):
    hidden = blobs(6) > 0
    masked = numpy.ma.MaskedArray((volume > 0).astype(dtype), hidden)
    assert same(voxelcore.core(masked, threshold=threshold), voxelcore.core(~hidden))


def test_a_mask_for_which_no_value_is_left_is_refused(volume):
    with pytest.raises(ValueError, match="no value is left"):
        voxelcore.core(numpy.ma.MaskedArray(volume, volume > 0), threshold=(0, 255))


@pytest.mark.parametrize(
    "place",
    [
        {"spacing": (0.0001, 1, 1)},
        {"spacing": (1, 1, 2.0**31 + 1)},
        {"spacing": (4.6e-41, 4.6e-41, 4.6e-41)},
        {"origin": (1.8446744e19, 0, 0)},
        {"origin": (float("nan"), 0, 0)},
    ],
)
def test_geometry_without_exact_lengths_is_refused(volume, place):
    with pytest.raises(ValueError) as caught:
        voxelcore.core(volume, **place)
    assert "--" not in str(caught.value)


def test_a_micrometre_a_kilometre_away_is_a_place(volume):
    core = voxelcore.core(volume, spacing=(0.001, 0.001, 0.001), origin=(1e6, 1e6, 1e6))
    assert core.topology == voxelcore.core(volume).topology


@pytest.mark.parametrize("make", [voxelcore.core, voxelcore.skeleton, voxelcore.thickness, voxelcore.sheets])
def test_a_byte_shown_as_more_voxels_than_memory_has_bits_is_refused_at_once(make):
    endless = numpy.broadcast_to(numpy.uint8(1), (100_000, 100_000, 100_000))
    began = time.monotonic()
    with pytest.raises(ValueError, match="1000000000000000 voxels, more than this machine has bits of memory"):
        make(endless)
    assert time.monotonic() - began < 2
    shown = numpy.broadcast_to(numpy.uint8(1), (9, 8, 7))
    assert voxelcore.core(shown).voxels == 9 * 8 * 7
