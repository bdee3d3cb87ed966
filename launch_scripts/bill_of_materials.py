#!/usr/bin/env python3
"""Bill of materials of a build, as CycloneDX 1.5 JSON on standard output.

  launch_scripts/bill_of_materials.py [BUILD]        BUILD: build folder with the programs and the page; default build/

Found, not listed: the Debian packages of the libraries that the programs load and of the headers that are compiled into them
(ninja knows them), and the npm packages that are in the page's bundle (its source map knows them). Versions and licences are
those of the installed packages.
"""

import glob
import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import uuid

SOURCES = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def output(*command, **more):
    return subprocess.run(command, check=True, text=True, capture_output=True, **more).stdout


def loaded_libraries(build):
    """Files of the shared libraries that the programs load, the security plugins too."""
    programs = glob.glob(f"{build}/bin/lukou*") + glob.glob(f"{build}/lib/*.so") + glob.glob(f"{build}/python/*.so")
    if not programs:
        sys.exit(f"bill_of_materials.py: no programs in {build}; build them first")
    files = set()
    for program in programs:
        for line in output("ldd", program).splitlines():
            match = re.search(r"=> (/\S+)", line)
            if match and not os.path.realpath(match.group(1)).startswith(os.path.realpath(build)):
                files.add(os.path.realpath(match.group(1)))
    for library in list(files):
        if "/libddsc." in library:
            files.update(glob.glob(os.path.dirname(library) + "/libddsc0debian/*.so"))
    return files


def compiled_headers(build):
    """Files of the headers outside the sources that were compiled into the programs."""
    files = set()
    ours = False
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if not line.startswith(" "):
            ours = line.startswith(("common/", "services/", "idl/"))
        elif ours and line.strip().startswith("/usr/"):
            files.add(os.path.realpath(line.strip()))
    return files


def packages_of(files):
    """The Debian packages that the files belong to."""
    found = set()
    # A path is known by its package as it was before /lib became a link to /usr/lib, or as it is now.
    names = sorted(files | {name.removeprefix("/usr") for name in files})
    for i in range(0, len(names), 500):
        listing = subprocess.run(["dpkg-query", "-S", *names[i : i + 500]], text=True, capture_output=True).stdout
        for line in listing.splitlines():
            if not line.startswith("diversion "):
                found.update(line.rsplit(": ", 1)[0].split(", "))
    return found


def debian_licences(package):
    """Short names of the licences in the package's copyright file; empty if it does not list them by machine."""
    try:
        with open(f"/usr/share/doc/{package.split(':')[0]}/copyright", encoding="utf-8") as file:
            text = file.read()
    except OSError:
        return []
    if not text.startswith("Format:"):
        return []
    return sorted({name.strip() for name in re.findall(r"^License:[ \t]*(\S.*)$", text, re.MULTILINE)})


def debian_component(package, use):
    fields = "${Package}\t${Version}\t${Architecture}\t${source:Package}"
    name, version, architecture, source = output("dpkg-query", "-W", "-f", fields, package).split("\t")
    licences = debian_licences(package) or [f"see /usr/share/doc/{name}/copyright"]
    return {
        "type": "library",
        "bom-ref": f"deb/{name}",
        "name": name,
        "version": version,
        "licenses": [{"license": {"name": licence}} for licence in licences],
        "purl": f"pkg:deb/debian/{name}@{version}?arch={architecture}",
        "properties": [{"name": "lukou:use", "value": use}, {"name": "lukou:debian-source", "value": source}],
    }


def npm_components():
    """What is in the page's bundle."""
    web = f"{SOURCES}/services/console/web"
    with open(f"{web}/package-lock.json", encoding="utf-8") as file:
        locked = json.load(file)["packages"]
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "LUKOU_PAGE_OUT": folder}
        output("npm", "run", "build", "--loglevel=error", "--", "--sourcemap", cwd=web, env=environment)
        names = set()
        for source_map in glob.glob(f"{folder}/assets/*.map"):
            with open(source_map, encoding="utf-8") as file:
                for source in json.load(file)["sources"]:
                    match = re.search(r".*node_modules/((?:@[^/]+/)?[^/]+)/", source)
                    if match:
                        names.add(match.group(1))
    if not names:
        sys.exit("bill_of_materials.py: the page's bundle names no package; did its build change?")
    components = []
    for name in sorted(names):
        package = locked[f"node_modules/{name}"]
        algorithm, digest = package["integrity"].split("-", 1)
        components.append(
            {
                "type": "library",
                "bom-ref": f"npm/{name}",
                "name": name,
                "version": package["version"],
                "licenses": [{"license": {"name": package.get("license", "not stated")}}],
                "purl": f"pkg:npm/{name.replace('@', '%40')}@{package['version']}",
                "properties": [
                    {"name": "lukou:use", "value": "in the page"},
                    {"name": "lukou:npm-integrity", "value": f"{algorithm}-{digest}"},
                ],
            }
        )
    return components


def main():
    build = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else f"{SOURCES}/build")
    loaded = packages_of(loaded_libraries(build))
    compiled = packages_of(compiled_headers(build)) - loaded
    components = [debian_component(package, "loaded") for package in sorted(loaded)]
    components += [debian_component(package, "headers compiled in") for package in sorted(compiled)]
    components += npm_components()
    version = output(f"{build}/bin/lukou", "--version").strip()
    content = json.dumps(components, sort_keys=True).encode()
    bill = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        # The same parts give the same number.
        "serialNumber": f"urn:uuid:{uuid.UUID(hashlib.sha256(content).hexdigest()[:32])}",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "name": "lukou",
                "version": version,
                "licenses": [{"license": {"id": "Apache-2.0"}}],
            },
            "properties": [{"name": "lukou:machine", "value": platform.machine()}],
        },
        "components": components,
    }
    json.dump(bill, sys.stdout, indent=2)
    print()


main()
