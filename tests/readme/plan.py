"""Says what the test does with every chunk of every README and every other page (*.md).

Commands are run as they are written, in the order of the README, in a folder like a fresh clone with
the program built. Each command must end with 0.

    QUICK     the command is run each time.
    SLOW      the command takes minutes, so only `ctest --preset slow` runs it (after those of QUICK).
    NOT_RUN   the command cannot be run here, for the stated reason. Its names are checked instead: the
              program's own --help must know all of its options and words, ctest its preset, Ninja
              its targets.
    NO_COMMAND  the chunk is no command; the value says what it is. The entry is the beginning of the chunk.

A synopsis has places to fill in (DIR, [--seed N], a|b), so it is never run. It needs no entry here:
run.py recognises it, and checks its names as for NOT_RUN.

    TYPED     doors.py types the whole page, from nothing to a gate.

A chunk that is in none of these lists fails the test, and so does an entry that no README has.
"""

RECURSION = "runs this very test"
NIGHT = "takes a night"
NO_QUERY = "libmine.so is the example, which holds no query; parts_of_a_detector_test runs them"
LENT = "builds, and the build is only lent"
EXAMPLES = "of files that the examples write; tests/reports/python runs those"
MUTANTS = "compiles as the build did, and the build is only lent; test mutation_smoke runs the script"
MISSES = "ends with 1, for the textbook test misses contacts; tests/corpus/vectors runs it"
SET_TESTS = "wants the Python module; tests/corpus/vectors and tests/reports/python run such lines"
BOUNDS = "the tests bounds, bounds_changes and bounds_contracted run it"

# Commands that make what the reader should have, run before the first command of the README.
GIVEN = {
    "detector/plugin/README.md": [
        "cc -std=c99 -shared -fPIC -I. tests/plugins/example.c -o libmine.so",
    ],
    "reports/README.md": [
        "cc -std=c99 -shared -fPIC -I. tests/plugins/example.c -o libmine.so",
    ],
}
# Commands run before the first slow command: they make what a page needs from an earlier page. A run
# proves as much as a certificate, in less time.
GIVEN_SLOW = {
    "README.md": ["assay run --campaign smoke --out build/certify"],
    "reports/certificate/README.md": ["assay certify --campaign smoke --out build/certify"],
}

QUICK = {
    "corpus/vectors/README.md": [
        "cc -std=c99 -O2 corpus/vectors/examples/plain.c -o build/plain -lm",
        "export PYTHONPATH=$PWD/build/release/python",
    ],
    "tests/README.md": [
        'RC_PARAMS="seed=7 max_success=1000 max_discard_ratio=100" ctest --preset law -R Laws.L3 --verbose',
    ],
    "README.md": [
        "export PATH=$PWD/build/release:$PATH",
    ],
    "reports/README.md": [
        "assay scene bend --size 2000 --frames 12 --out build/bend",
        "assay check build/bend/frame_*.ply",
        "assay check --culling view-line --json build/report.json build/bend/frame_*.ply",
        "assay check corpus/curated/B1_one_vertex_own_nearest.json",
        "assay list scenes",
        "assay scene twist --mesh build/bend/frame_0000.ply --frames 4 --out build/twist",
        "assay check build/bend/frame_0011.ply",
        "assay check --body build/bend/frame_0000.ply --body build/bend/frame_0011.ply",
        "assay check corpus/queries/example_vf.csv --method detector-exact",
        "assay replay quick:1:closed-generic:5 --why 0,5",
        "assay replay corpus/curated/B1_one_vertex_own_nearest.json --export build/export",
        "assay list faults",
    ],
    "reports/python/README.md": [
        "export PYTHONPATH=$PWD/build/release/python",
    ],
    "detector/plugin/README.md": [
        "cc -std=c99 -shared -fPIC -I. tests/plugins/example.c -o example.so",
        "assay scene bend --size 200 --frames 4 --out build/few",
        "assay check --detector ./example.so build/few/frame_*.ply",
    ],
}

