"""The example in the guide is run as it stands there."""

import os
import pathlib
import re

GUIDE = pathlib.Path(__file__).parents[2] / "Applications/manual/guide/python.md"


def test_the_example_in_the_guide_runs(tmp_path, monkeypatch, capsys):
    blocks = re.findall(r"```python\n(.*?)```", GUIDE.read_text(), re.S)
    assert blocks
    monkeypatch.chdir(tmp_path)
    for block in blocks:
        names = {}
        exec(compile(block, "python.md", "exec"), names)
        assert names["core"].topology == {"euler": 1, "betti": (1, 0, 0)}
        assert names["mesh"].GetNumberOfPolys() > 0
    assert os.path.getsize("medial.vtp") > 1000 and "Core of label 3" in capsys.readouterr().out
