#!/usr/bin/python3
"""Makes a wheel of this machine one for any Linux with a C library and a C++ library that are new enough.

usage: portable_wheel.py WHEEL -o FOLDER

Libraries other than those of C and C++ are put into the wheel, under names of their own, with what Debian says of their
licences. Names every version of a foreign symbol that is asked for, and from the highest ones follows the wheel's tag,
manylinux_2_NN. What was put in stands in <name>.dist-info/sboms (CycloneDX). The same wheel gives the same bytes. Needs
readelf and patchelf.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

from wheel_files import write

# What every Linux has that the tag names (PEP 600); all else goes into the wheel.
GIVEN = re.compile(r"(ld-linux.*|libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+)\.so\.\d+$")
# The C library that came with the first system whose libstdc++ has these symbols: GLIBCXX_3.4.x and CXXABI_1.3.x.
GLIBC_OF_GLIBCXX = [(19, 17), (22, 24), (25, 28), (28, 31), (29, 34), (30, 35), (32, 38)]
GLIBC_OF_CXXABI = [(7, 17), (10, 24), (11, 28), (12, 31), (13, 35), (14, 38)]


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed(library):
    return re.findall(r"\(NEEDED\).*\[(.+)\]", output("readelf", "-d", library))


def versions(library):
    """(library, version) of all symbols that are asked for."""
    found, section = set(), None
    for line in output("readelf", "-V", "-W", library).splitlines():
        if line.startswith("Version "):
            section = line
        if section and section.startswith("Version needs"):
            if named := re.search(r"File: (\S+)", line):
                source = named[1]
            elif named := re.search(r"Name: (\S+)", line):
                found.add((source, named[1]))
    return found


def glibc(version):
    """The minor number of the C library that a symbol's version asks for."""
    name, _, number = version.rpartition("_")
    parts = [int(part) for part in number.split(".")] if re.fullmatch(r"[0-9.]+", number) else []
    if name == "GLIBC" and parts:
        return parts[1]
    table = {"GLIBCXX": GLIBC_OF_GLIBCXX, "CXXABI": GLIBC_OF_CXXABI}.get(name)
    if table is None or not parts:
        return 17  # GCC_3.0 and the like, which are older than any of these
    minor = parts[2] if len(parts) > 2 else 0
    for highest, library in table:
        if minor <= highest:
            return library
    sys.exit(f"portable_wheel.py: {version} is newer than any known C library")


def place(name):
    """Where the loader finds a library."""
    for line in output("ldconfig", "-p").splitlines():
        if found := re.match(rf"\s+{re.escape(name)} \(.*\) => (\S+)", line):
            return pathlib.Path(found[1]).resolve()
    sys.exit(f"portable_wheel.py: {name} is not on this machine")


def package_of(library):
    """Debian's package of a library: its name, version and what it says of its licence. None elsewhere."""
    paths = [library]
    if library.is_relative_to("/usr/lib"):
        paths.append(pathlib.Path("/lib") / library.relative_to("/usr/lib"))
    for path in paths:
        found = subprocess.run(["dpkg", "-S", str(path)], capture_output=True, text=True)
        if found.returncode == 0:
            package = found.stdout.split(":")[0]
            version = output("dpkg-query", "-W", "-f=${Version}\n", package).splitlines()[0]
            return package, version, pathlib.Path("/usr/share/doc") / package / "copyright"
    return None


def bring_along(folder, package):
    """Puts foreign libraries into <package>.libs; the names they have there, and components as CycloneDX has them."""
    libraries = folder / f"{package}.libs"
    information = next(folder.glob("*.dist-info"))
    renamed = {}
    components = []
    waiting = list(folder.rglob("*.so"))
    while waiting:
        user = waiting.pop()
        inside = user.parent == libraries
        for name in needed(user):
            if GIVEN.match(name):
                continue
            if name not in renamed:
                source = place(name)
                digest = hashlib.sha256(source.read_bytes()).hexdigest()[:8]
                stem, _, rest = name.partition(".so")
                renamed[name] = f"{stem}-{digest}.so{rest}"
                libraries.mkdir(exist_ok=True)
                copy = libraries / renamed[name]
                shutil.copyfile(source, copy)
                copy.chmod(0o755)
                subprocess.run(["patchelf", "--set-soname", renamed[name], copy], check=True)
                waiting.append(copy)
                if of := package_of(source):
                    notes = information / "licenses"
                    notes.mkdir(exist_ok=True)
                    shutil.copyfile(of[2], notes / f"{of[0]}.txt")
                    components.append(
                        {
                            "type": "library",
                            "name": of[0],
                            "version": of[1],
                            "purl": f"pkg:deb/debian/{of[0]}@{of[1]}",
                            "hashes": [
                                {"alg": "SHA-256", "content": hashlib.sha256(source.read_bytes()).hexdigest()}
                            ],
                        }
                    )
            subprocess.run(["patchelf", "--replace-needed", name, renamed[name], user], check=True)
        up = os.path.relpath(libraries, user.parent)
        if inside or any(name in renamed.values() for name in needed(user)):
            subprocess.run(["patchelf", "--force-rpath", "--set-rpath", "$ORIGIN" if inside else f"$ORIGIN/{up}", user],
                           check=True)  # fmt: skip
    sboms = information / "sboms"
    sboms.mkdir(exist_ok=True)
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.4",
        "version": 1,
        "components": sorted(components, key=lambda one: one["name"]),
    }
    (sboms / "brought-along.cdx.json").write_text(json.dumps(document, indent=2) + "\n")
    return renamed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wheel", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    options = parser.parse_args()
    name, version, python, abi, platform = options.wheel.stem.rsplit("-", 4)
    machine = platform.partition("_")[2]
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        with zipfile.ZipFile(options.wheel) as archive:
            archive.extractall(folder)
        for source, copy in sorted(bring_along(folder, name).items()):
            print(f"brought along: {source} as {copy}")
        asked = {}
        for library in folder.rglob("*.so*"):
            for source, symbol in versions(library):
                if GIVEN.match(source):
                    asked.setdefault(source, set()).add(symbol)
        lowest = 17
        for source, symbols in sorted(asked.items()):
            print(f"{source}: {' '.join(sorted(symbols))}")
            lowest = max([lowest, *map(glibc, symbols)])
        tag = f"{python}-{abi}-manylinux_2_{lowest}_{machine}"
        facts = next(folder.glob("*.dist-info")) / "WHEEL"
        facts.write_text(re.sub(r"(?m)^Tag: .*$", f"Tag: {tag}", facts.read_text()))
        options.output.mkdir(parents=True, exist_ok=True)
        path = options.output / f"{name}-{version}-{tag}.whl"
        write(folder, path)
    print(f"{path} ({path.stat().st_size / 1e6:.1f} MB): for C libraries from 2.{lowest} on")


if __name__ == "__main__":
    main()
