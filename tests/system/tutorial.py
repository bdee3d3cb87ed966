"""Runs docs/tutorial.md as a reader does, and compares what it prints.

A block ```sh is typed into one shell that lives through the whole tutorial. A block ```text after it is what it must
have printed on standard output, line by line; `...` stands for any text. A block ```sh first terminal goes on while the
next one, ```sh second terminal, is typed.

usage: tutorial.py TUTORIAL BUILD SOURCE
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^```(\w*) ?([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
MARK = "-----tutorial-block-"


def blocks_of(text):
    """Each ```sh block with the kind of terminal, its line, and the ```text block that follows it, if one does."""
    blocks = []
    for match in FENCE.finditer(text):
        language, terminal, body = match.groups()
        line = text.count("\n", 0, match.start()) + 1
        if language == "sh":
            blocks.append({"terminal": terminal, "body": body, "line": line, "expected": None})
        elif language == "text":
            if not blocks or blocks[-1]["expected"] is not None:
                sys.exit(f"{line}: what printed this?")
            blocks[-1]["expected"] = body
    return blocks


def script_of(blocks):
    lines = ["set -euo pipefail"]
    for number, block in enumerate(blocks):
        lines.append(f'printf "\\n{MARK}{number}\\n"')
        if block["terminal"] == "first terminal":
            lines.append(f"( {block['body']} ) >first-terminal.txt & first=$!")
        elif block["terminal"] == "second terminal":
            # A reader types when the first terminal shows that the run goes on.
            lines.append("for i in $(seq 300); do build/bin/lukou ctl list | grep -q . && break; sleep 0.1; done")
            lines.append(block["body"])
            lines.append("wait $first")
        else:
            lines.append(block["body"])
    return "\n".join(lines) + "\n"


def matches(expected, printed):
    """Blanks may be more or fewer; a line `...` stands for any lines, also none."""
    pattern = re.escape(expected.strip() + "\n")
    pattern = re.sub(r"(?m)^\\\.\\\.\\\.\\\n", "(?:.*\n)?", pattern)
    pattern = re.sub(r"(\\ )+", r"\\s+", pattern.replace(re.escape("..."), ".*"))
    return re.fullmatch(pattern, printed.strip() + "\n", re.DOTALL) is not None


def main():
    tutorial, build, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    blocks = blocks_of(tutorial.read_text(encoding="utf-8"))
    if not blocks:
        sys.exit(f"{tutorial}: holds no block ```sh")
    with tempfile.TemporaryDirectory(prefix="lukou-tutorial-") as place:
        clone = pathlib.Path(place, "clone")
        home = pathlib.Path(place, "home")
        clone.mkdir()
        home.mkdir()
        (clone / "build").symlink_to(build)
        (clone / "launch_scripts").symlink_to(source / "launch_scripts")
        environment = dict(os.environ, HOME=str(home))
        with open(pathlib.Path(place, "stderr"), "w+", encoding="utf-8") as errors:
            ended = subprocess.run(["bash", "-c", script_of(blocks)], cwd=clone, env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=errors, text=True, check=False)
            errors.seek(0)
            said = errors.read()
    parts = ended.stdout.split(MARK)[1:]
    failed = ended.returncode != 0
    if failed:
        at = blocks[len(parts) - 1]
        print(f"{tutorial.name}:{at['line']}: this block ended with {ended.returncode}:\n{at['body']}"
              f"\nit printed\n{parts[-1][-3000:]}\nand on standard error\n{said[-3000:]}")
    for part, block in zip(parts, blocks):
        printed = part.partition("\n")[2]
        if block["expected"] is not None and not matches(block["expected"], printed):
            print(f"{tutorial.name}:{block['line']}: printed\n{printed}\ninstead of\n{block['expected']}")
            failed = True
    print(f"{len(parts)} of {len(blocks)} blocks typed, {sum(b['expected'] is not None for b in blocks)} compared")
    sys.exit(1 if failed else 0)


main()
