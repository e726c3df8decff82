#!/usr/bin/python3
"""Makes a wheel of Debian's numpy, to install from a folder where no other numpy can be had.

usage: numpy_wheel.py FOLDER
"""

import base64
import hashlib
import importlib.metadata
import pathlib
import sys
import sysconfig
import zipfile

files = {}
numpy = importlib.metadata.distribution("numpy")
root = pathlib.Path(numpy.locate_file("numpy")).resolve()
for file in sorted(root.rglob("*")):
    if file.is_file() and "__pycache__" not in file.parts and "tests" not in file.relative_to(root).parts:
        files[f"numpy/{file.relative_to(root)}"] = file.read_bytes()
python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
info = f"numpy-{numpy.version}.dist-info"
files[f"{info}/METADATA"] = f"Metadata-Version: 2.1\nName: numpy\nVersion: {numpy.version}\n".encode()
files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
record = "".join(
    f"{name},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"
    for name, data in files.items()
)
files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
path = pathlib.Path(sys.argv[1]) / f"numpy-{numpy.version}-{tag}.whl"
with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
    for name, data in files.items():
        archive.writestr(name, data)
print(path)
