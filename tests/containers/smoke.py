"""Runs the services of a compose file as containers of buildah, which knows no compose: in their order, with their command,
environment, volumes, networks and health checks. Then the run has to be sound, and its bytes those of a run in one process.

  smoke.py COMPOSE [--profile NAME] -- BUILDAH ...       BUILDAH: the command with its options; needs root
"""

import filecmp
import os
import re
import subprocess
import sys
import tempfile
import time

import yaml

LIMIT_S = 300


def interpolated(value):
    """As compose does: ${NAME:-default}, and $$ for $."""
    if isinstance(value, dict):
        return {key: interpolated(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [interpolated(inner) for inner in value]
    if not isinstance(value, str):
        return value

    def replaced(match):
        if match.group(0) == "$$":
            return "$"
        name, _, default = match.group(1).partition(":-")
        return os.environ.get(name) or default

    return re.sub(r"\$\$|\$\{([^}]*)\}", replaced, value)


class Smoke:
    def __init__(self, compose, profile, buildah, folder):
        self.services = {
            name: service
            for name, service in interpolated(compose["services"]).items()
            if not service.get("profiles") or profile in service["profiles"]
        }
        self.buildah = buildah
        self.folder = folder
        self.containers = {}
        self.networks = []
        self.running = {}

    def call(self, *arguments, **more):
        return subprocess.run([*self.buildah, *arguments], check=True, text=True, capture_output=True, **more).stdout.strip()

    def network(self, name):
        """The network namespace of a service, made when it is first asked for."""
        netns = f"lukou-smoke-{os.getpid()}-{name}"
        if netns not in self.networks:
            subprocess.run(["ip", "netns", "add", netns], check=True)
            self.networks.append(netns)
            subprocess.run(["ip", "-n", netns, "link", "set", "lo", "up"], check=True)
        return netns

    def command(self, name, words, container=None):
        """`words` in this container, with all that belongs to the service `name`."""
        service = self.services[name]
        mode = service.get("network_mode", "")
        network = self.network(mode.removeprefix("service:") if mode.startswith("service:") else name)
        run = ["ip", "netns", "exec", network, *self.buildah, "run"]
        for volume in service.get("volumes", []):
            source, target = volume.split(":")[:2]
            path = os.path.join(self.folder, source)
            run += ["--volume", f"{path}:{target}"]
        for key, value in service.get("environment", {}).items():
            run += ["--env", f"{key}={value}"]
        return [*run, container or self.containers[name], "--", *words]

    def start(self, name):
        service = self.services[name]
        self.containers[name] = self.call("from", "--pull-never", service["image"])
        command = self.command(name, service["entrypoint"] + service["command"])
        log = open(os.path.join(self.folder, name + ".log"), "w")
        self.running[name] = subprocess.Popen(command, stdout=log, stderr=log)

    def wait(self, name):
        code = self.running[name].wait(timeout=LIMIT_S)
        if code != 0:
            self.fail(f"{name} ended with code {code}")

    def fail(self, what):
        for name in self.running:
            print(f"--- {name}\n{open(os.path.join(self.folder, name + '.log')).read()}", file=sys.stderr)
        sys.exit(f"smoke.py: {what}")

    def healthy(self, name):
        test = self.services[name]["healthcheck"]["test"]
        words = ["/bin/sh", "-c", test[1]] if test[0] == "CMD-SHELL" else test[1:]
        # In a container of its own: buildah runs one command at a time in each.
        return subprocess.run(self.command(name, words, self.containers["probe"]), capture_output=True).returncode == 0

    def in_container(self, name, *words):
        return subprocess.run(self.command(name, list(words)), check=True, text=True, capture_output=True).stdout

    def up(self):
        done = set()
        while len(done) < len(self.services):
            for name, service in self.services.items():
                needed = service.get("depends_on", {})
                if name in done or any(other not in done for other in needed):
                    continue
                for other, how in needed.items():
                    if how["condition"] == "service_completed_successfully":
                        self.wait(other)
                self.start(name)
                done.add(name)

    def down(self):
        for process in self.running.values():
            if process.poll() is None:
                process.terminate()
                process.wait()
        for container in self.containers.values():
            self.call("rm", container)
        for netns in self.networks:
            subprocess.run(["ip", "netns", "del", netns], check=False)


def main():
    split = sys.argv.index("--")
    options, buildah = sys.argv[1:split], sys.argv[split + 1 :]
    profile = options[options.index("--profile") + 1] if "--profile" in options else None
    os.environ.setdefault("LUKOU_ARGUMENTS", "paper --duration 600")
    with open(options[0]) as file:
        compose = yaml.safe_load(file)
    with tempfile.TemporaryDirectory() as folder:
        smoke = Smoke(compose, profile, buildah, folder)
        try:
            first = next(iter(smoke.services))
            probe = smoke.call("from", "--pull-never", smoke.services[first]["image"])
            smoke.containers["probe"] = probe
            user = int(smoke.call("run", probe, "--", "id", "-u"))
            if user == 0:
                sys.exit("smoke.py: the image runs as root")
            for volume in compose.get("volumes", {}):
                os.mkdir(os.path.join(folder, volume))
                os.chown(os.path.join(folder, volume), user, user)
            os.chmod(folder, 0o755)

            # The image's own command: the demo.
            smoke.services["probe"] = {"volumes": ["results:/results"]}
            began = time.time()
            print(smoke.in_container("probe", "lukou", "run", "paper", "--duration", "600", "--quiet", "--json", "--out", "/results/demo")[:200])
            print(f"the demo ran in a container, {time.time() - began:.1f} s")
            del smoke.services["probe"]

            smoke.up()
            clocks = [name for name, service in smoke.services.items() if "test" in service.get("healthcheck", {})]
            for clock in clocks:
                deadline = time.time() + 30
                while not smoke.healthy(clock) and smoke.running[clock].poll() is None:
                    if time.time() > deadline:
                        smoke.fail(f"{clock} does not get healthy")
            for name in smoke.services:
                smoke.wait(name)

            print(f"{len(smoke.services)} containers ran, their health checks answered: {', '.join(clocks)}")
            smoke.services["probe"] = {"volumes": ["results:/results"]}
            results = os.path.join(folder, "results")
            for run in sorted(set(os.listdir(results)) - {"demo"}):
                print(smoke.in_container("probe", "lukou", "inspect", f"/results/{run}").strip())
                smoke.in_container("probe", "lukou", "run", f"/results/{run}/scenario.textproto", "--mode", "in-process", "--quiet", "--out", f"/results/{run}-alone")
                alone = os.path.join(results, run + "-alone")
                files = sorted(set(os.listdir(alone)) - {"timing.json", "operator.log"})
                _, different, missing = filecmp.cmpfiles(alone, os.path.join(results, run), files, shallow=False)
                if different or missing:
                    smoke.fail(f"{run}: {different + missing} differ from a run in one process")
                print(f"{run}: a process per container gives the bytes of one process, {len(files)} files")
        finally:
            smoke.down()


main()
