"""Images of other libraries have the place that the command line finds in their files."""

import sys
import types

import nibabel
import numpy
import pytest
import voxelcore
import xarray
from conftest import blobs, run, write_nrrd
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

SPACING = (0.5, 0.75, 1.5)
ORIGIN = (-10.0, 20.0, 5.5)
ANGLE = numpy.deg2rad(30)
DIRECTION = numpy.array(
    [[numpy.cos(ANGLE), -numpy.sin(ANGLE), 0], [numpy.sin(ANGLE), numpy.cos(ANGLE), 0], [0, 0, 1]]
)
VOLUME = blobs(11, shape=(20, 16, 12))


def place_of(result):
    """Exact topology and places that are as good as a float affine."""
    return result.vertices.round(4).tolist(), result.unit


@pytest.fixture(scope="module")
def expected():
    return voxelcore.core(VOLUME, spacing=SPACING, origin=ORIGIN, direction=DIRECTION)


def test_an_image_of_nibabel_lies_where_its_file_does(tmp_path):
    affine = numpy.eye(4)
    affine[:3, :3] = numpy.diag([-1, -1, 1]) @ DIRECTION @ numpy.diag(SPACING)
    affine[:3, 3] = numpy.array([-1, -1, 1]) * ORIGIN
    image = nibabel.Nifti1Image(VOLUME, affine)
    image.header.set_xyzt_units("mm")
    # Exact, as an affine in single precision may take a step of refinement elsewhere.
    core = voxelcore.core(image, refine="off")
    expected = voxelcore.core(VOLUME, spacing=SPACING, origin=ORIGIN, direction=DIRECTION, refine="off")
    assert numpy.allclose(core.vertices, expected.vertices, atol=1e-4)
    assert core.unit == expected.unit
    nibabel.save(image, tmp_path / "scan.nii.gz")
    done = run("core", tmp_path / "scan.nii.gz", "-o", tmp_path / "scan.vtp", "--refine", "off")
    assert done.returncode == 0, done.stderr
    assert numpy.allclose(voxelcore.read(tmp_path / "scan.vtp").vertices, core.vertices, atol=1e-5)


def test_units_of_nibabel_become_millimetres():
    image = nibabel.Nifti1Image(VOLUME, numpy.diag([500.0, 500, 500, 1]))
    image.header.set_xyzt_units("micron")
    assert voxelcore.core(image).spacing == pytest.approx((0.5, 0.5, 0.5))


@pytest.mark.parametrize("names", ["xyz", "zyx"])
def test_coordinates_of_xarray_are_its_place(names):
    expected = voxelcore.core(VOLUME, spacing=SPACING, origin=ORIGIN)
    values = VOLUME if names == "xyz" else VOLUME.T
    places = {name: ORIGIN[i] + SPACING[i] * numpy.arange(VOLUME.shape[i]) for i, name in enumerate("xyz")}
    image = xarray.DataArray(values, dims=list(names), coords=places)
    assert place_of(voxelcore.core(image)) == place_of(expected)
    skeleton = voxelcore.skeleton(image, prune_branches=0)
    assert skeleton.unit == "mm" and skeleton.topology == expected.topology
    assert voxelcore.core(xarray.DataArray(values, dims=list(names))).unit == "voxel"


def test_coordinates_that_give_no_spacing_are_refused():
    places = {name: numpy.arange(size, dtype=float) for name, size in zip("xyz", VOLUME.shape)}
    with pytest.raises(ValueError, match="do not rise evenly"):
        voxelcore.core(xarray.DataArray(VOLUME, dims=list("xyz"), coords=dict(places, y=places["y"] ** 2)))
    with pytest.raises(ValueError, match="expected x, y, z or z, y, x"):
        voxelcore.core(xarray.DataArray(VOLUME, dims=["a", "b", "c"]))
    with pytest.raises(ValueError, match="only some"):
        voxelcore.core(xarray.DataArray(VOLUME, dims=list("xyz"), coords={"x": places["x"]}))


def test_an_image_of_vtk_lies_where_vtk_has_it(expected):
    image = vtkImageData()
    image.SetDimensions(VOLUME.shape)
    image.SetSpacing(SPACING)
    image.SetOrigin(ORIGIN)
    image.SetDirectionMatrix(DIRECTION.ravel().tolist())
    image.GetPointData().SetScalars(numpy_to_vtk(VOLUME.ravel(order="F"), deep=1))
    assert place_of(voxelcore.core(image)) == place_of(expected)
    moved = vtkImageData()
    moved.ShallowCopy(image)
    shift = (3, -2, 7)
    moved.SetExtent(*(value for s, n in zip(shift, VOLUME.shape) for value in (s, s + n - 1)))
    moved.SetOrigin(*(numpy.array(ORIGIN) - DIRECTION @ (numpy.array(shift) * SPACING)))
    assert place_of(voxelcore.core(moved)) == place_of(expected)


class _Image:
    """What SimpleITK.Image and itk.Image answer, whose arrays are a[k, j, i]."""

    def GetSpacing(self):
        return SPACING

    def GetOrigin(self):
        return ORIGIN

    def GetDirection(self):
        return tuple(DIRECTION.ravel())


def test_images_of_simpleitk_and_itk_are_told_by_their_library(monkeypatch, expected):
    simpleitk = types.ModuleType("SimpleITK")
    simpleitk.GetArrayViewFromImage = lambda image: VOLUME.T
    itk = types.ModuleType("itk")
    itk.array_view_from_image = lambda image: VOLUME.T
    itk.array_from_matrix = lambda matrix: numpy.reshape(matrix, (3, 3))
    monkeypatch.setitem(sys.modules, "SimpleITK", simpleitk)
    monkeypatch.setitem(sys.modules, "itk", itk)
    for module in ("SimpleITK.SimpleITK", "itk.itkImagePython"):
        image = type("Image", (_Image,), {"__module__": module})()
        assert place_of(voxelcore.core(image)) == place_of(expected)


def test_what_is_given_beats_what_the_image_says():
    image = nibabel.Nifti1Image(VOLUME, numpy.diag([-2.0, -2, 2, 1]))
    core = voxelcore.core(image, spacing=(1, 1, 3), origin=(0, 0, 0))
    assert place_of(core) == place_of(voxelcore.core(VOLUME, spacing=(1, 1, 3)))


def test_whatever_has_an_array_is_an_array(tmp_path):
    class Wrapped:
        def __array__(self, dtype=None, copy=None):
            return VOLUME

    write_nrrd(tmp_path / "scan.nrrd", VOLUME, SPACING)
    assert run("core", tmp_path / "scan.nrrd", "-o", tmp_path / "scan.vtp").returncode == 0
    core = voxelcore.core(Wrapped(), spacing=SPACING)
    assert numpy.array_equal(core.vertices, voxelcore.read(tmp_path / "scan.vtp").vertices)
