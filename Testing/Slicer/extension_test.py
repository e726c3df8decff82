"""What surrounds the Slicer module: catalog entry, CMake of the extension, and panel file; each against what Slicer's
documents and parsers ask for."""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as xml

import pytest
from conftest import HERE, MODULE, ROOT

EXTENSION = os.path.join(ROOT, "Applications", "slicer", "Extension")
UI = os.path.join(MODULE, "Resources", "UI", "VoxelCore.ui")

# slicer-extension-catalog-entry-schema v1.0.1, as facts: what must be there, what may, and of which type.
ENTRY = {
    "$schema": (str, True),
    "category": (str, True),
    "scm_url": (str, True),
    "scm_revision": (str, False),
    "scm_type": (str, False),
    "build_dependencies": (list, False),
    "build_subdirectory": (str, False),
    "enabled": (bool, False),
    "tier": (int, False),
}


def faultsOfEntry(entry):
    found = [f"{name}: unknown" for name in entry if name not in ENTRY]
    for name, (kind, needed) in ENTRY.items():
        if name not in entry:
            found += [f"{name}: missing"] if needed else []
        elif type(entry[name]) is not kind:
            found.append(f"{name}: no {kind.__name__}")
    if entry.get("scm_type", "git") not in ("git", "local"):
        found.append("scm_type: neither git nor local")
    if entry.get("tier", 1) not in (1, 3, 5):
        found.append("tier: not 1, 3 or 5")
    if not all(isinstance(name, str) for name in entry.get("build_dependencies", [])):
        found.append("build_dependencies: not texts")
    return found


def cmakeVariable(name):
    text = open(os.path.join(EXTENSION, "CMakeLists.txt"), encoding="utf-8").read()
    return re.search(rf'set\({name}\s+"([^"]*)"\)', text).group(1)


def test_catalog_entry_holds_its_schema():
    with open(os.path.join(EXTENSION, "VoxelCore.json"), encoding="utf-8") as file:
        entry = json.load(file)
    assert faultsOfEntry(entry) == []
    assert entry["$schema"].endswith("slicer-extension-catalog-entry-schema-v1.0.1.json#")
    assert entry["category"] == cmakeVariable("EXTENSION_CATEGORY")
    # The check finds each kind of fault.
    for change in ({"tier": 2}, {"tier": "1"}, {"scm_type": "svn"}, {"homepage": "x"}, {"build_dependencies": "NA"},
                   {"build_dependencies": [1]}, {"enabled": "yes"}):
        assert faultsOfEntry({**entry, **change}), change
    for name in ("$schema", "category", "scm_url"):
        assert faultsOfEntry({key: value for key, value in entry.items() if key != name}), name


@pytest.mark.parametrize("source", [EXTENSION, ROOT], ids=["Extension", "root"])
def test_extension_configures_and_what_it_copies_can_be_imported(source, tmp_path):
    """Under a stand-in for Slicer's CMake package. Slicer's index configures the root of a repository."""
    cmake = shutil.which("cmake")
    build = tmp_path / "build"
    done = subprocess.run(
        [cmake, "-S", source, "-B", str(build), f"-DSlicer_DIR={os.path.join(HERE, 'stub', 'cmake')}",
         "-DBUILD_TESTING=ON"], capture_output=True, text=True)
    assert done.returncode == 0 and "Warning" not in done.stderr, done.stderr
    assert sorted(open(build / "called.txt").read().split()) == ["config", "cpack", "module:VoxelCore",
                                                                "test:VoxelCore.py", "use"]
    copied = build / "lib" / "qt-scripted-modules"
    of = lambda folder, ending: sorted(  # noqa: E731
        os.path.relpath(os.path.join(where, name), folder) for where, _, names in os.walk(folder) for name in names
        if name.endswith(ending) and "__pycache__" not in where)
    for ending in (".py", ".ui", ".png"):
        assert of(copied, ending) == of(MODULE, ending), f"{ending} files"
    code = "import panel, VoxelCore, VoxelCoreLib.Computation as c; print(VoxelCore.__file__, c.__file__)"
    environment = dict(os.environ, PYTHONPATH=f"{copied}:{os.path.join(HERE, 'stub')}", QT_QPA_PLATFORM="offscreen")
    done = subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(str(copied)) == 2


def test_address_of_the_repository_stands_in_one_place(tmp_path):
    """In the catalog entry; home page, icon and screenshot follow, and lead to files of the repository."""
    repository = tmp_path / "repository"
    shutil.copytree(EXTENSION, repository / "Applications/slicer/Extension")
    shutil.copytree(MODULE, repository / "Applications/slicer/VoxelCore")
    for name in ("LICENSE", "README.md"):
        shutil.copy(os.path.join(ROOT, name), repository)
    path = repository / "Applications/slicer/Extension/VoxelCore.json"
    entry = json.loads(path.read_text())
    assert re.fullmatch(r"https://[a-z-]+\.invalid/voxelcore\.git", entry["scm_url"]), "a name nobody can own"
    for url, said in ((entry["scm_url"], True), ("https://git.host/lab/core.git", False), ("https://a.b/c", False)):
        path.write_text(json.dumps({**entry, "scm_url": url}, indent=2))
        build = tmp_path / "build"
        done = subprocess.run(
            ["cmake", "-S", str(path.parent), "-B", str(build), f"-DSlicer_DIR={os.path.join(HERE, 'stub', 'cmake')}"],
            capture_output=True, text=True)  # fmt: skip
        assert done.returncode == 0 and ("put that of the repository" in done.stderr) == said, done.stderr
        home, *pictures = (build / "addresses.txt").read_text().split()
        assert home == url.removesuffix(".git") and len(pictures) == 3
        for address in pictures:
            assert address.startswith(home + "/raw/main/")
            assert os.path.isfile(os.path.join(ROOT, address[len(home + "/raw/main/"):]))


def test_panel_has_every_widget_the_code_names_and_no_other():
    root = xml.parse(UI).getroot()
    widgets = {widget.get("name"): widget.get("class") for widget in root.iter("widget")}
    code = open(os.path.join(MODULE, "VoxelCore.py"), encoding="utf-8").read()
    named = set(re.findall(r"self\.ui\.(\w+)", code)) | set(re.findall(r'^ +\("\w+", "(\w+)", "\w+"\),$', code, re.M))
    assert named <= set(widgets)
    assert len([name for name in named if name.endswith("CheckBox")]) >= 7
    handled = {name for name in widgets if not name.endswith("Label") and name != "VoxelCore"}
    assert {name for name in handled - named if widgets[name] != "ctkCollapsibleButton"} == set()
    custom = {one.findtext("class") for one in root.iter("customwidget")}
    assert {name for name in widgets.values() if name.startswith(("qMRML", "ctk"))} == custom
    for widget in root.iter("widget"):
        asks = widget.get("class") not in ("QLabel", "qMRMLWidget", "ctkCollapsibleButton", "QProgressBar")
        tip = widget.find("property[@name='toolTip']/string")
        assert not asks or (tip is not None and tip.text.endswith(".")), f"{widget.get('name')}: no tool tip"


def test_icon_is_128_pixels_with_transparency():
    with open(os.path.join(MODULE, "Resources", "Icons", "VoxelCore.png"), "rb") as file:
        head = file.read(26)
    width, height, depth, colour = struct.unpack(">IIBB", head[16:26])
    assert head[:8] == b"\x89PNG\r\n\x1a\n" and (width, height, depth, colour) == (128, 128, 8, 6)
