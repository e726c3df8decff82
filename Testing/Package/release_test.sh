#!/usr/bin/env bash
# Makes a release of what is committed, without its tests: two builds have the same bits, the checksums are right, and
# the list of what is in it names every file and the libraries in the wheel.
# usage: release_test.sh BUILD_DIR [PARTS]    exit 77: no git repository
set -euo pipefail
build=$(realpath "$1")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/release
git -C "$source" rev-parse HEAD >/dev/null 2>&1 ||
  { echo "release_test.sh: the sources are in no git repository" >&2; exit 77; }
rm -rf "$scratch"
mkdir -p "$scratch"
git clone -q "$source" "$scratch/clone"
bash "$scratch/clone/Applications/release/make-release.sh" "$scratch/release" --without-tests \
  --only "${2:-source,wheel,packages}"
cd "$scratch/release"
sha256sum --quiet -c SHA256SUMS
/usr/bin/python3 - <<'END'
import hashlib, json, pathlib
(listing,) = pathlib.Path().glob("*.cdx.json")
document = json.loads(listing.read_text())
assert (document["bomFormat"], document["specVersion"]) == ("CycloneDX", "1.4")
version = document["metadata"]["component"]["version"]
files = {one["name"]: one["hashes"][0]["content"] for one in document["components"] if one["type"] == "file"}
made = [path for path in pathlib.Path().iterdir() if path.suffix in (".gz", ".whl", ".deb", ".zip", ".tgz", ".html")]
assert {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in made} == files and len(made) > 0
known = {one["bom-ref"] for one in document["components"]}
for one in document["dependencies"]:
    assert set(one["dependsOn"]) <= known
    if one["ref"].endswith(".whl"):
        assert any("libcrypto" in ref or "libssl" in ref for ref in one["dependsOn"]), one
    elif one["ref"] in files and not one["ref"].endswith((".deb", f"-{version}.tar.gz")):
        assert any("debian/c-blosc@" in ref for ref in one["dependsOn"]), one
assert all(one["version"] for one in document["components"] if one["type"] == "library"), "a version is missing"
END
echo "a release of $(ls | wc -l) files"
