#!/usr/bin/env bash
# Builds one benchmark, runs it, keeps its figures as build/bench/NAME.json, prints its table and draws its plot.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

names=()
for file in bench/*.cpp; do
    [[ ! -f $file ]] || names+=("$(basename "$file" .cpp)")
done
names+=(compile_time work_precision advise scaling validation)
usage()
{
    cat <<END
usage: bash bench/run.sh NAME [options of Google Benchmark]
       bash bench/run.sh work_precision [--set paper] [--figures W1,...]
       bash bench/run.sh scaling [--only count|measure|diaries|page] [--anew]
       bash bench/run.sh advise --case taylor_green --error 0.01 | --budget 10s
       bash bench/run.sh validation [--long] [--only V15,...]

NAME is one of: ${names[*]}
Writes build/bench/NAME.json, and its plot beside it where there is one. What each measures: bench/README.md.
END
}

case ${1-} in
    --help | -h) usage; exit 0 ;;
    "") usage >&2; exit 2 ;;
esac
name=$1
shift
[[ " ${names[*]} " == *" $name "* ]] || {
    echo "run.sh: there is no benchmark $name; choose one of: ${names[*]}" >&2
    exit 2
}

bash tools/setup.sh --with bench
by_python=no
tool=bench/work_precision/$name.py
if [[ $name == work_precision || $name == advise || $name == scaling ]]; then
    by_python=yes
    [[ $name == advise ]] || tool=bench/$name/run.py
    case " $* " in # nothing to build for
        *" --help "* | *" -h "* | *" --page-only "* | *" --dry "*) exec /usr/bin/python3 -B "$tool" "$@" ;;
    esac
fi
if [[ $name == compile_time ]]; then
    bash tools/setup.sh --with examples --with clang
    exec bash bench/compile_time.sh "$@"
fi
if [[ $name == validation ]]; then
    case " $* " in # nothing to build for
        *" --help "* | *" -h "* | *" --page-only "*) exec /usr/bin/python3 -B bench/validation/run.py "$@" ;;
    esac
    bash tools/setup.sh --with tests
    cmake --preset gcc -D SPATE_QUICK_TESTS=OFF > /dev/null
    folders=$(grep -oE '\b(kernel|cells|physics|boundary|integrator|order|oracle|models):' bench/validation/cases.csv | tr -d : | sort -u)
    # shellcheck disable=SC2086
    cmake --build --preset gcc -j 2 --target $(printf 'test_%s ' $folders)
    exec /usr/bin/python3 -B bench/validation/run.py "$@"
fi
target=bench_$name
[[ $name != advise ]] || target=bench_work_precision
if [[ $by_python == no ]]; then
    cmake --preset bench > /dev/null
    cmake --build --preset bench --target "$target"
    [[ $name != cell_size ]] || cmake --build --preset bench --target bench_scaling_on_processes
else # not part of what they print
    mkdir -p build/bench
    { cmake --preset bench && cmake --build --preset bench -j 2 --target "$target"; } > build/bench/build.log 2>&1 || {
        tail -n 30 build/bench/build.log >&2
        exit 1
    }
fi
# As examples/run.sh: libgomp's spinning barriers cost milliseconds on a busy core, sleeping at once costs a tenth of the speed.
[[ -v OMP_WAIT_POLICY ]] || export OMP_WAIT_POLICY=passive GOMP_SPINCOUNT=10000
json=build/bench/$name.json
executable=$(find build/bench -name "$target" -type f -perm -u+x | head -n 1)

# What a figure is worth without: the machine, the compiler, the commit.
cpu=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo 2> /dev/null | head -n 1 | tr ',=' '  ') || cpu=
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/bench/CMakeCache.txt | head -n 1)
compiler="$(basename "$compiler") $("$compiler" -dumpfullversion 2> /dev/null || "$compiler" -dumpversion)"
commit=$(git describe --always --dirty=+ 2> /dev/null) || commit=unknown
if [[ $by_python == yes ]]; then
    exec /usr/bin/python3 -B "$tool" --executable "$executable" \
        --context "{\"cpu\": \"${cpu:-unknown} ($(nproc) cores)\", \"compiler\": \"$compiler\", \"commit\": \"$commit\"}" "$@"
fi
log=build/bench/$name.log
echo "run.sh: running $executable, log in $log" >&2
"$executable" --benchmark_context="cpu=${cpu:-unknown},compiler=$compiler,commit=$commit" \
    --benchmark_out="$json" --benchmark_out_format=json "$@" > "$log" 2>&1 || {
    tail -n 20 "$log" >&2
    exit 1
}
sed -i '/"host_name"/d' "$json"
echo "figures: $json"
if [[ $name == term_deleted ]]; then
    /usr/bin/python3 bench/instructions.py "$executable" > build/bench/instructions.txt
fi
/usr/bin/python3 bench/plot.py "$name"
if [[ $name == cell_size ]]; then # and whole steps of both seed cases
    /usr/bin/python3 -B bench/scaling/run.py --only cells --anew \
        --context "{\"cpu\": \"${cpu:-unknown} ($(nproc) cores)\", \"compiler\": \"$compiler\", \"commit\": \"$commit\"}"
fi
