#!/usr/bin/python3
"""Writes what is in a release, as CycloneDX 1.4: each file with its digest, and the libraries it holds or needs.

usage: sbom.py VERSION FOLDER > OUT.cdx.json      FOLDER holds archives, wheels, .deb and npm packages, and the page

Of a wheel the libraries put into it, with their Debian packages and versions; of a package what it depends on, with the
version it was linked with; of a program for another system, of the npm package and of the page, which is made of it,
what their file SOURCES names. SOURCE_DATE_EPOCH is the time it states; the same files give the same bytes.
"""

import datetime
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tarfile
import uuid
import zipfile


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def of_wheel(path):
    with zipfile.ZipFile(path) as archive:
        names = [name for name in archive.namelist() if name.endswith("/sboms/brought-along.cdx.json")]
        return json.loads(archive.read(names[0]))["components"] if names else []


def library(name, version):
    one = {"type": "library", "name": name, "purl": f"pkg:deb/debian/{name}" + (f"@{version}" if version else "")}
    return dict(one, version=version) if version else one


def of_package(path):
    """Of alternatives the first."""
    found = []
    for need in re.split(r",\s*", output("dpkg-deb", "-f", str(path), "Depends").strip()):
        name = re.match(r"[a-z0-9][a-z0-9.+-]*", need)
        if not name:
            continue
        done = subprocess.run(["dpkg-query", "-W", "-f=${Version}\n", name[0]], capture_output=True, text=True)
        version = done.stdout.splitlines()[0] if done.returncode == 0 and done.stdout.strip() else ""
        found.append(library(name[0], version))
    return found


def of_program(path):
    """Of an archive without such a file nothing."""
    if path.suffix == ".zip":
        with zipfile.ZipFile(path) as archive:
            texts = [archive.read(name) for name in archive.namelist() if name.endswith("/SOURCES")]
    else:
        with tarfile.open(path) as archive:
            texts = [archive.extractfile(one).read() for one in archive if one.name.endswith("/SOURCES")]
    return [library(*line.split()) for line in texts[0].decode().splitlines()] if texts else []


def libraries_of(path, folder, version):
    if path.suffix == ".whl":
        return of_wheel(path)
    if path.suffix == ".deb":
        return of_package(path)
    if path.suffix == ".html" or path.name.endswith("-page.tar.gz"):
        return of_program(folder / f"voxelcore-{version}.tgz")
    return of_program(path)


def main():
    version, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    libraries, files, needs = {}, [], []
    for path in sorted(folder.iterdir()):
        if path.suffix not in (".gz", ".whl", ".deb", ".zip", ".tgz", ".html"):
            continue
        digest = hashlib.sha256(path.read_bytes()).hexdigest()
        files.append(
            {
                "type": "file",
                "bom-ref": path.name,
                "name": path.name,
                "version": version,
                "hashes": [{"alg": "SHA-256", "content": digest}],
            }
        )
        of_file = libraries_of(path, folder, version)
        for one in of_file:
            libraries.setdefault(one["purl"], dict(one, **{"bom-ref": one["purl"]}))
        needs.append({"ref": path.name, "dependsOn": sorted({one["purl"] for one in of_file})})
    when = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
    licences = [{"license": {"id": "Apache-2.0"}}]
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.4",
        "serialNumber": f"urn:uuid:{uuid.uuid5(uuid.NAMESPACE_URL, json.dumps(files, sort_keys=True))}",
        "version": 1,
        "metadata": {
            "timestamp": when.strftime("%Y-%m-%dT%H:%M:%SZ"),
            "component": {
                "type": "application",
                "bom-ref": "voxelcore",
                "name": "voxelcore",
                "version": version,
                "licenses": licences,
            },
        },
        "components": files + [libraries[purl] for purl in sorted(libraries)],
        "dependencies": [{"ref": "voxelcore", "dependsOn": [file["bom-ref"] for file in files]}, *needs],
    }
    json.dump(document, sys.stdout, indent=2)
    print()


if __name__ == "__main__":
    main()
