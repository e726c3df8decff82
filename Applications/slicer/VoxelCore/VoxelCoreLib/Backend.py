"""Who computes: the Python package voxelcore in a process of Slicer's Python, or the program voxelcore."""

import dataclasses
import glob
import importlib
import importlib.util
import os
import shutil
import sys

from . import VoxelCoreError

WORKER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "Worker.py")
WHEELS = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "Resources", "Wheels")
REQUIREMENT = "voxelcore>=0.2,<1"


@dataclasses.dataclass
class Backend:
    """`words` begin the command line of a step; `environment` is that of the process, None: ours."""

    kind: str  # "package" or "program"
    words: list
    environment: dict = None


def _python():
    """Slicer's Python without the application around it."""
    return shutil.which("PythonSlicer") or sys.executable


def _startupEnvironment():
    """What a program from elsewhere needs: without the libraries of Slicer."""
    import slicer

    ask = getattr(getattr(slicer, "util", None), "startupEnvironment", None)
    return ask() if ask else None


def packageIsThere():
    importlib.invalidate_caches()
    return importlib.util.find_spec("voxelcore") is not None


def _program(path):
    environment = _startupEnvironment()
    where = (environment or os.environ).get("PATH")
    if path:
        found = shutil.which(path, path=where)
        if not found:
            raise VoxelCoreError(f"{path}: it is no program that can be run; choose voxelcore, or leave it empty")
        return Backend("program", [found], environment)
    found = shutil.which("voxelcore", path=where)
    return Backend("program", [found], environment) if found else None


def wheel(folder=WHEELS):
    """The newest wheel that came with the module, or None."""
    found = sorted(glob.glob(os.path.join(folder, "voxelcore-*.whl")), key=os.path.getmtime)
    return found[-1] if found else None


def install(requirement):
    """By slicer.packaging where Slicer has it (5.11 and later), which asks the user, else by slicer.util."""
    import slicer

    if os.path.isfile(requirement) and hasattr(slicer.util, "pip_install"):
        slicer.util.pip_install([os.path.abspath(requirement)])  # a file is no requirement that can be checked
        return
    try:
        packaging = importlib.import_module("slicer.packaging")
    except ImportError:
        packaging = None
    if packaging is not None and hasattr(packaging, "pip_ensure"):
        packaging.pip_ensure([requirement], requester="VoxelCore")
    else:
        slicer.util.pip_install([requirement])


def find(program="", wheelPath="", mayInstall=True):
    """The Backend. `program`: a path that the user chose, which then must work. `wheelPath`: the wheel to install at
    first use, else the one in Resources/Wheels, else from the package index. Without a package, the program on the
    path is taken. Raises VoxelCoreError with what went wrong where there is neither."""
    if program.strip():
        return _program(program.strip())
    reason = ""
    if not packageIsThere() and mayInstall:
        try:
            install(wheelPath.strip() or wheel() or REQUIREMENT)
        except Exception as error:  # pip's failures have many types
            reason = (str(error).strip() or type(error).__name__).splitlines()[-1]
    if packageIsThere():
        return Backend("package", [_python(), WORKER])
    found = _program("")
    if found is None:
        raise VoxelCoreError(
            "neither the Python package voxelcore nor the program is here; choose a wheel or the program under Advanced"
            + (f" (installing failed: {reason})" if reason else "")
        )
    return found
