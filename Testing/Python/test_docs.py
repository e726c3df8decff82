"""What the documentation shows is what happens, and the stubs name what there is."""

import ast
import doctest
import inspect
import pathlib

import numpy
import voxelcore


def test_docstrings_are_true():
    names = dict({name: getattr(voxelcore, name) for name in voxelcore.__all__}, numpy=numpy)
    runner = doctest.DocTestRunner()
    for result in (voxelcore.Core, voxelcore.Skeleton):
        for test in doctest.DocTestFinder().find(result, module=False, globs=names):
            runner.run(test)
    results = doctest.testmod(voxelcore)
    assert runner.failures == results.failed == 0 and runner.tries + results.attempted > 25


def test_everything_public_is_documented_and_has_its_stub():
    tree = ast.parse((pathlib.Path(voxelcore.__file__).parent / "__init__.pyi").read_text())
    stubs = {node.name: node for node in tree.body if hasattr(node, "name")}
    for name in voxelcore.__all__:
        thing = getattr(voxelcore, name)
        if name == "__version__":
            continue
        assert thing.__doc__ or name == "CertificateError", name
        assert name in stubs
        if inspect.isfunction(thing):
            stub = stubs[name].args
            assert list(inspect.signature(thing).parameters) == [
                argument.arg for argument in stub.args + stub.kwonlyargs + ([stub.kwarg] if stub.kwarg else [])
            ]
        elif name in ("Core", "Skeleton"):
            ours = {member for member in vars(thing) if not member.startswith("_")}
            theirs = {node.name for node in stubs[name].body}
            assert ours == theirs
            assert all(getattr(thing, member).__doc__ for member in ours)
