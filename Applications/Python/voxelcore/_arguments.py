"""Keyword arguments as options of the command line."""

import difflib
import inspect
import operator
import os
import textwrap
import typing

import numpy

from . import _images, _volume, _voxelcore


def text(name, value, unit="mm"):
    """A length as the command line takes it: a number is in the unit of the spacing. Errors name the argument."""
    if isinstance(value, str):
        if "," in value:
            raise ValueError(f"{name}={value!r}: expected one length; for several give a list")
        return value
    if isinstance(value, (bool, numpy.bool_)) or not numpy.isscalar(value):
        raise ValueError(f"{name}={value!r}: expected a length such as '1.5vox' or a number")
    number = numpy.format_float_positional(float(value), trim="-")
    return number + "vox" if unit == "voxel" and float(value) != 0 else number


def unit(source, spacing):
    """Of the lengths of what is made of an array or image."""
    if spacing is None:
        image = _images.of(source)
        spacing = image and image.spacing
    return "voxel" if spacing is None else "mm"


class Voxels(typing.NamedTuple):
    """An array a[i, j, k] and its place: three numbers, three and nine; None where neither image nor caller says it."""

    array: numpy.ndarray
    spacing: typing.Optional[list]
    origin: typing.Optional[list]
    direction: typing.Optional[list]
    axes: typing.Optional[str]  # of the array that was given

    def turned(self, volume):
        """A volume [i, j, k] with the axes of the array that was given."""
        return volume.T if volume is not None and self.axes == "kji" else volume


def voxels(array, spacing, axes, origin=None, direction=None, threshold=None):
    """Of an array, or of an image, whose own place counts where none is given."""
    if axes not in (None, "ijk", "kji"):
        raise ValueError(f"axes {axes!r}: expected 'ijk' or 'kji'")
    image = _images.of(array)
    if image is not None:
        array, axes = image.voxels, axes or image.axes
        spacing = image.spacing if spacing is None else spacing
        origin = image.origin if origin is None else origin
        direction = image.direction if direction is None else direction
    plain = without_mask(array, threshold)
    return Voxels(
        plain.T if axes == "kji" else plain,
        None if spacing is None else voxel_size(spacing),
        None if origin is None else three("origin", origin),
        None if direction is None else nine(direction),
        axes,
    )


def of_array(function, rows, options, array, spacing, axes, label, threshold, origin=None, direction=None):
    """Voxels, and options of the command line, of the arguments that core() and thickness() share."""
    given = values(function, rows, options)
    limits = None
    if threshold is not None:
        try:
            low, high = limits = tuple(threshold)
        except (TypeError, ValueError):
            raise ValueError(f"threshold {threshold!r}: expected two numbers, (lo, hi)") from None
        given["threshold"] = f"{text('threshold', low)}:{text('threshold', high)}"
    if isinstance(label, str) and label == "any":
        given["binary"] = "true"
    elif label is not None:
        given["labels"] = labels(label, array)
    if given.get("refine") == "grey" and numpy.ma.getmaskarray(array).any():
        raise ValueError("refine='grey': masked voxels have no grey values; give an array without a mask")
    return voxels(array, spacing, axes, origin, direction, limits), given


def join_pieces(options, connectivity):
    """Adds the connectivity of skeletons and sheets to options of core(). What simplifies topology joins as many pieces
    as it is asked for by itself, as on the command line."""
    asked = [name for name in ("pieces", "loops", "cavities") if options.get(name) is not None]
    simplifies = options.get("simplify_topology") is not None and ("pieces" in asked or not asked)
    if connectivity != "joined" or not (options.get("tree") or simplifies):
        options["connectivity"] = connectivity


def root(where):
    """Where a hierarchy begins, as the command line takes it."""
    return where if isinstance(where, str) else ",".join(repr(value) for value in three("root", where))


