"""The draft of a paper: its numbers are those of the tables that comments beside them quote, its authors
those of codemeta.json, its pictures there and made by a script, its references all cited.
usage: paper_test.py SOURCE_DIR"""

import json
import pathlib
import re
import sys

SOURCE = pathlib.Path(sys.argv[1])
FOLDER = SOURCE / "Applications/release/joss"


def plain(text):
    return " ".join(text.split())


def main():
    paper = (FOLDER / "paper.md").read_text()
    quoted = re.findall(r"<!-- (Testing/[\w/]+\.md): (.*?) -->", paper)
    assert len(quoted) == paper.count("<!--") >= 8
    for page, words in quoted:
        assert plain(words) in plain((SOURCE / page).read_text()), f"{page} does not say: {words}"
    # Each number of the section on accuracy stands in what is quoted below it.
    section = re.search(r"(?s)# Accuracy and cost\n(.*?)!\[", paper)[1]
    said = re.findall(r"\d[\d.,]*\d|\d", re.sub(r"(?s)<!--.*?-->", "", section))
    sources = " ".join((SOURCE / page).read_text() for page in {page for page, _ in quoted})
    for number in said:
        assert re.search(rf"(?<![\d.]){re.escape(number)}(?![\d])", sources), f"no table has {number}"
    assert len(said) > 15
    meta = json.loads((SOURCE / "Applications/release/codemeta.json").read_text())
    names = re.findall(r"(?m)^  - name: (.*)\n    affiliation: 1$", paper)
    assert names == [author["name"] for author in meta["author"]], names
    make = (SOURCE / "Data/pictures/make.sh").read_text()
    pictures = re.findall(r"\]\(([^)]+\.png)\)", paper)
    assert pictures and all((FOLDER / one).exists() and pathlib.Path(one).name in make for one in pictures)
    cited = set(re.findall(r"@([a-z]+)\]", paper))
    assert cited == set(re.findall(r"(?m)^@article{(\w+),", (FOLDER / "paper.bib").read_text())), cited
    words = len(re.sub(r"(?s)^---.*?---|<!--.*?-->", "", paper).split())
    assert 500 < words < 1000, f"{words} words are not two pages"
    print(f"{len(quoted)} sources of {len(said)} numbers, {len(cited)} references, {words} words")


main()
