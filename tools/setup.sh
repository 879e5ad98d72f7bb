#!/usr/bin/env bash
# Installs what spate needs and this Debian 12 lacks. Quiet and instant when all is there.
set -euo pipefail

usage()
{
    cat <<'END'
usage: bash tools/setup.sh [--with PART]...

Installs, as root or with sudo, the Debian packages that are missing for the library and for each PART:
  tests      GoogleTest, HDF5, libpng, and h5py and VTK to read files with
  examples   HDF5, libpng, CLI11, nlohmann-json  mpi        Open MPI, HDF5 for it
  bench      Google Benchmark, matplotlib        clang      clang, its OpenMP and its sanitizers
  tidy       clang-format and clang-tidy
With tests and bench comes mpi.
On another system it names the packages and stops with exit code 2. SPATE_SETUP=off skips it.
END
}

# One entry a package; a|b means that either will do, and a is installed if neither is there.
declare -A packages=(
    [library]="g++ cmake ninja-build libeigen3-dev libxsimd-dev"
    [tests]="libgtest-dev libgmock-dev libhdf5-dev|libhdf5-openmpi-dev libpng-dev python3 python3-h5py-serial|python3-h5py-mpi python3-vtk9"
    [examples]="libhdf5-dev|libhdf5-openmpi-dev libpng-dev libcli11-dev nlohmann-json3-dev"
    [mpi]="openmpi-bin libopenmpi-dev libhdf5-openmpi-dev"
    [bench]="libbenchmark-dev python3 python3-matplotlib python3-munkres|python3-scipy"
    [clang]="clang libomp-dev libclang-rt-14-dev"
    [tidy]="clang clang-format clang-tidy libomp-dev"
)

parts=(library)
while (($#)); do
    case $1 in
        --with)
            part=${2-}
            [[ -n $part && $part != library && -n ${packages[$part]-} ]] || {
                echo "setup.sh: --with $part: choose tests, examples, mpi, bench, clang or tidy" >&2
                exit 2
            }
            parts+=("$part")
            [[ $part != tests && $part != bench ]] || parts+=(mpi)
            shift 2
            ;;
        --help | -h) usage; exit 0 ;;
        *) echo "setup.sh: unknown option $1 (see --help)" >&2; exit 2 ;;
    esac
done
[[ ${SPATE_SETUP-} != off ]] || exit 0

wanted=()
for part in "${parts[@]}"; do
    read -ra entries <<< "${packages[$part]}"
    wanted+=("${entries[@]}")
done

installed=" "
if command -v dpkg-query > /dev/null; then
    read -ra names <<< "${wanted[*]//|/ }"
    # dpkg-query fails if it does not know one of them: that one is missing, no more.
    known=$(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "${names[@]}" 2> /dev/null || true)
    installed=" $(sed -n 's/^ii *//p' <<< "$known" | tr '\n' ' ') "
fi

missing=()
for entry in "${wanted[@]}"; do
    found=no
    for name in ${entry//|/ }; do
        [[ $installed != *" $name "* ]] || found=yes
    done
    [[ $found == yes || " ${missing[*]-} " == *" ${entry%%|*} "* ]] || missing+=("${entry%%|*}")
done
((${#missing[@]})) || exit 0

# shellcheck source=/dev/null
system=$(. /etc/os-release 2> /dev/null && echo "${ID-} ${VERSION_ID-}") || system=unknown
if [[ $system != "debian 12" ]] || ! command -v apt-get > /dev/null; then
    echo "setup.sh: this is not Debian 12; please install what Debian calls: ${missing[*]}" >&2
    echo "setup.sh: or set SPATE_SETUP=off if all of it is there under other names" >&2
    exit 2
fi
as_root=()
if ((EUID != 0)); then
    command -v sudo > /dev/null || {
        echo "setup.sh: neither root nor sudo; please let root install: ${missing[*]}" >&2
        exit 2
    }
    as_root=(sudo)
fi

echo "setup.sh: installing ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt_install()
{
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        -o DPkg::Lock::Timeout=300 "${missing[@]}" > "$log" 2>&1
}
# The lists of packages may be absent or old: refresh them, then install.
if ! { "${as_root[@]}" apt-get update > "$log" 2>&1 && apt_install; } && ! apt_install; then
    tail -n 20 "$log" >&2
    echo "setup.sh: apt-get could not install ${missing[*]}" >&2
    exit 1
fi
