"""Every relative link of the pages leads to a file and a heading that are there, every file a guide page names in
backquotes is there, and help names pages of the guide. Every page of the guide is linked from its index and stands in
the site's table of contents. The guide stays short. usage: links_test.py PROGRAM SOURCE_DIR"""

import re
import subprocess
import sys
from pathlib import Path

MOST_WORDS = 9_000  # a third of them in the table of arrays; who adds some finds others that may go

faults = []


def check(condition, message):
    if not condition:
        faults.append(message)


def without_code(text):
    """Without fenced and indented blocks."""
    text = re.sub(r"(?ms)^```.*?^```", "", text)
    return re.sub(r"(?m)^    .*$", "", text)


def anchors(path):
    """Anchors of a page's headings, as GitHub and mkdocs make them."""
    found = set()
    for heading in re.findall(r"(?m)^#+ (.*)$", re.sub(r"(?ms)^```.*?^```", "", path.read_text())):
        words = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)).strip().lower()
        found.add(words.replace(" ", "-"))
    return found


def links_of(path):
    return re.findall(r"\]\(([^)\s]+)\)", without_code(path.read_text()))


def check_links(path, root):
    links = links_of(path)
    for link in links:
        if re.match(r"[a-z]+:", link):
            continue
        file, _, anchor = link.partition("#")
        target = path.parent / file if file else path
        check(target.exists(), f"{path.relative_to(root)} links to {link}, which is not there")
        if anchor and target.exists():
            check(anchor in anchors(target), f"{path.relative_to(root)} links to {link}: no such heading")
    return len(links)


def main():
    program, root = sys.argv[1], Path(sys.argv[2]).resolve()
    guide = root / "Applications/manual/guide"
    pages = sorted(guide.glob("*.md"))
    folders = [root / name for name in ("Applications", "Modules", "Testing", "Data")]
    all_pages = sorted({root / "README.md", *(path for folder in folders for path in folder.rglob("*.md"))})
    count = sum(check_links(path, root) for path in all_pages)
    check(count > 100, f"only {count} links were found")

    navigation = (guide.parent / "mkdocs.yml").read_text()
    listed = re.findall(r"(?m)^ +- [^:]+: (\S+\.md)$", navigation)
    check(sorted(listed) == [page.name for page in pages], f"mkdocs.yml: {set(listed) ^ {page.name for page in pages}}")
    of_index = {link.partition("#")[0] for link in links_of(guide / "index.md")}
    # What has neither letter nor digit, such as the bars of tables, is no word.
    words = {page.name: sum(bool(re.search(r"\w", word)) for word in page.read_text().split()) for page in pages}
    check(sum(words.values()) <= MOST_WORDS, f"the guide has {sum(words.values())} words, not {MOST_WORDS}: {words}")
    missing = {page.name for page in pages} - of_index - {"index.md"}
    check(not missing, f"index.md does not lead to {sorted(missing)}")

    for page in [root / "README.md", *pages]:
        for name in re.findall(r"`((?:Testing|Applications|Modules|Data)/[\w./-]+)`", page.read_text()):
            check((root / name).exists(), f"{page.name} names {name}, which is not there")
    text = subprocess.run([program, "--help"], capture_output=True, text=True).stdout
    commands = re.findall(r"^  ([a-z]+) ", re.search(r"^Commands:\n(.*?)(\n\n|\Z)", text, re.M | re.S)[1], re.M)
    named = 0
    for command in commands:
        text = subprocess.run([program, command, "--help"], capture_output=True, text=True).stdout
        for name in re.findall(r"Guide:\s+(\S+)", text):
            named += 1
            check((guide / name.rstrip(".")).exists(), f"{command} --help names {name}, which the guide has not")
    check(named >= 8, f"help names {named} pages")
    if faults:
        sys.exit("\n".join(f"links_test.py: {fault}" for fault in faults))
    print(f"{count} links, {named} pages named by help")


main()