SLOW = {
    "tests/README.md": [
        "ASSAY_SEED=7 ASSAY_CASES=100000 ctest --preset law --verbose",
        "ASSAY_KILLS=50 ASSAY_SEED=7 ctest --preset unit -R KilledAtRandom --verbose",
        "ctest --preset planted --verbose",
        "build/release/assay-micro --benchmark_list_tests",
        "build/release/assay-micro --benchmark_filter=look --benchmark_repetitions=9 "
        "--benchmark_enable_random_interleaving=true",
    ],
    "README.md": [
        "assay run --campaign smoke --part steps --detector build/release/peers/cubic_double.so --power build/certify --out build/cubic",
    ],
    "reports/README.md": [
        "assay self-test --jobs 2",
        "assay bench --suite speed-error --json build/speed-error.json",
        "python3 reports/pictures/benches.py build/speed-error.json build/speed-error.svg",
        "assay run --campaign smoke --out build/smoke",
        "assay run --campaign smoke --detector ./libmine.so --power build/smoke --out build/mine",
    ],
    "corpus/peers/README.md": [
        "assay bench --suite peers --quick --case-seconds 1 --json build/peers.json",
        "python3 reports/pictures/benches.py build/peers.json build/peers.svg",
    ],
    "reports/certificate/README.md": [
        "assay certify --campaign quick --out build/quick",
        "assay report build/quick --out build/quick/report.html",
        "assay verify build/certify",
        "assay verify build/certify --again 0.05",
    ],
    "detector/README.md": [
        "cmake -S detector -B build/detector && cmake --build build/detector",
    ],
    "detector/plugin/README.md": [
        "assay run --campaign smoke --out proof",
        "assay run --campaign smoke --detector ./libmine.so --power proof --out mine",
    ],
}

# Commands that find a fault of a detector, and their exit codes: several codes, in order, if a page has
# the same command several times.
ENDS = {
    "README.md": {
        "assay run --campaign smoke --part steps --detector build/release/peers/cubic_double.so --power build/certify --out build/cubic": [1],
    },
    "reports/check/TEN_MINUTES.md": {
        "assay run --campaign detector/plugin/ci/push.json --seed 3 --detector ./my_ccd.so --power build/proof --out build/mine": [1],
        "assay replay build/mine/failures/search-push-3-001-292-my-CCD-smallest.json --detector ./my_ccd.so": [1, 0],
        "SEED=1 SOURCES=tests/plugins/additive_ccd.cpp sh detector/plugin/ci/job.sh": [1],
        "SEED=3 sh detector/plugin/ci/job.sh": [1],
        "assay check steps.log --keep build/judged": [1],
    },
}

# Output that a README shows, by command: the entry of NO_COMMAND with which the chunk begins. The
# command must print each line of the chunk now; times may differ.
SHOWN = {
    "README.md": {
        "assay run --campaign smoke --part steps --detector build/release/peers/cubic_double.so --power build/certify --out build/cubic":
            "DEFECT free-sound: answered free",
    },
    "reports/README.md": {
        "assay check build/bend/frame_*.ply": "step 11: collision at",
        "assay run --campaign smoke --out build/smoke": "canary pair/zero-zero-dropped",
    },
    "reports/check/TEN_MINUTES.md": {
        "assay run --campaign detector/plugin/ci/push.json --seed 3 --detector ./my_ccd.so --power build/proof --out build/mine": "claims     FAILS",
        "assay replay build/mine/failures/search-push-3-001-292-my-CCD-smallest.json --detector ./my_ccd.so": "my CCD: defect",
        "assay run --campaign detector/plugin/ci/push.json --seed 3 --detector ./my_ccd.so --power build/proof --out build/mine-mended": "claims     holds",
        "SEED=1 SOURCES=tests/plugins/additive_ccd.cpp sh detector/plugin/ci/job.sh": "corpus     FAILS",
        "SEED=3 sh detector/plugin/ci/job.sh": "verdict: defect",
        "assay check steps.log --keep build/judged": "step 111: free; DIFFER",
        "assay check steps.log": "500 of 500 steps judged",
    },
}

