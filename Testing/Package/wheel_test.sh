#!/usr/bin/env bash
# Makes the wheel, installs it into a virtual environment with numpy alone, offline, and runs the example of its README
# there: the bits of the command line. Then the module's own tests run on what was installed.
# usage: wheel_test.sh BUILD_DIR
set -euo pipefail

build=$(realpath "$1")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/wheel
program=$build/bin/voxelcore
fail() {
  echo "wheel_test.sh: $1" >&2
  exit 1
}

rm -rf "$scratch"
mkdir -p "$scratch/wheels" "$scratch/empty"
begin=$(date +%s)
bash "$source/Applications/Python/wheel/make-wheel.sh" "$scratch/wheels" /usr/bin/python3 >"$scratch/said" ||
  { tail -n 40 "$scratch/said" >&2; fail "the wheel cannot be made"; }
echo "made in $(($(date +%s) - begin)) s"
wheel=$(ls "$scratch"/wheels/voxelcore-*.whl)
[ "$(stat -c %s "$wheel")" -lt 12000000 ] || fail "the wheel is larger than 12 MB"
[[ $wheel == *-manylinux_2_*_$(uname -m).whl ]] || fail "$wheel names no manylinux policy"

# Nothing in it needs VTK, ITK, TetGen or X, and all it needs besides the C and C++ libraries it holds. None of the
# libraries in it asks for sources to be handed on but those of GCC, whose exception covers programs.
mkdir "$scratch/unpacked"
(cd "$scratch/unpacked" && /usr/bin/python3 -m zipfile -e "$wheel" .)
for library in $(cd "$scratch/unpacked" && find . -name '*.so*'); do
  needs=$(readelf -d "$scratch/unpacked/$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  for name in $needs; do
    [[ $name =~ ^(ld-linux.*|libc|libm|libdl|librt|libpthread|libgcc_s|libstdc\+\+)\.so\.[0-9]+$ ]] ||
      [ -e "$scratch/unpacked/voxelcore.libs/$name" ] || fail "$library needs $name, which is not in the wheel"
  done
done
foreign=$(cd "$scratch/unpacked/voxelcore.libs" && ls | grep -E '^lib(vtk|ITK|itk|tet|X11|GL|tiff|jbig)' || true)
[ -z "$foreign" ] || fail "the wheel carries $foreign"
ls "$scratch"/unpacked/voxelcore-*.dist-info/LICENSE >/dev/null || fail "the wheel does not hold its licence"
top=$(cd "$scratch/unpacked" && printf '%s ' *)
[[ $top =~ ^voxelcore\ voxelcore-[0-9.]+\.dist-info\ voxelcore\.libs\ $ ]] || fail "the wheel holds $top"
grep -qx 'voxelcore = voxelcore:napari.json' "$scratch"/unpacked/voxelcore-*.dist-info/entry_points.txt ||
  fail "napari does not find its plugin"

/usr/bin/python3 "$source/Testing/Package/numpy_wheel.py" "$scratch/wheels"
/usr/bin/python3 -m venv "$scratch/clean"
"$scratch/clean/bin/pip" install --quiet --no-index --find-links "$scratch/wheels" voxelcore numpy
packages=$("$scratch/clean/bin/pip" list --format=freeze | sed 's/==.*//' | grep -vxE 'pip|setuptools|wheel' | sort |
  tr '\n' ' ')
[ "$packages" = "numpy voxelcore " ] || fail "installed are $packages"
# What cibuildwheel would run on its wheels.
command=$(sed -n '/CIBW_TEST_COMMAND:/,/^      - /p' "$source/.github/workflows/wheels.yml" |
  sed -e '1s/.*CIBW_TEST_COMMAND: //' -e '$d' | tr -s '\n ' ' ')
[[ $command == 'python -c '*betti* ]] || fail "which test has wheels.yml? $command"
(cd "$scratch/empty" && env -u PYTHONPATH PATH="$scratch/clean/bin:$PATH" bash -euc "$command") ||
  fail "the test of wheels.yml fails"
cd "$scratch/empty"
unset PYTHONPATH
sed -n '/^```python$/,/^```$/p' "$source/Applications/Python/README.md" | grep -v '^```' >example.py
cat >>example.py <<'END'
import sys
for name in sys.modules:
    assert not name.startswith(("vtk", "itk", "pandas", "networkx")), name
voxelcore.read("medial.vtp").skeleton().save("skeleton.vtp", overwrite=True)
voxelcore.skeleton(labels, label=3, spacing=(0.5, 0.5, 1)).save("branches.vtp", overwrite=True)
with open("labels.nrrd", "wb") as file:
    sizes = " ".join(map(str, labels.shape))
    file.write(f"NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes}\n"
               "space directions: (0.5,0,0) (0,0.5,0) (0,0,1)\nencoding: raw\nspace origin: (0,0,0)\n\n".encode())
    file.write(labels.tobytes(order="F"))
print(voxelcore.__file__)
END
"$scratch/clean/bin/python" example.py >said || fail "the example of the README does not run"
grep -q "^$scratch/clean/" said || fail "another module was loaded: $(tail -1 said)"
"$program" core labels.nrrd --labels 3 -o program.vtp -q
"$program" skeleton program.vtp -o program-skeleton.vtp -q
"$program" skeleton labels.nrrd --labels 3 -o program-branches.vtp -q
# All but what this wheel leaves out: TetGen, and with it the second opinion.
/usr/bin/python3 -m venv --system-site-packages "$scratch/all"
"$scratch/all/bin/pip" install --quiet --no-index --no-deps "$wheel"
# Every array; of the provenance only the name and digest of the scan's file differ.
for pair in medial:program skeleton:program-skeleton branches:program-branches; do
  PYTHONPATH=$source/Testing/Python VOXELCORE_PROGRAM=$program "$scratch/all/bin/python" -B - "$pair" <<'END' ||
import sys
from test_results import arrays, polydata
ours, theirs = (arrays(polydata(f"{name}.vtp")) for name in sys.argv[1].split(":"))
assert len(ours) > 5 and ours == theirs
END
    fail "what the example makes is not what the command line makes ($pair)"
done
cd "$source/Testing/Python"
VOXELCORE_PROGRAM=$program "$scratch/all/bin/python" -B -m pytest -q -p no:cacheprovider \
  -k "not tetgen and not cross_check" \
  test_{arrays,exchange,images,interrupts,napari,options,processes,pruning,results,words}.py
# And the Slicer module's work, computed by what was installed.
VOXELCORE_PROGRAM=$program "$scratch/all/bin/python" -B -m pytest -q -p no:cacheprovider -k package \
  "$source/Testing/Slicer/logic_test.py"
