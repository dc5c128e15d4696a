"""Makes a folder like a fresh clone with the program built, and runs commands of READMEs in it."""
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

# Files of the build tree that a clone lacks: a command could build with them, or two ctests share a log.
NOT_LENT = {"Testing", "CMakeCache.txt", "build.ninja", ".ninja_log", ".ninja_deps"}

CAMPAIGN = re.compile(r"(assay run --campaign \w+ --out )(\S+)")


class Clone:
    """Holds a copy of the sources, so that commands do not change the sources, and links to the build."""

    campaigns = {}  # by command: its folder, a copy of this folder, its output; a second run is the same

    def __init__(self, place, sources, build):
        self.place = Path(place)
        shutil.rmtree(self.place, ignore_errors=True)
        shutil.copytree(sources, self.place, ignore=lambda folder, names: {
            n for n in names if n in (".git", "node_modules")
            or n == "build" and Path(folder) == sources})
        release = self.place / "build/release"
        release.mkdir(parents=True)
        for entry in Path(build).iterdir():
            if entry.name not in NOT_LENT and entry not in (self.place, *self.place.parents):
                (release / entry.name).symlink_to(entry)

    def run(self, command, seconds):
        """Runs a command. Returns its exit code, or "over SECONDS s", and its output."""
        campaign = CAMPAIGN.fullmatch(command)
        if campaign and campaign[1] in self.campaigns:
            out, kept, printed = self.campaigns[campaign[1]]
            shutil.copytree(kept, self.place / campaign[2])
            return 0, printed.replace(out, campaign[2])
        # The READMEs write `assay` for the program of any build.
        path = f"{self.place / 'build/release'}:{os.environ['PATH']}"
        job = subprocess.Popen(["bash", "-c", command], cwd=self.place,
                               env={**os.environ, "PATH": path}, text=True, errors="replace",
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, start_new_session=True)
        try:
            printed = job.communicate(timeout=seconds)[0]
            if campaign and job.returncode == 0:
                kept = self.place.parent / f"campaign-{len(self.campaigns)}"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(self.place / campaign[2], kept)
                self.campaigns[campaign[1]] = campaign[2], kept, printed
            return job.returncode, printed
        except subprocess.TimeoutExpired:
            os.killpg(job.pid, signal.SIGKILL)
            return f"over {seconds} s", job.communicate()[0]
