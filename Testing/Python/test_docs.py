"""What the documentation shows is what happens, it says shapes and units in numpydoc's form, and the stubs name what
there is."""

import ast
import doctest
import inspect
import pathlib
import re

import numpy
import pytest
import voxelcore
from voxelcore import _arguments

RESULTS = (voxelcore.Core, voxelcore.Skeleton)
FUNCTIONS = {name: getattr(voxelcore, name) for name in voxelcore.__all__}
FUNCTIONS = {name: thing for name, thing in FUNCTIONS.items() if inspect.isfunction(thing)}
METHODS = {
    f"{result.__name__}.{name}": member
    for result in RESULTS
    for name, member in vars(result).items()
    if inspect.isfunction(member) and not name.startswith("_")
}
PROPERTIES = {
    f"{result.__name__}.{name}": member
    for result in RESULTS
    for parent in result.__mro__
    for name, member in vars(parent).items()
    if isinstance(member, property)
}
OF_TABLE = {
    "core": _arguments.OF_CORE,
    "skeleton": _arguments.OF_SKELETON,
    "measure": _arguments.OF_MEASURE,
    "thickness": _arguments.OF_THICKNESS,
    "sheets": _arguments.OF_SHEETS,
    "compare": _arguments.OF_COMPARE,
}


def stubs():
    return ast.parse((pathlib.Path(voxelcore.__file__).parent / "__init__.pyi").read_text()).body


def sections(text):
    """A numpydoc text's sections by heading."""
    parts = re.split(r"\n([A-Z][a-z]+)\n-+\n", inspect.cleandoc(text) + "\n")
    return dict(zip(["Summary", *parts[1::2]], parts[0::2]))


def test_docstrings_are_true():
    names = dict({name: getattr(voxelcore, name) for name in voxelcore.__all__}, numpy=numpy)
    runner = doctest.DocTestRunner()
    for result in RESULTS:
        for test in doctest.DocTestFinder().find(result, module=False, globs=names):
            runner.run(test)
    results = doctest.testmod(voxelcore, extraglobs={"numpy": numpy})
    assert runner.failures == results.failed == 0 and runner.tries + results.attempted > 30


@pytest.mark.parametrize("name", [*FUNCTIONS, *METHODS])
def test_every_argument_is_described_with_its_type(name):
    function = {**FUNCTIONS, **METHODS}[name]
    told = sections(function.__doc__)
    assert len(told["Summary"].split()) > 1
    own = [parameter for parameter in inspect.signature(function).parameters if parameter not in ("self", "options")]
    further = [keyword for keyword in OF_TABLE.get(name, ()) if keyword.isidentifier() and keyword not in own]
    assert sorted(re.findall(r"(?m)^(\w+) : (?=.)", told.get("Parameters", ""))) == sorted(own + further)
    for keyword in further:
        described = re.search(rf"(?m)^{keyword} : .+\n((?:    .+\n?)+)", told["Parameters"])[1]
        assert " ".join(described.split()) == " ".join(_arguments.told(OF_TABLE[name][keyword]).split())
    if name in OF_TABLE:
        assert "**options" not in function.__doc__ and "--" not in told["Parameters"].replace("---", "")
    # A conversion may say in its sentence what it gives.
    if name in FUNCTIONS or name.partition(".")[2] in ("prune", "verify", "skeleton", "measure", "branch"):
        assert told["Returns"].strip()


@pytest.mark.parametrize("name", PROPERTIES)
def test_every_array_is_described_with_its_shape_type_and_unit(name):
    types = {
        f"{node.name}.{member.name}": ast.unparse(member.returns)
        for node in stubs()
        if isinstance(node, ast.ClassDef)
        for member in node.body
        if isinstance(member, ast.FunctionDef)
    }
    stub = types.get(name) or types["_Result." + name.partition(".")[2]]
    array = re.search(r"NDArray\[numpy\.(\w+)\]", stub)
    if array:
        text = PROPERTIES[name].__doc__
        assert array[1] in text, "its type"
        assert re.search(r"\(\w( \+ 1)?, ?\d?\)", text), "its shape"
        assert "mm" in text or array[1] != "float64", "its unit"


def test_everything_public_is_documented_and_has_its_stub():
    found = {node.name: node for node in stubs() if hasattr(node, "name")}
    for name in voxelcore.__all__:
        thing = getattr(voxelcore, name)
        if name == "__version__":
            continue
        assert thing.__doc__ or name == "CertificateError", name
        assert name in found
        if inspect.isfunction(thing):
            stub = found[name].args
            assert list(inspect.signature(thing).parameters) == [
                argument.arg for argument in stub.args + stub.kwonlyargs + ([stub.kwarg] if stub.kwarg else [])
            ]
        elif name in ("Core", "Skeleton"):
            ours = {member for member in vars(thing) if not member.startswith("_")}
            theirs = {node.name for node in found[name].body}
            assert ours == theirs
            assert all(getattr(thing, member).__doc__ for member in ours)
