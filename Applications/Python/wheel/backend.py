"""What pip calls to build the package (PEP 517): the extension by CMake, without VTK, ITK and TetGen.

Asks PyPI for CMake, Ninja and pybind11 where the machine lacks them, and for nothing else. How far it is it says on the
terminal, as pip keeps to itself what a build prints. Builds in build/python-TAG of the project, so that a second build
does only what changed. usage without pip: PYTHON backend.py FOLDER
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import time

from wheel_files import write

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
PROJECT = PACKAGE.parents[1]
OPTIONS = {
    "CMAKE_BUILD_TYPE": "Release",
    "BUILD_TESTING": "OFF",
    "VOXELCORE_ITK": "OFF",
    "VOXELCORE_VTK": "OFF",
    "VOXELCORE_TETGEN": "OFF",
    "VOXELCORE_TIFF": "OFF",  # Debian's libtiff brings along libjbig, which is under the GPL
    "VOXELCORE_PYTHON": "ON",
    "VOXELCORE_PYTHON_DIR": ".",
    "VOXELCORE_LEAN": "ON",
}
CLASSIFIERS = (
    "Framework :: napari",
    "License :: OSI Approved :: Apache Software License",
    "Operating System :: POSIX :: Linux",
    "Programming Language :: C++",
    "Programming Language :: Python :: 3",
    "Topic :: Scientific/Engineering :: Image Processing",
    "Topic :: Scientific/Engineering :: Medical Science Apps.",
    "Typing :: Typed",
)
EVERY = 10  # seconds between two lines about how far it is


def say(text):
    """To who waits: on the terminal, else where the build prints."""
    try:
        with open("/dev/tty", "w") as terminal:
            terminal.write(f"\r\033[K  voxelcore: {text}\n")
    except OSError:
        print(f"voxelcore: {text}", flush=True)


def version():
    return re.search(r"project\(VoxelCore VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]


def tag():
    """This Python's, as wheels name it: of CPython 3.11 on x86-64, cp311-cp311-linux_x86_64."""
    if sys.implementation.name != "cpython":
        raise SystemExit(f"voxelcore: it is built for CPython, and this is {sys.implementation.name}")
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return f"{python}-{python}{sys.abiflags}-{re.sub(r'[-.]', '_', sysconfig.get_platform())}"


def cmake_is_there():
    try:
        said = subprocess.run(["cmake", "--version"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return False
    return tuple(map(int, re.search(r"(\d+)\.(\d+)", said).groups())) >= (3, 25)


def get_requires_for_build_wheel(settings=None):
    needed = [] if cmake_is_there() else ["cmake>=3.25"]
    if not shutil.which("ninja"):
        needed.append("ninja")
    # Debian 12's pybind11 ends at Python 3.11.
    if sys.version_info >= (3, 12) or not any(pathlib.Path("/usr").glob("*/cmake/pybind11/pybind11Config.cmake")):
        needed.append("pybind11>=2.13")
    return needed


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    print(done.stdout, flush=True)
    if done.returncode != 0:
        last = "\n".join(done.stdout.splitlines()[-20:])
        raise SystemExit(
            f"{last}\nvoxelcore: '{' '.join(command[:2])}' failed. On Debian, "
            f"'bash {PROJECT}/Applications/install-packages.sh wheel' installs what a build needs."
        )


def compile_all(build):
    """Tells each EVERY seconds how many steps are done and how long the rest will take."""
    begin = told = time.monotonic()
    ninja = subprocess.Popen(
        ["cmake", "--build", build, "--target", "voxelcore_python"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=os.environ | {"NINJA_STATUS": "[%f/%t] "},
    )
    for line in ninja.stdout:
        print(line, end="", flush=True)
        now = time.monotonic()
        if (at := re.match(r"\[(\d+)/(\d+)\] ", line)) and now - told >= EVERY:
            told = now
            done, steps = int(at[1]), int(at[2])
            left = (now - begin) * (steps - done) / done
            say(f"{done} of {steps} steps in {now - begin:.0f} s, some {max(left, EVERY):.0f} s to go")
    if ninja.wait() != 0:
        raise SystemExit("voxelcore: compiling failed, as said above")
    say(f"compiled in {time.monotonic() - begin:.0f} s")


def metadata():
    lines = [
        "Metadata-Version: 2.1",
        "Name: voxelcore",
        f"Version: {version()}",
        "Summary: Certified medial surfaces and curve skeletons of segmented volumes",
        "License: Apache-2.0",
        *(f"Classifier: {name}" for name in CLASSIFIERS),
        "Requires-Python: >=3.9",
        "Requires-Dist: numpy>=1.20",
        "Description-Content-Type: text/markdown",
        "",
    ]
    return "\n".join(lines) + "\n" + (PACKAGE / "README.md").read_text()


def build_wheel(folder, settings=None, metadata_directory=None):
    """The wheel's name, which then lies in `folder`."""
    build = PROJECT / "build" / f"python-{tag()}"
    options = dict(OPTIONS, Python_EXECUTABLE=sys.executable)
    try:
        import pybind11

        options["pybind11_DIR"] = pybind11.get_cmake_dir()
    except ImportError:
        pass  # the machine's own
    with tempfile.TemporaryDirectory() as temporary:
        if not os.access(build if build.exists() else PROJECT, os.W_OK):
            build = pathlib.Path(temporary) / "build"
        cache = "with" if shutil.which("ccache") else "without"
        say(f"builds for {tag()} on {os.cpu_count()} cores, {cache} ccache; a few minutes")
        run("cmake", "-S", str(PROJECT), "-B", str(build), "-G", "Ninja", "-Wno-dev",
            *(f"-D{name}={value}" for name, value in options.items()))  # fmt: skip
        compile_all(str(build))
        content = pathlib.Path(temporary) / "wheel"
        run("cmake", "--install", str(build), "--component", "python", "--prefix", str(content))
        facts = content / f"voxelcore-{version()}.dist-info"
        facts.mkdir()
        (facts / "METADATA").write_text(metadata())
        (facts / "WHEEL").write_text(
            f"Wheel-Version: 1.0\nGenerator: voxelcore\nRoot-Is-Purelib: false\nTag: {tag()}\n"
        )
        (facts / "entry_points.txt").write_text("[napari.manifest]\nvoxelcore = voxelcore:napari.json\n")
        shutil.copy(PROJECT / "LICENSE", facts)
        name = f"voxelcore-{version()}-{tag()}.whl"
        write(content, pathlib.Path(folder) / name)
    return name


if __name__ == "__main__":
    print(build_wheel(sys.argv[1]))
