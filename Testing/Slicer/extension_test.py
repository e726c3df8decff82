"""What surrounds the Slicer module: catalog entry, CMake of the extension, panel file, and the XML of the modules that
run as programs; each against what Slicer's documents and parsers ask for."""

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


# What Slicer's parser of module descriptions knows: parameters by their tag, elements within them, attributes.
COMMON = {"name", "flag", "longflag", "description", "label", "default", "channel", "index"}
NUMBERS = {"constraints"}
PARAMETERS = {
    **dict.fromkeys(("integer", "float", "double"), (COMMON | NUMBERS, {"multiple", "hidden"})),
    **dict.fromkeys(("boolean", "string", "directory"), (COMMON, {"multiple", "hidden"})),
    **dict.fromkeys(("integer-vector", "float-vector", "double-vector", "string-vector"), (COMMON, {"hidden"})),
    **dict.fromkeys(("integer-enumeration", "float-enumeration", "double-enumeration", "string-enumeration"),
                    (COMMON | {"element"}, {"hidden"})),
    **dict.fromkeys(("point", "pointfile", "region"), (COMMON, {"multiple", "coordinateSystem", "fileExtensions"})),
    "file": (COMMON, {"multiple", "fileExtensions"}),
    "image": (COMMON, {"multiple", "type", "fileExtensions", "reference", "hidden"}),
    "geometry": (COMMON, {"multiple", "type", "fileExtensions", "reference", "hidden", "aggregate"}),
    "table": (COMMON, {"multiple", "type", "fileExtensions", "reference", "hidden"}),
    "transform": (COMMON, {"multiple", "type", "fileExtensions", "reference", "hidden"}),
    "measurement": (COMMON, {"multiple", "hidden"}),
}
TYPES = {"image": {"scalar", "label", "vector", "tensor", "diffusion-weighted"},
         "geometry": {"fiberbundle", "model", "segmentation", "scalar"}}
HEAD = ["category", "title", "description", "version", "documentation-url", "license", "contributor",
        "acknowledgements"]


def faultsOfDescription(root):
    found = []
    tags = [child.tag for child in root]
    head = tags[: tags.index("parameters")] if "parameters" in tags else tags
    if root.tag != "executable" or [tag for tag in HEAD if tag in head] != head or not {"title", "description"} <= set(
            head) or set(tags[len(head):]) != {"parameters"}:
        found.append(f"executable: {tags}")
    names, flags, indices = [], [], []
    for group in root.findall("parameters"):
        if [child.tag for child in group[:2]] != ["label", "description"] or len(group) < 3:
            found.append("parameters: no label, no description or nothing else")
        if set(group.attrib) - {"advanced"} or group.get("advanced", "true") not in ("true", "false"):
            found.append(f"parameters: {group.attrib}")
        for parameter in group[2:]:
            if parameter.tag not in PARAMETERS:
                found.append(f"{parameter.tag}: unknown")
                continue
            inside, attributes = PARAMETERS[parameter.tag]
            values = {child.tag: child.text or "" for child in parameter}
            name = values.get("name", "")
            once = [child.tag for child in parameter if child.tag != "element"]
            if set(values) - inside or set(parameter.attrib) - attributes or len(once) != len(set(once)):
                found.append(f"{name}: {sorted(values)} {parameter.attrib}")
            if not re.fullmatch(r"[_a-zA-Z][_a-zA-Z0-9]*", name):
                found.append(f"{name}: no name")
            if not values.get("label") or "description" not in values:
                found.append(f"{name}: no label or description")
            simple = parameter.tag in ("integer", "double", "float", "boolean", "string", "string-enumeration")
            returned = simple and values.get("channel") == "output"
            if not returned and not {"flag", "longflag", "index"} & set(values):
                found.append(f"{name}: no flag and no index")
            if not re.fullmatch(r"-{0,2}[a-zA-Z][a-zA-Z0-9_-]*", values.get("longflag", "a")):
                found.append(f"{name}: longflag {values['longflag']}")
            if "index" in values and not values["index"].isdigit():
                found.append(f"{name}: index")
            if values.get("channel", "input") not in ("input", "output"):
                found.append(f"{name}: channel")
            if not simple and "channel" not in values:
                found.append(f"{name}: a file without channel")
            if parameter.get("type") and parameter.get("type") not in TYPES.get(parameter.tag, ()):
                found.append(f"{name}: type {parameter.get('type')}")
            if parameter.get("reference") and parameter.get("reference") not in names:
                found.append(f"{name}: reference to nobody")
            if parameter.tag.endswith("enumeration"):
                offered = [child.text for child in parameter.findall("element")]
                if values.get("default") not in offered:
                    found.append(f"{name}: default is no element")
            for tag, kind in (("integer", int), ("double", float), ("float", float)):
                if parameter.tag == tag and values.get("default"):
                    try:
                        kind(values["default"])
                    except ValueError:
                        found.append(f"{name}: default {values['default']}")
            if parameter.tag == "boolean" and values.get("default") not in ("true", "false"):
                found.append(f"{name}: default of a boolean")
            names.append(name)
            flags += [values[flag].lstrip("-") for flag in ("flag", "longflag") if flag in values]
            indices += [values["index"]] if "index" in values else []
    for what, all in (("name", names), ("flag", flags), ("index", indices)):
        found += [f"{what} twice: {one}" for one in set(all) if all.count(one) > 1]
    return found


@pytest.mark.parametrize("name", ["VoxelCoreMedialSurface", "VoxelCoreCurveSkeleton"])
def test_xml_of_the_command_line_modules_holds_slicers_schema(name):
    module = os.path.join(os.environ["VOXELCORE_CLI_MODULES"], name)
    text = subprocess.run([module, "--xml"], capture_output=True, text=True, check=True).stdout
    root = xml.fromstring(text)
    assert faultsOfDescription(root) == []
    # The check finds faults of each kind.
    for old, new in (("<channel>input", "<channel>in"), ("<index>1", "<index>0"), ("<label>", "<lable>"),
                     ('type="label"', 'type="mask"'), ('reference="LabelVolume"', 'reference="Nobody"'),
                     ("<longflag>--labels", "<longflag>--8labels"), ("<name>Labels", "<name>8Labels"),
                     ("<string>", "<text>"), ("<title>", "<titel>")):
        assert old in text, old
        broken = text.replace(old, new).replace(old.replace("<", "</"), new.replace("<", "</"))
        assert faultsOfDescription(xml.fromstring(broken)), f"{old} as {new}"