def edits(given):
    """Edits of a tree: a path as bytes, or a list of (place, edit, name, label) of dicts or the rows of a DataFrame."""
    if isinstance(given, (str, os.PathLike)):
        return os.fsencode(given)
    rows = given.to_dict("records") if hasattr(given, "to_dict") else list(given)

    def field(row, name):  # an empty one of a DataFrame is NaN
        value = row.get(name)
        return "" if value is None or value != value else value

    def made(number, row):
        if not isinstance(row, dict):
            raise ValueError(f"edits: row {number}: expected a dict of x, y, z, edit and name")
        place = three(f"edits: row {number}: x, y, z", [row.get(axis) for axis in "xyz"])
        label = field(row, "label")
        return place, str(field(row, "edit")), str(field(row, "name")), None if label == "" else operator.index(label)

    said = [row for row in rows if not isinstance(row, dict) or field(row, "edit") != "" or field(row, "name") != ""]
    return [made(number, row) for number, row in enumerate(said)]


def several(given):
    """A list, tuple, range or array of values as a list; None of a single value."""
    is_array = isinstance(given, numpy.ndarray) and given.ndim == 1
    return list(given) if is_array or isinstance(given, (list, tuple, range)) else None


def pruning(lambda_, tolerance, unit):
    """Options for lambda_ and tolerance, of which None is not given; whether one of them asks for several results."""
    values = {}
    is_list = False
    for name, given in (("lambda", lambda_), ("tolerance", tolerance)):
        listed = several(given)
        if listed is not None:
            is_list = True
            if not listed:
                raise ValueError(f"{name}: the list is empty")
            values[name] = ",".join(text(name, value, unit) for value in listed)
        elif given is not None:
            values[name] = text(name, given, unit)
    return values, is_list


def share(progress, begin, end):
    """A listener to a part of the work, which runs from `begin` to `end` of the whole."""
    if progress is None:
        return None
    return lambda stage, done: progress(stage if end == 1 or stage != "done" else "core", begin + (end - begin) * done)


def without_mask(array, threshold):
    """A plain array, in which the masked voxels of a numpy.ma array are background."""
    voxels = numpy.ma.getdata(array) if isinstance(array, numpy.ma.MaskedArray) else numpy.asarray(array)
    mask = numpy.ma.getmaskarray(array) if isinstance(array, numpy.ma.MaskedArray) else numpy.False_
    if not mask.any():
        return voxels
    if mask.dtype != bool:
        raise ValueError("the array: its mask has fields; give one of plain True and False")
    value = 0
    if threshold is not None:
        if voxels.dtype == bool:
            voxels = voxels.astype(numpy.uint8)
        limits = (numpy.finfo if voxels.dtype.kind == "f" else numpy.iinfo)(voxels.dtype)
        outside = [limit for limit in (limits.min, limits.max) if not threshold[0] <= limit <= threshold[1]]
        if not outside:
            raise ValueError(f"threshold: every {voxels.dtype} lies within it; no value is left for masked voxels")
        value = outside[0]
    return numpy.where(mask, voxels.dtype.type(value), voxels)


def labels(label, source=None):
    """Values as the command line takes them; names are those of a source that is a file."""
    if isinstance(label, str) and label == "all":
        return label
    try:
        values = several(label) or [label]
        if any(isinstance(value, str) for value in values):
            values = [by_name(value, source) if isinstance(value, str) else value for value in values]
        wholes = [int(value) for value in values if not isinstance(value, (bool, str))]
    except LookupError as unknown:
        raise ValueError(unknown.args[0]) from None
    except (TypeError, ValueError, OverflowError):
        values, wholes = [], []
    if not wholes or wholes != list(values):
        shown = " ".join(repr(label).split())  # arrays take several lines
        raise ValueError(f"label {shown}: expected a whole number, a list of them, 'all', 'any' or None; names are for "
                         "files, given as paths")
    return ",".join(map(str, wholes))


