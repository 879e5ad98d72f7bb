#!/usr/bin/env bash
# Compiles the dam break, and a file that only includes spate.hpp, at -O3 with both compilers: user seconds and peak
# memory, the least of three turns. Limits: 10 s and 1 GB for dam_break.cpp, 4 s for spate.hpp.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ ${1-} == --help || ${1-} == -h ]]; then
    echo "usage: bash bench/compile_time.sh [TURNS]"
    exit 0
fi
mkdir -p build/bench
/usr/bin/python3 - "${1-3}" <<'END'
import json, os, resource, shutil, subprocess, sys, tempfile

turns = int(sys.argv[1])
flags = ["-std=c++20", "-O3", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-fopenmp"]
flags += ["-Iinclude", "-Iexamples"]


def words(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
    except (OSError, subprocess.CalledProcessError):
        return []


def first_of(*folders):
    return ["-isystem" + f for f in folders if os.path.isdir(f)][:1]


flags += first_of("/usr/include/eigen3")
flags += first_of("/usr/include/hdf5/serial", "/usr/include/hdf5/openmpi")
if not os.path.isdir("/usr/include/hdf5/serial"):  # HDF5 for MPI includes mpi.h
    flags += [f.replace("-I", "-isystem") for f in words("mpicxx", "--showme:compile") if f.startswith("-I")]


def once(compiler, source, output):
    """User seconds and peak megabytes of one compilation, of the driver and all that it starts."""
    pid = os.fork()
    if pid == 0:
        ok = subprocess.run([compiler, *flags, "-c", source, "-o", output]).returncode == 0
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        with open(output + ".used", "w") as f:
            json.dump([ok, used.ru_utime, used.ru_maxrss / 1024], f)
        os._exit(0)
    os.waitpid(pid, 0)
    with open(output + ".used") as f:
        ok, seconds, megabytes = json.load(f)
    if not ok:
        sys.exit(f"compile_time.sh: {compiler} could not compile {source}")
    return seconds, megabytes


result = {}
with tempfile.TemporaryDirectory() as folder:
    only = os.path.join(folder, "only_spate.cpp")
    with open(only, "w") as f:
        f.write("#include <spate/spate.hpp>\nint main() {}\n")
    files = {"dam_break.cpp": ("examples/dam_break/dam_break.cpp", 10, 1000), "spate.hpp alone": (only, 4, None)}
    print(f"{'':17} {'compiler':9} {'user s':>7} {'limit':>6} {'peak MB':>8} {'limit':>6}")
    for name, (source, most_seconds, most_memory) in files.items():
        for compiler in ("g++", "clang++"):
            if not shutil.which(compiler):
                continue
            taken = [once(compiler, source, os.path.join(folder, "out.o")) for _ in range(turns)]
            seconds, megabytes = min(t[0] for t in taken), min(t[1] for t in taken)
            result.setdefault(name, {})[compiler] = {"user_s": seconds, "peak_mb": megabytes}
            print(f"{name:17} {compiler:9} {seconds:7.2f} {most_seconds:6} {megabytes:8.0f} {most_memory or '':>6}")
with open("build/bench/compile_time.json", "w") as f:
    json.dump(result, f, indent=1)
END
echo "figures: build/bench/compile_time.json"
