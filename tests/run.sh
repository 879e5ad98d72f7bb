#!/usr/bin/env bash
# Sets up, configures, builds and runs the tests; the exit code is that of the first step that fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage()
{
    cat <<'END'
usage: bash tests/run.sh [options]

  --long               also the tests whose suite begins with Long (minutes to hours); all compiled with -O3, not -O1
  --compiler NAME      gcc (default) or clang
  --preset NAME        gcc, clang, asan-ubsan or tsan; builds in build/NAME
  --suites "NAME..."   build and run only these folders of tests/, such as "core kernel"
  --filter REGEX       run only the tests whose name matches, such as kernel/WendlandC2
END
}

preset=gcc suites="" arguments=() long=no
fail()
{
    echo "run.sh: $1" >&2
    exit 2
}
while (($#)); do
    case $1 in
        --long) long=yes; shift; continue ;;
        --help | -h) usage; exit 0 ;;
        --compiler | --preset | --suites | --filter) (($# > 1)) || fail "$1 needs a value" ;;
        *) fail "unknown option $1 (see --help)" ;;
    esac
    case $1 in
        --compiler)
            [[ $2 == gcc || $2 == clang ]] || fail "--compiler $2: choose gcc or clang"
            preset=$2
            ;;
        --preset)
            [[ " gcc clang asan-ubsan tsan " == *" $2 "* ]] || fail "--preset $2: choose gcc, clang, asan-ubsan or tsan"
            preset=$2
            ;;
        --suites) suites=$2 ;;
        --filter) arguments+=(-R "$2") ;;
    esac
    shift 2
done
[[ $long == yes ]] || arguments+=(-LE '^long$')

needs=(--with tests)
[[ $preset == gcc ]] || needs+=(--with clang)
bash tools/setup.sh "${needs[@]}"

# Two jobs at most: one may take a gigabyte.
jobs=$(nproc)
((jobs <= 2)) || jobs=2
quick=ON
[[ $long == no ]] || quick=OFF
cmake --preset "$preset" -D SPATE_QUICK_TESTS=$quick > /dev/null
targets=()
if [[ -n $suites ]]; then
    read -ra names <<< "$suites"
    for name in "${names[@]}"; do
        case $name in
            compile | consumer | includes | instructions | bench) targets+=(spate_precompiled) ;;
            thread_sanitizer) targets+=(thread_sanitizer_race thread_sanitizer_clean) ;;
            *) targets+=("test_$name") ;;
        esac
    done
    arguments+=(-L "^($(IFS='|'; echo "${names[*]}"))\$")
    targets=(--target "${targets[@]}")
fi
cmake --build --preset "$preset" -j "$jobs" "${targets[@]}"
ctest --preset "$preset" -j "$jobs" "${arguments[@]}"