def by_name(name, source):
    """The value of the label of a file that has this name."""
    if not isinstance(source, _volume.Volume):
        raise TypeError  # an array has no names
    values = [value for value, one in source.names.items() if one.lower() == name.lower()]
    if len(values) != 1:
        near = difflib.get_close_matches(name, source.names.values(), 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        known = ", ".join(map(repr, list(source.names.values())[:10]))
        count = "no label" if not values else "several labels"
        raise LookupError(f"label {name!r}: {count} of this name; the names are {known}{hint}")
    return values[0]


def voxel_size(spacing):
    """In mm along i, j, k, of one number or three, or of text as the command line takes it."""
    if isinstance(spacing, str):
        return _voxelcore.voxel_size(spacing)
    return three("spacing", (spacing,) * 3 if numpy.isscalar(spacing) else spacing)


def three(name, values):
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 3:
        raise ValueError(f"{name}: expected three numbers")
    return numbers


def nine(values):
    try:
        matrix = numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        matrix = numpy.empty(0)
    if matrix.size != 9:
        raise ValueError("direction: expected a 3 by 3 matrix or its nine numbers row by row")
    return [float(value) for value in matrix.reshape(9)]


_TABLE = _voxelcore.option_table()


def rows(command, *groups):
    """The rows of the option table that are keyword arguments here, by keyword."""
    return {
        row["keyword"]: row
        for row in _TABLE
        if row["command"] == command and row["group"] in groups and row["keyword"]
    }


OF_CORE = rows("core", "Input", "Pruning", "Shape edits", "Refinement", "Running")
OF_SKELETON = rows("skeleton", "Skeleton")
OF_MEASURE = rows("measure", "Skeleton", "Running")
OF_PRUNE = rows("prune", "Pruning", "Running")
OF_THICKNESS = rows("thickness", "Input", "Pruning", "Shape edits", "Refinement", "Thickness and sheets", "Running")
OF_SHEETS = rows("sheets", "Input", "Pruning", "Shape edits", "Refinement", "Thickness and sheets", "Running")
OF_COMPARE = rows("compare", "Input", "Comparison", "Running")
for _of_saving in (OF_SKELETON, OF_MEASURE):
    del _of_saving["also"]  # of Skeleton.save()
for _of_program in ("sections", "branch_map", "order_map", "skeleton_map", "centerlines", "flow", "inlet",
                    "soma"):  # files
    for _of_branches in (OF_SKELETON, OF_MEASURE):
        _of_branches.pop(_of_program, None)
for _of_background in ("separation", "within"):  # measure the background as an array of its own
    del OF_THICKNESS[_of_background]


def values(function, rows, given):
    """Options of the command line from keyword arguments; what is None or False is not given."""
    values = {}
    for keyword, value in given.items():
        row = rows.get(keyword)
        if row is None:
            near = {"labels": ["label"]}.get(keyword) or difflib.get_close_matches(keyword, rows, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise TypeError(f"{function}() got an unexpected keyword argument {keyword!r}{hint}")
        if value is None or value is False:
            continue
        if row["is_flag"] != (value is True):
            raise ValueError(f"{keyword}={value!r}: expected " + ("True or False" if row["is_flag"] else "a value"))
        if not isinstance(value, str) and not numpy.isscalar(value):
            raise ValueError(f"{keyword}={value!r}: expected a string or a number")
        values[row["name"]] = "true" if row["is_flag"] else value if isinstance(value, str) else text(keyword, value)
    return values


def _type(row):
    """As numpydoc has it."""
    kind = {"choice": "{" + ", ".join(map(repr, row["placeholder"].split("|"))) + "}", "bool": "bool"}
    word = kind.get(row["kind"], row["kind"])
    if not row["default"]:
        return word + ", optional"
    return word + ", default " + (row["default"] if row["kind"] in ("int", "float") else repr(row["default"]))


def told(row):
    """What an option does, in Python's words."""
    return _voxelcore.in_python_words(row["description"])


def documented(function, rows):
    """Puts what the option table says of the function's further arguments where its text has **options."""
    own = inspect.signature(function).parameters
    entries = [
        f"    {keyword} : {_type(row)}\n" + textwrap.indent(textwrap.fill(told(row), 104), " " * 8)
        for keyword, row in rows.items()
        if keyword.isidentifier() and keyword not in own
    ]
    head, _, rest = function.__doc__.partition("    **options\n")
    function.__doc__ = head + "\n".join(entries) + "\n" + rest
    return function
