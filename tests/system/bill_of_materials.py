"""bill_of_materials.py BUILD SOURCES: the bill names what the programs are known to be made of, with what is installed."""

import json
import subprocess
import sys

build, sources = sys.argv[1:]


def bill():
    script = f"{sources}/launch_scripts/bill_of_materials.py"
    return json.loads(subprocess.run([script, build], check=True, capture_output=True).stdout)


def installed(package):
    query = ["dpkg-query", "-W", "-f=${Version}", package]
    return subprocess.run(query, check=True, text=True, capture_output=True).stdout


found = bill()
assert (found["bomFormat"], found["specVersion"]) == ("CycloneDX", "1.5")
parts = {part["name"]: part for part in found["components"]}
assert len(parts) == len(found["components"]), "each part once"
for name, part in parts.items():
    assert part["version"] and part["licenses"] and part["purl"].startswith(("pkg:deb/debian/", "pkg:npm/")), part
    assert all(licence["license"]["name"] for licence in part["licenses"]), part


def use(name):
    return {entry["name"]: entry["value"] for entry in parts[name]["properties"]}["lukou:use"]


# The bus with its security, what crosses the air, the log, cryptography; headers alone; the page's two libraries and its frame.
for name in ("libddsc0debian", "libprotobuf32", "libspdlog1.10", "libssl3"):
    assert use(name) == "loaded", name
    assert parts[name]["version"] == installed(name), name
for name in ("libboost1.81-dev", "libcli11-dev", "nlohmann-json3-dev", "librandom123-dev", "pybind11-dev"):
    assert use(name) == "headers compiled in", name
for name in ("@bufbuild/protobuf", "uplot", "svelte"):
    assert use(name) == "in the page", name
with open(f"{sources}/services/console/web/package-lock.json", encoding="utf-8") as file:
    locked = json.load(file)["packages"]
assert parts["uplot"]["version"] == locked["node_modules/uplot"]["version"]
# Tools of the tests are no part of the product.
for name in ("libgtest-dev", "libbenchmark-dev", "playwright-core", "vitest", "vite"):
    assert name not in parts, name
assert bill() == found, "the same parts give the same bill"
print(f"{len(parts)} parts")
