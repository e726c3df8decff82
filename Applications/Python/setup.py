"""The wheel: the extension by CMake, without VTK, ITK and TetGen; its version is the project's."""

import pathlib
import re

from skbuild import setup

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]


def version():
    return re.search(r"project\(VoxelCore VERSION ([0-9.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]


setup(
    name="voxelcore",
    version=version(),
    description="Certified medial surfaces and curve skeletons of segmented volumes",
    long_description=(HERE / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="Apache-2.0",
    classifiers=[
        "License :: OSI Approved :: Apache Software License",
        "Operating System :: POSIX :: Linux",
        "Programming Language :: C++",
        "Programming Language :: Python :: 3",
        "Topic :: Scientific/Engineering :: Image Processing",
        "Topic :: Scientific/Engineering :: Medical Science Apps.",
        "Typing :: Typed",
    ],
    python_requires=">=3.9",
    install_requires=["numpy>=1.20"],
    packages=["voxelcore"],
    package_data={"voxelcore": ["py.typed", "*.pyi"]},
    include_package_data=False,
    zip_safe=False,
    cmake_source_dir=str(PROJECT),
    cmake_install_target="install-python",
    cmake_args=[
        "-DCMAKE_BUILD_TYPE=Release",
        "-DBUILD_TESTING=OFF",
        "-DVOXELCORE_ITK=OFF",
        "-DVOXELCORE_VTK=OFF",
        "-DVOXELCORE_TETGEN=OFF",
        "-DVOXELCORE_TIFF=OFF",  # Debian's libtiff brings along libjbig, which is under the GPL
        "-DVOXELCORE_PYTHON=ON",
        "-DVOXELCORE_PYTHON_DIR=.",
        "-DVOXELCORE_LEAN=ON",
    ],
)
