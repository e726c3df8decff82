"""Images of other libraries as arrays with a place in space. None of these libraries is imported here: who has one of
their images has imported it."""

import sys

import numpy

from ._volume import Volume

# Millimetres in a unit of length.
_UNITS = {
    "m": 1000.0, "meter": 1000.0, "metre": 1000.0, "cm": 10.0, "mm": 1.0, "millimeter": 1.0, "millimetre": 1.0,
    "um": 1e-3, "µm": 1e-3, "μm": 1e-3, "micron": 1e-3, "microns": 1e-3, "micrometer": 1e-3, "micrometre": 1e-3,
    "nm": 1e-6, "nanometer": 1e-6, "nanometre": 1e-6,
}  # fmt: skip

_LPS_FROM_RAS = numpy.diag([-1.0, -1.0, 1.0])


class Placed:
    """Voxels with their axes ('ijk' or 'kji'), and, where the image knows them, spacing and origin (LPS mm) along i, j
    and k, and direction."""

    def __init__(self, voxels, axes="ijk", spacing=None, origin=None, direction=None):
        self.voxels = voxels
        self.axes = axes
        self.spacing = spacing
        self.origin = origin
        self.direction = direction


def of(image):
    """What is known of an image; None for arrays and whatever else numpy makes arrays of."""
    for recognise in (_volume, _nibabel, _simpleitk, _itk, _vtk, _xarray):
        placed = recognise(image)
        if placed is not None:
            return placed
    return None


def _volume(image):
    if not isinstance(image, Volume):
        return None
    return Placed(image.array, "ijk", image.spacing, image.origin, image.direction)


def _library(image, name):
    """Whether the image's class, or one it is derived from, comes from the library."""
    return any(parent.__module__.partition(".")[0] == name for parent in type(image).__mro__)


def _nibabel(image):
    if not (_library(image, "nibabel") and hasattr(image, "dataobj") and image.affine is not None):
        return None
    affine = numpy.asarray(image.affine, float)
    unit = "mm"
    if hasattr(image.header, "get_xyzt_units"):
        unit = image.header.get_xyzt_units()[0]
    scale = _UNITS.get(unit, 1.0)
    columns = _LPS_FROM_RAS @ affine[:3, :3]
    spacing = numpy.sqrt((columns**2).sum(0))
    if not (spacing > 0).all():
        raise ValueError("the image: its affine is not invertible")
    voxels = numpy.asanyarray(image.dataobj)
    while voxels.ndim > 3 and voxels.shape[-1] == 1:
        voxels = voxels[..., 0]
    return Placed(voxels, "ijk", spacing * scale, _LPS_FROM_RAS @ affine[:3, 3] * scale, columns / spacing)


def _simpleitk(image):
    if not (_library(image, "SimpleITK") and hasattr(image, "GetSpacing")):
        return None
    voxels = sys.modules["SimpleITK"].GetArrayViewFromImage(image)
    return Placed(voxels, "kji", image.GetSpacing(), image.GetOrigin(), image.GetDirection())


def _itk(image):
    if not ((_library(image, "itk") or _library(image, "itkImagePython")) and hasattr(image, "GetSpacing")):
        return None
    itk = sys.modules["itk"]
    direction = itk.array_from_matrix(image.GetDirection())
    return Placed(itk.array_view_from_image(image), "kji", tuple(image.GetSpacing()), tuple(image.GetOrigin()),
                  direction)  # fmt: skip


def _vtk(image):
    if not (hasattr(image, "IsA") and image.IsA("vtkImageData")):
        return None
    from vtkmodules.util.numpy_support import vtk_to_numpy

    scalars = image.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise ValueError("the image: it has no scalars of one component")
    size = image.GetDimensions()
    matrix = image.GetDirectionMatrix()
    direction = numpy.array([[matrix.GetElement(i, j) for j in range(3)] for i in range(3)])
    begin = image.GetExtent()[::2] * numpy.asarray(image.GetSpacing())
    origin = numpy.asarray(image.GetOrigin()) + direction @ begin
    return Placed(vtk_to_numpy(scalars).reshape(size[::-1]), "kji", image.GetSpacing(), origin, direction)


def _xarray(image):
    if not (_library(image, "xarray") and hasattr(image, "dims") and hasattr(image, "coords")):
        return None
    names = "".join(str(name).lower() for name in image.dims)
    if names not in ("xyz", "zyx"):
        named = ", ".join(map(str, image.dims))
        raise ValueError(f"the array: its dimensions are {named}; expected x, y, z or z, y, x")
    axes = "ijk" if names == "xyz" else "kji"
    given = [name for name in image.dims if name in image.coords]
    if not given:
        return Placed(image.values, axes)
    if len(given) < 3:
        raise ValueError("the array: only some of its dimensions have coordinates")
    spacing, origin = [], []
    for name in image.dims if axes == "ijk" else image.dims[::-1]:
        places = numpy.asarray(image.coords[name].values, float)
        scale = _UNITS.get(image.coords[name].attrs.get("units", "mm"), None)
        if scale is None:
            raise ValueError(f"the array: the unit {image.coords[name].attrs['units']!r} of {name} is not known")
        steps = numpy.diff(places)
        if len(steps) == 0:
            raise ValueError(f"the array: a single place along {name} gives no spacing")
        step = (places[-1] - places[0]) / len(steps)
        if not step > 0 or abs(steps - step).max() > 1e-4 * step:
            raise ValueError(f"the array: its coordinates along {name} do not rise evenly")
        spacing.append(step * scale)
        origin.append(places[0] * scale)
    direction = image.attrs.get("direction")
    if direction is not None and axes == "kji":
        direction = numpy.flip(numpy.asarray(direction, float))  # as itk.xarray_from_image gives it
    return Placed(image.values, axes, spacing, origin, direction)