NOT_RUN = {
    "README.md": {
        "reports/certify": "installs packages and builds; the slow list certifies by the program",
        "ninja -C build/release peer_cubic_double": LENT,
    },
    "reports/README.md": {
        "python3 reports/pictures/sequences.py assay reports/pictures/sequences.svg":
            "takes a minute, and prints times",
        "assay certify --campaign nightly --jobs 2 --out build/night": NIGHT,
        "assay verify night/* --out all": NIGHT + "; tests/nightly runs it",
    },
    ".github/CONTRIBUTING.md": {
        "tests/run": RECURSION,
        "tests/run --whole": RECURSION,
        "ninja -C build/release properties_judging_tests": LENT,
        "ctest --preset unit -R '^Claims'": RECURSION,
    },
    "corpus/vectors/README.md": {
        "python3 corpus/vectors/vectors.py run --out build/results.json -- build/plain": MISSES,
        "python3 corpus/vectors/vectors.py check corpus/vectors": "tests/corpus/vectors does so",
        "python3 corpus/vectors/vectors.py run --arithmetic exact --out build/exact.json": SET_TESTS,
        "python3 corpus/vectors/vectors.py score build/exact.json --out build/matrix.html": SET_TESTS,
    },
    "detector/plugin/README.md": {
        "assay check --detector ./libmine.so corpus/queries/example_vf.csv": NO_QUERY,
        "assay run --campaign smoke --part query --detector ./libmine.so --power proof --out mine-query":
            NO_QUERY,
    },
    "reports/python/README.md": {
        "cmake --preset release": LENT,
        "cmake --build build/release --target assay_python": LENT,
        "cmake --install build/release": "installs; install_test does it elsewhere",
        "assay check --detector python:textbook:TextbookCubic sim_0.ply sim_1.ply": EXAMPLES,
        "assay run --campaign smoke --detector python:textbook:TextbookCubic --out judged": EXAMPLES,
    },
    "tests/README.md": {
        "ctest --preset slow": RECURSION,
        "ctest --preset release": RECURSION,
        "tests/sanitized": "compiles and runs for hours",
        "python3 tests/bounds/prove.py": BOUNDS,
        "python3 tests/bounds/prove.py --changes tests/bounds/changes.json": BOUNDS,
        "python3 tests/bounds/contracted.py --build build/release": BOUNDS,
        "cmake --build --preset release --target mutation_facts mutant_judge detector_tests "
        "properties_detector_tests": LENT,
        "python3 tests/mutation/mutate.py": MUTANTS,
        "python3 tests/mutation/mutate.py --seed 2 --mutants 300 --jobs 2": MUTANTS,
        "python3 tests/mutation/mutate.py --only state/ boundary/ step/ search/ --mutants 200": MUTANTS,
        "python3 tests/mutation/mutate.py --these tests/mutation/smoke.json --anew": MUTANTS,
    },
}

# Pages of which doors.py types every line.
TYPED = {"reports/check/TEN_MINUTES.md"}

PYTHON = "Python; tests/reports/python/examples_test.py runs all of it"
NO_COMMAND = {
    "README.md": {
        "verdict: certified in": "what reports/certify prints",
        "DEFECT free-sound: answered free": "what `assay run` prints of the cubic",
    },
    "reports/README.md": {
        "step 11: collision at": "what `assay check` prints",
        "contact: triangles 0 and 1": "what `assay check` prints",
        "step 1: near at t = 0.5": "what `assay check --separation` prints",
        "canary pair/zero-zero-dropped": "what `assay run` prints",
        "parallel --jobs 2": "lines of GNU parallel and Slurm; tests/nightly runs them",
        "twist ": "the table of sequences.py",
        "arithmetic culling": "the table of `assay bench --suite speed-error`",
        "oracle: 5 queries (5 within": "what `assay check --separation` prints",
    },
    "reports/check/TEN_MINUTES.md": {
        '#include "detector/plugin/assay_detector.hpp"': "C++; a test compares it with the file",
        "claims     FAILS": "what `assay run` prints",
        "my CCD: defect": "what `assay replay` prints before the fault is mended",
        "corpus     FAILS": "what the job prints of a fault",
        "verdict: defect": "what the job prints of a fault in Python",
        "claims     holds": "what `assay run` prints",
        "step 111: free; DIFFER": "what `assay check` prints",
        "500 of 500 steps judged": "what `assay check` prints",
    },
    "corpus/README.md": {
        "83                      an array": "the bytes of a record; tests/detector/plugin reads them",
    },
    "corpus/vectors/README.md": {
        "import vectors": "Python; tests/corpus/vectors runs such lines",
    },
    "corpus/peers/README.md": {
        "built-in, exact, bvh": "rows of the table of `assay bench --suite peers`",
    },
    "detector/README.md": {
        '#include "detector/detector.h"': "C++; tests/consumer compiles a whole program like it",
        "Positions direction = descent(x);": "C++; tests/detector/limit_test.cpp runs such a loop",
    },
    "detector/plugin/README.md": {
        "// A detector by spheres": "C++; a test compiles and runs it, and compares the two",
        "find_package(assay 0.3": "CMake; tests/consumer/plugin builds plug-ins so",
        "c++ -std=c++17 -O2 -shared -fPIC $(pkg-config": "a shell's; tests/consumer/pkg_config.sh builds so",
        '#include "detector/plugin/assay_record.h"': "C; tests/recording compiles and runs it",
    },
    "properties/README.md": {
        "WorkerProcess worker(": "C++; the tests of the worker are made of such lines",
    },
    "reports/python/README.md": {
        "/usr/bin/python3 -m pip wheel": "builds; install_test does so",
        "/usr/bin/python3 -m venv": "installs; install_test does so",
        "import numpy as np": PYTHON,
        "print(result.counts": PYTHON,
        "face = [[": PYTHON,
        "near = assay.judge": PYTHON,
        "import meshio": PYTHON,
        'words = {"name": "mine"': PYTHON,
        "import textbook": PYTHON,
        'print(assay.run("campaign.json"': PYTHON,
    },
}
